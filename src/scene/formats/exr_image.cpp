// Reads OpenEXR files from memory with the library OpenEXR, and writes pictures in this format.
// Their colors are linear and premultiplied. With 8 bits, values above white are clipped.
#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfMultiPartInputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfVersion.h>
#include <ImfXdr.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "scene/formats/exr.h"
#include "scene/formats/exr_stream.h"
#include "scene/formats/image_formats.h"

namespace holomorph {
namespace {

/// How many lines a compression stores together.
int lines_together(Imf::Compression compression) {
  switch (compression) {
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
      return 1;
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 16;
    case Imf::PIZ_COMPRESSION:
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
      return 32;
    default:
      return 256;
  }
}

/// Throws Error if reading a few lines of a file would take much memory. The library checks the
/// sizes of pictures and tiles, but not the number of channels.
void check_memory(const std::string& bytes, const std::string& name) {
  constexpr double kMost = 1 << 28;  // bytes
  ExrStream stream(bytes, name);
  stream.seekg(4);
  int version = 0;
  Imf::Xdr::read<Imf::StreamIO>(stream, version);
  Imf::Header header;
  header.readFrom(stream, version);
  header.sanityCheck(header.hasTileDescription(), Imf::isMultiPart(version));
  double pixel = 0;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
    pixel += channel.channel().type == Imf::HALF ? 2 : 4;
  const Imath::Box2i& data = header.dataWindow();
  const double width = static_cast<double>(data.max.x) - static_cast<double>(data.min.x) + 1;
  const double lines = header.hasTileDescription() ? header.tileDescription().ySize
                                                   : lines_together(header.compression());
  if (width * lines * pixel > kMost)
    throw Error(ErrorKind::bad_input,
                name + ": reading a line of the picture takes too much memory; it has " +
                    std::to_string(static_cast<int>(pixel)) + " bytes per pixel");
}

/// Limits what the library reads. Throws Error if reading the file would take much memory.
void check_limits(const std::string& bytes, const std::string& name) {
  constexpr int kLargest = 16384, kLargestTile = 2048;
  static const bool limited = [] {
    Imf::Header::setMaxImageSize(kLargest, kLargest);
    Imf::Header::setMaxTileSize(kLargestTile, kLargestTile);
    return true;
  }();
  check(limited, "check_limits: limits are set");
  check_memory(bytes, name);
}

/// The matrix from a file's linear colors, as row vectors, to those of sRGB. Colors are adapted to
/// the other white by the Bradford transform.
Imath::M33f to_linear_srgb(const Imf::Chromaticities& from) {
  const Imf::Chromaticities srgb;
  const auto part = [](const Imath::M44f& m) {
    return Imath::M33f(m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1],
                       m[2][2]);
  };
  const Imath::M33f cones(0.8951f, -0.7502f, 0.0389f, 0.2664f, 1.7135f, -0.0685f, -0.1614f, 0.0367f,
                          1.0296f);
  const auto white = [&](const Imf::Chromaticities& colors) {
    const Imath::V2f& w = colors.white;
    return Imath::V3f(w.x / w.y, 1, (1 - w.x - w.y) / w.y) * cones;
  };
  const Imath::V3f scale = white(srgb) / white(from);
  const Imath::M33f adapted(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
  return part(Imf::RGBtoXYZ(from, 1)) * cones * adapted * cones.inverse() *
         part(Imf::XYZtoRGB(srgb, 1));
}

/// The sample, or the nearest number up to that of a half; 0 for NaN.
float finite(float sample) {
  const float most = HALF_MAX;
  return sample == sample ? std::clamp(sample, -most, most) : 0;
}

/// From linear to sRGB. The curve continues above white. NaN and negative numbers become 0.
float srgb_of(float linear) {
  if (!(linear > 0)) return 0;
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}
float linear_of(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}
std::uint8_t srgb_byte(float linear) {
  return static_cast<std::uint8_t>(std::lround(255 * srgb_of(std::min(linear, 1.0f))));
}

struct Sample {
  float r = 0, g = 0, b = 0, a = 1;
};

/// Reads rows of a file. Samples stored as floats keep their accuracy.
class Rows {
 public:
  Rows(ExrStream& stream, const std::string& name) : file_(stream) {
    const Imf::ChannelList& channels = file_.header().channels();
    const auto has = [&](const char* channel) { return channels.findChannel(channel) != nullptr; };
    const bool colors = has("R") || has("G") || has("B");
    if (!colors && !has("Y"))
      throw Error(ErrorKind::bad_input,
                  name + ": the OpenEXR file has no channels R, G, B or Y in its first part");
    const Imath::Box2i& stored = file_.header().dataWindow();
    row_.resize(static_cast<size_t>(std::int64_t{stored.max.x} - stored.min.x + 1));
    left_ = stored.min.x;
    if (!colors && (has("RY") || has("BY"))) {
      // The library interpolates colors that are stored for every other pixel, as halves.
      stream.seekg(0);
      converted_ = std::make_unique<Imf::RgbaInputFile>(stream);
      halves_.resize(row_.size());
      return;
    }
    gray_ = !colors;
    insert(gray_ ? "Y" : "R", &Sample::r, 0);
    if (!gray_) {
      insert("G", &Sample::g, 0);
      insert("B", &Sample::b, 0);
    }
    insert("A", &Sample::a, 1);
    file_.setFrameBuffer(buffer_);
  }

  const Imf::Header& header() const { return file_.header(); }

