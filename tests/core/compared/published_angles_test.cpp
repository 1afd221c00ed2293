// The published angle maps compared with ours: the errors of their functions.
#include "core/compared/published_angles.h"

#include <numeric>

#include "core/angles/angle_map.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/shapes.h"

namespace holomorph::published_angles_test {

namespace {

std::vector<Index> all_of(const Points& polygon) {
  std::vector<Index> all(polygon.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

Points star() {
  Points star;
  for (int i = 0; i < 20; ++i) star.push_back(std::polar(i % 2 ? 50.0 : 100.0, 2 * kPi * i / 20));
  return star;
}

}  // namespace

TEST_CASE("As published: the angle error is hundredths of a radian, ours is below a thousandth") {
  for (const auto& [polygon, anchor, pieces] :
       {std::tuple(shapes::l_shape(), Complex(50, 50), 100), {star(), Complex(0, 0), 320}}) {
    const Cage cage = polygon_cage(polygon);
    const PublishedAngles published(cage, all_of(polygon), anchor, pieces);
    const HilbertCoordinates ours(cage, corner_values(cage, all_of(polygon)));
    INFO(published.unknowns() << " functions: " << published.error() << "; ours " << ours.unknowns()
                              << ": " << ours.error());
    CHECK(published.error() > 0.04);
    CHECK(published.error() < 1);
    CHECK(ours.error() < 1e-3);
    CHECK(ours.unknowns() < published.unknowns());
  }
}

TEST_CASE("As published: for a gentle bend the map is close to ours") {
  const Points bar{{0, 0}, {600, 0}, {600, 100}, {0, 100}};
  Rest rest;
  rest.cage = polygon_cage(bar);
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {1000}));
  rest.samples = rest.mesh->vertices;
  rest.corners = {0, 1, 2, 3};
  const Pose pose{rest.cage, {}, {}, {{0, 0}, {0.8, 0.8}, {0.8, 0.8}, {0, 0}}};
  SampledMap ours, published;
  ours = method_named("angles").prepare(rest, nullptr)->deform(pose, {true});
  rest.parameters["published"] = 1;
  const auto deformer = method_named("angles").prepare(rest, nullptr);
  published = deformer->deform(pose, {true});
  CHECK_THAT(published.note, Catch::Contains("As published"));
  CHECK(published.f.allFinite());
  CHECK(published.fz.allFinite());
  CHECK((published.f - ours.f).cwiseAbs().maxCoeff() < 10);
  CHECK((published.f - ours.f).cwiseAbs().maxCoeff() > 0.01);
  CHECK_FALSE(deformer->point_map(pose));
}

}  // namespace holomorph::published_angles_test
