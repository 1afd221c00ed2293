#include "scene/formats/psd_file.h"

#include <algorithm>
#include <array>
#include <map>

#include "system/text.h"

namespace holomorph {
namespace {

constexpr int kMostRecords = 8000;      ///< layers, and the ends of groups
constexpr int kFarthestEdge = 1 << 17;  ///< largest coordinate of a layer

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

void add_lost(std::string& lost, const std::string& what) {
  if (lost.find(what) == std::string::npos) lost += (lost.empty() ? "" : ", ") + what;
}

/// A text of UTF-16 code units after their count.
std::string unicode_text(const FileBytes& file, size_t place, size_t end) {
  constexpr size_t kLongest = 255;
  if (end - place < 4 || file.big(place, 4) > (end - place - 4) / 2)
    file.damaged("a name is too long");
  const size_t count = std::min(kLongest, file.big(place, 4));
  std::u16string units;
  for (size_t i = 0; i < count; ++i)
    if (const size_t unit = file.big(place + 4 + 2 * i, 2); unit != 0)
      units += static_cast<char16_t>(unit);
  return utf8_of(units);
}

PsdBounds read_bounds(const FileBytes& file, size_t place) {
  const PsdBounds bounds{file.big_signed(place), file.big_signed(place + 4),
                         file.big_signed(place + 8), file.big_signed(place + 12)};
  for (const int x : {bounds.top, bounds.left, bounds.bottom, bounds.right})
    if (std::abs(static_cast<long>(x)) > kFarthestEdge) file.damaged("a layer lies too far away");
  return bounds;
}

void read_mask(const FileBytes& file, size_t place, size_t length, PsdRecord& record) {
  if (length < 18) return;
  const bool disabled = file.at(place + 17) & 2;
  if (disabled) return;
  record.mask = read_bounds(file, place);
  record.outside_mask = static_cast<std::uint8_t>(file.at(place + 16));
}

void read_block(const FileBytes& file, const std::string& key, size_t place, size_t end,
                PsdRecord& record) {
  FileLayer& layer = record.layer;
  if (key == "luni") layer.name = unicode_text(file, place, end);
  const size_t length = end - place;
  if (key == "lyid" && length >= 4) layer.entry = "id:" + std::to_string(file.big(place, 4));
  if ((key == "lsct" || key == "lsdk") && length >= 4) {
    const size_t kind = file.big(place, 4);
    if (kind == 1 || kind == 2) record.section = PsdSection::group;
    if (kind == 3) record.section = PsdSection::divider;
    if (length >= 12) record.pass_through = file.text(place + 8, 4) == "pass";
  }
  if (key == "clbl" && length >= 1) record.splits_clipped = file.at(place) == 0;
  if (key == "iOpa" && length >= 1) layer.opacity *= static_cast<double>(file.at(place)) / 255;
  if (key == "lfx2" || key == "lrFX" || key == "lmfx") add_lost(layer.lost, "its effects");
  if (key == "vmsk" || key == "vsms") add_lost(layer.lost, "its vector mask");
  if (key == "SoLd" || key == "SoLE" || key == "PlLd")
    add_lost(layer.lost, "its smart object, of which only the pixels are kept");
  if (key == "TySh") add_lost(layer.lost, "its text, of which only the pixels are kept");
  if (std::ranges::find(kAdjustments, key) != std::end(kAdjustments)) record.skipped = true;
}

/// Reads the record at `place` and moves `place` behind it.
PsdRecord read_record(const FileBytes& file, size_t& place) {
  PsdRecord record;
  record.bounds = read_bounds(file, place);
  const size_t channels = file.big(place + 16, 2);
  constexpr size_t kMostChannels = 60;
  if (channels > kMostChannels) file.damaged("a layer has too many channels");
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

/// What the resources say about colors.
void read_resources(const FileBytes& file, size_t place, size_t end, PsdFile& psd) {
  constexpr size_t kProfile = 1039, kTransparentColor = 1047;
  while (place + 12 <= end) {
    const size_t id = file.big(place + 4, 2), name = file.at(place + 6);
    place += 6 + (name + 2) / 2 * 2;
    const size_t length = file.big(place, 4);
    place += 4;
    if (id == kProfile) psd.profile = file.text(place, length);
    if (id == kTransparentColor && length >= 2) psd.transparent = file.big(place, 2);
    file.need(place, length);
    place += length + length % 2;
  }
}

/// Reads the records of the layers and finds their channels.
void read_layers(const FileBytes& file, size_t place, PsdFile& psd) {
  const int signed_count = static_cast<std::int16_t>(file.big(place, 2)),
            count = std::abs(signed_count);
  psd.says_alpha = signed_count <= 0;
  place += 2;
  if (count > kMostRecords) file.damaged("it has too many layers");
  for (int i = 0; i < count; ++i) psd.records.push_back(read_record(file, place));
  std::map<std::string, int> ids;
  for (const PsdRecord& record : psd.records)
    if (record.section == PsdSection::layer) ++ids[record.layer.entry];
  for (size_t i = 0; i < psd.records.size(); ++i) {
    PsdRecord& record = psd.records[i];
    std::string& entry = record.layer.entry;
    if (record.section != PsdSection::layer)
      entry.clear();
    else if (entry.empty() || ids[entry] > 1)
      entry = "layer:" + std::to_string(i);
    for (PsdChannel& channel : record.channels) {
      file.need(place, channel.length);
      channel.place = place;
      place += channel.length;
    }
  }
}

/// The layers are at the beginning of their section or, with 16 bits, in one of its blocks. 0 if
/// there are none.
size_t place_of_layers(const FileBytes& file, size_t place, size_t end) {
  if (end - place < 4) return 0;
  const size_t length = file.big(place, 4);
  if (length >= 2) return place + 4;
  place += 4 + length;
  if (place + 4 > end) return 0;
  place += 4 + file.big(place, 4);  // settings of masks
  while (place + 12 <= end) {
    const size_t block = file.big(place + 8, 4);
    if (file.text(place + 4, 4) == "Lr16") return block >= 2 ? place + 12 : 0;
    file.need(place + 12, block);
    place += 12 + (block + 3) / 4 * 4;
  }
  return 0;
}

PsdMode mode_of(const FileBytes& file, size_t number) {
  for (const PsdMode mode : {PsdMode::bitmap, PsdMode::gray, PsdMode::indexed, PsdMode::rgb,
                             PsdMode::cmyk, PsdMode::duotone, PsdMode::lab})
    if (static_cast<size_t>(mode) == number) return mode;
  file.unsupported("its color mode is not supported; convert it to RGB");
}

}  // namespace

const PsdChannel* PsdRecord::channel(int id) const {
  const auto found = std::ranges::find(channels, id, &PsdChannel::id);
  return found == channels.end() ? nullptr : &*found;
}

PsdFile read_psd(const FileBytes& file) {
  PsdFile psd;
  if (file.big(4, 2) != 1) file.unsupported("it is a large document (PSB); save it as PSD");
  psd.channels = file.big(12, 2);
  psd.height = file.big(14, 4);
  psd.width = file.big(18, 4);
  psd.depth = static_cast<int>(file.big(22, 2));
  psd.mode = mode_of(file, file.big(24, 2));
  if (psd.depth == 32) file.unsupported("it has 32 bits per channel; convert it to 16 bits");
  if (psd.depth != (psd.mode == PsdMode::bitmap ? 1 : 8) &&
      (psd.depth != 16 || psd.mode == PsdMode::bitmap || psd.mode == PsdMode::indexed))
    file.damaged("its number of bits is invalid");
  size_t place = 26;
  const auto section = [&] {  // returns the end of the section that starts at `place`
    const size_t length = file.big(place, 4);
    place += 4;
    file.need(place, length);
    return place + length;
  };
  size_t end = section();
  if (psd.mode == PsdMode::indexed)
    psd.palette = file.text(place, std::min<size_t>(end - place, 768));
  place = end;
  end = section();
  read_resources(file, place, end, psd);
  place = end;
  end = section();
  if (const size_t layers = place_of_layers(file, place, end)) read_layers(file, layers, psd);
  psd.merged = end;
  return psd;
}

}  // namespace holomorph
