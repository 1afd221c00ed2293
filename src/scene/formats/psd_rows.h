// The samples of one channel of a Photoshop file, row by row.
#pragma once

#include <memory>
#include <vector>

#include "scene/formats/file_bytes.h"

namespace holomorph {

/// How the samples of a channel are stored, with the numbers that this has in the file.
enum class PsdPacking { none = 0, run_lengths = 1, zip = 2, zip_differences = 3 };

/// Where the samples of a channel are.
struct PsdSamples {
  PsdPacking packing = PsdPacking::none;
  size_t place = 0, end = 0;
  size_t lengths = 0;  ///< with run lengths, where the lengths of the rows are
  size_t width = 0, height = 0;
  int depth = 8;  ///< bits: 1, 8 or 16

  size_t bytes_per_row() const { return (width * static_cast<size_t>(depth) + 7) / 8; }
};

/// The packing with this number in the file. Throws Error{bad_input} if it is unknown.
PsdPacking packing_of(const FileBytes& file, size_t number);

/// Unpacks a channel from the top. Throws Error{bad_input} if the file is damaged.
class PsdRows {
 public:
  /// `file` must outlive it.
  PsdRows(const FileBytes& file, const PsdSamples& samples);
  ~PsdRows();
  PsdRows(PsdRows&&) noexcept;

  /// The samples of the next row: 0 to 255, or 0 to 65535 with 16 bits. Bits are 0 or 255, where 0
  /// is ink.
  const std::vector<std::uint16_t>& next();
  /// Passes over rows.
  void skip(size_t rows);

 private:
  struct Inflater;
  void advance();
  void unpack(size_t length);

  const FileBytes* file_;
  PsdSamples samples_;
  size_t row_ = 0;
  std::vector<std::uint8_t> bytes_;  ///< of the row
  std::vector<std::uint16_t> values_;
  std::unique_ptr<Inflater> inflater_;
};

}  // namespace holomorph
