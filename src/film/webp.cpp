// Writes animated WebP with libwebp. Each frame is lossless if that is smaller, otherwise lossy.
#include <webp/encode.h>
#include <webp/mux.h>

#include "core/error.h"
#include "film/film_writer.h"
#include "system/new_file.h"

namespace holomorph {
namespace {

[[noreturn]] void fail(const Path& out, const char* what) {
  throw Error(ErrorKind::failed, out.string() + ": the WebP encoder failed: " + what);
}

class WebpWriter final : public FilmWriter {
 public:
  WebpWriter(const Path& out, const FilmShape& shape) : out_(out), shape_(shape) {
    constexpr int kLargest = 16383;  // limit of the format
    if (shape.width > kLargest || shape.height > kLargest)
      throw Error(ErrorKind::bad_input,
                  "WebP pictures have at most 16383 pixels on a side; choose a smaller scale");
    WebPAnimEncoderOptions options;
    if (!WebPAnimEncoderOptionsInit(&options) || !WebPConfigInit(&config_))
      fail(out, "the library has an incompatible version");
    options.anim_params.loop_count = shape.loops ? 0 : 1;
    options.allow_mixed = 1;
    config_.quality = 90;
    config_.method = 3;
    encoder_.reset(WebPAnimEncoderNew(shape.width, shape.height, &options));
    if (!encoder_) fail(out, "not enough memory");
  }

  void add(const Image& frame) override {
    WebPPicture picture;
    if (!WebPPictureInit(&picture)) fail(out_, "the library has an incompatible version");
    picture.use_argb = 1;
    picture.width = frame.width;
    picture.height = frame.height;
    const bool added = WebPPictureImportRGBA(&picture, frame.pixels.data(), 4 * frame.width) &&
                       WebPAnimEncoderAdd(encoder_.get(), &picture, milliseconds(), &config_);
    WebPPictureFree(&picture);
    if (!added) fail(out_, WebPAnimEncoderGetError(encoder_.get()));
    ++frames_;
  }

  void finish() override {
    WebPData data;
    WebPDataInit(&data);
    if (!WebPAnimEncoderAdd(encoder_.get(), nullptr, milliseconds(), nullptr) ||
        !WebPAnimEncoderAssemble(encoder_.get(), &data))
      fail(out_, WebPAnimEncoderGetError(encoder_.get()));
    const std::string bytes(reinterpret_cast<const char*>(data.bytes), data.size);
    WebPDataClear(&data);
    write_file(out_, bytes);
  }

 private:
  int milliseconds() const {
    return static_cast<int>(std::lround(1000 * frames_ / shape_.frames_per_second));
  }
  struct Delete {
    void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
  };

  Path out_;
  FilmShape shape_;
  WebPConfig config_{};
  std::unique_ptr<WebPAnimEncoder, Delete> encoder_;
  int frames_ = 0;
};

}  // namespace

std::unique_ptr<FilmWriter> webp_writer(const Path& out, const FilmShape& shape) {
  return std::make_unique<WebpWriter>(out, shape);
}

}  // namespace holomorph
