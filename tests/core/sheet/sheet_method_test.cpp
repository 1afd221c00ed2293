// Method `sheet`: what is far from the pins stays, frames stay rectangles, turned pins turn what is
// around them, and motion between keys is proved.
#include <algorithm>
#include <cmath>

#include "core/arithmetic.h"
#include "core/maps/deformer.h"
#include "core/maps/distortion.h"
#include "core/maps/injectivity.h"
#include "core/maps/method.h"
#include "support/catch.h"
#include "support/pinned_rest.h"
#include "support/random_puppet.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::sheet_method_test {

namespace {

std::unique_ptr<Deformer> prepared(const Rest& rest) {
  return method_named("sheet").prepare(rest, nullptr);
}

double size_of(const Rest& rest) {
  return box_of(rest.mesh->vertices).diagonal();
}

/// Keys a second apart. They refer to the poses and the maps.
std::vector<MotionKey> keys_of(const std::array<Pose, 2>& poses,
                               const std::vector<SampledMap>& maps) {
  std::vector<MotionKey> keys;
  for (size_t k = 0; k < 2; ++k)
    keys.push_back(
        {maps[k].solution, maps[k].extremes, &poses[k], &maps[k].f, 0, static_cast<double>(k)});
  return keys;
}

}  // namespace

TEST_CASE("Sheet: beyond pins that hold, the picture stands still") {
  // Six pins hold a bar whose end is pulled.
  Rest rest = rest_of(polygon_cage(shapes::rectangle(1000, 100)), {{60, 50}}, 1500);
  for (const double x : {300., 350., 400.})
    for (const double y : {25., 75.}) rest.pins.push_back({Complex(x, y)});
  Pose pose = at_rest(rest);
  pose.pins[0].position += Complex(40, 130);
  const SampledMap map = prepared(rest)->deform(pose, {});
  REQUIRE(map.status == SampledMap::Status::certified);
  const double half_width = 50;
  double beyond = 0, moved = 0;
  for (size_t v = 0; v < rest.samples.size(); ++v) {
    const double off = std::abs(map.f[static_cast<Index>(v)] - rest.samples[v]);
    moved = std::max(moved, off);
    if (rest.samples[v].real() > 400 + 2 * half_width) beyond = std::max(beyond, off);
  }
  CHECK(moved > 100);
  CHECK(beyond < 0.003 * size_of(rest));
}

TEST_CASE("Sheet: exact pins are met, others nearly") {
  for (const unsigned seed : seeds_of("exact pins of sheets", {1, 2})) {
    std::mt19937 random(seed);
    Puppet puppet = random_puppet(random);
    Pose pose = at_rest(puppet.rest);
    for (PosePin& pin : pose.pins) pin.position += 0.06 * puppet.size * random_complex(random);
    for (const bool exact : {false, true}) {
      puppet.rest.parameters["exact"] = exact;
      const auto deformer = prepared(puppet.rest);
      REQUIRE(deformer->deform(pose, {}).status == SampledMap::Status::certified);
      const auto points = deformer->point_map(pose);
      for (size_t i = 0; i < pose.pins.size(); ++i) {
        const double off =
            std::abs(points->at(puppet.rest.pins[i].position).f - pose.pins[i].position);
        CHECK(off < (exact ? 1e-8 : 0.01) * puppet.size);
      }
    }
  }
}

