// Writes animated PNG. Each frame is encoded as a PNG, whose image data becomes one frame of the
// film. The few chunks around the frames are written here, because no packaged library writes them.
#include <zlib.h>

#include "film/film_writer.h"
#include "film/ordered_tasks.h"
#include "system/new_file.h"

namespace holomorph {
namespace {

constexpr size_t kSignature = 8;

std::string big_endian(std::uint32_t value, int bytes) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
    text += static_cast<char>(value >> shift & 255);
  return text;
}

std::uint32_t number_at(const std::string& bytes, size_t at) {
  std::uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const uLong check =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(static_cast<std::uint32_t>(data.size()), 4) + body +
         big_endian(static_cast<std::uint32_t>(check), 4);
}

class ApngWriter final : public FilmWriter {
 public:
  ApngWriter(const Path& out, const FilmShape& shape) : out_(out), shape_(shape) {}

  void add(const Image& frame) override {
    pngs_.add([frame] { return encode_png(frame); });
  }

  void finish() override {
    pngs_.finish();
    write_file(out_,
               head_ + chunk("acTL", big_endian(frames_, 4) + big_endian(shape_.loops ? 0 : 1, 4)) +
                   body_ + chunk("IEND", ""));
  }

 private:
  void append(const std::string& png) {
    std::string data;
    for (size_t at = kSignature; at + 12 <= png.size();) {
      const size_t length = number_at(png, at);
      const std::string type = png.substr(at + 4, 4);
      if (type == "IHDR" && frames_ == 0)
        head_ = png.substr(0, kSignature) + png.substr(at, length + 12);
      if (type == "IDAT") data += png.substr(at + 8, length);
      at += length + 12;
    }
    // Number, size, offset, duration, disposal 1 (clear afterward), blending 0 (replace). The
    // duration is a fraction with numerator 250, which is exact for rates like 24 and 23.976.
    const std::uint32_t first = sequence_++;
    body_ += chunk(
        "fcTL",
        big_endian(first, 4) + big_endian(static_cast<std::uint32_t>(shape_.width), 4) +
            big_endian(static_cast<std::uint32_t>(shape_.height), 4) + big_endian(0, 4) +
            big_endian(0, 4) + big_endian(250, 2) +
            big_endian(static_cast<std::uint32_t>(std::lround(250 * shape_.frames_per_second)), 2) +
            big_endian(1, 1) + big_endian(0, 1));
    body_ += frames_ == 0 ? chunk("IDAT", data) : chunk("fdAT", big_endian(sequence_, 4) + data);
    if (frames_ > 0) ++sequence_;
    ++frames_;
  }

  Path out_;
  FilmShape shape_;
  std::string head_, body_;
  std::uint32_t frames_ = 0, sequence_ = 0;
  OrderedTasks<std::string> pngs_{[this](const std::string& png) { append(png); }};
};

}  // namespace

std::unique_ptr<FilmWriter> apng_writer(const Path& out, const FilmShape& shape) {
  return std::make_unique<ApngWriter>(out, shape);
}

}  // namespace holomorph
