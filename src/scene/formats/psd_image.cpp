// Adobe Photoshop File Formats Specification, 2019. Numbers have their highest byte first. A file
// consists of a header, the color table, resources, the layers, and the merged picture.
#include "scene/formats/psd_image.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/file_bytes.h"
#include "scene/formats/to_srgb.h"

namespace holomorph {
namespace {

constexpr size_t kDeepestPsdGroup = 50;  ///< levels of groups
constexpr int kMostRecords = 8000;       ///< layers, and the ends of groups
constexpr size_t kRunLengths = 1;        ///< the compression by run lengths; 0 is none
constexpr int kFarthestEdge = 1 << 24;   ///< largest coordinate of a layer

struct BlendingKey {
  const char* key;
  Blending blending;
};
constexpr BlendingKey kBlendingKeys[] = {{"norm", Blending::normal},
                                         {"mul ", Blending::multiply},
                                         {"scrn", Blending::screen},
                                         {"over", Blending::overlay},
                                         {"lddg", Blending::add}};

/// Tagged blocks of layers that only change the colors below them or fill areas.
constexpr const char* kAdjustments[] = {"SoCo", "GdFl", "PtFl", "brit", "levl", "curv", "expA",
                                        "vibA", "hue ", "hue2", "blnc", "blwh", "phfl", "mixr",
                                        "clrL", "nvrt", "post", "thrs", "grdm", "selc"};

struct PsdBounds {
  int top = 0, left = 0, bottom = 0, right = 0;
  size_t width() const { return static_cast<size_t>(std::max(0, right - left)); }
  size_t height() const { return static_cast<size_t>(std::max(0, bottom - top)); }
};

struct Channel {
  int id = 0;  ///< 0 to 2: colors; -1: alpha; -2: mask
  size_t place = 0, length = 0;
};

enum class Section { layer, group, divider };

/// What the file says about a layer or about the end of a group.
struct Record {
  PsdBounds bounds;
  std::vector<Channel> channels;
  FileLayer layer;
  bool pass_through = false;  ///< a group whose layers blend with what is below the group
  Section section = Section::layer;
  bool skipped = false;  ///< has no pixels of its own
  std::optional<PsdBounds> mask;
  std::uint8_t outside_mask = 255;
};

struct PsdCanvas {
  size_t width = 0, height = 0;
  bool gray = false;
  std::string profile;
};

struct Psd {
  PsdCanvas canvas;
  std::vector<Record> records;  ///< from bottom to top
  std::string unreadable;       ///< why its layers cannot be read
};

void add_lost(std::string& lost, const std::string& what) {
  if (lost.find(what) == std::string::npos) lost += (lost.empty() ? "" : ", ") + what;
}

void append_utf8(std::string& text, unsigned code) {
  const auto put = [&](unsigned byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return put(code);
  if (code < 0x800) {
    put(0xc0 | code >> 6);
  } else {
    if (code < 0x10000) {
      put(0xe0 | code >> 12);
    } else {
      put(0xf0 | code >> 18);
      put(0x80 | (code >> 12 & 63));
    }
    put(0x80 | (code >> 6 & 63));
  }
  put(0x80 | (code & 63));
}

/// A text of UTF-16 code units after their count. Half surrogate pairs become question marks.
std::string unicode_text(const FileBytes& file, size_t place, size_t end) {
  constexpr size_t kLongest = 255;
  if (end - place < 4 || file.big(place, 4) > (end - place - 4) / 2)
    file.damaged("a name is too long");
  const size_t count = std::min(kLongest, file.big(place, 4));
  std::string text;
  for (size_t i = 0; i < count; ++i) {
    unsigned code = static_cast<unsigned>(file.big(place + 4 + 2 * i, 2));
    if (code >= 0xd800 && code < 0xe000) {
      const unsigned low =
          i + 1 < count ? static_cast<unsigned>(file.big(place + 6 + 2 * i, 2)) : 0;
      const bool pair = code < 0xdc00 && low >= 0xdc00 && low < 0xe000;
      code = pair ? 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00) : '?';
      i += pair;
    }
    if (code != 0) append_utf8(text, code);
  }
  return text;
}

PsdBounds read_bounds(const FileBytes& file, size_t place) {
  const PsdBounds bounds{file.big_signed(place), file.big_signed(place + 4),
                         file.big_signed(place + 8), file.big_signed(place + 12)};
  for (const int x : {bounds.top, bounds.left, bounds.bottom, bounds.right})
    if (std::abs(static_cast<long>(x)) > kFarthestEdge) file.damaged("a layer lies too far away");
  return bounds;
}

void read_mask(const FileBytes& file, size_t place, size_t length, Record& record) {
  if (length < 18) return;
  const bool disabled = file.at(place + 17) & 2;
  if (disabled) return;
  record.mask = read_bounds(file, place);
  record.outside_mask = static_cast<std::uint8_t>(file.at(place + 16));
}

void read_block(const FileBytes& file, const std::string& key, size_t place, size_t end,
                Record& record) {
  FileLayer& layer = record.layer;
  if (key == "luni") layer.name = unicode_text(file, place, end);
  const size_t length = end - place;
  if (key == "lyid" && length >= 4) layer.entry = "id:" + std::to_string(file.big(place, 4));
  if ((key == "lsct" || key == "lsdk") && length >= 4) {
    const size_t kind = file.big(place, 4);
    if (kind == 1 || kind == 2) record.section = Section::group;
    if (kind == 3) record.section = Section::divider;
    if (length >= 12) record.pass_through = file.text(place + 8, 4) == "pass";
  }
  if (key == "iOpa" && length >= 1) layer.opacity *= static_cast<double>(file.at(place)) / 255;
  if (key == "lfx2" || key == "lrFX" || key == "lmfx") add_lost(layer.lost, "its effects");
  if (key == "vmsk" || key == "vsms") add_lost(layer.lost, "its vector mask");
  if (key == "SoLd" || key == "SoLE" || key == "PlLd")
    add_lost(layer.lost, "its smart object, of which only the pixels are kept");
  if (std::ranges::find(kAdjustments, key) != std::end(kAdjustments)) record.skipped = true;
}

/// Reads the record at `place` and moves `place` behind it.
Record read_record(const FileBytes& file, size_t& place) {
  Record record;
  record.bounds = read_bounds(file, place);
  const size_t channels = file.big(place + 16, 2);
  place += 18;
  for (size_t k = 0; k < channels; ++k, place += 6)
    record.channels.push_back(
        {static_cast<std::int16_t>(file.big(place, 2)), 0, file.big(place + 2, 4)});
  if (file.text(place, 4) != "8BIM") file.damaged("a layer has no signature");
  FileLayer& layer = record.layer;
  const std::string key = file.text(place + 4, 4);
  const auto known = std::ranges::find(kBlendingKeys, key, &BlendingKey::key);
  if (known != std::end(kBlendingKeys))
    layer.blending = known->blending;
  else if (key != "pass")
    add_lost(layer.lost, "its blending mode");
  layer.opacity = static_cast<double>(file.at(place + 8)) / 255;
  layer.clipped = file.at(place + 9) != 0;
  layer.visible = (file.at(place + 10) & 2) == 0;
  const size_t end = place + 16 + file.big(place + 12, 4);
  place += 16;
  file.need(place, end - place);
  const auto skip = [&](size_t length) {
    if (length > end - place) file.damaged("the parts of a layer are longer than the layer");
    place += length;
  };
  const size_t mask = file.big(place, 4);
  read_mask(file, place + 4, mask, record);
  skip(4 + mask);
  skip(4 + file.big(place, 4));  // blending ranges
  const size_t name = file.at(place);
  for (const char c : file.text(place + 1, name))
    layer.name += c >= ' ' && c < 127 ? c : '?';  // the encoding is not known
  skip((1 + name + 3) / 4 * 4);
  while (end - place >= 12) {
    const size_t length = file.big(place + 8, 4), block = place + 12;
    const std::string tag = file.text(place + 4, 4);
    skip(12);
    if (length > end - place) file.damaged("a block of a layer is too long");
    read_block(file, tag, block, block + length, record);
    place += std::min(end - place, length + length % 2);
  }
  place = end;
  return record;
}

/// The color profile among the resources.
std::string read_profile(const FileBytes& file, size_t place, size_t end) {
  constexpr size_t kProfile = 1039;
  while (place + 12 <= end) {
    const size_t id = file.big(place + 4, 2), name = file.at(place + 6);
    place += 6 + (name + 2) / 2 * 2;
    const size_t length = file.big(place, 4);
    place += 4;
    if (id == kProfile) return file.text(place, length);
    file.need(place, length);
    place += length + length % 2;
  }
  return "";
}

Psd read_psd(const std::string& bytes, const std::string& name) {
  const FileBytes file(bytes, name);
  Psd psd;
  const size_t version = file.big(4, 2), depth = file.big(22, 2), mode = file.big(24, 2);
  constexpr size_t kGray = 1, kRgb = 3;
  psd.canvas = {file.big(18, 4), file.big(14, 4), mode == kGray, ""};
  if (version != 1) psd.unreadable = "it is a large document (PSB)";
  if (depth != 8) psd.unreadable = "they have " + std::to_string(depth) + " bits per channel";
  if (mode != kGray && mode != kRgb) psd.unreadable = "their colors are neither RGB nor gray";
  if (!psd.unreadable.empty()) return psd;
  size_t place = 26;
  const auto section = [&] {  // returns the end of the section that starts at `place`
    const size_t length = file.big(place, 4);
    place += 4;
    file.need(place, length);
    return place + length;
  };
  place = section();  // the color table
  const size_t resources_end = section();
  psd.canvas.profile = read_profile(file, place, resources_end);
  place = resources_end;
  const size_t layers_end = section();
  if (layers_end - place < 6 || file.big(place, 4) < 2) return psd;
  place += 4;
  const int count = std::abs(static_cast<int>(static_cast<std::int16_t>(file.big(place, 2))));
  place += 2;
  if (count > kMostRecords) file.damaged("it has too many layers");
  for (int i = 0; i < count; ++i) psd.records.push_back(read_record(file, place));
  std::map<std::string, int> ids;
  for (const Record& record : psd.records)
    if (record.section == Section::layer) ++ids[record.layer.entry];
  for (size_t i = 0; i < psd.records.size(); ++i) {
    Record& record = psd.records[i];
    std::string& entry = record.layer.entry;
    const bool is_layer = record.section == Section::layer;
    if (!is_layer)
      entry.clear();
    else if (entry.empty() || ids[entry] > 1)
      entry = "layer:" + std::to_string(i);
    for (Channel& channel : record.channels) {
      file.need(place, channel.length);
      channel.place = place;
      if (is_layer && channel.length >= 2 && file.big(place, 2) > kRunLengths)
        psd.unreadable = "they are compressed by ZIP";
      place += channel.length;
    }
  }
  return psd;
}

/// A layer, or a group with what it contains.
struct Node {
  const Record* record = nullptr;
  std::vector<Node> children;  ///< from bottom to top
};

std::vector<Node> tree_of(const Psd& psd, const FileBytes& file) {
  std::vector<std::vector<Node>> open(1);
  for (const Record& record : psd.records) {
    if (record.section == Section::divider) {
      open.emplace_back();
      if (open.size() > kDeepestPsdGroup) file.damaged("its groups are nested too deeply");
      continue;
    }
    Node node{&record, {}};
    if (record.section == Section::group) {
      if (open.size() < 2) file.damaged("a group has no beginning");
      node.children = std::move(open.back());
      open.pop_back();
    }
    open.back().push_back(std::move(node));
  }
  if (open.size() > 1) file.damaged("a group has no end");
  return std::move(open[0]);
}

/// Adds the layers of a group, which inherit its name, opacity and visibility.
void flatten(const std::vector<Node>& nodes, const FileLayer& group, FileLayers& all) {
  const auto lose = [&](const FileLayer& layer, const std::string& what) {
    constexpr size_t kLongest = 2000;
    if (all.warning.size() > kLongest) return;
    all.warning += (all.warning.empty() ? "" : "; ") + layer.name + ": " + what;
  };
  bool has_base = false;
  for (const Node& node : nodes) {
    FileLayer layer = node.record->layer;
    layer.name = group.name + layer.name;
    layer.visible = layer.visible && group.visible;
    const bool is_clipped = layer.clipped;
    const bool is_group = node.record->section == Section::group;
    if (node.record->skipped) {
      lose(layer, "the whole layer, because it is an adjustment or a fill");
      if (!is_clipped) has_base = false;
      continue;
    }
    if (is_clipped && (!has_base || is_group)) {
      lose(layer, "its clipping");
      layer.clipped = false;
    }
    if (is_group || !is_clipped) has_base = !is_group;
    // The opacity of the base, and thus of its groups, also applies to what is clipped to it.
    if (!layer.clipped) layer.opacity *= group.opacity;
    if (!layer.lost.empty()) lose(layer, layer.lost + (is_group ? " (of the group)" : ""));
    if (!is_group) {
      all.layers.push_back(std::move(layer));
      continue;
    }
    if (node.record->mask) lose(layer, "the mask of the group");
    const bool blends = std::ranges::any_of(node.children, [](const Node& child) {
      return child.record->layer.blending != Blending::normal;
    });
    if (layer.blending != Blending::normal || (blends && !node.record->pass_through))
      lose(layer, "the blending of the group");
    layer.name += "/";
    flatten(node.children, layer, all);
  }
}

/// Unpacks a row of run lengths (PackBits).
void unpack(const FileBytes& file, size_t place, size_t length, std::uint8_t* row, size_t width) {
  const std::uint8_t* from = file.data(place, length);
  size_t at = 0;
  for (size_t i = 0; i < length;) {
    const std::uint8_t head = from[i++];
    if (head == 128) continue;
    const bool repeats = head > 128;
    const size_t count = repeats ? 257u - head : head + 1u, taken = repeats ? 1 : count;
    if (taken > length - i || count > width - at) file.damaged("its rows have the wrong length");
    if (repeats)
      std::memset(row + at, from[i], count);
    else
      std::memcpy(row + at, from + i, count);
    at += count;
    i += taken;
  }
  if (at != width) file.damaged("its rows have the wrong length");
}

/// One channel in the part of its bounds that lies on the canvas.
struct Plane {
  PsdBounds kept;
  std::vector<std::uint8_t> values;
  std::uint8_t at(size_t column, size_t row) const { return values[row * kept.width() + column]; }
};

PsdBounds on_canvas(const PsdBounds& bounds, const PsdCanvas& canvas) {
  const int width = static_cast<int>(canvas.width), height = static_cast<int>(canvas.height);
  return {std::clamp(bounds.top, 0, height), std::clamp(bounds.left, 0, width),
          std::clamp(bounds.bottom, 0, height), std::clamp(bounds.right, 0, width)};
}

Plane plane_of(const FileBytes& file, const Channel& channel, const PsdBounds& bounds,
               const PsdCanvas& canvas) {
  Plane plane{on_canvas(bounds, canvas), {}};
  const size_t width = bounds.width(), height = bounds.height(), kept = plane.kept.width();
  if (kept == 0 || plane.kept.height() == 0) return plane;
  if (channel.length < 2) file.damaged("a channel is missing");
  const size_t packed = file.big(channel.place, 2), end = channel.place + channel.length;
  if (packed > kRunLengths) file.damaged("its compression is unknown");
  const size_t first_row = static_cast<size_t>(plane.kept.top - bounds.top),
               first_column = static_cast<size_t>(plane.kept.left - bounds.left);
  plane.values.resize(kept * plane.kept.height());
  size_t place = channel.place + 2;
  if (packed == 0) {
    if (width * height > end - place) file.damaged("a channel is too short");
    for (size_t r = 0; r < plane.kept.height(); ++r)
      std::memcpy(&plane.values[r * kept],
                  file.data(place + (first_row + r) * width + first_column, kept), kept);
    return plane;
  }
  if (2 * height > end - place) file.damaged("a channel is too short");
  const size_t lengths = place;
  place += 2 * height;
  std::vector<std::uint8_t> row(width);
  for (size_t r = 0; r < height; ++r) {
    const size_t length = file.big(lengths + 2 * r, 2);
    if (length > end - place) file.damaged("a channel is too short");
    if (r >= first_row && r - first_row < plane.kept.height()) {
      unpack(file, place, length, row.data(), width);
      std::memcpy(&plane.values[(r - first_row) * kept], &row[first_column], kept);
    }
    place += length;
  }
  return plane;
}

const Channel* channel_of(const Record& record, int id) {
  const auto found = std::ranges::find(record.channels, id, &Channel::id);
  return found == record.channels.end() ? nullptr : &*found;
}

/// Multiplies the alpha by the layer's mask.
void apply_mask(const FileBytes& file, const Record& record, const PsdCanvas& canvas,
                const PsdBounds& kept, Image& image) {
  const Channel* channel = channel_of(record, -2);
  if (!record.mask || !channel) return;
  const Plane mask = plane_of(file, *channel, *record.mask, canvas);
  for (int r = kept.top; r < kept.bottom; ++r)
    for (int c = kept.left; c < kept.right; ++c) {
      const bool inside =
          r >= mask.kept.top && r < mask.kept.bottom && c >= mask.kept.left && c < mask.kept.right;
      const unsigned level = inside ? mask.at(static_cast<size_t>(c - mask.kept.left),
                                              static_cast<size_t>(r - mask.kept.top))
                                    : record.outside_mask;
      std::uint8_t& alpha = image.at(c, r)[3];
      alpha = static_cast<std::uint8_t>((alpha * level + 127) / 255);
    }
}

}  // namespace

bool is_psd(const std::string& bytes) {
  return bytes.starts_with("8BPS");
}

FileLayers psd_layers(const std::string& bytes, const std::string& name) {
  const FileBytes file(bytes, name);
  const Psd psd = read_psd(bytes, name);
  FileLayers all;
  if (!psd.unreadable.empty()) {
    all.warning = "its layers, because " + psd.unreadable;
    return all;
  }
  flatten(tree_of(psd, file), {}, all);
  PixelBudget one;
  one.take(psd.canvas.width, psd.canvas.height, name);
  check_budget(&Budget::pixels,
               static_cast<double>(psd.canvas.width * psd.canvas.height * all.layers.size()),
               name + ": the layers have");
  return all;
}

Image decode_psd_layer(const std::string& bytes, const std::string& entry, const std::string& name,
                       PixelBudget& pixels) {
  const FileBytes file(bytes, name);
  const Psd psd = read_psd(bytes, name);
  const auto found = std::ranges::find_if(
      psd.records, [&](const Record& record) { return record.layer.entry == entry; });
  if (found == psd.records.end()) file.damaged("its layer " + entry + " no longer exists");
  const Record& record = *found;
  pixels.take(psd.canvas.width, psd.canvas.height, name);
  Image image(static_cast<int>(psd.canvas.width), static_cast<int>(psd.canvas.height));
  const PsdBounds kept = on_canvas(record.bounds, psd.canvas);
  const auto fill = [&](int id, std::initializer_list<int> components) {
    const Channel* channel = channel_of(record, id);
    if (!channel && id >= 0) file.damaged("a channel is missing");
    const Plane plane = channel ? plane_of(file, *channel, record.bounds, psd.canvas) : Plane{};
    for (int r = kept.top; r < kept.bottom; ++r)
      for (int c = kept.left; c < kept.right; ++c) {
        const std::uint8_t value = channel ? plane.at(static_cast<size_t>(c - kept.left),
                                                      static_cast<size_t>(r - kept.top))
                                           : 255;
        for (const int k : components) image.at(c, r)[k] = value;
      }
  };
  if (psd.canvas.gray) {
    fill(0, {0, 1, 2});
  } else {
    for (const int k : {0, 1, 2}) fill(k, {k});
  }
  fill(-1, {3});
  apply_mask(file, record, psd.canvas, kept, image);
  if (!psd.canvas.profile.empty()) to_srgb(image, psd.canvas.profile);
  return image;
}

}  // namespace holomorph
