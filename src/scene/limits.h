// Limits on the contents of a scene. Readers and edits reject larger values.
#pragma once

#include <cstddef>

namespace holomorph {

inline constexpr double kMaxCoordinate = 1e8;  ///< absolute value of x and y, in plane units
inline constexpr size_t kMaxLayers = 400;
inline constexpr int kMaxImageSide = 1 << 20;  ///< pixels
inline constexpr size_t kMaxSegments = 5000;   ///< in one cage
inline constexpr size_t kMaxHoles = 100;       ///< in one cage
inline constexpr size_t kMaxParts = 100;       ///< of one cage
inline constexpr size_t kMaxPins = 2000, kMaxStrokes = 200;
inline constexpr size_t kMaxCurvePoints = 20000;  ///< in one stroke or outline
inline constexpr int kMaxId = 1'000'000'000;      ///< of layers, pins and strokes
inline constexpr double kMinPlacementScale = 1e-6, kMaxPlacementScale = 1e6;
inline constexpr double kMaxDabLevel = 10;     ///< powers of ten, in absolute value
inline constexpr double kMaxCornerTurn = 1e3;  ///< radians: 159 full turns
inline constexpr double kMaxPinTurn = 1e5;     ///< radians
inline constexpr int kMaxDepth = 1000;         ///< of a pin, in absolute value
inline constexpr double kMaxTime = 3600;       ///< seconds
inline constexpr double kMinFrameRate = 1, kMaxFrameRate = 240;  ///< per second
inline constexpr int kMaxFilmFrames = 1'000'000'000;             ///< of a film that is a picture
inline constexpr int kMaxTurns = 150;                            ///< between two keyframes
inline constexpr size_t kMaxKeyframes = 2000;

}  // namespace holomorph
