// Writes PSD files; psd_image.cpp reads them. All numbers have their highest byte first.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "scene/formats/psd_image.h"

namespace holomorph {
namespace {

constexpr int kRuns = 1;                    ///< the compression by run lengths
constexpr int kChannels[] = {-1, 0, 1, 2};  ///< of a layer: alpha and colors

void put(std::string& bytes, size_t value, int count) {
  for (int k = count; k-- > 0;) bytes += static_cast<char>(value >> (8 * k) & 255);
}
void put_signed(std::string& bytes, int value, int count) {
  put(bytes, static_cast<size_t>(static_cast<long>(value)), count);
}
void check_size(const std::string& bytes) {
  if (bytes.size() > size_t{std::numeric_limits<int>::max()})
    throw Error(ErrorKind::failed,
                "the picture is too large for a PSD file; use OpenRaster (.ora)");
}

/// A section after its length.
void put_section(std::string& bytes, const std::string& section) {
  check_size(section);
  put(bytes, section.size(), 4);
  bytes += section;
}

/// A row as run lengths (PackBits).
std::string packed(const std::uint8_t* row, size_t width) {
  constexpr size_t kLongest = 128;
  std::string bytes;
  size_t literal = 0;  // the first value that has not been written
  const auto put_literal = [&](size_t end) {
    while (literal < end) {
      const size_t count = std::min(kLongest, end - literal);
      bytes += static_cast<char>(count - 1);
      bytes.append(reinterpret_cast<const char*>(row + literal), count);
      literal += count;
    }
  };
  for (size_t i = 0; i < width;) {
    size_t run = 1;
    while (run < kLongest && i + run < width && row[i + run] == row[i]) ++run;
    if (run >= 3) {
      put_literal(i);
      bytes += static_cast<char>(257 - run);
      bytes += static_cast<char>(row[i]);
      literal = i + run;
    }
    i += run;
  }
  put_literal(width);
  return bytes;
}

/// The packed rows of one component of an image, after a table of their lengths.
struct PackedRows {
  std::string lengths, rows;
};
template <class Value>
PackedRows packed_rows(const Image& image, Value value) {
  PackedRows all;
  std::vector<std::uint8_t> row(static_cast<size_t>(image.width));
  for (int r = 0; r < image.height; ++r) {
    for (int c = 0; c < image.width; ++c) row[static_cast<size_t>(c)] = value(image.at(c, r));
    const std::string bytes = packed(row.data(), row.size());
    put(all.lengths, bytes.size(), 2);
    all.rows += bytes;
  }
  return all;
}

std::string channel_data(const Image& image, int channel) {
  const size_t component = channel < 0 ? 3 : static_cast<size_t>(channel);
  const PackedRows rows =
      packed_rows(image, [component](const std::uint8_t* pixel) { return pixel[component]; });
  std::string bytes;
  put(bytes, kRuns, 2);
  return bytes + rows.lengths + rows.rows;
}

/// The UTF-16 code units of a text.
std::vector<unsigned> utf16(const std::string& text) {
  std::vector<unsigned> units;
  for (size_t i = 0; i < text.size();) {
    const auto byte = [&](size_t k) {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u;
    };
    const unsigned head = byte(0);
    const size_t length = head < 0x80 ? 1 : head < 0xe0 ? 2 : head < 0xf0 ? 3 : 4;
    unsigned code = length == 1 ? head : head & (0x7f >> length);
    for (size_t k = 1; k < length; ++k) code = code << 6 | (byte(k) & 63);
    i += length;
    if (code >= 0x10000) {
      units.push_back(0xd800 + ((code - 0x10000) >> 10 & 0x3ff));
      code = 0xdc00 + (code & 0x3ff);
    }
    units.push_back(code);
  }
  return units;
}

void put_name(std::string& bytes, const std::string& name) {
  constexpr size_t kLongest = 255;
  std::string plain = name.substr(0, kLongest);
  for (char& c : plain)
    if (c < ' ' || c == 127) c = '?';
  put(bytes, plain.size(), 1);
  bytes += plain;
  bytes.append(3 - plain.size() % 4, '\0');
}

void put_block(std::string& bytes, const std::string& key, std::string content) {
  if (content.size() % 2 == 1) content += '\0';
  bytes += "8BIM" + key;
  put_section(bytes, content);
}

const char* key_of(Blending blending) {
  switch (blending) {
    case Blending::multiply:
      return "mul ";
    case Blending::screen:
      return "scrn";
    case Blending::overlay:
      return "over";
    case Blending::add:
      return "lddg";
    case Blending::normal:
      break;
  }
  return "norm";
}

/// What a record stands for; the numbers are those of the block lsct.
enum class RecordKind { layer = 0, group = 1, divider = 3 };

/// The record of a layer whose channels have these lengths in the file.
std::string record_of(const DrawnLayer& layer, size_t number, const std::vector<size_t>& lengths,
                      RecordKind section) {
  std::string bytes;
  for (const int x :
       {layer.top, layer.left, layer.top + layer.image.height, layer.left + layer.image.width})
    put_signed(bytes, x, 4);
  put(bytes, std::size(kChannels), 2);
  for (size_t k = 0; k < std::size(kChannels); ++k) {
    put_signed(bytes, kChannels[k], 2);
    put(bytes, lengths[k], 4);
  }
  bytes += std::string("8BIM") + key_of(layer.blending);
  put(bytes, static_cast<size_t>(std::lround(255 * layer.opacity)), 1);
  put(bytes, layer.clipped, 1);
  constexpr size_t kHidden = 2, kModern = 8;
  put(bytes, kModern | (layer.visible ? 0 : kHidden), 1);
  put(bytes, 0, 1);
  std::string extra(8, '\0');  // no mask and no blending ranges
  put_name(extra, layer.name);
  std::string name;
  const std::vector<unsigned> units = utf16(layer.name);
  put(name, units.size(), 4);
  for (const unsigned unit : units) put(name, unit, 2);
  put_block(extra, "luni", name);
  std::string id;
  put(id, number + 1, 4);
  put_block(extra, "lyid", id);
  put_block(extra, "clbl", std::string("\1\0\0\0", 4));  // what is clipped to it blends with it
  if (section != RecordKind::layer) {
    std::string kind;
    put(kind, static_cast<size_t>(section), 4);
    put_block(extra, "lsct", kind + "8BIMnorm");
  }
  put_section(bytes, extra);
  return bytes;
}

std::string layer_section(const LayeredPicture& picture) {
  std::string records, channels;
  int count = 0;
  const auto add = [&](const DrawnLayer& layer, RecordKind section = RecordKind::layer) {
    std::vector<size_t> lengths;
    for (const int channel : kChannels) {
      const std::string data = channel_data(layer.image, channel);
      lengths.push_back(data.size());
      channels += data;
    }
    records += record_of(layer, static_cast<size_t>(count++), lengths, section);
  };
  const bool groups = needs_group(picture);
  DrawnLayer divider, group;
  divider.name = "</Layer group>";
  group.name = "Layers";
  if (picture.background) add(background_layer(picture));
  for (const DrawnLayer& original : picture.originals) add(original);
  if (groups) add(divider, RecordKind::divider);
  for (const DrawnLayer& layer : picture.layers) add(layer);
  if (groups) add(group, RecordKind::group);
  std::string info;
  // A negative count says that the merged picture has an alpha channel.
  put_signed(info, -count, 2);
  info += records + channels;
  if (info.size() % 2 == 1) info += '\0';
  std::string section;
  put_section(section, info);
  put(section, 0, 4);  // no global mask
  return section;
}

/// The merged picture. Programs expect its colors as they look on white.
std::string merged_data(const Image& image) {
  std::string lengths, rows;
  for (const size_t component : {0, 1, 2, 3}) {
    const PackedRows packed =
        packed_rows(image, [component](const std::uint8_t* pixel) -> std::uint8_t {
          if (component == 3) return pixel[3];
          const int alpha = pixel[3];
          return static_cast<std::uint8_t>((pixel[component] * alpha + 255 * (255 - alpha) + 127) /
                                           255);
        });
    lengths += packed.lengths;
    rows += packed.rows;
  }
  std::string bytes;
  put(bytes, kRuns, 2);
  return bytes + lengths + rows;
}

}  // namespace

std::string encode_psd(const LayeredPicture& picture) {
  constexpr size_t kDepth = 8, kRgb = 3;
  std::string bytes = "8BPS";
  put(bytes, 1, 2);
  bytes.append(6, '\0');
  put(bytes, std::size(kChannels), 2);
  put(bytes, static_cast<size_t>(picture.merged.height), 4);
  put(bytes, static_cast<size_t>(picture.merged.width), 4);
  put(bytes, kDepth, 2);
  put(bytes, kRgb, 2);
  put(bytes, 0, 4);  // no color table
  put(bytes, 0, 4);  // no resources
  put_section(bytes, layer_section(picture));
  bytes += merged_data(picture.merged);
  check_size(bytes);
  return bytes;
}

}  // namespace holomorph