TEST_CASE("Sheet: a frame that slides remains its rectangle, and a fixed one stays") {
  for (const unsigned seed : seeds_of("frames", {1, 2}))
    for (const Frame frame : {Frame::slide, Frame::fixed}) {
      std::mt19937 random(seed);
      const Points corners = shapes::rectangle(640, 400);
      Rest rest = rest_of(polygon_cage(corners), {{200, 150}, {420, 250}, {100, 300}, {320, 40}});
      rest.frame = frame;
      Pose pose = at_rest(rest);
      pose.pins[0].position += 90.0 * random_complex(random);
      pose.pins[3].position += 60.0 * random_complex(random);
      const auto deformer = prepared(rest);
      const SampledMap map = deformer->deform(pose, {});
      CHECK(map.status == SampledMap::Status::certified);
      const auto points = deformer->point_map(pose);
      double slid = 0;
      for (size_t k = 0; k < 4; ++k)
        for (int i = 0; i <= 50; ++i) {
          const Complex a = corners[k], b = corners[(k + 1) % 4], z = a + (i / 50.0) * (b - a),
                        w = points->at(z).f;
          // All of a side's points stay on its line, not only vertices.
          CHECK(std::abs(cross(b - a, w - a)) <= 1e-9 * std::norm(b - a));
          if (i == 0) CHECK(std::abs(w - a) <= 1e-9);
          slid = std::max(slid, std::abs(w - z));
        }
      if (frame == Frame::slide)
        CHECK(slid > 0.5);
      else
        CHECK(slid <= 1e-9);
    }
}

TEST_CASE("Sheet: drafts ignore solutions of sheets that are held differently") {
  Rest rest = rest_of(polygon_cage(shapes::rectangle(640, 400)), {{320, 60}, {320, 300}});
  rest.frame = Frame::slide;
  Pose pose = at_rest(rest);
  pose.pins[0].position += Complex(90, 10);
  const auto slides = prepared(rest);
  const SampledMap before = slides->deform(pose, {});
  rest.frame = Frame::fixed;
  const auto fixed = method_named("sheet").prepare(rest, slides.get());
  const EvalOptions draft{.derivatives = false, .draft = true};
  CHECK(fixed->deform(pose, draft, before.solution.get()).f == fixed->deform(pose, draft).f);
}

TEST_CASE("Sheet: a pin with a rotation turns what is around it, and other parts stay") {
  // A head on a neck, beside a body that two pins hold.
  const Points outline{{0, 0},     {500, 0},   {500, 200}, {330, 220}, {330, 300}, {400, 330},
                       {400, 480}, {200, 480}, {200, 330}, {270, 300}, {270, 220}, {0, 200}};
  Rest rest = rest_of(polygon_cage(outline), {{300, 400}, {100, 100}, {400, 100}}, 1200);
  rest.pins[0].has_frame = true;
  Pose pose = at_rest(rest);
  pose.pins[0].angle = 0.8;
  const auto deformer = prepared(rest);
  REQUIRE(deformer->deform(pose, {}).status == SampledMap::Status::certified);
  const auto points = deformer->point_map(pose);
  for (const Complex z : {Complex(300, 400), {340, 400}, {260, 400}, {300, 440}, {300, 360}}) {
    CHECK(std::abs(std::arg(points->at(z).fz) - 0.8) < 0.1);
    CHECK(std::abs(points->at(z).f -
                   (Complex(300, 400) + (z - Complex(300, 400)) * std::polar(1.0, 0.8))) < 5);
  }
  for (const Complex z : {Complex(20, 100), {480, 100}, {300, 30}, {100, 180}})
    CHECK(std::abs(points->at(z).f - z) < 15);
  // A scale, too.
  pose.pins[0].angle = 0;
  pose.pins[0].scale = 1.5;
  const auto scaled = deformer->point_map(pose);
  CHECK(std::abs(scaled->at({300, 400}).fz - 1.5) < 0.1);
  // A small radius acts on a small part.
  rest.pins[0].radius = 25;
  const auto small = prepared(rest)->point_map(pose);
  CHECK(std::abs(small->at({300, 400}).fz) > 1.3);
  CHECK(std::abs(small->at({220, 460}).fz) < 1.15);
}

