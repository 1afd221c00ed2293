// TIFF by libtiff, from memory. What a file says about itself is not trusted: libtiff checks it,
// and its words become errors.
#include <tiffio.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "core/error.h"
#include "scene/image_formats.h"

namespace holomorph {
namespace {

struct Stream {
  const std::string& bytes;
  toff_t at = 0;
};

tmsize_t read(thandle_t handle, void* out, tmsize_t count) {
  auto& stream = *static_cast<Stream*>(handle);
  const toff_t size = stream.bytes.size(), left = stream.at < size ? size - stream.at : 0;
  const tmsize_t got = static_cast<tmsize_t>(std::min<toff_t>(left, static_cast<toff_t>(count)));
  std::memcpy(out, stream.bytes.data() + (got > 0 ? stream.at : 0), static_cast<size_t>(got));
  stream.at += static_cast<toff_t>(got);
  return got;
}

toff_t seek(thandle_t handle, toff_t to, int from) {
  auto& stream = *static_cast<Stream*>(handle);
  return stream.at = to + (from == SEEK_CUR   ? stream.at
                           : from == SEEK_END ? static_cast<toff_t>(stream.bytes.size())
                                              : 0);
}

tmsize_t no_write(thandle_t, void*, tmsize_t) {
  return 0;
}
int no_close(thandle_t) {
  return 0;
}
toff_t size_of(thandle_t handle) {
  return static_cast<Stream*>(handle)->bytes.size();
}

struct Close {
  void operator()(TIFF* file) const { TIFFClose(file); }
};

}  // namespace

bool is_tiff(const std::string& bytes) {
  using namespace std::string_view_literals;
  const std::string_view head = std::string_view(bytes).substr(0, 4);
  return head == "II*\0"sv || head == "MM\0*"sv;
}

Image decode_tiff(const std::string& bytes, const std::string& name) {
  TIFFSetWarningHandler(nullptr);
  TIFFSetErrorHandler(nullptr);
  Stream stream{bytes};
  const std::unique_ptr<TIFF, Close> file(TIFFClientOpen(
      name.c_str(), "rm", &stream, read, no_write, seek, no_close, size_of, nullptr, nullptr));
  const auto damaged = [&](const std::string& why) {
    return Error(ErrorKind::bad_input, name + ": the TIFF picture cannot be read" + why);
  };
  uint32_t width = 0, height = 0;
  if (!file || !TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &width) ||
      !TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &height) || width == 0 || height == 0)
    throw damaged("");
  check_image_size(static_cast<int>(std::min(width, 1u << 30)),
                   static_cast<int>(std::min(height, 1u << 30)), name);
  char why[1024] = "";
  if (!TIFFRGBAImageOK(file.get(), why)) throw damaged(std::string(": ") + why);
  Image image(static_cast<int>(width), static_cast<int>(height));
  std::vector<uint32_t> pixels(image.pixels.size() / 4);
  if (!TIFFReadRGBAImageOriented(file.get(), width, height, pixels.data(), ORIENTATION_TOPLEFT, 1))
    throw damaged("; it is damaged");
  for (size_t i = 0; i < pixels.size(); ++i) {
    const uint32_t alpha = TIFFGetA(pixels[i]);
    // libtiff gives colours multiplied by alpha.
    const auto straight = [&](uint32_t value) {
      return static_cast<std::uint8_t>(
          alpha == 0 ? 0 : std::min(255u, (255 * value + alpha / 2) / alpha));
    };
    image.pixels[4 * i] = straight(TIFFGetR(pixels[i]));
    image.pixels[4 * i + 1] = straight(TIFFGetG(pixels[i]));
    image.pixels[4 * i + 2] = straight(TIFFGetB(pixels[i]));
    image.pixels[4 * i + 3] = static_cast<std::uint8_t>(alpha);
  }
  return image;
}

}  // namespace holomorph
