// The rest and pose that the contract tests use for every method.
#pragma once

#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph {

struct Setup {
  Rest rest;
  Pose pose;
};

inline Complex bend(Complex z) {
  return z + 25.0 * std::sin(z.imag() / 60) + kI * (z.real() * 0.12);
}

/// The edges of the rest cage: straight, straight with a higher degree, or curved. `holes` is a
/// cage with straight edges and two unequal holes, one of which runs in the wrong direction.
enum class Shape { straight, raised, curved, holes };

/// Straight edges, curved ones and holes, as far as a method allows them. In scripts/test, methods
/// that solve have no curved edges, because that is where holes matter, and others no holes.
inline std::vector<Shape> shapes_for(const Method& method) {
  std::vector<Shape> shapes{Shape::straight};
  if (method.allows_holes && (method.iterates || soaks())) shapes.push_back(Shape::holes);
  if (shapes.size() == 1 || soaks()) shapes.push_back(Shape::curved);
  return shapes;
}

inline Cage cage_of(Shape shape) {
  const Cage straight = polygon_cage(shapes::l_shape());
  if (shape == Shape::straight) return straight;
  if (shape == Shape::holes) {
    Cage holed = straight;
    add_hole(holed, polygon_cage(Points{{160, 15}, {190, 20}, {186, 45}, {166, 40}}).segments);
    add_hole(holed, polygon_cage(Points{{58, 84}, {66, 112}, {88, 82}}).segments);
    return holed;
  }
  Cage cubic = straight;
  for (Points& segment : cubic.segments) segment.resize(3);
  cubic = elevated_to(straight, cubic);
  if (shape == Shape::curved)
    for (Points& segment : cubic.segments) {
      segment[1] += Complex(6, -8);
      segment[2] += Complex(5, 9);
    }
  return cubic;
}

/// A cage, posed by a bend. For methods that use them, there are also three pins, one of them with
/// a frame, and two strokes.
inline Setup setup(const Method& method, Precision precision, Shape shape = Shape::straight) {
  Setup s;
  s.rest.cage = cage_of(shape);
  s.rest.precision = precision;
  const Mesh mesh = domain_mesh(s.rest.cage, {400});
  s.rest.samples = mesh.vertices;
  s.rest.mesh = std::make_shared<const Mesh>(mesh);
  s.rest.derivative_samples = derivative_samples(mesh);
  if (method.uses_pins) s.rest.pins = {{{40, 40}, false}, {{150, 60}, true}, {{50, 160}, false}};
  if (method.uses_strokes)
    s.rest.strokes = {{{20, 20}, {60, 30}, {110, 25}}, {{30, 90}, {30, 150}}};
  s.pose.cage = s.rest.cage;
  for (Points& segment : s.pose.cage.segments)
    for (Complex& z : segment) z = bend(z);
  for (const Points& stroke : s.rest.strokes) {
    s.pose.strokes.emplace_back();
    for (const Complex& z : stroke) s.pose.strokes.back().push_back(bend(z) + Complex(2, 4));
  }
  for (const RestPin& pin : s.rest.pins)
    s.pose.pins.push_back({bend(pin.position) + Complex(5, -3), 0.3});
  return s;
}

}  // namespace holomorph