TEST_CASE("Sheet: pins along an arc, or a posed cage, curl a bar without crushing it") {
  for (const unsigned seed : seeds_of("curled bars", {1, 2, 3})) {
    std::mt19937 random(seed);
    // Up to a three-quarter turn, in either direction.
    const double angle = (0.55 + 0.2 * random_complex(random).real()) * 2 * kPi *
                         (random() % 2 == 0 ? 1 : -1),
                 radius = 500 / angle;
    const auto curled = [&](Complex z) {
      const double along = (z.real() - 300) / radius;
      return Complex(300, 52 + radius) +
             std::polar(1.0, along) * Complex(0, z.imag() - 52 - radius);
    };
    const Points corners = shapes::rectangle(600, 104);
    for (const bool by_pins : {true, false}) {
      Cage cage = polygon_cage(corners);
      if (!by_pins)  // long edges would be straight again
        cage = polygon_cage(Points{{0, 0},
                                   {100, 0},
                                   {200, 0},
                                   {300, 0},
                                   {400, 0},
                                   {500, 0},
                                   {600, 0},
                                   {600, 104},
                                   {500, 104},
                                   {400, 104},
                                   {300, 104},
                                   {200, 104},
                                   {100, 104},
                                   {0, 104}});
      Rest rest = rest_of(cage, {}, 900);
      for (int k = 0; by_pins && k < 6; ++k) rest.pins.push_back({Complex(50 + 100 * k, 52)});
      Pose pose = at_rest(rest);
      for (PosePin& pin : pose.pins) pin.position = curled(pin.position);
      for (Points& segment : pose.cage.segments)
        for (Complex& z : segment) z = curled(z);
      const SampledMap map = prepared(rest)->deform(pose, {});
      INFO("seed " << seed << ", angle " << angle << ", pins " << by_pins);
      CHECK(map.status == SampledMap::Status::certified);
      const Injectivity injectivity = injectivity_of(*rest.mesh, map.f);
      CHECK_FALSE(injectivity.folds());
      CHECK_FALSE(injectivity.crossing);
      CHECK(isometric_energy_of(*rest.mesh, map.f) < 3);
    }
  }
}

TEST_CASE("Sheet: turns choose among maps of one pose") {
  Rest rest = rest_of(polygon_cage(shapes::rectangle(900, 80)), {{50, 40}, {450, 40}, {850, 40}});
  const auto deformer = prepared(rest);
  Pose pose = at_rest(rest);
  // The bar makes a loop to the left or to the right.
  pose.pins[2].position = {400, 40};
  for (const double turn : {1.5 * kPi, -1.5 * kPi}) {
    pose.pins[2].turn = turn;
    const SampledMap map = deformer->deform(pose, {});
    CHECK(map.status == SampledMap::Status::certified);
    CHECK(std::abs(*map.turns[2] - *map.turns[0] - turn) < 0.5);
    // The turns that were found lead to the same map.
    Pose again = pose;
    for (size_t i = 0; i < 3; ++i) again.pins[i].turn = map.turns[i];
    CHECK((deformer->deform(again, {}).f - map.f).cwiseAbs().maxCoeff() < 1e-3 * size_of(rest));
  }
}

TEST_CASE("Sheet: pins give way at the stretch limit, and those at rest hold") {
  Rest rest = rest_of(polygon_cage(shapes::rectangle(800, 120)), {{60, 60}, {740, 60}}, 600);
  Pose pose = at_rest(rest);
  for (const double limit : {2.0, 4.0, 8.0}) {
    CAPTURE(limit);
    rest.parameters["stretch_limit"] = limit;
    pose.pins[1].position = {60 + 2 * limit * 680, 60};
    const auto deformer = prepared(rest);
    CHECK(deformer->deform(pose, {}).note.find("stretch limit") != std::string::npos);
    const auto points = deformer->point_map(pose);
    CHECK(std::abs(points->at({60, 60}).f - pose.pins[0].position) < 1e-3 * size_of(rest));
    const double stretched = std::abs(points->at({500, 60}).f - points->at({300, 60}).f) / 200;
    CHECK(stretched > limit);
    CHECK(stretched < 1.7 * limit);  // with what is added far away
    // A pull within the limit is followed.
    pose.pins[1].position = {60 + 0.9 * limit * 680, 60};
    CHECK(std::abs(deformer->point_map(pose)->at({740, 60}).f - pose.pins[1].position) <
          1e-3 * size_of(rest));
  }
  // So do exact pins, and pins with frames.
  pose.pins[1].position = {60 + 20 * 680, 60};
  for (const bool exact : {false, true}) {
    rest.parameters = {{"exact", exact}};
    rest.pins[1].has_frame = !exact;
    const auto points = prepared(rest)->point_map(pose);
    CHECK(std::abs(points->at({740, 60}).f - pose.pins[1].position) > 0.1 * size_of(rest));
    CHECK(std::abs(points->at({60, 60}).f - pose.pins[0].position) <
          (exact ? 1e-8 : 1e-3) * size_of(rest));
  }
}

