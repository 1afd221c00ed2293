// Folds count only where an eye can see them.
#include "edit/visible_folds.h"

#include <catch2/catch.hpp>

#include "core/mesh/mesher.h"
#include "support/seeds.h"
#include "support/shapes.h"

using namespace holomorph;

namespace {

/// A transparent picture with an opaque rectangle in plane coordinates.
Image with_rectangle(int size, Box box, std::uint8_t alpha = 255) {
  Image image(size, size);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      if (box.contains({column + 0.5, size - row - 0.5})) image.at(column, row)[3] = alpha;
  return image;
}

/// The identity, except that the vertex nearest to z is pulled across its neighbors.
VectorXc folded_at(const Mesh& mesh, Complex z, double by) {
  VectorXc f(static_cast<Index>(mesh.vertices.size()));
  size_t nearest = 0;
  const std::vector<char> on_boundary = boundary_marks(mesh);
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    f[static_cast<Index>(v)] = mesh.vertices[v];
    if (!on_boundary[v] && (on_boundary[nearest] ||
                            std::abs(mesh.vertices[v] - z) < std::abs(mesh.vertices[nearest] - z)))
      nearest = v;
  }
  f[static_cast<Index>(nearest)] += by;
  return f;
}

}  // namespace

TEST_CASE("A fold is found where the picture is opaque, and ignored where it is not") {
  const Mesh mesh = domain_mesh(polygon_cage(shapes::rectangle(400, 400)), {800});
  for (const unsigned seed : seeds_of("visible folds", {1, 2, 3})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const Complex z = Complex(200, 200) + 120.0 * random_complex(random);
    const VectorXc f = folded_at(mesh, z, 80);
    Box around, away;
    around.include(z - Complex(60, 60));
    around.include(z + Complex(60, 60));
    const Complex other = Complex(400, 400) - z;
    const bool apart = std::abs(other - z) > 200;
    away.include(other - Complex(5, 5));
    away.include(other + Complex(5, 5));
    const Image seen = with_rectangle(400, around), faint = with_rectangle(400, around, 10),
                unseen = with_rectangle(400, away);
    const auto folds = [&](const Image* picture) {
      return visible_folds(mesh, f, visible_triangles(mesh, picture));
    };
    REQUIRE(folds(nullptr).size() == 1);
    REQUIRE(folds(&seen).size() == 1);
    CHECK(std::abs(folds(&seen)[0].at - z) < 100);
    CHECK(folds(&seen)[0].radius > 1);
    CHECK(folds(&faint).empty());  // an alpha of 4 %
    if (apart) CHECK(folds(&unseen).empty());
  }
}

TEST_CASE("A fold smaller than a pixel is ignored") {
  const Mesh mesh = domain_mesh(polygon_cage(shapes::rectangle(4, 4)), {800});
  const VectorXc f = folded_at(mesh, {2, 2}, 0.4);
  CHECK(visible_folds(mesh, f, visible_triangles(mesh, nullptr)).empty());
  const VectorXc large = 100 * f;
  CHECK(visible_folds(mesh, large, visible_triangles(mesh, nullptr)).size() == 1);
}
