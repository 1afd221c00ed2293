// Which module reads and writes the layers of which files.
#include "scene/formats/layered.h"

#include <algorithm>

#include "core/error.h"
#include "scene/formats/image_formats.h"
#include "scene/formats/ora_image.h"
#include "scene/formats/psd_image.h"
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
  static const std::vector<LayeredFormat> all{{"Photoshop file with layers", ".psd", encode_psd},
                                              {"OpenRaster file with layers", ".ora", encode_ora}};
  return all;
}

const LayeredFormat* layered_format_of(const Path& file) {
  const auto found = std::ranges::find(layered_formats(), lower_case(file.extension().string()),
                                       &LayeredFormat::extension);
  return found == layered_formats().end() ? nullptr : &*found;
}

}  // namespace holomorph