TEST_CASE("Sheet: pins that are back at rest have no turns") {
  const Rest rest =
      rest_of(polygon_cage(shapes::rectangle(800, 120)), {{60, 60}, {300, 60}, {740, 60}}, 400);
  Pose pose = at_rest(rest);
  pose.pins[2].turn = 2 * kPi;
  const SampledMap map = prepared(rest)->deform(pose, {});
  for (const auto& turn : map.turns) CHECK(*turn == 0);
  for (PosePin& pin : pose.pins) pin.turn = 4 * kPi;  // all of it was turned
  for (const auto& turn : prepared(rest)->deform(pose, {}).turns) CHECK(*turn == Approx(4 * kPi));
}

TEST_CASE("Sheet: a motion to a pin that gives way is spread over the whole interval") {
  Rest rest = rest_of(polygon_cage(shapes::rectangle(800, 120)), {{60, 60}, {740, 60}}, 600);
  const auto deformer = prepared(rest);
  std::array<Pose, 2> poses{at_rest(rest), at_rest(rest)};
  poses[1].pins[1].position = {60 + 20 * 680, 60};
  std::vector<SampledMap> maps;
  for (const Pose& pose : poses) maps.push_back(deformer->deform(pose, {}));
  const std::vector<MotionKey> keys = keys_of(poses, maps);
  const auto interval = deformer->motion()->interval(nullptr, keys[0], keys[1], nullptr, false);
  REQUIRE(interval);
  const Location pin = locate_near(*rest.mesh, rest.pins[1].position);
  const auto image = [&](const SampledMap& map) { return pin.in(*rest.mesh, as_span(map.f)); };
  const double whole = std::abs(image(maps[1]) - image(maps[0]));
  CHECK(whole > 1000);
  double last = 0;
  for (const double u : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const SampledMap map = interval->at(u, true);
    CHECK(map.status == SampledMap::Status::certified);
    const double way = std::abs(image(map) - image(maps[0])) / whole;
    CAPTURE(u, way);
    CHECK(way > last);
    CHECK(std::abs(way - u) < 0.3);  // sizes are blended geometrically
    last = way;
  }
}

TEST_CASE("Sheet: frames hold between keys, whatever moves or turns inside") {
  const Cage cage = polygon_cage(shapes::rectangle(800, 500));
  for (const unsigned seed : seeds_of("frames between keys", {1, 2, 3, 4, 5, 6})) {
    std::mt19937 random(seed);
    Rest rest = rest_of(cage, {{250, 250}, {560, 200}}, 700);
    rest.frame = seed % 3 == 0 ? Frame::fixed : Frame::slide;
    if (seed % 2 == 0) rest.held_beyond = 180;
    rest.pins[0].has_frame = seed % 3 != 1;
    const auto deformer = prepared(rest);
    std::array<Pose, 2> poses{at_rest(rest), at_rest(rest)};
    for (Pose& pose : poses) {
      pose.pins[0].position += 150.0 * random_complex(random);
      if (rest.pins[0].has_frame) pose.pins[0].angle = 1.5 * random_complex(random).real();
    }
    CAPTURE(seed);
    std::vector<SampledMap> maps;
    for (const Pose& pose : poses) maps.push_back(deformer->deform(pose, {}));
    const std::vector<MotionKey> keys = keys_of(poses, maps);
    const auto interval = deformer->motion()->interval(nullptr, keys[0], keys[1], nullptr, false);
    REQUIRE(interval);
    for (const double u : {0.1, 0.4, 0.5, 0.8}) {
      const SampledMap map = interval->at(u, true);
      CHECK(map.status == SampledMap::Status::certified);
      for (size_t v = 0; v < rest.samples.size(); ++v) {
        const Complex z = rest.samples[v], f = map.f[static_cast<Index>(v)];
        if (z.real() == 0 || z.real() == 800) CHECK(std::abs(f.real() - z.real()) < 1e-9);
        if (z.imag() == 0 || z.imag() == 500) CHECK(std::abs(f.imag() - z.imag()) < 1e-9);
        if (rest.held_beyond && std::min(std::abs(z - rest.pins[0].position),
                                         std::abs(z - rest.pins[1].position)) > 250)
          CHECK(std::abs(f - z) < 1e-9);
      }
      // Pins that give way at the keys do so in between.
      const Location pin = locate_near(*rest.mesh, rest.pins[0].position);
      const Complex from = pin.in(*rest.mesh, as_span(maps[0].f)),
                    to = pin.in(*rest.mesh, as_span(maps[1].f)), between = (1 - u) * from + u * to;
      CHECK(std::abs(pin.in(*rest.mesh, as_span(map.f)) - between) <
            0.5 * std::abs(to - from) + 10);
    }
  }
}

