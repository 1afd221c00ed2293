// Pins that are dragged farther than the picture can follow give way.
#include "core/cauchy/cauchy.h"
#include "core/maps/distortion.h"
#include "edit/fold_finder.h"
#include "scene/prepared_map.h"
#include "support/catch.h"
#include "support/desk.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::far_drags_test {

namespace {

/// A photograph in its frame, or a shape, whose pins are dragged by up to its size.
Deformation random_drag(std::mt19937& random, bool photograph) {
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution<>(from, to)(random);
  };
  Points outline = shapes::rectangle(1600, 1000);
  if (!photograph) {
    const bool bent = random() % 2 == 0;
    const int tips = 5 + static_cast<int>(random() % 6);
    outline = bent ? shapes::l_shape() : shapes::star(tips, 0.5, random());
    const double scale = 2000 / box_of(outline).diagonal();
    for (Complex& z : outline) z *= scale;
  }
  Deformation drag;
  drag.method = "sheet";
  drag.rest = drag.pose = polygon_cage(outline);
  const Box box = box_of(outline);
  const double size = box.diagonal();
  const size_t pins = 1 + random() % 5;
  for (int tries = 0; drag.pins.size() < pins && tries < 1000; ++tries) {
    const double x = uniform(box.left, box.right), y = uniform(box.bottom, box.top);
    const Complex z(x, y);
    const bool is_near = std::ranges::any_of(
        drag.pins, [&](const Pin& pin) { return std::abs(pin.rest - z) < 0.05 * size; });
    if (contains(drag.rest, z) && !is_near) drag.pins.push_back({z, z, {}, {}});
  }
  for (size_t i = random() % drag.pins.size() + 1; i > 0; --i) {
    const double far = uniform(0, size), direction = uniform(0, 2 * kPi);
    drag.pins[i - 1].pose += std::polar(far, direction);
  }
  if (random() % 3 == 0) {
    drag.pins[0].angle = uniform(-2, 2);
    drag.pins[0].scale = uniform(0.3, 2.5);
  }
  if (photograph) {
    drag.frame = Frame::slide;
    if (random() % 2 == 0) drag.held_beyond = uniform(0.1, 0.5) * size;
  }
  return drag;
}

}  // namespace

TEST_CASE("Far drags: pins give way before the picture is crushed or folds visibly") {
  size_t drags = 0, folded = 0, extreme = 0;
  for (const bool photograph : {true, false})
    for (const unsigned seed : seeds_of("far drags", {1, 2, 3, 4, 5, 6})) {
      std::mt19937 random(seed);
      const Deformation drag = random_drag(random, photograph);
      CAPTURE(photograph, seed);
      const auto prepared = prepared_map(drag, Precision::single, {});
      const SampledMap map = prepared->deformer->deform(pose_of(drag), {.derivatives = false});
      CHECK(map.status == SampledMap::Status::certified);
      REQUIRE(map.extremes);
      ++drags;
      extreme += map.extremes->largest > 10 || map.extremes->smallest < 0.0005;
      const Mesh& drawn = *prepared->mesh;
      CHECK(drawn.vertices.size() > 4000);
      folded += !visible_folds(drawn, map.f, injectivity_of(drawn, map.f)).empty();
    }
  CAPTURE(drags, folded, extreme);
  // Half of the drags would stretch something more than tenfold if the pins were exact.
  CHECK(folded <= drags / 100);
  CHECK(extreme <= 1 + drags / 20);
}

TEST_CASE("A drag beyond the coordinates of files shows and stores nothing there") {
  for (const char* method : {"pins", "harmonic"}) {
    TestWorkspace desk(shapes::rectangle(400, 200));
    Deformation start = desk.workspace.shown.deformation();
    start.method = method;
    start.pins.push_back({{100, 100}, {100, 100}, {}, {}});
    desk.workspace.commit("Pin", start);
    desk.update();
    INFO(method);
    Deformation far = start;
    (far.method == "pins" ? far.pins[0].pose : far.pose.segments[0][0]) = {3e8, 50};
    desk.workspace.shown.preview = far;
    desk.update();
    CHECK_FALSE(desk.workspace.shown.preview);
    CHECK(desk.workspace.shown.deformation() == start);
    CHECK_THAT(desk.workspace.messages.toasts.back().text, Catch::Contains("larger than 1e8"));
    CHECK_FALSE(desk.workspace.commit("Drag", far));
    CHECK(desk.workspace.shown.deformation() == start);
    desk.workspace.shown.preview = start;
    desk.update();
    CHECK(desk.workspace.shown.preview);
  }
}

}  // namespace holomorph::far_drags_test
