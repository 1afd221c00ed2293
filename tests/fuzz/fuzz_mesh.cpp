// Meshes any polygon: an Error, or a mesh with positive triangles that fill it and with finite
// coordinates.
#include <cstring>

#include "core/cauchy/cauchy_array.h"
#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/mesh/mesher.h"

using namespace holomorph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  if (size < 1) return 0;
  // The first byte selects a scale, and whether coordinates have 16 bits, which makes coincidences
  // common, or also have small relative perturbations, which make near misses common.
  const double scale = std::ldexp(1.0, (data[0] % 24) - 12);
  const bool jitters = data[0] >= 128;
  const size_t stride = jitters ? 6 : 4;
  Points polygon;
  for (size_t i = 1; i + stride <= size && polygon.size() < 60; i += stride) {
    std::int16_t xy[2];
    std::memcpy(xy, data + i, 4);
    Complex z(xy[0], xy[1]);
    if (jitters)  // relative perturbations of 2^-52 to 2^-20
      for (int k = 0; k < 2; ++k) {
        const int byte = data[i + 4 + k];
        const double by = std::ldexp(1.0, 15 - 52 + byte % 33) * (byte % 2 ? 1 : -1);
        z += k ? Complex(0, by) : Complex(by, 0);
      }
    polygon.push_back(scale * z);
  }
  try {
    const Mesh mesh = domain_mesh(polygon, {120});
    double area = 0;
    for (const Triangle& t : mesh.triangles) {
      const double twice = cross(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                                 mesh.vertices[t[2]] - mesh.vertices[t[0]]);
      check(twice > 0, "triangles are counter-clockwise");
      area += 0.5 * twice;
    }
    const double exact = std::abs(signed_area(polygon)),
                 size2 = std::norm(Complex(box_of(polygon).diagonal(), 0));
    check(std::abs(area - exact) <= 1e-9 * size2, "triangles fill the polygon");
    const auto C = planar_coordinates<double>(polygon_cage(polygon), mesh.vertices);
    check(C.re.allFinite() && C.im.allFinite(), "coordinates are finite");
  } catch (const Error&) {
  }
  return 0;
}
