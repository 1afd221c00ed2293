// Reads PNG files from memory with libpng: upright, and converted to sRGB before colors are rounded
// to 8 bits. Fine pixels are kept on demand. Writes PNG files with 16 bits.
#include <png.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstring>

#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/file_bytes.h"
#include "scene/formats/image_formats.h"
#include "scene/formats/to_srgb.h"

namespace holomorph {
namespace {

/// libpng reports errors with longjmp, which does not call destructors. Functions that it can
/// interrupt therefore have no local objects with destructors; such objects are members instead.
class PngReader {
 public:
  PngReader(const std::string& bytes, const std::string& name, PixelDepth depth)
      : bytes_(bytes), name_(name), keeps_fine_(depth == PixelDepth::full) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, [](auto, auto) {});
    if (png_) info_ = png_create_info_struct(png_);
    if (!info_) throw Error(ErrorKind::failed, name + ": not enough memory for a PNG picture");
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  Image read(PixelBudget& pixels) {
    run(&PngReader::read_header);
    take_pixels(pixels);
    run(&PngReader::prepare);
    const int width = static_cast<int>(width_), height = static_cast<int>(height_);
    const size_t row = 4 * static_cast<size_t>(width_);
    rows_.resize(height_);
    if (is_deep_) {
      deep_ = {width, height, std::vector<std::uint16_t>(row * height_)};
      for (size_t r = 0; r < rows_.size(); ++r)
        rows_[r] = reinterpret_cast<png_bytep>(&deep_.pixels[row * r]);
    } else {
      image_ = Image(width, height);
      for (size_t r = 0; r < rows_.size(); ++r) rows_[r] = &image_.pixels[row * r];
    }
    run(&PngReader::read_pixels);
    convert();
    const int orientation =
        exif_ ? orientation_of_exif("Exif" + std::string(2, '\0') +
                                    std::string(reinterpret_cast<const char*>(exif_), exif_size_))
              : 1;
    return upright(std::move(image_), orientation);
  }

 private:
  /// Without fine pixels, very large pictures are rounded first, because there is no memory for
  /// both.
  void take_pixels(PixelBudget& pixels) {
    constexpr double kSamples = 2;  // copies; samples have two bytes instead of one
    keeps_fine_ = keeps_fine_ && depth_ == 16;
    is_deep_ = keeps_fine_ || (depth_ == 16 && (profile_size_ > 0 || gamma_ > 0) &&
                               (kSamples + 1) * width_ * height_ <= budget().pixels);
    pixels.take(width_, height_, name_, keeps_fine_ ? kSamples + kFineCopies : 1);
  }

  void convert() {
    const std::string profile(reinterpret_cast<const char*>(profile_), profile_size_);
    if (keeps_fine_) {
      image_ = Image(deep_.width, deep_.height);
      image_.fine = profile_size_ > 0 ? fine_in_srgb(deep_, profile)
                                      : fine_in_srgb(deep_, primaries_, gamma_);
      round_fine(image_);
    } else if (is_deep_) {
      image_ = profile_size_ > 0 ? in_srgb(deep_, profile) : in_srgb(deep_, primaries_, gamma_);
    } else if (profile_size_ > 0) {
      to_srgb(image_, profile);
    } else if (gamma_ > 0) {
      to_srgb(image_, primaries_, gamma_);
    }
    deep_ = {};
  }

  void run(void (PngReader::*step)()) {
    if (setjmp(png_jmpbuf(png_)) == 0)
      (this->*step)();
    else
      throw Error(ErrorKind::bad_input,
                  name_ + (ended_ ? ": the picture is incomplete: the file ends too early"
                                  : ": the picture is damaged (" + std::string(message_) + ")"));
  }

  static void on_error(png_structp png, png_const_charp message) {
    auto* reader = static_cast<PngReader*>(png_get_error_ptr(png));
    std::strncpy(reader->message_, message, sizeof reader->message_ - 1);
    png_longjmp(png, 1);
  }

  static void take(png_structp png, png_bytep out, size_t count) {
    auto* reader = static_cast<PngReader*>(png_get_io_ptr(png));
    if (count > reader->bytes_.size() - reader->at_) {
      reader->ended_ = true;
      png_error(png, "");
    }
    std::memcpy(out, reader->bytes_.data() + reader->at_, count);
    reader->at_ += count;
  }

  void read_header() {
    constexpr png_alloc_size_t kLargestChunk = 16 << 20;
    png_set_read_fn(png_, this, take);
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // the budget limits the size
    png_set_chunk_malloc_max(png_, kLargestChunk);
    png_set_chunk_cache_max(png_, 1);  // text chunks are not needed
    png_read_info(png_, info_);
    int colors = 0;
    png_get_IHDR(png_, info_, &width_, &height_, &depth_, &colors, nullptr, nullptr, nullptr);
    read_colors();
  }

