// ST-maps and unwarped pictures: each pixel shows the point that the map takes there.
#include "raster/unwarp.h"

#include "core/cauchy/cauchy.h"
#include "core/error.h"
#include "raster/picture.h"
#include "scene/timed_map.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::unwarp_test {

namespace {

constexpr int kWidth = 400, kHeight = 400;

/// A star with straight or curved edges and a random pose for a method.
Scene random_scene(const Method& method, bool curved, unsigned seed) {
  std::mt19937 random(seed);
  Deformation deformation;
  deformation.method = method.id;
  deformation.rest =
      curved ? shapes::curved_star(7, 3, 0.2, seed) : polygon_cage(shapes::star(7, 0.3, seed));
  deformation.pose = deformation.rest;
  for (Points& segment : deformation.pose.segments)
    for (Complex& z : segment) z += 15.0 * random_complex(random);
  if (method.uses_pins)
    for (int i = 0; i < 3; ++i) {
      const Complex z = Complex(200, 200) + std::polar(45.0, 2 * kPi * i / 3);
      deformation.pins.push_back({z, z + 12.0 * random_complex(random), {}, {}});
    }
  if (method.uses_strokes) {
    const Points stroke{{160, 190}, {200, 205}, {240, 190}};
    Points posed = stroke;
    for (Complex& z : posed) z += 6.0 * random_complex(random);
    deformation.strokes.push_back({stroke, posed, {}});
  }
  return scene_of(deformation);
}

Image white() {
  Image picture(kWidth, kHeight);
  std::ranges::fill(picture.pixels, 255);
  return picture;
}

/// The position in the picture that an ST-map has at a pixel.
Complex entry(const StMap& map, int column, int row) {
  const float* st = &map.st[2 * (static_cast<size_t>(row) * static_cast<size_t>(map.width) +
                                 static_cast<size_t>(column))];
  return {st[0] * static_cast<double>(kWidth), st[1] * static_cast<double>(kHeight)};
}

}  // namespace

TEST_CASE("ST-map: the map takes each entry to within a hundredth of its pixel") {
  for (const unsigned seed : seeds_of("ST-map", {5}))
    for (size_t m = 0; m < methods().size(); m += static_cast<size_t>(few_or_many(3, 1))) {
      const Method& method = methods()[m];
      const bool curved = (m + seed) % 2 != 0;
      const Scene scene = random_scene(method, curved, seed);
      INFO(method.id << ", seed " << seed << (curved ? ", curved" : ""));
      const int side = few_or_many(300, 600);
      const double scale = 1.0 * side / kWidth;
      TimedMap timed(scene);
      const StMap map = st_map_of(timed, white(), {.scale = scale});
      REQUIRE(map.width == side);
      REQUIRE(map.height == side);
      const auto inverse = timed.inverse(timed.frame({}));
      REQUIRE(inverse);
      std::mt19937 random(seed);
      double worst = 0;
      int shown = 0, missing = 0, wrong = 0;
      for (int i = 0; i < few_or_many(100, 900); ++i) {
        const int column = static_cast<int>(random() % static_cast<unsigned>(side)),
                  row = static_cast<int>(random() % static_cast<unsigned>(side));
        const Complex w((column + 0.5) / scale, kHeight - (row + 0.5) / scale);
        const Complex z = entry(map, column, row);
        const std::vector<Preimage> exact = inverse->inverse.at(w);
        if (!is_finite(z)) {
          missing += !exact.empty();
          wrong += exact.empty() && !contains(scene.deformation().rest, w);
        } else if (exact.empty()) {  // points outside the cage do not move
          wrong += std::abs(z - w) > 1e-3 || contains(scene.deformation().rest, w);
        } else {
          ++shown;
          worst = std::max(worst, scale * std::abs(inverse->map->at(z).f - w));
        }
      }
      CHECK(worst <= kStAccuracy);
      CHECK(shown > few_or_many(3, 40));
      CHECK(missing + wrong == 0);
    }
}

TEST_CASE("ST-map: the part that is drawn on top counts") {
  // A bar bent like a U, whose limbs overlap: the one with the greater depth covers the other.
  for (const int depth : {1, -1}) {
    Deformation deformation =
        with_cage(Deformation{},
                  Points{{20, 180}, {200, 180}, {380, 180}, {380, 220}, {200, 220}, {20, 220}});
    deformation.method = "arap";
    deformation.pins = {{{60, 200}, {100, 190}, {}, {}},
                        {{200, 200}, {300, 200}, {}, {}},
                        {{340, 200}, {100, 210}, {}, {}}};
    deformation.pins[2].depth = depth;
    const Scene scene = scene_of(deformation);
    TimedMap timed(scene);
    const StMap map = st_map_of(timed, white());
    const Complex at_end = entry(map, 150, kHeight - 200);
    INFO("depth " << depth);
    CHECK((at_end.real() > 200) == (depth > 0));
  }
}

