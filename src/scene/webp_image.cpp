// WebP by libwebp.
#include <webp/decode.h>
#include <webp/encode.h>

#include <algorithm>
#include <memory>

#include "core/error.h"
#include "scene/image_formats.h"

namespace holomorph {

bool is_webp(const std::string& bytes) {
  return bytes.size() > 12 && bytes.starts_with("RIFF") && bytes.compare(8, 4, "WEBP") == 0;
}

Image decode_webp(const std::string& bytes, const std::string& name) {
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  WebPBitstreamFeatures features{};
  if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK)
    throw Error(ErrorKind::bad_input, name + ": the WebP picture is damaged");
  if (features.has_animation)
    throw Error(ErrorKind::bad_input,
                name + ": this WebP is animated; open one of its frames, saved as a picture");
  check_image_size(features.width, features.height, name);
  Image image(features.width, features.height);
  if (!WebPDecodeRGBAInto(data, bytes.size(), image.pixels.data(), image.pixels.size(),
                          4 * image.width))
    throw Error(ErrorKind::bad_input, name + ": the WebP picture is damaged");
  return image;
}

std::string encode_webp(const Image& image) {
  if (std::max(image.width, image.height) > WEBP_MAX_DIMENSION)
    throw Error(ErrorKind::failed, "WebP pictures have at most 16383 pixels a side; take PNG");
  std::uint8_t* data = nullptr;
  const size_t size = WebPEncodeLosslessRGBA(image.pixels.data(), image.width, image.height,
                                             4 * image.width, &data);
  const std::unique_ptr<std::uint8_t, void (*)(void*)> owner(data, WebPFree);
  if (size == 0) throw Error(ErrorKind::failed, "the picture could not be encoded as WebP");
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace holomorph
