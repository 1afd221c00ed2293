// Films do not jump at keys: an instant away from a key, the map is nearly that of the key, on the
// mesh and at single points.
#include "core/mesh/mesher.h"
#include "scene/keyframes.h"
#include "scene/timed_map.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::continuous_film_test {

namespace {

/// A star with one long and thin spike, and a few pins, some with rings, in two keys.
Deformation random_film(const std::string& method, std::mt19937& random) {
  const auto unit = [&] { return random_complex(random).real(); };  // -1 to 1
  Deformation film;
  Points corners = shapes::star(6 + static_cast<int>(random() % 5), 0.7, random());
  corners[0] *= 1.5 + 1.5 * std::abs(unit());
  film.rest = film.pose = polygon_cage(corners);
  film.method = method;
  if (method == "sheet") {
    film.parameters["pin_weight"] = random() % 2 == 0 ? 1e5 : 100;
    film.parameters["exact"] = random() % 2 == 0;
    film.parameters["roundness"] = random() % 3 == 0 ? 0.0 : 0.5;
  }
  if (method == "bounded" && random() % 2 == 0) film.parameters["space"] = 1;
  const Mesh mesh = domain_mesh(film.rest, {200});
  const double size = box_of(corners).diagonal();
  for (size_t i = 0; i < 4; ++i) {
    Pin pin;
    pin.rest = pin.pose = mesh.vertices[random() % mesh.vertices.size()];
    const auto is_near = [&](const Pin& other) {
      return std::abs(other.rest - pin.rest) < 0.08 * size;
    };
    if (std::ranges::none_of(film.pins, is_near)) film.pins.push_back(pin);
  }
  for (const double time : {0.0, 1.0}) {
    for (size_t i = 1; i < film.pins.size(); ++i) {
      if (i != 2) film.pins[i].pose = film.pins[i].rest + 0.25 * size * random_complex(random);
      if (i == 3) film.pins[i].angle = unit(), film.pins[i].scale = 1 + 0.3 * unit();
    }
    film.keyframes.push_back(
        {time, whole_pose_of(film), random() % 2 == 0 ? Ease::smooth : Ease::linear});
  }
  if (random() % 4 == 0) film.keyframes[1].turns = 1;
  return film;
}

void check_keys(const std::string& method, const std::vector<unsigned>& seeds) {
  constexpr double kInstant = 1e-7, kJump = 1e-4;  // seconds, and fractions of the size
  int keys = 0;
  for (const unsigned seed : seeds) {
    INFO(method << ", seed " << seed);
    std::mt19937 random(seed);
    const Deformation film = random_film(method, random);
    TimedMap timed(film);
    const double size = box_of(timed.mesh().vertices).diagonal();
    Points places;
    for (const Pin& pin : film.pins) places.push_back(pin.rest);
    for (const double key : {0.0, 1.0}) {
      const TimedFrame at = timed.frame(key), nearby = timed.frame(std::abs(key - kInstant));
      const SampledMap there = timed.on_mesh(at);
      INFO("key at " << key << ": " << there.note << "; nearby: " << nearby.between.note);
      if (there.status != SampledMap::Status::certified) continue;
      ++keys;
      CHECK((there.f - nearby.between.f).cwiseAbs().maxCoeff() <= kJump * size);
      const VectorXc off = timed.at(at, places).f - timed.at(nearby, places).f;
      CHECK(off.cwiseAbs().maxCoeff() <= kJump * size);
    }
  }
  CHECK(keys > 0);
}

}  // namespace

TEST_CASE("Films of sheets do not jump at keys") {
  check_keys("sheet", seeds_of("sheets at keys", {3717175996u, 4018755450u}));
}

TEST_CASE("Films of other maps without folds do not jump at keys") {
  for (const std::string method : {"puppet", "bounded"})
    check_keys(method, seeds_of("other films at keys", {1}));
}

}  // namespace holomorph::continuous_film_test
