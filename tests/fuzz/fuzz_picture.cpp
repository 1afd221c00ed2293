// Reads any bytes as a picture: an Error, or as many pixels as its size states.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/image.h"
#include "scene/formats/layered.h"

using namespace holomorph;

namespace {

/// The checksum that libpng requires at the end of each chunk before it looks at the content.
std::uint32_t checksum(const std::uint8_t* data, size_t size) {
  std::uint32_t sum = 0xffffffff;
  for (size_t i = 0; i < size; ++i) {
    sum ^= data[i];
    for (int bit = 0; bit < 8; ++bit) sum = sum & 1 ? sum >> 1 ^ 0xedb88320 : sum >> 1;
  }
  return ~sum;
}

void mend_checksums(std::uint8_t* data, size_t size) {
  if (size < 8 || std::memcmp(data, "\x89PNG", 4) != 0) return;
  for (size_t at = 8; at + 12 <= size;) {
    const size_t length =
        static_cast<size_t>(data[at]) << 24 | data[at + 1] << 16 | data[at + 2] << 8 | data[at + 3];
    if (length > size - at - 12) return;
    const std::uint32_t sum = checksum(data + at + 4, length + 4);
    for (size_t k = 0; k < 4; ++k)
      data[at + 8 + length + k] = static_cast<std::uint8_t>(sum >> (24 - 8 * k));
    at += 12 + length;
  }
}

}  // namespace

extern "C" size_t LLVMFuzzerMutate(std::uint8_t* data, size_t size, size_t most);
extern "C" size_t LLVMFuzzerCustomMutator(std::uint8_t* data, size_t size, size_t most,
                                          unsigned int seed) {
  const size_t now = LLVMFuzzerMutate(data, size, most);
  if (seed % 8 != 0) mend_checksums(data, now);
  return now;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  static const bool set = [] {
    Budget small;
    small.pixels = 1e6;
    set_budget(small);
    return true;
  }();
  check(set, "the budget is set");
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
    PixelBudget again;
    if (bytes.starts_with("PK") || bytes.starts_with("8BPS"))
      for (const FileLayer& layer : layers_of_file(bytes, "fuzz").layers)
        decode_layer(bytes, layer.entry, "fuzz", again);
  } catch (const Error&) {
  }
  try {
    PixelBudget alone;
    const Image image =
        decode_image(bytes, "fuzz", alone, size % 2 ? PixelDepth::full : PixelDepth::eight_bits);
    check(image.width > 0 && image.height > 0 &&
              image.pixels.size() ==
                  4u * static_cast<size_t>(image.width) * static_cast<size_t>(image.height),
          "a picture has as many pixels as its size says");
    check(image.fine.empty() || image.fine.size() == image.pixels.size(),
          "all pixels are fine, or none");
    check(std::ranges::all_of(image.fine, [](float x) { return x >= 0 && std::isfinite(x); }),
          "fine pixels are finite");
  } catch (const Error&) {
  }
  return 0;
}
