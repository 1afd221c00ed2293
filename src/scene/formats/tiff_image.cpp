// Reads TIFF files from memory with libtiff. libtiff checks the values in a file, and its messages
// are reported as errors.
#include <tiffio.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include "core/error.h"
#include "scene/formats/image_formats.h"
#include "scene/formats/to_srgb.h"

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

/// libtiff gives premultiplied colors in 8 bits. Where a file's colors are straight, this lets it
/// take them for premultiplied ones, so that it leaves them as they are. Returns whether it does.
bool leaves_straight(TIFF* file) {
  uint16_t count = 0, *kinds = nullptr;
  if (!TIFFGetField(file, TIFFTAG_EXTRASAMPLES, &count, &kinds) || count == 0 ||
      kinds[0] != EXTRASAMPLE_UNASSALPHA)
    return false;
  std::vector<uint16_t> changed(kinds, kinds + count);
  changed[0] = EXTRASAMPLE_ASSOCALPHA;
  return TIFFSetField(file, TIFFTAG_EXTRASAMPLES, count, changed.data()) == 1;
}

/// Unpacks the pixels, which libtiff packs into one number each, and converts them to straight
/// alpha unless they have it already.
void unpack(Image& image, bool is_straight) {
  for (size_t i = 0; i < image.pixels.size(); i += 4) {
    uint32_t pixel = 0;
    std::memcpy(&pixel, &image.pixels[i], 4);
    const uint32_t alpha = TIFFGetA(pixel);
    const auto straight = [&](uint32_t value) {
      return static_cast<std::uint8_t>(is_straight ? value
                                       : alpha == 0
                                           ? 0
                                           : std::min(255u, (255 * value + alpha / 2) / alpha));
    };
    image.pixels[i] = straight(TIFFGetR(pixel));
    image.pixels[i + 1] = straight(TIFFGetG(pixel));
    image.pixels[i + 2] = straight(TIFFGetB(pixel));
    image.pixels[i + 3] = static_cast<std::uint8_t>(alpha);
  }
}

struct CloseTiff {
  void operator()(TIFF* file) const { TIFFClose(file); }
};

/// Null if the file cannot be opened.
std::unique_ptr<TIFF, CloseTiff> opened(Stream& stream, const std::string& name) {
  constexpr tmsize_t kLargestBlock = tmsize_t{1} << 30;  // bytes of a strip or a tile
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  const auto quiet = [](TIFF*, void*, const char*, const char*, va_list) { return 1; };
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kLargestBlock);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), quiet, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), quiet, nullptr);
  return std::unique_ptr<TIFF, CloseTiff>(TIFFClientOpenExt(name.c_str(), "rm", &stream, read,
                                                            no_write, seek, no_close, size_of,
                                                            nullptr, nullptr, options.get()));
}

}  // namespace

bool is_tiff(const std::string& bytes) {
  using namespace std::string_view_literals;
  const std::string_view head = std::string_view(bytes).substr(0, 4);
  return head == "II*\0"sv || head == "MM\0*"sv;
}

void report_tiff(const std::string& bytes, const std::string& name, ImportReport& report) {
  Stream stream{bytes};
  const auto file = opened(stream, name);
  if (!file) return;
  uint16_t bits = 8, count = 0, *kinds = nullptr;
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetField(file.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds);
  if (bits > 8)
    report.add("", "its " + std::to_string(bits) + " bits per channel are rounded to 8");
  if (count > 1) report.add("", "left out: all of its extra channels but the first");
  report_first_of(TIFFNumberOfDirectories(file.get()), "pages", report);
}

Image decode_tiff(const std::string& bytes, const std::string& name, PixelBudget& pixels) {
  Stream stream{bytes};
  const auto file = opened(stream, name);
  const auto damaged = [&](const std::string& why) {
    return Error(ErrorKind::bad_input, name + ": the TIFF picture cannot be read" + why);
  };
  uint32_t width = 0, height = 0;
  if (!file || !TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &width) ||
      !TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &height) || width == 0 || height == 0)
    throw damaged("");
  pixels.take(width, height, name);
  const bool is_straight = leaves_straight(file.get());
  char why[1024] = "";
  if (!TIFFRGBAImageOK(file.get(), why)) throw damaged(std::string(": ") + why);
  Image image(static_cast<int>(width), static_cast<int>(height));
  auto* packed = reinterpret_cast<uint32_t*>(image.pixels.data());
  if (!TIFFReadRGBAImageOriented(file.get(), width, height, packed, ORIENTATION_TOPLEFT, 1))
    throw damaged("; it is damaged or incomplete");
  unpack(image, is_straight);
  uint32_t size = 0;
  void* profile = nullptr;
  if (TIFFGetField(file.get(), TIFFTAG_ICCPROFILE, &size, &profile))
    to_srgb(image, std::string(static_cast<const char*>(profile), size));
  // libtiff has already mirrored the picture. Rows and columns may still have to be swapped.
  uint16_t orientation = 1;
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_ORIENTATION, &orientation);
  const bool over = orientation == ORIENTATION_LEFTTOP || orientation == ORIENTATION_RIGHTBOT,
             under = orientation == ORIENTATION_RIGHTTOP || orientation == ORIENTATION_LEFTBOT;
  return upright(std::move(image), over ? 5 : under ? 7 : 1);
}

}  // namespace holomorph
