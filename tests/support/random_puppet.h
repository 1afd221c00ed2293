// Random shapes with three to six pins.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>

#include "core/maps/rest.h"
#include "core/mesh/mesher.h"
#include "support/shapes.h"

namespace holomorph {

/// The methods that keep sizes, follow pins and never fold. HOLOMORPH_METHOD sets a single one, for
/// measurements.
inline std::vector<std::string> puppet_methods() {
  if (const char* given = std::getenv("HOLOMORPH_METHOD")) return {given};
  return {"puppet", "sheet"};
}

/// A shape with pins, for such methods.
struct Puppet {
  Rest rest;
  double size = 1;  ///< the diagonal
};

inline Puppet random_puppet(std::mt19937& random) {
  Puppet puppet;
  const int kind = static_cast<int>(random() % 4);
  const Points outline = kind == 0   ? shapes::rectangle(600, 100)
                         : kind == 1 ? shapes::l_shape()
                         : kind == 2
                             ? shapes::star(6 + static_cast<int>(random() % 20), 0.5, random())
                             : shapes::star(9, 0.7, random());
  puppet.rest.cage = polygon_cage(outline);
  const auto mesh = std::make_shared<const Mesh>(domain_mesh(puppet.rest.cage, {400}));
  puppet.rest.mesh = mesh;
  puppet.rest.samples = mesh->vertices;
  puppet.size = box_of(outline).diagonal();
  const size_t pins = 3 + random() % 4;
  for (int tries = 0; puppet.rest.pins.size() < pins && tries < 1000; ++tries) {
    const Complex z = mesh->vertices[random() % mesh->vertices.size()];
    const bool is_near = std::ranges::any_of(puppet.rest.pins, [&](const RestPin& pin) {
      return std::abs(pin.position - z) < 0.1 * puppet.size;
    });
    if (!is_near) puppet.rest.pins.push_back({z});
  }
  return puppet;
}

}  // namespace holomorph
