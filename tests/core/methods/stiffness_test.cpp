// Painted stiffness: dabs add up, and stiff parts keep their shape better.
#include "core/geometry/stiffness.h"

#include "core/maps/deformer.h"
#include "core/maps/distortion.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/shapes.h"

namespace holomorph::stiffness_test {

namespace {

std::vector<Method> methods_with_stiffness() {
  std::vector<Method> found;
  for (const Method& method : methods())
    if (method.uses_stiffness) found.push_back(method);
  REQUIRE(found.size() >= 2);
  return found;
}

/// A bar whose right end is pulled up.
struct Bent {
  Rest rest;
  SampledMap map;

  Bent(const Method& method, std::vector<BrushDab> stiffness) {
    rest.cage = polygon_cage(shapes::rectangle(300, 60));
    auto mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {900}));
    rest.mesh = mesh;
    rest.samples = mesh->vertices;
    rest.stiffness = std::move(stiffness);
    for (const double x : {10.0, 290.0}) rest.pins.push_back({{x, 30}});
    Pose pose{rest.cage, {{{10, 30}}, {{200, 190}}}};
    map = method.prepare(rest, nullptr)->deform(pose, {});
  }
  /// The mean deviation from rigidity at the vertices between two abscissas.
  double strain(double from, double to) const {
    const VertexDerivatives d = vertex_derivatives(*rest.mesh, map.f);
    double sum = 0;
    int count = 0;
    for (Index i = 0; i < map.f.size(); ++i) {
      const double x = rest.samples[static_cast<size_t>(i)].real();
      if (x < from || x > to) continue;
      sum += std::abs(std::abs(d.fz[i]) - 1) + std::abs(d.fzbar[i]);
      ++count;
    }
    return sum / count;
  }
};

}  // namespace

TEST_CASE("Stiffness: dabs add up, fall off to zero and stay within bounds") {
  const std::vector<BrushDab> one{{{10, 20}, 30, 0.5}};
  CHECK(stiffness_level({}, {10, 20}) == 0);
  CHECK(stiffness_level(one, {10, 20}) == 0.5);
  CHECK(stiffness_level(one, {25, 20}) == 0.5 * 0.75 * 0.75);  // exact in binary
  CHECK(stiffness_level(one, {40, 20}) == 0);
  std::vector<BrushDab> many(20, one[0]);
  CHECK(stiffness_level(many, {10, 20}) == kMaxStiffness);
  for (BrushDab& dab : many) dab.level = -1;
  CHECK(stiffness_level(many, {10, 20}) == kMinStiffness);
  many.push_back({{10, 20}, 30, 19.5});
  CHECK(stiffness_level(many, {10, 20}) == -0.5);
}

TEST_CASE("Stiffness: stiff parts keep their shape, and soft parts give way") {
  for (const Method& method : methods_with_stiffness()) {
    INFO(method.id);
    const Bent plain(method, {}), stiff(method, {{{80, 30}, 110, 2}}),
        soft(method, {{{80, 30}, 110, -1}});
    INFO("plain " << plain.strain(30, 130) << " stiff " << stiff.strain(30, 130) << " soft "
                  << soft.strain(30, 130));
    CHECK(stiff.strain(30, 130) < 0.4 * plain.strain(30, 130));
    CHECK(soft.strain(30, 130) > 1.3 * plain.strain(30, 130));
    CHECK(stiff.strain(190, 270) > plain.strain(190, 270));
    // Pins hold regardless of the stiffness around them.
    for (const Bent* bent : {&plain, &stiff, &soft}) {
      const auto at = locate(*bent->rest.mesh, bent->rest.samples, {290, 30});
      REQUIRE(at);
      const Complex place =
          at->in(*bent->rest.mesh, {bent->map.f.data(), bent->rest.samples.size()});
      CHECK(std::abs(place - Complex(200, 190)) < 0.5);
    }
  }
}

TEST_CASE("Stiffness: the same value everywhere has no effect") {
  for (const Method& method : methods_with_stiffness()) {
    INFO(method.id);
    const Bent plain(method, {}), even(method, {{{150, 30}, 1e5, 1}});
    CHECK((plain.map.f - even.map.f).cwiseAbs().maxCoeff() < 0.5);
  }
}

TEST_CASE("Stiffness: a small dab between the samples has an effect, too") {
  for (const Method& method : methods_with_stiffness()) {
    INFO(method.id);
    // Wider than 2 % of the size, in the middle of the bar.
    const Bent plain(method, {}), dab(method, {{{137, 29}, 9, 2}});
    CHECK((plain.map.f - dab.map.f).cwiseAbs().maxCoeff() > 1e-3);
  }
}

TEST_CASE("Stiffness: only methods that use it receive it") {
  Rest rest;
  rest.stiffness = {{{0, 0}, 10, 1}};
  for (const Method& method : methods())
    CHECK(used_by(method, rest).stiffness.empty() == !method.uses_stiffness);
}

}  // namespace holomorph::stiffness_test