  /// Sets up the conversion to RGBA. This makes libpng allocate its row buffers, so the picture's
  /// size must have been checked before.
  void prepare() {
    png_set_expand(png_);
    if (!is_deep_)
      png_set_scale_16(png_);
    else if constexpr (std::endian::native == std::endian::little)
      png_set_swap(png_);
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, is_deep_ ? 65535 : 255, PNG_FILLER_AFTER);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    if (png_get_rowbytes(png_, info_) != (is_deep_ ? 8 : 4) * static_cast<size_t>(width_))
      png_error(png_, "its rows have an unknown format");
  }

  /// An sRGB chunk means that no conversion is needed.
  void read_colors() {
    int how = 0;
    png_charp name = nullptr;
    if (png_get_sRGB(png_, info_, &how)) return;
    if (png_get_iCCP(png_, info_, &name, &how, &profile_, &profile_size_)) return;
    if (!png_get_gAMA(png_, info_, &gamma_)) return;
    Chromaticities& p = primaries_;
    png_get_cHRM(png_, info_, p.white, p.white + 1, p.red, p.red + 1, p.green, p.green + 1, p.blue,
                 p.blue + 1);
  }

  void read_pixels() {
    png_read_image(png_, rows_.data());
    png_read_end(png_, info_);
    png_get_eXIf_1(png_, info_, &exif_size_, &exif_);
  }

  const std::string& bytes_;
  const std::string& name_;
  size_t at_ = 0;
  bool ended_ = false;
  int depth_ = 8;
  bool keeps_fine_;
  bool is_deep_ = false;  ///< samples of 16 bits are converted before they are rounded to 8 bits
  char message_[200] = "";
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  png_uint_32 width_ = 0, height_ = 0;
  png_bytep profile_ = nullptr;  ///< owned by libpng
  png_uint_32 profile_size_ = 0;
  double gamma_ = 0;
  Chromaticities primaries_;
  png_bytep exif_ = nullptr;  ///< owned by libpng
  png_uint_32 exif_size_ = 0;
  Image image_;
  DeepImage deep_;  ///< the samples, if they are deep
  std::vector<png_bytep> rows_;
};

/// Functions that longjmp can interrupt have no local objects with destructors, as in PngReader.
class PngWriter {
 public:
  explicit PngWriter(const Image& image)
      : image_(image), row_(4 * static_cast<size_t>(image.width)) {
    const auto fail = [](png_structp png, png_const_charp) { png_longjmp(png, 1); };
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, [](auto, auto) {});
    if (png_) info_ = png_create_info_struct(png_);
    if (!info_) throw Error(ErrorKind::failed, "not enough memory for a PNG picture");
  }
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  std::string bytes() {
    if (setjmp(png_jmpbuf(png_)) == 0)
      write();
    else
      throw Error(ErrorKind::failed, "the picture could not be encoded as PNG");
    return std::move(bytes_);
  }

 private:
  void write() {
    const auto append = [](png_structp png, png_bytep data, size_t size) {
      static_cast<std::string*>(png_get_io_ptr(png))
          ->append(reinterpret_cast<const char*>(data), size);
    };
    png_set_write_fn(png_, &bytes_, append, [](auto) {});
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(image_.width),
                 static_cast<png_uint_32>(image_.height), 16, PNG_COLOR_TYPE_RGB_ALPHA,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png_, info_, PNG_sRGB_INTENT_RELATIVE);
    png_write_info(png_, info_);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    for (int r = 0; r < image_.height; ++r) {
      for (size_t i = 0; i < row_.size(); ++i) row_[i] = sample(image_.index(0, r) + i);
      png_write_row(png_, reinterpret_cast<png_bytep>(row_.data()));
    }
    png_write_end(png_, info_);
  }
  std::uint16_t sample(size_t i) const {
    constexpr float kStep = 257;  // 16-bit steps per 8-bit step
    if (image_.fine.empty()) return static_cast<std::uint16_t>(257 * image_.pixels[i]);
    const float exact = kStep * image_.fine[i];
    return exact > 0 ? static_cast<std::uint16_t>(std::min(exact + 0.5f, 65535.0f)) : 0;
  }

  const Image& image_;
  std::vector<std::uint16_t> row_;
  std::string bytes_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

bool is_png(const std::string& bytes) {
  return bytes.starts_with("\x89PNG");
}

/// The chunk acTL of an animated PNG file begins with the number of frames. It comes before the
/// pixels.
void report_png(const std::string& bytes, const std::string& name, ImportReport& report) {
  constexpr size_t kSignature = 8, kAround = 12;  // bytes of a chunk around its content
  const FileBytes file(bytes, name);
  for (size_t place = kSignature; place + kAround <= file.size();) {
    const size_t length = file.big(place, 4);
    const std::string kind = file.text(place + 4, 4);
    if (kind == "IDAT" || kind == "IEND") return;
    if (kind == "acTL" && length >= 4)
      return report_first_of(file.big(place + 8, 4), "pictures", report);
    place += kAround + length;
  }
}

Image decode_png(const std::string& bytes, const std::string& name, PixelBudget& pixels,
                 PixelDepth depth) {
  return PngReader(bytes, name, depth).read(pixels);
}

std::string encode_png_16(const Image& image) {
  return PngWriter(image).bytes();
}

}  // namespace holomorph
