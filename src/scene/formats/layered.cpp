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
  if (is_psd(bytes)) return decode_psd_layer(bytes, entry, name, pixels);
  return decode_ora_layer(bytes, entry, name, pixels);
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
