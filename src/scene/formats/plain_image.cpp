// Reads BMP and TGA files with stb_image. stb_image reads missing bytes as zeros and does not
// check the sizes in a file. Therefore this file first checks that all pixels are present.
#include "core/error.h"
#include "scene/formats/file_bytes.h"
#include "scene/formats/image_formats.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_THREAD_LOCALS
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image.h>
#pragma GCC diagnostic pop

#include <cstring>
#include <memory>
#include <mutex>

namespace holomorph {
namespace {

struct Size {
  size_t width = 0, height = 0;
};

/// The absolute value of a signed 32-bit number.
size_t magnitude(size_t value) {
  return value < size_t{1} << 31 ? value : (size_t{1} << 32) - value;
}

Size bmp_size(const FileBytes& file) {
  const size_t header = file.little(14, 4);
  const bool old = header == 12;
  return {old ? file.little(18, 2) : magnitude(file.little(18, 4)),
          old ? file.little(20, 2) : magnitude(file.little(22, 4))};
}

void check_bmp(const FileBytes& file, const Size& size) {
  const size_t header = file.little(14, 4);
  if (header != 12 && header != 40 && header != 56 && header != 108 && header != 124)
    file.damaged("its header has an unknown format");
  file.need(14, header);
  const size_t bits = file.little(header == 12 ? 24 : 28, 2), pixels = file.little(10, 4);
  if (bits > 32) file.damaged("its pixels have an unknown format");
  const size_t row = (size.width * bits + 31) / 32 * 4;
  // The padding of the last row may be missing.
  file.need(pixels, row * (size.height - 1) + (size.width * bits + 7) / 8);
}

Size tga_size(const FileBytes& file) {
  return {file.little(12, 2), file.little(14, 2)};
}

void check_tga(const FileBytes& file, const Size& size) {
  const size_t kind = file.at(2), pixel = (file.at(16) + 7) / 8,
               colors =
                   file.at(1) ? file.little(3, 2) + file.little(5, 2) * ((file.at(7) + 7) / 8) : 0;
  if (pixel < 1 || pixel > 4) file.damaged("its pixels have an unknown format");
  size_t place = 18 + file.at(0) + colors;
  if (kind < 8) return file.need(place, size.width * size.height * pixel);
  for (size_t left = size.width * size.height; left > 0;) {
    const size_t packet = file.at(place), count = std::min(left, (packet & 127) + 1),
                 length = 1 + (packet & 128 ? 1 : count) * pixel;
    file.need(place, length);
    place += length;
    left -= count;
  }
}

/// Whether a file is a TGA file. The format has no signature, so this checks that all fields of the
/// header are plausible.
bool is_tga(const std::string& bytes) {
  if (bytes.size() < 18) return false;
  const auto at = [&](size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const int kind = at(2) & 7, bits = at(16);
  return at(1) <= 1 && (at(2) & ~8) == kind && kind >= 1 && kind <= 3 &&
         (at(1) == 1) == (kind == 1) &&
         (bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32);
}

Image decode(const std::string& bytes, const std::string& name, const Size& size,
             PixelBudget& pixels, void (*check)(const FileBytes&, const Size&)) {
  constexpr size_t kLargestFile = 1u << 30;  // stb_image stores sizes as int
  const FileBytes file(bytes, name);
  if (size.width == 0 || size.height == 0 || bytes.size() > kLargestFile)
    file.damaged("its size is invalid");
  pixels.take(size.width, size.height, name);
  check(file, size);
  static std::mutex mutex;  // stb_image stores its error message in a global variable
  const std::lock_guard lock(mutex);
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> found(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                            static_cast<int>(bytes.size()), &width, &height, &channels, 4),
      stbi_image_free);
  if (!found) file.damaged(stbi_failure_reason());
  if (static_cast<size_t>(width) != size.width || static_cast<size_t>(height) != size.height)
    file.damaged("its sizes contradict each other");
  Image image(width, height);
  std::memcpy(image.pixels.data(), found.get(), image.pixels.size());
  return image;
}

}  // namespace

std::optional<Image> decode_plain(const std::string& bytes, const std::string& name,
                                  PixelBudget& pixels) {
  const FileBytes file(bytes, name);
  if (bytes.starts_with("BM")) return decode(bytes, name, bmp_size(file), pixels, check_bmp);
  if (is_tga(bytes)) return decode(bytes, name, tga_size(file), pixels, check_tga);
  return {};
}

}  // namespace holomorph
