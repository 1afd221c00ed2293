// stb_image behind two functions; other formats by their own libraries.
#include "scene/image.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <cstring>
#include <memory>

#include "core/error.h"
#include "scene/image_formats.h"

namespace holomorph {

void check_image_size(int width, int height, const std::string& name) {
  constexpr int kLargest = 16384;
  if (width > kLargest || height > kLargest)
    throw Error(ErrorKind::bad_input, name + ": the picture has " + std::to_string(width) + " x " +
                                          std::to_string(height) + " pixels; at most " +
                                          std::to_string(kLargest) + " a side can be opened");
}

const std::vector<std::string>& picture_extensions() {
  static const std::vector<std::string> all{".png",  ".jpg", ".jpeg", ".webp", ".tif",
                                            ".tiff", ".bmp", ".tga",  ".gif",  ".psd"};
  return all;
}

Image decode_image(const std::string& bytes, const std::string& name) {
  if (is_webp(bytes)) return decode_webp(bytes, name);
  if (is_tiff(bytes)) return decode_tiff(bytes, name);
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels))
    throw Error(ErrorKind::bad_input,
                name +
                    ": this is no picture that can be read (PNG, JPEG, WebP, TIFF, BMP, TGA, GIF "
                    "or PSD)");
  check_image_size(width, height, name);
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
  if (!pixels)
    throw Error(ErrorKind::bad_input,
                name + ": the picture is damaged (" + stbi_failure_reason() + ")");
  Image image(width, height);
  std::memcpy(image.pixels.data(), pixels.get(), image.pixels.size());
  return image;
}

std::string encode_png(const Image& image) {
  std::string bytes;
  const auto append = [](void* out, void* data, int size) {
    static_cast<std::string*>(out)->append(static_cast<const char*>(data),
                                           static_cast<size_t>(size));
  };
  if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, 4, image.pixels.data(),
                              4 * image.width))
    throw Error(ErrorKind::failed, "the picture could not be encoded as PNG");
  return bytes;
}

bool has_transparency(const Image& image) {
  for (size_t i = 3; i < image.pixels.size(); i += 4)
    if (image.pixels[i] != 255) return true;
  return false;
}

}  // namespace holomorph
