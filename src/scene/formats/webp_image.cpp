// Reads and writes WebP files with libwebp.
#include <webp/decode.h>
#include <webp/demux.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <memory>

#include "core/error.h"
#include "scene/formats/image_formats.h"
#include "scene/formats/to_srgb.h"

namespace holomorph {

bool is_webp(const std::string& bytes) {
  return bytes.size() > 12 && bytes.starts_with("RIFF") && bytes.compare(8, 4, "WEBP") == 0;
}

namespace {

/// Draws the first frame of an animated picture, as large as its canvas.
bool decode_first_frame(const std::string& bytes, Image& image) {
  const WebPData file{reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
  WebPAnimDecoderOptions options;
  if (!WebPAnimDecoderOptionsInit(&options)) return false;
  options.color_mode = MODE_RGBA;
  const std::unique_ptr<WebPAnimDecoder, void (*)(WebPAnimDecoder*)> decoder(
      WebPAnimDecoderNew(&file, &options), WebPAnimDecoderDelete);
  uint8_t* pixels = nullptr;
  int time = 0;
  WebPAnimInfo info{};
  if (!decoder || !WebPAnimDecoderGetInfo(decoder.get(), &info) ||
      static_cast<int>(info.canvas_width) != image.width ||
      static_cast<int>(info.canvas_height) != image.height ||
      !WebPAnimDecoderGetNext(decoder.get(), &pixels, &time))
    return false;
  std::copy_n(pixels, image.pixels.size(), image.pixels.data());
  return true;
}

/// A chunk with metadata, such as Exif data or a color profile; empty if there is none.
std::string chunk_of(const std::string& bytes, const char* kind) {
  const WebPData file{reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
  const std::unique_ptr<WebPMux, void (*)(WebPMux*)> mux(WebPMuxCreate(&file, 0), WebPMuxDelete);
  WebPData chunk{};
  if (!mux || WebPMuxGetChunk(mux.get(), kind, &chunk) != WEBP_MUX_OK) return "";
  return {reinterpret_cast<const char*>(chunk.bytes), chunk.size};
}

int orientation_of(const std::string& bytes) {
  const std::string exif = chunk_of(bytes, "EXIF");
  if (exif.empty()) return 1;
  return orientation_of_exif(exif.starts_with("Exif") ? exif
                                                      : "Exif" + std::string(2, '\0') + exif);
}

}  // namespace

void report_webp(const std::string& bytes, const std::string&, ImportReport& report) {
  const WebPData file{reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
  const std::unique_ptr<WebPMux, void (*)(WebPMux*)> mux(WebPMuxCreate(&file, 0), WebPMuxDelete);
  int frames = 0;
  if (mux && WebPMuxNumChunks(mux.get(), WEBP_CHUNK_ANMF, &frames) == WEBP_MUX_OK)
    report_first_of(static_cast<size_t>(frames), "pictures", report);
}

Image decode_webp(const std::string& bytes, const std::string& name, PixelBudget& pixels) {
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  WebPBitstreamFeatures features{};
  if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK)
    throw Error(ErrorKind::bad_input, name + ": the WebP picture is damaged");
  // The header contains the length of the file.
  const auto byte = [&](size_t i) { return static_cast<size_t>(data[i]); };
  if ((byte(4) | byte(5) << 8 | byte(6) << 16 | byte(7) << 24) + 8 > bytes.size())
    throw Error(ErrorKind::bad_input,
                name + ": the picture is incomplete: the file ends too early");
  pixels.take(static_cast<size_t>(features.width), static_cast<size_t>(features.height), name);
  Image image(features.width, features.height);
  if (!(features.has_animation
            ? decode_first_frame(bytes, image)
            : WebPDecodeRGBAInto(data, bytes.size(), image.pixels.data(), image.pixels.size(),
                                 4 * image.width) != nullptr))
    throw Error(ErrorKind::bad_input, name + ": the WebP picture is damaged");
  if (const std::string profile = chunk_of(bytes, "ICCP"); !profile.empty())
    to_srgb(image, profile);
  return upright(std::move(image), orientation_of(bytes));
}

std::string encode_webp(const Image& image) {
  if (std::max(image.width, image.height) > WEBP_MAX_DIMENSION)
    throw Error(ErrorKind::failed, "WebP pictures have at most 16383 pixels per side; use PNG");
  std::uint8_t* data = nullptr;
  const size_t size = WebPEncodeLosslessRGBA(image.pixels.data(), image.width, image.height,
                                             4 * image.width, &data);
  const std::unique_ptr<std::uint8_t, void (*)(void*)> owner(data, WebPFree);
  if (size == 0) throw Error(ErrorKind::failed, "the picture could not be encoded as WebP");
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace holomorph
