// Films do not jump. An instant away from a key, the map is nearly that of the key, on the mesh and
// at single points; and between keys, no step is large however short it is.
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

/// A bar, a comb or an L with a still pin and others that are moved, pushed and swung far.
Deformation far_film(std::mt19937& random) {
  const auto unit = [&] { return random_complex(random).real(); };
  const std::array<Points, 3> outlines{shapes::rectangle(600, 100), shapes::l_shape(),
                                       Points{{0, 20},
                                              {600, 20},
                                              {600, 280},
                                              {480, 280},
                                              {480, 100},
                                              {360, 100},
                                              {360, 280},
                                              {240, 280},
                                              {240, 100},
                                              {120, 100},
                                              {120, 280},
                                              {0, 280}}};
  Deformation film;
  film.rest = film.pose = polygon_cage(outlines[random() % outlines.size()]);
  film.method = "sheet";
  const Mesh mesh = domain_mesh(film.rest, {200});
  const double size = box_of(mesh.vertices).diagonal();
  for (const size_t count = 2 + random() % 3; film.pins.size() < count;) {
    Pin pin;
    pin.rest = pin.pose = mesh.vertices[random() % mesh.vertices.size()];
    const auto is_near = [&](const Pin& other) {
      return std::abs(other.rest - pin.rest) < 0.15 * size;
    };
    if (std::ranges::none_of(film.pins, is_near)) film.pins.push_back(pin);
  }
  for (const double time : {0.0, 1.0}) {
    const Complex swing = time > 0 ? std::polar(1.0, 3 * unit()) : 1;
    for (size_t i = 1; i < film.pins.size(); ++i) {
      Pin& pin = film.pins[i];
      const Complex still = film.pins[0].rest;
      pin.pose = still + swing * (pin.rest + 0.3 * size * random_complex(random) - still);
    }
    film.keyframes.push_back({time, whole_pose_of(film), Ease::linear});
  }
  if (random() % 4 == 0) film.keyframes[1].turns = 1;
  return film;
}

/// The largest step of a film between two times that are as good as one; 0 if it is said there that
/// nothing is proved.
double largest_jump(TimedMap& timed) {
  constexpr int kSteps = 24, kHalvings = 10;
  const auto at = [&](double time) { return timed.on_mesh(timed.frame(time)); };
  const auto gap = [](const SampledMap& a, const SampledMap& b) {
    return (a.f - b.f).cwiseAbs().maxCoeff();
  };
  std::vector<SampledMap> maps;
  for (int i = 0; i <= kSteps; ++i) maps.push_back(at(static_cast<double>(i) / kSteps));
  size_t widest = 0;
  for (size_t i = 0; i < kSteps; ++i)
    if (gap(maps[i], maps[i + 1]) > gap(maps[widest], maps[widest + 1])) widest = i;
  double from = static_cast<double>(widest) / kSteps, to = from + 1.0 / kSteps;
  SampledMap before = maps[widest], after = maps[widest + 1];
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (from + to);
    SampledMap between = at(middle);
    if (gap(before, between) > gap(between, after))
      to = middle, after = std::move(between);
    else
      from = middle, before = std::move(between);
  }
  const bool is_proved = before.status == SampledMap::Status::certified &&
                         after.status == SampledMap::Status::certified;
  return is_proved ? gap(before, after) : 0;
}

void check_between(const std::vector<unsigned>& seeds) {
  for (const unsigned seed : seeds) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    TimedMap timed(far_film(random));
    CHECK(largest_jump(timed) <= 0.005 * box_of(timed.mesh().vertices).diagonal());
  }
}

}  // namespace

TEST_CASE("Films of sheets do not jump between keys") {
  check_between(seeds_of("sheets between keys", {1990116765u, 1979692540u}));
}

// As above; a case of its own, because each seed takes more than a second.
TEST_CASE("Films of sheets do not jump between keys, with other poses") {
  check_between(seeds_of("sheets between keys, other poses", {143084239u, 2643535451u}));
}

TEST_CASE("Films of sheets do not jump at keys") {
  check_keys("sheet", seeds_of("sheets at keys", {3717175996u, 4018755450u}));
}

TEST_CASE("Films of other maps without folds do not jump at keys") {
  for (const std::string method : {"puppet", "bounded"})
    check_keys(method, seeds_of("other films at keys", {1}));
}

}  // namespace holomorph::continuous_film_test
