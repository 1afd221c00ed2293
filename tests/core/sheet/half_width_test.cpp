// The local half width of shapes whose widths are known.
#include "core/sheet/half_width.h"

#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::half_width_test {

TEST_CASE("Half width: a bar is as wide at its edges as in its middle") {
  for (const unsigned seed : seeds_of("half width of bars", {1, 2, 3})) {
    std::mt19937 random(seed);
    const double half = 20 + 15 * random_complex(random).real(), length = 400;
    const Complex turn = std::polar(1.0, 3 * random_complex(random).real());
    Points bar{{0, -half}, {length, -half}, {length, half}, {0, half}};
    for (Complex& z : bar) z *= turn;
    const HalfWidth width(domain_mesh(polygon_cage(bar), {1500}));
    CAPTURE(seed, half);
    for (int i = 0; i < 300; ++i) {
      const Complex at = random_complex(random);
      // At the ends, disks do not reach into the corners.
      const Complex z(length / 2 + (length / 2 - half) * at.real(), half * at.imag());
      const double found = width.at(turn * z);
      CHECK(found <= half * (1 + 1e-9));
      CHECK(found >= 0.85 * half);
    }
    CHECK(width.at(turn * Complex(length, half)) < 0.2 * half);
  }
}

TEST_CASE("Half width: a neck is narrow between two wide parts, and holes make parts narrow") {
  // Two squares with a bar between them.
  const Cage dumbbell = polygon_cage(Points{{0, 0},
                                            {200, 0},
                                            {200, 85},
                                            {400, 85},
                                            {400, 0},
                                            {600, 0},
                                            {600, 200},
                                            {400, 200},
                                            {400, 115},
                                            {200, 115},
                                            {200, 200},
                                            {0, 200}});
  const HalfWidth width(domain_mesh(dumbbell, {3000}));
  CHECK(width.at({100, 100}) == Approx(100).epsilon(0.05));
  CHECK(width.at({100, 5}) == Approx(100).epsilon(0.05));  // next to an edge
  CHECK(width.at({300, 100}) == Approx(15).epsilon(0.15));
  CHECK(width.at({300, 86}) == Approx(15).epsilon(0.15));

  Cage frame = polygon_cage(shapes::rectangle(300, 300));
  add_hole(frame, polygon_cage(Points{{60, 60}, {240, 60}, {240, 240}, {60, 240}}).segments);
  const HalfWidth around(domain_mesh(frame, {3000}));
  for (const Complex z : {Complex(150, 30), Complex(5, 150), Complex(299, 100), Complex(150, 245)})
    CHECK(around.at(z) == Approx(30).epsilon(0.15));
}

}  // namespace holomorph::half_width_test
