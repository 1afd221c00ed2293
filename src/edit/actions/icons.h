// Glyphs of Font Awesome 4.
#pragma once

namespace holomorph {

inline constexpr const char *kAdd = "\uf067", *kAngle = "\uf14e", *kBack = "\uf048",
                            *kDouble = "\uf24d", *kDown = "\uf063", *kExport = "\uf1c5",
                            *kFilm = "\uf008", *kFirst = "\uf049", *kFit = "\uf065",
                            *kForward = "\uf051", *kHalves = "\uf042", *kHelp = "\uf059",
                            *kKey = "\uf084", *kLast = "\uf050", *kLoop = "\uf079",
                            *kMagic = "\uf0d0", *kMove = "\uf047", *kNew = "\uf016",
                            *kOnion = "\uf24d", *kOpen = "\uf07c", *kOutline = "\uf044",
                            *kPen = "\uf040", *kPin = "\uf08d", *kPlay = "\uf04b",
                            *kPointer = "\uf245", *kRecord = "\uf111", *kRedo = "\uf01e",
                            *kReset = "\uf0e2", *kSave = "\uf0c7", *kSearch = "\uf002",
                            *kShield = "\uf132", *kSnap = "\uf076", *kSoft = "\uf192",
                            *kStroke = "\uf1fc", *kSymmetry = "\uf0ec", *kTrash = "\uf1f8",
                            *kUndo = "\uf0e2", *kUp = "\uf062";

}  // namespace holomorph