TEST_CASE("Unwarping a posed picture gives the picture back") {
  for (const unsigned seed : seeds_of("Unwarp", {3}))
    for (const char* id : first_of<const char*>({"pins", "angles", "arap", "cage", "puppet"}, 3)) {
      const Scene scene = random_scene(method_named(id), false, seed);
      Image smooth(kWidth, kHeight);
      for (int r = 0; r < kHeight; ++r)
        for (int c = 0; c < kWidth; ++c) {
          const double wave = std::sin(c / 23.0) * std::cos(r / 31.0);
          std::uint8_t* p = smooth.at(c, r);
          p[0] = static_cast<std::uint8_t>(128 + 100 * wave);
          p[1] = static_cast<std::uint8_t>(128 + 90 * std::sin((c + r) / 40.0));
          p[2] = static_cast<std::uint8_t>(c / 2);
          p[3] = 255;
        }
      PictureOptions crop;
      crop.crop = true;
      const Image bent = picture_of(scene, &smooth, crop).image, back = unwarped(scene, &bent);
      REQUIRE(back.width == kWidth);
      INFO(id << ", seed " << seed);
      int solid = 0, far = 0;
      TimedMap timed(scene);
      const auto inverse = timed.inverse(timed.frame({}));
      for (int r = 3; r < kHeight; r += 7)
        for (int c = 3; c < kWidth; c += 7) {
          const Complex z(c + 0.5, kHeight - r - 0.5);
          if (!contains(scene.deformation().rest, z) || back.at(c, r)[3] < 255) continue;
          // Where the posed picture overlaps itself, it does not show z.
          const std::vector<Preimage> shown = inverse->inverse.at(inverse->map->at(z).f);
          if (shown.size() != 1) continue;
          ++solid;
          for (int k = 0; k < 3; ++k) far += std::abs(back.at(c, r)[k] - smooth.at(c, r)[k]) > 12;
        }
      CHECK(solid > 200);
      CHECK(far <= solid / 50);
    }
}

TEST_CASE("ST-maps and unwarped pictures refuse scales that make no sense") {
  const Scene scene = random_scene(method_named("cage"), false, 1);
  const Image picture(kWidth, kHeight);
  TimedMap timed(scene);
  for (const double scale : {0.0, -1.0, std::nan(""), 1e6}) {
    CHECK_THROWS_AS(st_map_of(timed, white(), {.scale = scale}), Error);
    CHECK_THROWS_AS(unwarped(scene, &picture, scale), Error);
  }
}

TEST_CASE("ST-maps and unwarped pictures can be interrupted") {
  const Scene scene = random_scene(method_named("cage"), false, 1);
  const Image picture(kWidth, kHeight);
  const auto stop = [](int, int) { throw Error(ErrorKind::failed, "stop"); };
  TimedMap timed(scene);
  CHECK_THROWS_AS(st_map_of(timed, white(), {}, stop), Error);
  CHECK_THROWS_AS(unwarped(scene, &picture, 1, {}, stop), Error);
}

TEST_CASE("Preimages of many points at once are those of each point") {
  for (const unsigned seed : seeds_of("many preimages", {1}))
    for (size_t m = 0; m < methods().size(); m += static_cast<size_t>(few_or_many(2, 1)))
      for (const bool curved : {false, true}) {
        if (curved && !soaks()) continue;
        const Method& method = methods()[m];
        const Scene scene = random_scene(method, curved, seed);
        TimedMap timed(scene);
        const auto inverse = timed.inverse(timed.frame({}));
        if (!inverse) continue;
        INFO(method.id << (curved ? ", curved" : ", straight") << ", seed " << seed);
        std::mt19937 random(seed);
        Points targets;
        for (int i = 0; i < few_or_many(10, 150); ++i)  // not a multiple of a block
          targets.push_back(Complex(200, 200) + 190.0 * random_complex(random));
        const auto found = inverse->at(targets);
        REQUIRE(found.size() == targets.size());
        for (size_t i = 0; i < targets.size(); ++i) {
          const std::vector<Preimage> alone = inverse->inverse.at(targets[i]);
          REQUIRE(found[i].size() == alone.size());
          for (size_t k = 0; k < alone.size(); ++k) REQUIRE(found[i][k].z == alone[k].z);
        }
      }
}

}  // namespace holomorph::unwarp_test
