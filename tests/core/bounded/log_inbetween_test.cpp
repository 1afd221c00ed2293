// Motion between maps without folds: certified, within the extremes of the keys, with still
// stations, closed around holes, and continuous. Blending triangle by triangle is the contrast.
#include "core/bounded/log_inbetween.h"

#include <random>

#include "core/error.h"
#include "core/isometric/isometric_space.h"
#include "core/maps/distortion.h"
#include "core/mesh/inbetween.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/seeds.h"

namespace holomorph::log_inbetween_test {

namespace {

struct Stage {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const BoundaryBasis> basis;
  Points pins;
  std::unique_ptr<IsometricSpace> space;
  std::unique_ptr<LogInbetween> between;
  double size;

  Stage(const Cage& cage, const std::vector<int>& pinned, int vertices = 800)
      : mesh(std::make_shared<const Mesh>(domain_mesh(cage, {vertices}))),
        basis(std::make_shared<const BoundaryBasis>(cage, 60, 360)),
        size(box_of(mesh->vertices).diagonal()) {
    for (const int v : pinned) pins.push_back(mesh->vertices[static_cast<size_t>(v)]);
    const Index count = static_cast<Index>(pins.size());
    space = std::make_unique<IsometricSpace>(
        basis, *mesh, IsometricHandles{pins, count, VectorXd::Ones(count), {}, {}},
        std::vector<AreaSample>{}, VectorXd{}, IsometricEnergy{});
    between = std::make_unique<LogInbetween>(basis, mesh, pins);
  }

