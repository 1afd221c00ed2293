// Writes GIF with giflib; libimagequant chooses the colors. Frame durations are in hundredths of a
// second and are rounded in a way that keeps the length of the whole film correct.
#include <gif_lib.h>
#include <libimagequant.h>

#include "core/error.h"
#include "film/film_writer.h"
#include "film/ordered_tasks.h"
#include "system/new_file.h"

namespace holomorph {
namespace {

/// Deletes an object of a C library by the library's own function.
template <class T, void (*release)(T*)>
struct Release {
  void operator()(T* what) const { release(what); }
};
template <class T, void (*release)(T*)>
using Owned = std::unique_ptr<T, Release<T, release>>;

struct Quantized {
  std::vector<GifColorType> palette;
  std::vector<unsigned char> pixels;
  int transparent = 0;  ///< index of the transparent color
};

/// 255 colors, and one for pixels that are more than half transparent.
Quantized quantized(const Image& frame) {
  Image solid = frame;
  for (size_t i = 0; i < solid.pixels.size(); i += 4) {
    const bool is_opaque = solid.pixels[i + 3] >= 128;
    if (!is_opaque) solid.pixels[i] = solid.pixels[i + 1] = solid.pixels[i + 2] = 0;
    solid.pixels[i + 3] = is_opaque ? 255 : 0;
  }
  const auto throw_if_failed = [](liq_error error) {
    if (error != LIQ_OK) throw Error(ErrorKind::failed, "cannot choose the colors of a GIF frame");
  };
  const Owned<liq_attr, liq_attr_destroy> settings(liq_attr_create());
  liq_set_max_colors(settings.get(), 255);  // one more is for transparency
  liq_set_speed(settings.get(), 6);
  const Owned<liq_image, liq_image_destroy> image(
      liq_image_create_rgba(settings.get(), solid.pixels.data(), solid.width, solid.height, 0));
  liq_result* found = nullptr;
  throw_if_failed(liq_image_quantize(image.get(), settings.get(), &found));
  const Owned<liq_result, liq_result_destroy> result(found);
  liq_set_dithering_level(result.get(), 0.7f);
  Quantized quantized;
  quantized.pixels.resize(solid.pixels.size() / 4);
  throw_if_failed(liq_write_remapped_image(result.get(), image.get(), quantized.pixels.data(),
                                           quantized.pixels.size()));
  const liq_palette* palette = liq_get_palette(result.get());
  for (unsigned i = 0; i < palette->count; ++i) {
    const liq_color& color = palette->entries[i];
    quantized.palette.push_back({color.r, color.g, color.b});
  }
  quantized.transparent = static_cast<int>(palette->count);
  quantized.palette.push_back({0, 0, 0});
  for (size_t i = 0; i < quantized.pixels.size(); ++i)
    if (solid.pixels[4 * i + 3] == 0)
      quantized.pixels[i] = static_cast<unsigned char>(palette->count);
  size_t size = 2;  // the size of a GIF color map is a power of two
  while (size < quantized.palette.size()) size *= 2;
  quantized.palette.resize(size, {0, 0, 0});
  return quantized;
}

int append(GifFileType* file, const GifByteType* bytes, int count) {
  static_cast<std::string*>(file->UserData)
      ->append(reinterpret_cast<const char*>(bytes), static_cast<size_t>(count));
  return count;
}

void close(GifFileType* file) {
  int ignored = 0;
  EGifCloseFile(file, &ignored);
}

class GifWriter final : public FilmWriter {
 public:
  GifWriter(const Path& out, const FilmShape& shape) : out_(out), shape_(shape) {
    constexpr double kMaxFrameRate = 50;  // viewers slow down faster films
    if (shape.frames_per_second > kMaxFrameRate)
      throw Error(ErrorKind::bad_input,
                  out.string() +
                      ": a GIF has at most 50 frames per second; lower the frame rate, or "
                      "choose .webp or .apng");
    int error_code = 0;
    file_.reset(EGifOpen(&bytes_, append, &error_code));
    if (!file_) throw Error(ErrorKind::failed, out.string() + ": not enough memory for a GIF file");
    EGifSetGifVersion(file_.get(), true);
    throw_if_failed(EGifPutScreenDesc(file_.get(), shape.width, shape.height, 8, 0, nullptr));
    if (!shape.loops) return;
    const std::array<unsigned char, 3> forever{1, 0, 0};
    throw_if_failed(EGifPutExtensionLeader(file_.get(), APPLICATION_EXT_FUNC_CODE));
    throw_if_failed(EGifPutExtensionBlock(file_.get(), 11, "NETSCAPE2.0"));
    throw_if_failed(EGifPutExtensionBlock(file_.get(), 3, forever.data()));
    throw_if_failed(EGifPutExtensionTrailer(file_.get()));
  }

  void add(const Image& frame) override {
    palettes_.add([frame] { return quantized(frame); });
  }

  void finish() override {
    palettes_.finish();
    int error_code = 0;
    throw_if_failed(EGifCloseFile(file_.release(), &error_code));
    write_file(out_, bytes_);
  }

 private:
  void append_frame(Quantized quantized) {
    GraphicsControlBlock control{};
    control.DisposalMode = DISPOSE_BACKGROUND;
    control.DelayTime = hundredths(frames_ + 1) - hundredths(frames_);
    control.TransparentColor = quantized.transparent;
    std::array<GifByteType, 4> block{};
    EGifGCBToExtension(&control, block.data());
    throw_if_failed(EGifPutExtension(file_.get(), GRAPHICS_EXT_FUNC_CODE, 4, block.data()));
    const Owned<ColorMapObject, GifFreeMapObject> colors(
        GifMakeMapObject(static_cast<int>(quantized.palette.size()), quantized.palette.data()));
    throw_if_failed(
        EGifPutImageDesc(file_.get(), 0, 0, shape_.width, shape_.height, false, colors.get()));
    for (int row = 0; row < shape_.height; ++row)
      throw_if_failed(EGifPutLine(
          file_.get(),
          &quantized.pixels[static_cast<size_t>(row) * static_cast<size_t>(shape_.width)],
          shape_.width));
    ++frames_;
  }

  int hundredths(int frames) const {
    return static_cast<int>(std::lround(100 * frames / shape_.frames_per_second));
  }
  void throw_if_failed(int result) const {
    if (result != GIF_OK)
      throw Error(ErrorKind::failed, out_.string() + ": the GIF encoder failed");
  }

  Path out_;
  FilmShape shape_;
  std::string bytes_;
  Owned<GifFileType, close> file_;
  int frames_ = 0;
  OrderedTasks<Quantized> palettes_{
      [this](Quantized quantized) { append_frame(std::move(quantized)); }};
};

}  // namespace

std::unique_ptr<FilmWriter> gif_writer(const Path& out, const FilmShape& shape) {
  return std::make_unique<GifWriter>(out, shape);
}

}  // namespace holomorph
