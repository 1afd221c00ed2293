// Folds count only where an eye can see them.
#include "edit/fold_finder.h"

#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/desk.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::fold_finder_test {

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
      return visible_folds(mesh, f, injectivity_of(mesh, f), visible_triangles(mesh, picture));
    };
    REQUIRE(folds(nullptr).size() == 1);
    REQUIRE(folds(&seen).size() == 1);
    CHECK(std::abs(folds(&seen)[0].at - z) < 100);
    CHECK(folds(&seen)[0].radius > 1);
    CHECK(folds(&faint).empty());  // an alpha of 4 %
    if (apart) CHECK(folds(&unseen).empty());
  }
}

TEST_CASE("A fold in a transparent part is no alarm, although the picture lies on top of it") {
  TestWorkspace desk(shapes::rectangle(400, 400));
  Workspace& w = desk.workspace;
  Deformation deformation = desk.deformation();
  deformation.method = "mean_value";
  deformation.pose.segments[0][0] = {330, 300};  // the lower left corner goes across the picture
  w.commit("Fold", deformation);
  desk.settle();
  REQUIRE(w.map().injectivity().folds());
  Box visible, hidden;  // at rest
  visible.include({200, 200}), visible.include({400, 400});
  hidden.include({0, 0}), hidden.include({130, 130});
  FoldFinder finder;
  CHECK_FALSE(finder.folds(w.map(), nullptr).empty());
  CHECK_FALSE(
      finder.folds(w.map(), std::make_shared<const Image>(with_rectangle(400, hidden))).empty());
  const auto picture = std::make_shared<const Image>(with_rectangle(400, visible));
  const std::vector<char> seen = visible_triangles(*w.map().prepared()->mesh, picture.get());
  const Mesh& mesh = *w.map().prepared()->mesh;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [i, j, k] = mesh.triangles[t];
    const VectorXc& f = w.map().map().f;
    if (seen[t]) REQUIRE(cross(f[j] - f[i], f[k] - f[i]) > 0);
  }
  CHECK(finder.folds(w.map(), picture).empty());
}

TEST_CASE("A fold smaller than a pixel is ignored") {
  const Mesh mesh = domain_mesh(polygon_cage(shapes::rectangle(4, 4)), {800});
  const VectorXc f = folded_at(mesh, {2, 2}, 0.4);
  CHECK(visible_folds(mesh, f, injectivity_of(mesh, f)).empty());
  const VectorXc large = 100 * f;
  CHECK(visible_folds(mesh, large, injectivity_of(mesh, large)).size() == 1);
}

}  // namespace holomorph::fold_finder_test
