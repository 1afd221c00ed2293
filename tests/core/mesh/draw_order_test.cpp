// The triangles nearest to the highest point, as measured through the mesh, are drawn last.
#include "core/mesh/draw_order.h"
#include "core/mesh/mesher.h"

#include <map>

#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::draw_order_test {

namespace {

Complex middle(const Mesh& mesh, const Triangle& t) {
  return (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
}

/// The position of each triangle in the draw order.
std::map<Triangle, size_t> positions_of(const std::vector<Triangle>& order) {
  std::map<Triangle, size_t> positions;
  for (size_t i = 0; i < order.size(); ++i) positions[order[i]] = i;
  return positions;
}

}  // namespace

TEST_CASE("The draw order contains each triangle once, and equal depths change nothing") {
  const Mesh mesh = domain_mesh(shapes::rectangle(300, 100), {600});
  const std::vector<Depth> level{{{50, 50}, 3}, {{250, 50}, 3}}, away{{{900, 900}, 7}};
  CHECK(draw_order(mesh, {}) == mesh.triangles);
  for (const EqualHeights equals : {EqualHeights::as_in_mesh, EqualHeights::outward}) {
    CHECK(draw_order(mesh, level, equals) == draw_order(mesh, {}, equals));
    CHECK(draw_order(mesh, away, equals) == draw_order(mesh, {}, equals));
  }
  const std::vector<Depth> two{{{50, 50}, 0}, {{250, 50}, 1}};
  std::vector<Triangle> order = draw_order(mesh, two), all = mesh.triangles;
  std::ranges::sort(order);
  std::ranges::sort(all);
  CHECK(order == all);
}

TEST_CASE("Triangles nearest to the higher point are drawn later") {
  const Mesh mesh = domain_mesh(shapes::rectangle(300, 100), {600});
  for (const int height : {1, -1}) {
    const std::vector<Depth> depths{{{50, 50}, 0}, {{250, 50}, height}};
    const auto positions = positions_of(draw_order(mesh, depths));
    size_t last_lower = 0, first_higher = positions.size();
    for (const Triangle& t : mesh.triangles) {
      const double x = middle(mesh, t).real();
      if (std::abs(x - 150) < 30) continue;  // between the two
      if ((x > 150) == (height > 0))
        first_higher = std::min(first_higher, positions.at(t));
      else
        last_lower = std::max(last_lower, positions.at(t));
    }
    INFO(height);
    CHECK(last_lower < first_higher);
  }
}

TEST_CASE("Distance is measured through the mesh, not across a gap") {
  // A U: the ends of its arms are near each other in the plane, but far apart along the shape.
  const Points u{{0, 0}, {110, 0}, {110, 300}, {60, 300}, {60, 50}, {50, 50}, {50, 300}, {0, 300}};
  const Mesh mesh = domain_mesh(u, {900});
  const std::vector<Depth> depths{{{85, 290}, 1}, {{25, 100}, 0}};
  const auto positions = positions_of(draw_order(mesh, depths));
  size_t lowest_high = positions.size(), highest_low = 0;
  for (const Triangle& t : mesh.triangles) {
    const Complex z = middle(mesh, t);
    if (z.imag() < 250) continue;
    if (z.real() > 60)
      lowest_high = std::min(lowest_high, positions.at(t));
    else
      highest_low = std::max(highest_low, positions.at(t));
  }
  CHECK(highest_low < lowest_high);
}

TEST_CASE("Drawn outward, all of a limb that crosses the body lies in front of it") {
  for (const unsigned seed : seeds_of("draw order", {1, 2, 3})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    // A body with a long arm, anywhere and turned by any angle.
    const Complex turn = std::polar(1.0, 3.0 * random_complex(random).real()),
                  away = 200.0 * random_complex(random);
    Points shape{{0, 0},     {200, 0},  {200, 200}, {120, 200},
                 {120, 420}, {80, 420}, {80, 200},  {0, 200}};
    const auto moved = [&](Complex z) { return turn * z + away; };
    for (Complex& z : shape) z = moved(z);
    const Mesh mesh = domain_mesh(shape, {900});
    size_t body = 0, arm = mesh.triangles.size(), number = 0;
    for (const Triangle& t : draw_order(mesh, {}, EqualHeights::outward)) {
      const Complex z = (middle(mesh, t) - away) / turn;
      if (std::abs(z - Complex(100, 100)) < 90) body = number;  // all that the arm can reach
      if (z.imag() > 250 && arm == mesh.triangles.size()) arm = number;
      ++number;
    }
    CHECK(body < arm);
  }
}

}  // namespace holomorph::draw_order_test
