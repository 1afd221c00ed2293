// Layers are flattened: groups pass on what their layers need.
#include "scene/formats/psd_image.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/image_formats.h"
#include "scene/formats/psd_file.h"
#include "scene/formats/psd_rows.h"
#include "scene/formats/to_srgb.h"

namespace holomorph {
namespace {

constexpr size_t kDeepestPsdGroup = 50;  ///< levels of groups

/// A layer, or a group with what it contains.
struct Node {
  const PsdRecord* record = nullptr;
  std::vector<Node> children;  ///< from bottom to top
};

std::vector<Node> tree_of(const PsdFile& psd, const FileBytes& file) {
  std::vector<std::vector<Node>> open(1);
  for (const PsdRecord& record : psd.records) {
    if (record.section == PsdSection::divider) {
      open.emplace_back();
      if (open.size() > kDeepestPsdGroup) file.damaged("its groups are nested too deeply");
      continue;
    }
    Node node{&record, {}};
    if (record.section == PsdSection::group) {
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
    all.report.add(layer.name, "left out: " + what);
  };
  bool has_base = false;
  std::string split_base;  // its name, until something is clipped to it
  for (const Node& node : nodes) {
    FileLayer layer = node.record->layer;
    layer.name = group.name + layer.name;
    layer.visible = layer.visible && group.visible;
    const bool is_clipped = layer.clipped;
    const bool is_group = node.record->section == PsdSection::group;
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
    if (!is_clipped) split_base = node.record->splits_clipped ? layer.name : "";
    if (layer.clipped && !split_base.empty())
      all.report.add(std::exchange(split_base, ""),
                     "converted: layers that are clipped to it blend with it alone");
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

/// Whether a picture may be as large as this.
bool is_small(const PsdBounds& bounds) {
  return bounds.width() <= PixelBudget::kLargestSide &&
         bounds.height() <= PixelBudget::kLargestSide;
}

PsdBounds on_canvas(const PsdBounds& bounds, const PsdFile& psd) {
  const int width = static_cast<int>(psd.width), height = static_cast<int>(psd.height);
  return {std::clamp(bounds.top, 0, height), std::clamp(bounds.left, 0, width),
          std::clamp(bounds.bottom, 0, height), std::clamp(bounds.right, 0, width)};
}

PsdRows rows_of(const FileBytes& file, const PsdFile& psd, const PsdChannel& channel,
                const PsdBounds& bounds) {
  PsdSamples samples;
  samples.width = bounds.width();
  samples.height = bounds.height();
  samples.depth = psd.depth;
  if (channel.length < 2) file.damaged("a channel is missing");
  samples.packing = packing_of(file, file.big(channel.place, 2));
  samples.place = channel.place + 2;
  samples.end = channel.place + channel.length;
  if (samples.packing == PsdPacking::run_lengths) {
    samples.lengths = samples.place;
    if (2 * samples.height > samples.end - samples.place) file.damaged("a channel is too short");
    samples.place += 2 * samples.height;
  }
  return PsdRows(file, samples);
}

/// Collects rows of samples as pixels in the colors of the file, and converts them to sRGB.
class PsdPixels {
 public:
  PsdPixels(const PsdFile& psd, int width, int height) : psd_(psd), image_(width, height) {
    if (psd.mode == PsdMode::cmyk) inks_ = std::make_unique<CmykToSrgb>(psd.profile);
    if (is_deep()) deep_ = {width, height, std::vector<std::uint16_t>(image_.pixels.size())};
  }

  /// Sets a row from the columns that begin at `first`. `alpha` is null if all are opaque.
  void set(int row, const std::vector<const std::uint16_t*>& colors, const std::uint16_t* alpha,
           size_t first) {
    const auto width = static_cast<size_t>(image_.width);
    if (psd_.mode == PsdMode::cmyk) return set_inks(row, colors, alpha, first);
    for (size_t c = 0; c < width; ++c) {
      const size_t i = image_.index(static_cast<int>(c), row);
      for (size_t k = 0; k < 3; ++k) {
        const unsigned value = colors[k % colors.size()][first + c];
        if (is_deep())
          deep_.pixels[i + k] = static_cast<std::uint16_t>(value);
        else
          image_.pixels[i + k] = psd_.mode == PsdMode::indexed ? palette(value, k) : narrow(value);
      }
      const bool is_clear =
          psd_.mode == PsdMode::indexed && psd_.transparent == colors[0][first + c];
      const unsigned opacity = alpha ? alpha[first + c] : is_clear ? 0 : most();
      if (is_deep())
        deep_.pixels[i + 3] = static_cast<std::uint16_t>(opacity);
      else
        image_.pixels[i + 3] = narrow(opacity);
    }
  }

  Image in_colors_of_screen() && {
    if (is_deep()) return in_srgb(deep_, psd_.profile);
    if (psd_.mode == PsdMode::lab)
      lab_to_srgb(image_);
    else if (psd_.mode != PsdMode::cmyk && !psd_.profile.empty())
      to_srgb(image_, psd_.profile);
    return std::move(image_);
  }

 private:
  /// Whether 16 bits are kept until the colors are converted.
  bool is_deep() const {
    return psd_.depth == 16 && psd_.mode != PsdMode::cmyk && psd_.mode != PsdMode::lab;
  }
  unsigned most() const { return psd_.depth == 16 ? 65535 : 255; }
  std::uint8_t narrow(unsigned value) const {
    return static_cast<std::uint8_t>(psd_.depth == 16 ? (value + 128) / 257 : value);
  }
  std::uint8_t palette(unsigned index, size_t k) const {
    const size_t at = 256 * k + index;
    return at < psd_.palette.size() ? static_cast<std::uint8_t>(psd_.palette[at]) : 0;
  }
  void set_inks(int row, const std::vector<const std::uint16_t*>& colors,
                const std::uint16_t* alpha, size_t first) {
    const auto width = static_cast<size_t>(image_.width);
    std::vector<std::uint8_t> cmyk(4 * width);
    for (size_t c = 0; c < width; ++c)
      for (size_t k = 0; k < 4; ++k) cmyk[4 * c + k] = narrow(colors[k][first + c]);
    inks_->row(cmyk.data(), image_.at(0, row), image_.width);
    for (size_t c = 0; alpha && c < width; ++c)
      image_.at(static_cast<int>(c), row)[3] = narrow(alpha[first + c]);
  }

  const PsdFile& psd_;
  Image image_;
  DeepImage deep_;
  std::unique_ptr<CmykToSrgb> inks_;
};

/// Draws channels that cover `bounds`, cut to `kept`.
Image drawn(const PsdFile& psd, std::vector<PsdRows> colors, std::optional<PsdRows> alpha,
            const PsdBounds& bounds, const PsdBounds& kept) {
  PsdPixels pixels(psd, static_cast<int>(kept.width()), static_cast<int>(kept.height()));
  const auto above = static_cast<size_t>(kept.top - bounds.top),
             before = static_cast<size_t>(kept.left - bounds.left);
  for (PsdRows& rows : colors) rows.skip(above);
  if (alpha) alpha->skip(above);
  std::vector<const std::uint16_t*> row(colors.size());
  for (int r = 0; r < static_cast<int>(kept.height()); ++r) {
    for (size_t k = 0; k < colors.size(); ++k) row[k] = colors[k].next().data();
    pixels.set(r, row, alpha ? alpha->next().data() : nullptr, before);
  }
  return std::move(pixels).in_colors_of_screen();
}

/// Multiplies the alpha by the layer's mask.
void apply_mask(const FileBytes& file, const PsdFile& psd, const PsdRecord& record,
                const PsdBounds& kept, Image& image) {
  const PsdChannel* channel = record.channel(PsdChannel::kMask);
  if (!record.mask || !channel) return;
  const PsdBounds& mask = *record.mask;
  check_budget(&Budget::pixels, static_cast<double>(mask.width() * mask.height()),
               file.name() + ": a mask has");
  std::optional<PsdRows> rows;
  if (mask.width() > 0 && mask.height() > 0) rows.emplace(rows_of(file, psd, *channel, mask));
  if (rows && kept.top > mask.top)
    rows->skip(std::min(mask.height(), static_cast<size_t>(kept.top - mask.top)));
  for (int r = kept.top; r < kept.bottom; ++r) {
    const bool in_rows = rows && r >= mask.top && r < mask.bottom;
    const std::uint16_t* row = in_rows ? rows->next().data() : nullptr;
    for (int c = kept.left; c < kept.right; ++c) {
      const bool inside = in_rows && c >= mask.left && c < mask.right;
      unsigned level = inside ? row[c - mask.left] : record.outside_mask;
      if (inside && psd.depth == 16) level = (level + 128) / 257;
      std::uint8_t& alpha = image.at(c - kept.left, r - kept.top)[3];
      alpha = static_cast<std::uint8_t>((alpha * level + 127) / 255);
    }
  }
}

/// What is said about the colors of the whole file.
void report_colors(const PsdFile& psd, ImportReport& report) {
  if (psd.mode == PsdMode::cmyk) report.add("", "its CMYK colors are converted to sRGB");
  if (psd.mode == PsdMode::lab) report.add("", "its Lab colors are converted to sRGB");
  if (psd.mode == PsdMode::duotone) report.add("", "its duotone is shown in gray");
  if (psd.depth == 16) report.add("", "its 16 bits per channel are rounded to 8");
}

/// The merged picture mixes faint pixels with white, which is undone here.
void take_white_away(Image& image) {
  for (size_t i = 0; i < image.pixels.size(); i += 4) {
    const int alpha = image.pixels[i + 3];
    if (alpha == 0 || alpha == 255) continue;
    for (size_t k = 0; k < 3; ++k) {
      const int value = image.pixels[i + k];
      image.pixels[i + k] = static_cast<std::uint8_t>(
          std::clamp(((value - 255) * 255 + 255 * alpha + alpha / 2) / alpha, 0, 255));
    }
  }
}

}  // namespace

bool is_psd(const std::string& bytes) {
  return bytes.starts_with("8BPS");
}

FileLayers psd_layers(const std::string& bytes, const std::string& name) {
  const FileBytes file(bytes, name);
  const PsdFile psd = read_psd(file);
  FileLayers all;
  report_colors(psd, all.report);
  flatten(tree_of(psd, file), {}, all);
  PixelBudget one;
  one.take(psd.width, psd.height, name);
  all.width = static_cast<int>(psd.width);
  all.height = static_cast<int>(psd.height);
  if (psd.records.empty() && psd.has_merged_alpha())
    all.report.add("", "its first extra channel is used as transparency");
  return all;
}

Image decode_psd_layer(const std::string& bytes, const std::string& entry, const std::string& name,
                       PixelBudget& pixels) {
  const FileBytes file(bytes, name);
  const PsdFile psd = read_psd(file);
  const auto found = std::ranges::find_if(
      psd.records, [&](const PsdRecord& record) { return record.layer.entry == entry; });
  if (found == psd.records.end()) file.damaged("its layer " + entry + " no longer exists");
  const PsdRecord& record = *found;
  check_budget(&Budget::pixels, static_cast<double>(record.bounds.width() * record.bounds.height()),
               name + ": a layer has");
  const int height = static_cast<int>(psd.height);
  const Box canvas{0, 0, static_cast<double>(psd.width), static_cast<double>(psd.height)};
  const PsdBounds kept = is_small(record.bounds) ? record.bounds : on_canvas(record.bounds, psd);
  if (kept.width() == 0 || kept.height() == 0) return nothing_on(canvas);
  pixels.take(kept.width(), kept.height(), name, psd.depth == 16 ? 3 : 1);
  std::vector<PsdRows> colors;
  for (size_t k = 0; k < psd.colors(); ++k) {
    const PsdChannel* channel = record.channel(static_cast<int>(k));
    if (!channel) file.damaged("a channel is missing");
    colors.push_back(rows_of(file, psd, *channel, record.bounds));
  }
  std::optional<PsdRows> alpha;
  if (const PsdChannel* channel = record.channel(PsdChannel::kAlpha))
    alpha.emplace(rows_of(file, psd, *channel, record.bounds));
  Image image = drawn(psd, std::move(colors), std::move(alpha), record.bounds, kept);
  apply_mask(file, psd, record, kept, image);
  image.left = kept.left;
  image.bottom = height - kept.bottom;
  image.canvas = canvas;
  return image;
}

Image decode_psd(const std::string& bytes, const std::string& name, PixelBudget& pixels) {
  const FileBytes file(bytes, name);
  const PsdFile psd = read_psd(file);
  pixels.take(psd.width, psd.height, name, psd.depth == 16 ? 3 : 1);
  if (psd.channels < psd.colors()) file.damaged("a channel is missing");
  PsdSamples samples;
  samples.width = psd.width;
  samples.height = psd.height;
  samples.depth = psd.depth;
  samples.packing = packing_of(file, file.big(psd.merged, 2));
  if (samples.packing > PsdPacking::run_lengths) file.damaged("its compression is unknown");
  samples.lengths = psd.merged + 2;
  const bool packed = samples.packing == PsdPacking::run_lengths;
  samples.place = samples.lengths + (packed ? 2 * psd.channels * psd.height : 0);
  std::vector<PsdRows> channels;
  const bool has_alpha = psd.has_merged_alpha();
  for (size_t k = 0; k < psd.colors() + (has_alpha ? 1 : 0); ++k) {
    size_t length = packed ? 0 : samples.bytes_per_row() * psd.height;
    for (size_t r = 0; packed && r < psd.height; ++r)
      length += file.big(samples.lengths + 2 * r, 2);
    samples.end = samples.place + length;
    channels.emplace_back(file, samples);
    samples.place = samples.end;
    if (packed) samples.lengths += 2 * psd.height;
  }
  std::optional<PsdRows> alpha;
  if (has_alpha) {
    alpha.emplace(std::move(channels.back()));
    channels.pop_back();
  }
  const PsdBounds all{0, 0, static_cast<int>(psd.height), static_cast<int>(psd.width)};
  Image image = drawn(psd, std::move(channels), std::move(alpha), all, all);
  if (has_alpha) take_white_away(image);
  return image;
}

}  // namespace holomorph
