// A bar with three pins on its middle line.
#pragma once

#include "scene/deformation.h"

namespace holomorph {

inline Deformation pinned_bar(const std::string& method) {
  Deformation deformation =
      with_cage(Deformation{}, Points{{0, 0}, {600, 0}, {600, 100}, {0, 100}});
  deformation.method = method;
  for (const Complex z : {Complex(50, 50), Complex(300, 50), Complex(550, 50)})
    deformation.pins.push_back({z, z, {}, {}});
  return deformation;
}

}  // namespace holomorph
