// What opening a file has changed: what was left out, merged, converted or cut off.
#pragma once

#include <string>
#include <vector>

namespace holomorph {

/// Something that is not as in the program that wrote the file.
struct ImportNote {
  std::string layer;  ///< its name; empty: the whole file
  std::string text;   ///< such as "left out: its effects"
  bool operator==(const ImportNote&) const = default;
};

/// The notes about a file, in the order of its layers.
struct ImportReport {
  std::string file;  ///< its name, without the folder
  std::vector<ImportNote> notes;

  void add(const std::string& layer, const std::string& text) { notes.push_back({layer, text}); }
  void add(const ImportReport& other) {
    notes.insert(notes.end(), other.notes.begin(), other.notes.end());
  }
  /// A line for each note, such as "Hat: left out: its effects" or "a.gif: only the first of its 12
  /// pictures is opened". Beyond `most` notes, the last line says how many more there are.
  std::string text(size_t most = ~size_t{0}) const;
};

}  // namespace holomorph
