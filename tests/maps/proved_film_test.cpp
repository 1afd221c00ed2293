// Films of the samples by methods without folds: every frame is proved, stays within the limits of
// its keys, and keeps still pins still. Blending triangle by triangle is the contrast.
//
// HOLOMORPH_FRAMES=200 measures that many frames of each film.
#include <random>

#include "core/maps/distortion.h"
#include "core/mesh/inbetween.h"
#include "scene/loading.h"
#include "scene/prepared_map.h"
#include "scene/timed_map.h"
#include "support/catch.h"
#include "support/seeds.h"

namespace holomorph::proved_film_test {

namespace {

int frames() {
  const char* wanted = std::getenv("HOLOMORPH_FRAMES");
  return wanted ? std::atoi(wanted) : few_or_many(3, 6);
}

/// A film of three keys from a sample with pins: at rest, as the sample is posed, and with its pins
/// moved at random. The first two pins keep their rest positions.
Deformation film_of(const std::string& name, const std::string& method, std::mt19937& random) {
  Deformation deformation =
      load_scene(std::string(HOLOMORPH_SOURCE) + "/assets/" + name + ".json").scene.deformation();
  deformation.method = method;
  deformation.parameters.clear();
  deformation.pose = deformation.rest;
  const double size = box_of(outline_of(deformation.rest)).diagonal();
  const auto key = [&](double time) {
    for (size_t i = 0; i < 2; ++i) deformation.pins[i].pose = deformation.pins[i].rest;
    deformation.keyframes.push_back({time, whole_pose_of(deformation)});
  };
  const Deformation posed = deformation;
  deformation = at_rest(deformation);
  key(0);
  for (size_t i = 0; i < deformation.pins.size(); ++i)
    deformation.pins[i].pose = posed.pins[i].pose;
  key(1);
  for (Pin& pin : deformation.pins) pin.pose = pin.rest + 0.08 * size * random_complex(random);
  key(2.5);
  return deformation;
}

void check_film(const std::string& name, const std::string& method, std::mt19937& random) {
  const Deformation film = film_of(name, method, random);
  TimedMap timed(film);
  const Mesh& mesh = timed.mesh();
  const double size = box_of(mesh.vertices).diagonal();
  std::vector<SampledMap> keys;
  for (const Keyframe& key : film.keyframes) keys.push_back(timed.on_mesh(timed.frame(key.time)));
  for (const SampledMap& key : keys) REQUIRE(key.status == SampledMap::Status::certified);
  const Inbetween triangles(std::make_shared<const Mesh>(mesh));
  std::vector<Inbetween::Shape> shapes;
  for (const SampledMap& key : keys)
    shapes.push_back(shapes.empty()
                         ? triangles.shape_of(key.f)
                         : triangles.shape_after(shapes.back(), triangles.shape_of(key.f)));
  const auto image = [&](size_t pin, const VectorXc& f) {
    return locate_near(mesh, film.pins[pin].rest).in(mesh, as_span(f));
  };
  int unproved = 0, flipped = 0, flipped_before = 0;
  double slid = 0, slid_before = 0, shear = 0, smaller = 0;
  const int count = frames();
  for (int frame = 0; frame < count; ++frame) {
    const double time = 2.5 * (frame + 0.5) / count, u = time < 1 ? time : (time - 1) / 1.5;
    const size_t k = time < 1 ? 0 : 1;
    const SampledMap map = timed.on_mesh(timed.frame(time));
    unproved += map.status != SampledMap::Status::certified;
    flipped += flipped_triangles(mesh, map.f);
    if (map.extremes) {
      shear = std::max(shear, map.extremes->shear /
                                  std::max(keys[k].extremes->shear, keys[k + 1].extremes->shear));
      smaller =
          std::max(smaller, std::min(keys[k].extremes->smallest, keys[k + 1].extremes->smallest) /
                                map.extremes->smallest);
    }
    VectorXc before;
    triangles.blend({shapes[k], shapes[k + 1]}, u, before);
    flipped_before += flipped_triangles(mesh, before);
    for (size_t pin = 0; pin < 2; ++pin) {
      if (std::abs(image(pin, keys[k].f) - image(pin, keys[k + 1].f)) > 1e-4 * size) continue;
      slid = std::max(slid, std::abs(image(pin, map.f) - image(pin, keys[k].f)));
      slid_before = std::max(slid_before, std::abs(image(pin, before) - image(pin, keys[k].f)));
    }
  }
  std::printf(
      "%s, %s: %d frames, %d not proved, %d flips, still pins slide %.1e, |nu| %.3f and 1 / "
      "smallest size %.3f times those of the keys; triangles: %d flips, slide %.1e\n",
      name.c_str(), method.c_str(), count, unproved, flipped, slid / size, shear, smaller,
      flipped_before, slid_before / size);
  CHECK(unproved == 0);
  CHECK(flipped == 0);
  CHECK(slid <= 1e-4 * size);
  CHECK(shear <= 1.03);
  CHECK(smaller <= 1.03);
}

}  // namespace

TEST_CASE("Films of the samples by puppets without folds are proved frame by frame") {
  for (const unsigned seed : seeds_of("films by puppets", {1})) {
    std::mt19937 random(seed);
    for (const std::string& name : first_of<std::string>({"sunflower", "octopus", "gecko"}, 1))
      check_film(name, "puppet", random);
  }
}

TEST_CASE("Films of the samples by bounded maps are proved frame by frame") {
  for (const unsigned seed : seeds_of("films by bounded maps", {1})) {
    std::mt19937 random(seed);
    for (const std::string& name : first_of<std::string>({"octopus", "gecko"}, 1))
      check_film(name, "bounded", random);
  }
}

}  // namespace holomorph::proved_film_test
