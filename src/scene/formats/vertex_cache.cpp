// MDD has its highest byte first, and PC2 its lowest.
#include <cstring>

#include "scene/formats/moving_mesh.h"

namespace holomorph {
namespace {

class CacheWriter {
 public:
  explicit CacheWriter(bool highest_byte_first) : highest_byte_first_(highest_byte_first) {}
  void text(std::string_view bytes) { bytes_ += bytes; }
  void whole(size_t number) { put(static_cast<std::uint32_t>(number)); }
  void real(double number) {
    const auto single = static_cast<float>(number);
    std::uint32_t bits;
    std::memcpy(&bits, &single, sizeof bits);
    put(bits);
  }
  void frames(const MovingMesh& mesh) {
    for (const Points& frame : mesh.frames)
      for (const Complex& z : frame) {
        real(z.real());
        real(z.imag());
        real(0);
      }
  }
  std::string bytes() && { return std::move(bytes_); }

 private:
  void put(std::uint32_t bits) {
    for (int k = 0; k < 4; ++k)
      bytes_ += static_cast<char>(bits >> (8 * (highest_byte_first_ ? 3 - k : k)) & 255);
  }

  std::string bytes_;
  bool highest_byte_first_;
};

}  // namespace

std::string mdd_of(const MovingMesh& mesh, const std::vector<double>& times) {
  CacheWriter writer(true);
  writer.whole(mesh.frames.size());
  writer.whole(mesh.rest.size());
  for (const double time : times) writer.real(time - times[0]);
  writer.frames(mesh);
  return std::move(writer).bytes();
}

std::string pc2_of(const MovingMesh& mesh, const std::vector<double>& times) {
  constexpr size_t kVersion = 1;
  CacheWriter writer(false);
  writer.text(std::string_view("POINTCACHE2\0", 12));
  writer.whole(kVersion);
  writer.whole(mesh.rest.size());
  writer.real(0);  // the first frame
  writer.real(1);  // samples per frame
  writer.whole(times.size());
  writer.frames(mesh);
  return std::move(writer).bytes();
}

}  // namespace holomorph