  /// The samples of row y, from the left of the data window.
  const std::vector<Sample>& row(int y) {
    if (converted_) {
      converted_->setFrameBuffer(halves_.data() - left_, 1, 0);
      converted_->readPixels(y);
      for (size_t i = 0; i < row_.size(); ++i)
        row_[i] = {halves_[i].r, halves_[i].g, halves_[i].b, halves_[i].a};
      return row_;
    }
    file_.readPixels(y);
    if (gray_)
      for (Sample& sample : row_) sample.g = sample.b = sample.r;
    return row_;
  }

 private:
  void insert(const char* channel, float Sample::*place, double missing) {
    char* base = reinterpret_cast<char*>(&(row_.front().*place));
    buffer_.insert(channel, Imf::Slice(Imf::FLOAT,
                                       base - std::ptrdiff_t{left_} *
                                                  static_cast<std::ptrdiff_t>(sizeof(Sample)),
                                       sizeof(Sample), 0, 1, 1, missing));
  }

  Imf::InputFile file_;
  std::unique_ptr<Imf::RgbaInputFile> converted_;
  Imf::FrameBuffer buffer_;
  std::vector<Sample> row_;
  std::vector<Imf::Rgba> halves_;
  int left_ = 0;
  bool gray_ = false;
};

/// The display window of a file, transparent where it has no pixels.
Image read_display(Rows& rows, const std::string& name, PixelBudget& pixels, PixelDepth depth) {
  const Imath::Box2i shown = rows.header().displayWindow(), stored = rows.header().dataWindow();
  const auto side = [](int low, int high) {
    return static_cast<size_t>(std::max<std::int64_t>(std::int64_t{high} - low + 1, 0));
  };
  const bool keeps_fine = depth == PixelDepth::full;
  pixels.take(side(shown.min.x, shown.max.x), side(shown.min.y, shown.max.y), name,
              keeps_fine ? kFineCopies : 1);
  Image image(shown.max.x - shown.min.x + 1, shown.max.y - shown.min.y + 1);
  if (keeps_fine) image.fine.resize(image.pixels.size());
  const bool is_srgb = !Imf::hasChromaticities(rows.header());
  const Imath::M33f matrix =
      is_srgb ? Imath::M33f() : to_linear_srgb(Imf::chromaticities(rows.header()));
  constexpr float kFaintest = 1e-8f, kBrightest = 1e12f;  // so that quotients are finite
  const int left = std::max(shown.min.x, stored.min.x), right = std::min(shown.max.x, stored.max.x);
  for (int y = std::max(shown.min.y, stored.min.y); y <= std::min(shown.max.y, stored.max.y); ++y) {
    const std::vector<Sample>& row = rows.row(y);
    for (int x = left; x <= right; ++x) {
      const Sample& sample = row[static_cast<size_t>(x - stored.min.x)];
      const float alpha = sample.a > kFaintest ? std::min(sample.a, 1.0f) : 0;
      if (alpha == 0) continue;
      Imath::V3f color(finite(sample.r), finite(sample.g), finite(sample.b));
      color /= alpha;
      if (!is_srgb) color = color * matrix;
      std::uint8_t* out = image.at(x - shown.min.x, y - shown.min.y);
      for (int k = 0; k < 3; ++k) out[k] = srgb_byte(color[k]);
      out[3] = static_cast<std::uint8_t>(std::lround(255 * alpha));
      if (!keeps_fine) continue;
      float* fine = &image.fine[image.index(x - shown.min.x, y - shown.min.y)];
      for (int k = 0; k < 3; ++k) fine[k] = 255 * srgb_of(std::min(color[k], kBrightest));
      fine[3] = 255 * alpha;
    }
  }
  return image;
}

}  // namespace

bool is_exr(const std::string& bytes) {
  return bytes.starts_with("\x76\x2f\x31\x01");
}

Image decode_exr(const std::string& bytes, const std::string& name, PixelBudget& pixels,
                 PixelDepth depth) {
  try {
    check_limits(bytes, name);
    ExrStream stream(bytes, name);
    Rows rows(stream, name);
    return read_display(rows, name, pixels, depth);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(ErrorKind::bad_input, name + ": the picture cannot be read: " + error.what());
  }
}

void report_exr(const std::string& bytes, const std::string& name, ImportReport& report) {
  try {
    check_limits(bytes, name);
    ExrStream stream(bytes, name);
    const Imf::MultiPartInputFile file(stream, 1);
    report_first_of(static_cast<size_t>(file.parts()), "parts", report);
    const Imf::ChannelList& channels = file.header(0).channels();
    const auto has = [&](const char* color) { return channels.findChannel(color) != nullptr; };
    const std::set<std::string> colors = has("R") || has("G") || has("B")
                                             ? std::set<std::string>{"R", "G", "B", "A"}
                                             : std::set<std::string>{"Y", "RY", "BY", "A"};
    size_t others = 0;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
      others += !colors.contains(channel.name());
    if (others > 0)
      report.add("", "left out: its " + std::to_string(others) + " channels that are not colors");
  } catch (const std::exception&) {
    report.add("", "left out: its further parts, which are damaged");
  }
}

std::string encode_exr(const Image& image, int depth) {
  const auto write_row = [&](int row, float* out) {
    for (int column = 0; column < image.width; ++column, out += 4) {
      const size_t i = image.index(column, row);
      const auto from = [&](size_t k) {
        return (image.fine.empty() ? static_cast<float>(image.pixels[i + k]) : image.fine[i + k]) /
               255;
      };
      out[3] = from(3);
      for (size_t k = 0; k < 3; ++k) out[k] = out[3] * linear_of(from(k));
    }
  };
  return exr_of({image.width, image.height}, depth == 32 ? FloatBits::single : FloatBits::half,
                write_row);
}

}  // namespace holomorph