  LogKey key(const Points& targets, double time) const {
    IsometricTarget target;
    target.stations.resize(static_cast<Index>(pins.size()));
    for (size_t i = 0; i < pins.size(); ++i)
      target.stations[static_cast<Index>(i)] = targets[i] - pins[i];
    const IsometricMap map = space->solved(target, {.pin_weight = 1e5});
    REQUIRE(map.certificate.holds);
    LogKey key{map.map, space->extremes(map.map), {}, time};
    const MapOnMesh on_mesh(*basis, *mesh);
    key.f = on_mesh.integrated(map.map);
    if (map.solution.gaps.size() > 0)
      key.f -= space->loops().correction(on_mesh.tree(), map.solution.gaps);
    const Complex first = pins[0] + target.stations[0] + map.solution.offsets[0];
    key.f.array() += first - locate_near(*mesh, pins[0]).in(*mesh, as_span(key.f));
    return key;
  }
};

Cage bar() {
  return polygon_cage(Points{{0, -.5}, {6, -.5}, {6, .5}, {0, .5}});
}

Cage frame() {
  Cage cage = polygon_cage(Points{{-3, -1.5}, {3, -1.5}, {3, 1.5}, {-3, 1.5}});
  for (const double x : {-1.5, 1.5})
    add_hole(
        cage,
        polygon_cage(Points{{x - .7, -.7}, {x + .7, -.7}, {x + .7, .7}, {x - .7, .7}}).segments);
  return cage;
}

/// Inner vertices of a mesh, as many as asked for, apart from each other.
std::vector<int> inner_vertices(const Cage& cage, int vertices, size_t count,
                                std::mt19937& random) {
  const Mesh mesh = domain_mesh(cage, {vertices});
  const std::vector<char> outer = boundary_marks(mesh);
  const double apart = 0.12 * box_of(mesh.vertices).diagonal();
  std::uniform_int_distribution<size_t> any(0, mesh.vertices.size() - 1);
  std::vector<int> found;
  for (int tries = 0; tries < 5000 && found.size() < count; ++tries) {
    const size_t v = any(random);
    if (!outer[v] && std::ranges::all_of(found, [&](int other) {
          return std::abs(mesh.vertices[static_cast<size_t>(other)] - mesh.vertices[v]) > apart;
        }))
      found.push_back(static_cast<int>(v));
  }
  return found;
}

}  // namespace

TEST_CASE("In-betweens of maps without folds do not fold, and still pins do not slide") {
  for (const unsigned seed : seeds_of("certified in-betweens", {3640247491u, 2596997916u})) {
    std::mt19937 random(seed);
    int frames = 0, held_frames = 0;
    for (const Cage& cage : {bar(), frame()}) {
      const std::vector<int> pinned = inner_vertices(cage, 800, 5, random);
      const Stage stage(cage, pinned);
      Points from = stage.pins, to = stage.pins;  // the first two pins are still
      for (size_t i = 2; i < from.size(); ++i) {
        from[i] += 0.1 * stage.size * random_complex(random);
        to[i] += 0.25 * stage.size * random_complex(random);
      }
      const LogKey a = stage.key(from, 0), b = stage.key(to, 1);
      std::vector<char> held(stage.pins.size(), 0);
      held[0] = held[1] = 1;
      const double shear = std::max(a.extremes.shear, b.extremes.shear),
                   smallest = std::min(a.extremes.smallest, b.extremes.smallest);
      for (const bool smooth : {false, true}) {
        const auto interval = stage.between->interval({nullptr, &a, &b, nullptr}, smooth, held);
        double slid = 0;
        for (int frame = 1; frame < 25; ++frame) {
          const auto blend = interval.at(frame / 25.0, true);
          CHECK(blend.certified);
          REQUIRE(blend.extremes);
          CHECK(blend.extremes->shear <= 1.03 * shear + 1e-3);
          CHECK(blend.extremes->smallest >= 0.97 * smallest - 1e-3);
          CHECK(blend.gap <= 1e-6 * stage.size);
          CHECK(flipped_triangles(*stage.mesh, blend.f) == 0);
          ++frames;
          held_frames += blend.slides.empty();
          if (!blend.slides.empty()) continue;
          for (const size_t i : {0, 1})
            if (std::abs(a.f[pinned[i]] - b.f[pinned[i]]) < 1e-3 * stage.size)  // met by both
              slid =
                  std::max(slid, std::abs(blend.f[pinned[i]] - (1 - frame / 25.0) * a.f[pinned[i]] -
                                          frame / 25.0 * b.f[pinned[i]]));
        }
        CHECK(slid <= 1e-4 * stage.size);
        // The ends are the keys.
        CHECK((interval.at(1e-7, false).f - a.f).cwiseAbs().maxCoeff() <= 1e-4 * stage.size);
        CHECK((interval.at(1 - 1e-7, false).f - b.f).cwiseAbs().maxCoeff() <= 1e-4 * stage.size);
      }
    }
    CHECK(held_frames >= frames * 9 / 10);  // usually all
  }
}

TEST_CASE("In-betweens unwind whole turns, and triangles alone let still pins slide") {
  std::mt19937 random(5);
  const std::vector<int> pinned = inner_vertices(bar(), 800, 4, random);
  const Stage stage(bar(), pinned);
  Points to = stage.pins;
  for (Complex& z : to)  // a bend of the right half
    if (z.real() > 3) z = Complex(3, 0) + (z - 3.0) * std::polar(1.0, 1.3);
  LogKey a = stage.key(stage.pins, 0), b = stage.key(to, 1);
  std::vector<char> held;
  for (size_t i = 0; i < to.size(); ++i) held.push_back(to[i] == stage.pins[i]);
  const auto once = stage.between->interval({nullptr, &a, &b, nullptr}, false, held);
  const Inbetween triangles(stage.mesh);
  const auto shape_a = triangles.shape_of(a.f),
             shape_b = triangles.shape_after(shape_a, triangles.shape_of(b.f));
  double slid = 0, certified_slid = 0;
  for (int frame = 1; frame < 20; ++frame) {
    const double u = frame / 20.0;
    VectorXc blended;
    triangles.blend({shape_a, shape_b}, u, blended);
    const VectorXc own = once.at(u, false).f;
    for (size_t i = 0; i < to.size(); ++i) {
      if (!held[i]) continue;
      slid = std::max(slid, std::abs(blended[pinned[i]] - stage.pins[i]));
      certified_slid = std::max(certified_slid, std::abs(own[pinned[i]] - stage.pins[i]));
    }
  }
  INFO("triangles: " << slid / stage.size << ", certified: " << certified_slid / stage.size);
  CHECK(certified_slid <= 2e-4 * stage.size);
  CHECK(slid > 5 * certified_slid);
  // With two more turns, the middle of the motion is turned by a whole turn.
  b.map.l.array() += 4 * kPi * kI;
  const auto turning =
      stage.between->interval({nullptr, &a, &b, nullptr}, false, std::vector<char>(to.size(), 0));
  const auto middle = turning.at(0.25, false);
  CHECK(middle.certified);
  CHECK(stage.between->mean_argument(b.map) > 4 * kPi);
  // A quarter of two turns is half a turn, and there is a little more.
  CHECK(std::abs(std::arg(-middle.first.phi.mean())) < 1);
}

TEST_CASE("Smooth in-betweens rest between equal keys") {
  std::mt19937 random(6);
  const Stage stage(bar(), inner_vertices(bar(), 500, 3, random), 500);
  Points bent = stage.pins;
  bent[2] += Complex(0.2, 0.9);
  const LogKey a = stage.key(bent, 0), b = stage.key(bent, 0.6), c = stage.key(stage.pins, 1);
  const auto rests = stage.between->interval({nullptr, &a, &b, &c}, true, {1, 1, 1});
  for (const double u : {0.2, 0.5, 0.9})
    CHECK((rests.at(u, false).f - a.f).cwiseAbs().maxCoeff() <= 1e-9 * stage.size);
}

TEST_CASE("Smooth in-betweens pass through keys with one velocity") {
  std::mt19937 random(8);
  const std::vector<int> pinned = inner_vertices(bar(), 500, 4, random);
  const Stage stage(bar(), pinned, 500);
  std::vector<LogKey> keys;
  for (const double time : {0.0, 1.0, 1.7, 3.0}) {
    Points targets = stage.pins;
    for (size_t i = 1; i < targets.size(); ++i)
      targets[i] += 0.08 * stage.size * random_complex(random);
    keys.push_back(stage.key(targets, time));
  }
  const std::vector<char> held{1, 0, 0, 0};
  const auto first = stage.between->interval({nullptr, &keys[0], &keys[1], &keys[2]}, true, held);
  const auto second = stage.between->interval({&keys[0], &keys[1], &keys[2], &keys[3]}, true, held);
  constexpr double kStep = 1e-4;  // seconds
  const double mean_left = stage.between->mean_argument(keys[1].map);
  CHECK(std::isfinite(mean_left));
  const VectorXc at_key = first.at(1 - 1e-9, false).f,
                 left = (at_key - first.at(1 - kStep / 1.0, false).f) / kStep,
                 right = (second.at(kStep / 0.7, false).f - at_key) / kStep;
  // Velocities are those of l and nu; the position of the picture rests on its still pin.
  CHECK((left - right).cwiseAbs().maxCoeff() <= 0.02 * left.cwiseAbs().maxCoeff());
  CHECK(left.cwiseAbs().maxCoeff() > 0.01);
}

TEST_CASE("Smooth in-betweens are certified next to keys that are much more distorted") {
  for (const unsigned seed : seeds_of("distorted neighbors", {3, 4})) {
    std::mt19937 random(seed);
    const std::vector<int> pinned = inner_vertices(bar(), 800, 4, random);
    const Stage stage(bar(), pinned);
    const auto posed = [&](double reach, double time) {
      Points to = stage.pins;
      for (Complex& z : to) z += reach * stage.size * random_complex(random);
      return stage.key(to, time);
    };
    const LogKey before = posed(0.5, 0), a = posed(0.02, 1), b = posed(0.02, 2),
                 after = posed(0.5, 3);
    const auto interval = stage.between->interval({&before, &a, &b, &after}, true,
                                                  std::vector<char>(stage.pins.size(), 0));
    for (int frame = 1; frame < 20; ++frame) CHECK(interval.at(frame / 20.0, false).certified);
  }
}

}  // namespace holomorph::log_inbetween_test
