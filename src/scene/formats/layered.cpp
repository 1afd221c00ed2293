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

/// A part of a picture, in pixels from its upper left corner.
struct PixelRange {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// The pixels that are not transparent; without any, the first one.
PixelRange filled_range(const Image& image) {
  PixelRange content{image.width, image.height, 0, 0};
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c)
      if (image.at(c, r)[3] > 0) {
        content.left = std::min(content.left, c);
        content.right = std::max(content.right, c + 1);
        content.top = std::min(content.top, r);
        content.bottom = r + 1;
      }
  return content.right == 0 ? PixelRange{0, 0, 1, 1} : content;
}

/// The content of a picture, with one transparent row or column at each side that lies inside the
/// canvas: colors are mixed across the edges of the content.
Image trimmed(const Image& image) {
  const auto [left, top, right, bottom] = filled_range(image);
  const Box canvas = image.page();
  const int before = image.left + left > canvas.left, above = image.top() - top < canvas.top,
            after = image.left + right<canvas.right, below = image.top() - bottom> canvas.bottom;
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
  const auto [left, top, right, bottom] = filled_range(image);
  const PixelPosition corner{image.left + left, image.top() - bottom};
  if (image.at(left, top)[3] == 0 && right - left == 1 && bottom - top == 1)
    return {name, "", corner};  // all layers without content are alike
  std::string bytes = std::to_string(right - left) + " x " + std::to_string(bottom - top) + "\n";
  for (int r = top; r < bottom; ++r)
    for (int c = left; c < right; ++c) {
      constexpr std::uint8_t kNothing[4] = {};
      const std::uint8_t* pixel = image.at(c, r)[3] > 0 ? image.at(c, r) : kNothing;
      bytes.append(reinterpret_cast<const char*>(pixel), 4);
    }
  return {name, sha256_hex(bytes), corner};
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
  return picture.background && std::ranges::any_of(picture.layers, [](const DrawnLayer& layer) {
           return layer.blending != Blending::normal;
         });
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
