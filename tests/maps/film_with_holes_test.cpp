// Films of a cage with two holes, by every method that allows holes.
#include "core/maps/method.h"
#include "scene/formats/scene_json.h"
#include "scene/prepared_map.h"
#include "scene/timed_map.h"
#include "support/catch.h"

namespace holomorph::film_with_holes_test {

namespace {

const char* const kText = R"({
  "format": "holomorph", "version": 3,
  "cage": {"rest": [[[0,0]], [[200,0]], [[200,100]], [[0,100]]],
           "holes": [{"rest": [[[20,20]], [[60,20]], [[40,60]]]},
                     {"rest": [[[120,40]], [[150,80]], [[170,40]]]}]},
  "keyframes": [{"time": 0, "pose": {"cage": [[[0,0]], [[200,0]], [[200,100]], [[0,100]]]}},
                {"time": 1, "pose": {"cage": [[[0,0]], [[200,0]], [[200,120]], [[0,100]]],
                 "holes": [[[[20,20]], [[60,20]], [[40,70]]], [[[120,40]], [[150,80]], [[170,40]]]]}}]
})";

}  // namespace

TEST_CASE("Holes move through in-betweens of every method that allows them") {
  for (const Method& method : methods()) {
    if (!method.allows_holes) continue;
    Deformation deformation = scene_from_json(kText, "scene.json").deformation();
    deformation.method = method.id;
    INFO(method.id);
    TimedMap timed(deformation);
    double moved = 0;
    VectorXc last;
    for (const double time : {0.0, 0.6}) {
      const SampledMap map = timed.on_mesh(timed.frame(time));
      CHECK(map.f.allFinite());
      if (last.size() > 0) moved = std::max(moved, (map.f - last).cwiseAbs().maxCoeff());
      last = map.f;
    }
    CHECK(moved > 1);
  }
}

}  // namespace holomorph::film_with_holes_test
