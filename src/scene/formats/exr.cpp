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

void to_halves(const std::vector<float>& numbers, std::vector<half>& halves) {
  static constexpr float kMost = 65504;  // the largest half float
  std::ranges::transform(numbers, halves.begin(),
                         [](float number) { return half(std::clamp(number, -kMost, kMost)); });
}

}  // namespace

std::string exr_of(const FloatShape& shape, FloatBits bits,
                   const std::function<void(int row, float* out)>& write_row) {
  using Imath::Box2i;
  const int over = shape.overscan;
  const Box2i display({0, 0}, {shape.width - 2 * over - 1, shape.height - 2 * over - 1}),
      data({-over, -over}, {shape.width - over - 1, shape.height - over - 1});
  try {
    const bool is_half = bits == FloatBits::half;
    std::vector<float> row(4 * static_cast<size_t>(shape.width));
    std::vector<half> halves(is_half ? row.size() : 0);
    const size_t size = is_half ? sizeof(half) : sizeof(float);
    char* first =
        is_half ? reinterpret_cast<char*>(halves.data()) : reinterpret_cast<char*>(row.data());
    const Imf::PixelType type = is_half ? Imf::HALF : Imf::FLOAT;
    Imf::Header header(display, data);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    for (size_t k = 0; k < 4; ++k) {
      const std::string name(1, "RGBA"[k]);
      header.channels().insert(name, Imf::Channel(type));
      // All rows are read from the same memory, one after the other.
      char* base = first + k * size + static_cast<std::ptrdiff_t>(4 * size) * over;
      buffer.insert(name, Imf::Slice(type, base, 4 * size, 0));
    }
    StringStream stream;
    {
      Imf::OutputFile file(stream, header);
      file.setFrameBuffer(buffer);
      for (int r = 0; r < shape.height; ++r) {
        write_row(r, row.data());
        if (is_half) to_halves(row, halves);
        file.writePixels(1);
      }
    }
    return stream.take();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(ErrorKind::failed, std::string("OpenEXR: ") + error.what());
  }
}

std::string exr_of(const FloatImage& image, FloatBits bits) {
  const size_t row = 4 * static_cast<size_t>(image.width);
  return exr_of(image, bits, [&](int r, float* out) {
    std::copy_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(row * static_cast<size_t>(r)),
                row, out);
  });
}

}  // namespace holomorph
