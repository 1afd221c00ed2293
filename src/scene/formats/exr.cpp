// Writes OpenEXR files into memory with the library OpenEXR, so that files appear as a whole.
#include "scene/formats/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>

#include <half.h>
#include <algorithm>

#include "core/error.h"

namespace holomorph {
namespace {

/// Writes into a string.
class StringStream : public Imf::OStream {
 public:
  StringStream() : OStream("OpenEXR") {}
  void write(const char* bytes, int count) override {
    const size_t size = static_cast<size_t>(count);
    text_.resize(std::max(text_.size(), at_ + size));
    std::copy_n(bytes, count, text_.begin() + static_cast<std::ptrdiff_t>(at_));
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = at; }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  size_t at_ = 0;
};

std::vector<half> halves_of(const std::vector<float>& numbers) {
  constexpr float kMost = 65504;  // the largest half float
  std::vector<half> halves;
  halves.reserve(numbers.size());
  for (const float number : numbers) halves.emplace_back(std::clamp(number, -kMost, kMost));
  return halves;
}

}  // namespace

std::string exr_of(const FloatImage& image, FloatBits bits) {
  using Imath::Box2i;
  const int over = image.overscan;
  const Box2i display({0, 0}, {image.width - 2 * over - 1, image.height - 2 * over - 1}),
      data({-over, -over}, {image.width - over - 1, image.height - over - 1});
  try {
    const bool is_half = bits == FloatBits::half;
    const std::vector<half> halves = is_half ? halves_of(image.pixels) : std::vector<half>();
    const size_t size = is_half ? sizeof(half) : sizeof(float),
                 columns = static_cast<size_t>(image.width);
    const char* first = is_half ? reinterpret_cast<const char*>(halves.data())
                                : reinterpret_cast<const char*>(image.pixels.data());
    const Imf::PixelType type = is_half ? Imf::HALF : Imf::FLOAT;
    Imf::Header header(display, data);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    for (size_t k = 0; k < 4; ++k) {
      const std::string name(1, "RGBA"[k]);
      header.channels().insert(name, Imf::Channel(type));
      // OpenEXR only reads from the buffer.
      buffer.insert(name, Imf::Slice::Make(type, const_cast<char*>(first) + k * size, data,
                                           4 * size, 4 * size * columns));
    }
    StringStream stream;
    {
      Imf::OutputFile file(stream, header);
      file.setFrameBuffer(buffer);
      file.writePixels(image.height);
    }
    return stream.take();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(ErrorKind::failed, std::string("OpenEXR: ") + error.what());
  }
}

}  // namespace holomorph
