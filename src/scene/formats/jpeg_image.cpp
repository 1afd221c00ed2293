// Reads JPEG files with libjpeg-turbo, from memory: gray, YCbCr, RGB and CMYK, in sRGB and upright.
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
// After cstdio, because jpeglib.h needs FILE.
// clang-format off
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include "core/error.h"
#include "scene/formats/image_formats.h"
#include "scene/formats/to_srgb.h"

namespace holomorph {
namespace {

constexpr int kMostScans = 100;  // a scan covers the whole picture, even if it has few bytes

/// libjpeg reports errors with longjmp, which does not call destructors. Functions that it can
/// interrupt therefore have no local objects with destructors; such objects are members instead.
class JpegReader {
 public:
  JpegReader(const std::string& bytes, const std::string& name) : bytes_(bytes), name_(name) {
    jpeg_.err = jpeg_std_error(&errors_);
    jpeg_.client_data = this;
    errors_.error_exit = [](j_common_ptr jpeg) { reader_of(jpeg).leave(); };
    errors_.emit_message = [](j_common_ptr jpeg, int level) { reader_of(jpeg).warn(level); };
    errors_.output_message = [](j_common_ptr) {};
    progress_.progress_monitor = [](j_common_ptr jpeg) { reader_of(jpeg).count_scans(); };
  }
  ~JpegReader() {
    std::free(profile_);
    jpeg_destroy_decompress(&jpeg_);
  }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  Image read(PixelBudget& pixels) {
    run(&JpegReader::read_header);
    // For a picture with several scans, libjpeg needs memory for a second copy.
    const double copies = jpeg_has_multiple_scans(&jpeg_) ? 2 : 1;
    pixels.take(jpeg_.image_width, jpeg_.image_height, name_, copies);
    const std::string profile(reinterpret_cast<const char*>(profile_), profile_size_);
    const CmykToSrgb cmyk(profile);
    if (jpeg_.out_color_space == JCS_CMYK) cmyk_ = &cmyk;
    image_ = Image(static_cast<int>(jpeg_.image_width), static_cast<int>(jpeg_.image_height));
    row_.resize(4 * static_cast<size_t>(jpeg_.image_width));
    run(&JpegReader::read_pixels);
    if (!cmyk_) to_srgb(image_, profile);
    return upright(std::move(image_), orientation_of_exif(bytes_));
  }

 private:
  static JpegReader& reader_of(j_common_ptr jpeg) {
    return *static_cast<JpegReader*>(jpeg->client_data);
  }

  void run(void (JpegReader::*step)()) {
    if (setjmp(back_) == 0) return (this->*step)();
    if (ended_)
      throw Error(ErrorKind::bad_input,
                  name_ + ": the picture is incomplete: the file ends too early");
    if (scans_)
      throw Error(ErrorKind::bad_input, name_ + ": the picture has more than " +
                                            std::to_string(kMostScans) +
                                            " passes; save it again in another program");
    throw Error(ErrorKind::bad_input, name_ + ": the picture is damaged (" + message_ + ")");
  }

  [[noreturn]] void leave() {
    errors_.format_message(reinterpret_cast<j_common_ptr>(&jpeg_), message_);
    const int code = errors_.msg_code;
    ended_ = ended_ || code == JERR_INPUT_EOF || code == JERR_INPUT_EMPTY;
    std::longjmp(back_, 1);
  }

  /// After these warnings, libjpeg would continue with made-up pixels. They are treated as errors.
  void warn(int level) {
    if (level >= 0) return;
    const int code = errors_.msg_code;
    ended_ = ended_ || code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER;
    if (ended_ || code == JWRN_HUFF_BAD_CODE || code == JWRN_MUST_RESYNC ||
        code == JWRN_ARITH_BAD_CODE || code == JWRN_BOGUS_PROGRESSION)
      leave();
  }

  void count_scans() {
    scans_ = jpeg_.input_scan_number > kMostScans;
    if (scans_) leave();
  }

  void read_header() {
    jpeg_create_decompress(&jpeg_);
    jpeg_.progress = &progress_;
    jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
    jpeg_save_markers(&jpeg_, JPEG_APP0 + 2, 0xffff);  // the color profile
    jpeg_read_header(&jpeg_, TRUE);
    jpeg_read_icc_profile(&jpeg_, &profile_, &profile_size_);
    const bool inks = jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK;
    jpeg_.out_color_space = inks ? JCS_CMYK : JCS_EXT_RGBA;
  }

  void read_pixels() {
    jpeg_start_decompress(&jpeg_);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      std::uint8_t* out = image_.at(0, static_cast<int>(jpeg_.output_scanline));
      JSAMPROW row = cmyk_ ? row_.data() : out;
      jpeg_read_scanlines(&jpeg_, &row, 1);
      if (cmyk_) from_inks(row, out);
    }
    jpeg_finish_decompress(&jpeg_);
  }

  void from_inks(JSAMPROW row, std::uint8_t* out) const {
    // Adobe programs store inverted ink values; other programs do not.
    if (!jpeg_.saw_Adobe_marker)
      for (size_t i = 0; i < row_.size(); ++i) row[i] = static_cast<JSAMPLE>(255 - row[i]);
    cmyk_->row(row, out, image_.width);
  }

  const std::string& bytes_;
  const std::string& name_;
  std::jmp_buf back_;
  jpeg_decompress_struct jpeg_{};
  jpeg_error_mgr errors_{};
  jpeg_progress_mgr progress_{};
  bool ended_ = false, scans_ = false;
  char message_[JMSG_LENGTH_MAX] = "";
  JOCTET* profile_ = nullptr;
  unsigned int profile_size_ = 0;
  const CmykToSrgb* cmyk_ = nullptr;
  Image image_;
  std::vector<JSAMPLE> row_;
};

}  // namespace

bool is_jpeg(const std::string& bytes) {
  return bytes.starts_with("\xff\xd8\xff");
}

Image decode_jpeg(const std::string& bytes, const std::string& name, PixelBudget& pixels) {
  return JpegReader(bytes, name).read(pixels);
}

}  // namespace holomorph
