// The structure of Photoshop files (Adobe Photoshop File Formats Specification, 2019). A file
// consists of a header, the color table, resources, the layers, and the merged picture. Numbers
// have their highest byte first.
#pragma once

#include <optional>

#include "scene/formats/file_bytes.h"
#include "scene/formats/layered.h"

namespace holomorph {

/// Pixels from the upper left corner of the canvas.
struct PsdBounds {
  int top = 0, left = 0, bottom = 0, right = 0;
  size_t width() const { return static_cast<size_t>(std::max(0, right - left)); }
  size_t height() const { return static_cast<size_t>(std::max(0, bottom - top)); }
};

struct PsdChannel {
  static constexpr int kAlpha = -1, kMask = -2;
  int id = 0;  ///< kAlpha, kMask, or the number of a color
  size_t place = 0, length = 0;
};

enum class PsdSection { layer, group, divider };

/// What the file says about a layer or about the end of a group.
struct PsdRecord {
  PsdBounds bounds;
  std::vector<PsdChannel> channels;
  FileLayer layer;
  bool pass_through = false;  ///< a group whose layers blend with what is below the group
  PsdSection section = PsdSection::layer;
  bool skipped = false;         ///< has no pixels of its own
  bool splits_clipped = false;  ///< what is clipped to it also blends with what is below it
  std::optional<PsdBounds> mask;
  std::uint8_t outside_mask = 255;

  const PsdChannel* channel(int id) const;  ///< null if there is none
};

/// The color modes, with the numbers that they have in the file.
enum class PsdMode { bitmap = 0, gray = 1, indexed = 2, rgb = 3, cmyk = 4, duotone = 8, lab = 9 };

struct PsdFile {
  size_t width = 0, height = 0;
  int depth = 8;        ///< bits of a sample: 1, 8 or 16
  size_t channels = 0;  ///< of the merged picture
  PsdMode mode = PsdMode::rgb;
  std::string palette;                ///< of an indexed picture: 256 red values, and so on
  std::optional<size_t> transparent;  ///< the color of an indexed picture that is transparent
  std::string profile;
  std::vector<PsdRecord> records;  ///< from bottom to top
  size_t merged = 0;               ///< where the merged picture begins

  /// The layers say that the first extra channel of the merged picture is its transparency. Files
  /// without layers do not tell.
  bool says_alpha = true;
  bool has_merged_alpha() const {
    return says_alpha && channels > colors() && mode != PsdMode::indexed;
  }

  /// The number of channels that are colors.
  size_t colors() const {
    return mode == PsdMode::cmyk ? 4 : mode == PsdMode::rgb || mode == PsdMode::lab ? 3 : 1;
  }
};

/// Reads everything but the pixels. Throws Error{bad_input}, also for large documents (PSB), for
/// other color modes and for 32 bits.
PsdFile read_psd(const FileBytes& file);

}  // namespace holomorph