TEST_CASE("Sheet: painted parts change less") {
  const auto stretch = [](bool painted) {
    Rest rest = rest_of(polygon_cage(shapes::rectangle(800, 120)), {{40, 60}, {760, 60}}, 900);
    if (painted) rest.stiffness = {{{200, 60}, 150, 2}};
    Pose pose = at_rest(rest);
    pose.pins[1].position += 300;
    const auto points = prepared(rest)->point_map(pose);
    return std::abs(points->at({230, 60}).f - points->at({170, 60}).f) / 60;
  };
  CHECK(stretch(false) > 1.2);
  CHECK(stretch(true) < 1.1);
}

TEST_CASE("Sheet: the motion between keys is proved, holds pins, and ends at the keys") {
  for (const unsigned seed : seeds_of("motion of sheets", {1, 2, 3, 4})) {
    std::mt19937 random(seed);
    Puppet puppet = random_puppet(random);
    const auto deformer = prepared(puppet.rest);
    std::array<Pose, 2> poses{at_rest(puppet.rest), at_rest(puppet.rest)};
    for (size_t i = 1; i < poses[1].pins.size(); ++i)  // pin 1 is held
      poses[1].pins[i].position += 0.15 * puppet.size * random_complex(random);
    poses[0].pins.back().position += 0.1 * puppet.size * random_complex(random);
    std::vector<SampledMap> maps;
    for (const Pose& pose : poses) maps.push_back(deformer->deform(pose, {}));
    for (const SampledMap& map : maps) REQUIRE(map.extremes);
    const std::vector<MotionKey> keys = keys_of(poses, maps);
    const auto motion = deformer->motion();
    REQUIRE(motion);
    INFO("seed " << seed);
    const Location held = locate_near(*puppet.rest.mesh, puppet.rest.pins[0].position);
    for (const bool smooth : {false, true}) {
      const auto interval = motion->interval(nullptr, keys[0], keys[1], nullptr, smooth);
      REQUIRE(interval);
      for (const double u : {0.1, 0.3, 0.5, 0.8}) {
        const SampledMap at = interval->at(u, true);
        CHECK(at.status == SampledMap::Status::certified);
        REQUIRE(at.extremes);
        CHECK(at.extremes->smallest > 0);
        CHECK(flipped_triangles(*puppet.rest.mesh, at.f) == 0);
        // The pin is a vertex of this mesh. It moves straight from one key to the other.
        const double share = smooth ? smoothstep(u) : u;
        const auto image = [&](const SampledMap& map) {
          return held.in(*puppet.rest.mesh, as_span(map.f));
        };
        CHECK(std::abs(image(at) - (1 - share) * image(maps[0]) - share * image(maps[1])) <=
              1e-6 * puppet.size);
      }
      for (const size_t end : {size_t{0}, size_t{1}}) {
        const SampledMap near = interval->at(end == 0 ? 1e-7 : 1 - 1e-7, false);
        CHECK((near.f - maps[end].f).cwiseAbs().maxCoeff() <= 1e-4 * puppet.size);
      }
    }
  }
}

}  // namespace holomorph::sheet_method_test
