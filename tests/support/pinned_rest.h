// Rests and poses of cages with pins, on a mesh.
#pragma once

#include <initializer_list>

#include "core/maps/rest.h"
#include "core/mesh/mesher.h"

namespace holomorph {

/// A rest whose samples are the vertices of a mesh with about this many of them.
inline Rest rest_of(const Cage& cage, std::initializer_list<Complex> pins, int vertices = 700) {
  Rest rest;
  rest.cage = cage;
  const auto mesh = std::make_shared<const Mesh>(domain_mesh(cage, {vertices}));
  rest.mesh = mesh;
  rest.samples = mesh->vertices;
  for (const Complex& z : pins) rest.pins.push_back({z});
  return rest;
}

inline Pose at_rest(const Rest& rest) {
  Pose pose{rest.cage, {}};
  for (const RestPin& pin : rest.pins) pose.pins.push_back({pin.position});
  return pose;
}

}  // namespace holomorph
