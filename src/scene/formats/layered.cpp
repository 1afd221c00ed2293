// Which module reads and writes the layers of which files.
#include "scene/formats/layered.h"

#include <algorithm>

#include "core/error.h"
#include "scene/formats/image_formats.h"
#include "scene/formats/ora_image.h"
#include "scene/formats/psd_image.h"
#include "scene/formats/svg_writer.h"
#include "system/text.h"

namespace holomorph {
namespace {

/// The content of a picture, with one transparent row or column at each side that lies inside the
/// canvas: colors are mixed across the edges of the content.
Image trimmed(const Image& image) {
  const PixelRange filled = filled_range(image);
  if (filled.empty()) return nothing_on(image.page());
  const auto [left, top, right, bottom] = filled;
  const Box canvas = image.page();
  const bool before = image.left + left > canvas.left, above = image.top() - top < canvas.top;
  const bool after = image.left + right<canvas.right, below = image.top() - bottom> canvas.bottom;
  Image content(right - left + before + after, bottom - top + above + below);
  for (int r = top; r < bottom; ++r)
    std::copy_n(image.at(left, r), 4 * (right - left), content.at(before, r - top + above));
  content.left = image.left + left - before;
  content.bottom = image.top() - bottom - below;
  content.canvas = image.canvas;
  return content;
}

}  // namespace

bool may_have_layers(const Path& file) {
  const std::string extension = lower_case(file.extension().string());
  return extension == ".ora" || extension == ".psd";
}

FileLayers layers_of_file(const std::string& bytes, const std::string& name) {
  if (is_psd(bytes)) return psd_layers(bytes, name);
  if (is_ora(bytes)) return ora_layers(bytes, name);
  return {};  // another kind of picture, in spite of its name
}

Image decode_layer(const std::string& bytes, const std::string& entry, const std::string& name,
                   PixelBudget& pixels) {
  return trimmed(is_psd(bytes) ? decode_psd_layer(bytes, entry, name, pixels)
                               : decode_ora_layer(bytes, entry, name, pixels));
}

LayerMark mark_of(const Image& image, const std::string& name) {
  const PixelRange content = filled_range(image);
  if (content.empty()) return {name, "", {}};  // all layers without content are alike
  const auto [left, top, right, bottom] = content;
  std::string bytes = std::to_string(right - left) + " x " + std::to_string(bottom - top) + "\n";
  for (int r = top; r < bottom; ++r)
    for (int c = left; c < right; ++c) {
      constexpr std::uint8_t kNothing[4] = {};
      const std::uint8_t* pixel = image.at(c, r)[3] > 0 ? image.at(c, r) : kNothing;
      bytes.append(reinterpret_cast<const char*>(pixel), 4);
    }
  return {name, sha256_hex(bytes), {image.left + left, image.top() - bottom}};
}

DrawnLayer background_layer(const LayeredPicture& picture) {
  DrawnLayer layer;
  layer.name = "Background";
  layer.image = Image(picture.merged.width, picture.merged.height);
  for (size_t i = 0; i < layer.image.pixels.size(); i += 4) {
    std::ranges::copy(*picture.background, &layer.image.pixels[i]);
    layer.image.pixels[i + 3] = 255;
  }
  return layer;
}

bool needs_group(const LayeredPicture& picture) {
  return (picture.background || !picture.originals.empty()) &&
         std::ranges::any_of(picture.layers, [](const DrawnLayer& layer) {
           return layer.blending != Blending::normal;
         });
}

std::string name_for_xml(const std::string& name) {
  std::string allowed;
  for (size_t i = 0; i < name.size(); ++i) {
    const std::string_view three = std::string_view(name).substr(i, 3);
    if (three == "\xEF\xBF\xBE" || three == "\xEF\xBF\xBF") {
      allowed += ' ';
      i += 2;
    } else {
      allowed += static_cast<unsigned char>(name[i]) < ' ' || name[i] == 0x7f ? ' ' : name[i];
    }
  }
  return allowed;
}

const std::vector<LayeredFormat>& layered_formats() {
  static const std::vector<LayeredFormat> all{
      {"psd", "Photoshop file with layers", ".psd", encode_psd},
      {"ora", "OpenRaster file with layers", ".ora", encode_ora},
      {"drawing", "Drawing with layers (SVG)", ".svg", encode_svg, true}};
  return all;
}

const LayeredFormat* layered_format_of(const Path& file) {
  const auto found = std::ranges::find(layered_formats(), lower_case(file.extension().string()),
                                       &LayeredFormat::extension);
  return found == layered_formats().end() ? nullptr : &*found;
}

const LayeredFormat* layered_format_named(const std::string& id) {
  const auto found = std::ranges::find(layered_formats(), id, &LayeredFormat::id);
  return found == layered_formats().end() ? nullptr : &*found;
}

}  // namespace holomorph
