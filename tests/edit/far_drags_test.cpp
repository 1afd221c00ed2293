// Pins that are dragged farther than the picture can follow give way.
#include "core/maps/deformer.h"
#include "core/maps/distortion.h"
#include "core/maps/method.h"
#include "core/mesh/divided.h"
#include "core/mesh/mesher.h"
#include "edit/visible_folds.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::far_drags_test {

namespace {

struct FarDrag {
  Rest rest;
  Pose pose;
  std::shared_ptr<const Mesh> drawn;
  double size = 1;
};

/// A photograph in its frame, or a shape, whose pins are dragged by up to its size.
FarDrag random_drag(std::mt19937& random, bool photograph) {
  FarDrag drag;
  Points outline = shapes::rectangle(1600, 1000);
  if (!photograph) {
    outline = random() % 2 == 0 ? shapes::l_shape()
                                : shapes::star(5 + static_cast<int>(random() % 6), 0.5, random());
    const double scale = 2000 / box_of(outline).diagonal();
    for (Complex& z : outline) z *= scale;
  }
  drag.rest.cage = polygon_cage(outline);
  drag.size = box_of(outline_of(drag.rest.cage).points).diagonal();
  drag.rest.mesh = std::make_shared<const Mesh>(domain_mesh(drag.rest.cage, {1000}));
  drag.drawn = std::make_shared<const Mesh>(divided(*drag.rest.mesh, 3));
  drag.rest.samples = drag.drawn->vertices;
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution<>(from, to)(random);
  };
  for (size_t pins = 1 + random() % 5; pins > 0; --pins) {
    const Complex z = drag.drawn->vertices[random() % drag.drawn->vertices.size()];
    const auto is_near = [&](const RestPin& pin) {
      return std::abs(pin.position - z) < 0.05 * drag.size;
    };
    if (std::ranges::none_of(drag.rest.pins, is_near)) drag.rest.pins.push_back({z});
  }
  drag.rest.pins[0].has_frame = random() % 3 == 0;
  if (photograph) {
    drag.rest.frame = Frame::slide;
    if (random() % 2 == 0) drag.rest.held_beyond = uniform(0.1, 0.5) * drag.size;
  }
  drag.pose.cage = drag.rest.cage;
  for (const RestPin& pin : drag.rest.pins) drag.pose.pins.push_back({pin.position});
  for (size_t i = random() % drag.pose.pins.size() + 1; i > 0; --i)
    drag.pose.pins[i - 1].position += std::polar(uniform(0, 1) * drag.size, uniform(0, 2 * kPi));
  if (drag.rest.pins[0].has_frame)
    drag.pose.pins[0].angle = uniform(-2, 2), drag.pose.pins[0].scale = uniform(0.3, 2.5);
  return drag;
}

}  // namespace

TEST_CASE("Far drags: pins give way before the picture is crushed or folds visibly") {
  size_t drags = 0, folded = 0, extreme = 0;
  for (const bool photograph : {true, false})
    for (const unsigned seed : seeds_of("far drags", {1, 2, 3, 4, 5, 6})) {
      std::mt19937 random(seed);
      const FarDrag drag = random_drag(random, photograph);
      CAPTURE(photograph, seed);
      const auto deformer = method_named("sheet").prepare(drag.rest, nullptr);
      const SampledMap map = deformer->deform(drag.pose, {});
      CHECK(map.status == SampledMap::Status::certified);
      REQUIRE(map.extremes);
      ++drags;
      extreme += map.extremes->largest > 10 || map.extremes->smallest < 0.01;
      // Drawn triangles are straight, so that a few may flip where a proved map bends sharply.
      const std::vector<char> visible(drag.drawn->triangles.size(), 1);
      folded += !visible_folds(*drag.drawn, map.f, visible).empty();
    }
  CAPTURE(drags, folded, extreme);
  CHECK(folded == 0);
  CHECK(extreme <= 1 + drags / 20);
}

}  // namespace holomorph::far_drags_test
