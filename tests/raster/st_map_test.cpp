// ST-maps: overscan, coverage, both directions, and what filters need near edges.
#include "raster/st_map.h"

#include "core/cauchy/cauchy.h"
#include "core/error.h"
#include "raster/nearest_covered.h"
#include "raster/raster.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::st_map_test {

namespace {

constexpr int kSide = 240;

Image opaque_picture() {
  Image picture(kSide, kSide);
  std::ranges::fill(picture.pixels, 255);
  return picture;
}

/// A star in the middle of the picture that is moved, turned and bent at random, so that parts of
/// it leave the picture.
Scene moved_star(const char* method, unsigned seed) {
  std::mt19937 random(seed);
  Deformation deformation;
  deformation.method = method;
  Points star = shapes::star(8, 0.25, seed);
  for (Complex& z : star) z *= 0.55;
  deformation.rest = polygon_cage(star);
  deformation.pose = deformation.rest;
  const Complex turn = std::polar(1.0, random_complex(random).real()),
                shift = 90.0 * random_complex(random), center(110, 110);
  for (Points& segment : deformation.pose.segments)
    for (Complex& z : segment)
      z = center + turn * (z - center) + shift + 4.0 * random_complex(random);
  return scene_of(deformation);
}

/// A bar from x = 20 to `right` that is bent like a U until its ends overlap, the right one on top.
Scene bent_bar(double right) {
  const double middle = 0.5 * (20 + right);
  Deformation bar = with_cage(
      Deformation{},
      Points{{20, 100}, {middle, 100}, {right, 100}, {right, 140}, {middle, 140}, {20, 140}});
  bar.method = "arap";
  bar.pins = {{{40, 120}, {60, 115}, {}, {}},
              {{middle, 120}, {180, 120}, {}, {}},
              {{right - 20, 120}, {60, 125}, {}, {}}};
  bar.pins[2].depth = 1;
  return scene_of(bar);
}

size_t index_of(const StMap& map, int column, int row) {
  return static_cast<size_t>(row) * static_cast<size_t>(map.width) + static_cast<size_t>(column);
}

Complex entry(const StMap& map, int column, int row) {
  const size_t i = 2 * index_of(map, column, row);
  return {kSide * static_cast<double>(map.st[i]), kSide * static_cast<double>(map.st[i + 1])};
}

}  // namespace

TEST_CASE("An overscan adds pixels and changes none") {
  for (const unsigned seed : seeds_of("overscan", {3})) {
    const Scene scene = moved_star("cage", seed);
    TimedMap timed(scene);
    for (const bool unwarps : {false, true}) {
      INFO("seed " << seed << (unwarps ? ", unwarps" : ""));
      const StMap plain = st_map_of(timed, opaque_picture(), {.unwarps = unwarps}),
                  wide = st_map_of(timed, opaque_picture(), {.unwarps = unwarps, .overscan = 37});
      REQUIRE(plain.width == kSide);
      REQUIRE(wide.width == kSide + 74);
      REQUIRE(wide.height == kSide + 74);
      double farthest = 0;
      int other = 0;
      for (int r = 0; r < kSide; ++r)
        for (int c = 0; c < kSide; ++c) {
          const Complex a = entry(plain, c, r), b = entry(wide, c + 37, r + 37);
          // At an edge, rounding decides.
          if (is_finite(a) != is_finite(b)) ++other;
          if (is_finite(a) && is_finite(b)) farthest = std::max(farthest, std::abs(a - b));
        }
      CHECK(farthest < 1e-3);
      CHECK(other <= 2);
    }
  }
}

TEST_CASE("Coverage is the opacity with which a white picture is drawn") {
  // A bar beyond the right edge of the picture is bent until what shows nothing lies on top.
  std::vector<Scene> scenes{bent_bar(380)};
  for (const unsigned seed : seeds_of("coverage", {4})) scenes.push_back(moved_star("cage", seed));
  for (const Scene& scene : scenes) {
    TimedMap timed(scene);
    const Image picture = opaque_picture();
    const int over = 60;
    const StMap map = st_map_of(timed, picture, {.overscan = over});
    const VectorXc f = timed.on_mesh(timed.frame({})).f;
    RasterJob job;
    job.mesh = &timed.mesh();
    job.positions = as_span(f);
    job.source = &picture;
    job.region = Box{-over, -over, kSide + over, kSide + over};
    const Image drawn = rasterized(job).image;
    REQUIRE(drawn.width == map.width);
    // Both count 4 x 4 samples. At the picture's edge, drawing also interpolates its opacity, by at
    // most a half, and only in a small part of the 130,000 pixels.
    int other = 0;
    double worst = 0;
    for (int r = 0; r < map.height; ++r)
      for (int c = 0; c < map.width; ++c) {
        const double off = std::abs(static_cast<double>(map.coverage[index_of(map, c, r)]) -
                                    drawn.at(c, r)[3] / 255.0);
        worst = std::max(worst, off);
        other += off > 0.1;
      }
    CHECK(worst <= 0.51);
    CHECK(other < 600);
  }
}

TEST_CASE("An unwarping ST-map holds the images of the pixels at rest") {
  for (const unsigned seed : seeds_of("unwarping ST-map", {6}))
    for (size_t m = 0; m < methods().size(); m += static_cast<size_t>(few_or_many(2, 1))) {
      const Method& method = methods()[m];
      const Scene scene = moved_star(method.id.c_str(), seed);
      INFO(method.id << ", seed " << seed);
      TimedMap timed(scene);
      const double scale = 1.5;
      const StMap map = st_map_of(timed, opaque_picture(), {.unwarps = true, .scale = scale});
      Points inside;
      std::vector<Complex> found;
      for (int r = 1; r < map.height; r += 7)
        for (int c = 1; c < map.width; c += 7) {
          const Complex z((c + 0.5) / scale, kSide - (r + 0.5) / scale), st = entry(map, c, r);
          if (contains(scene.deformation().rest, z)) {
            inside.push_back(z);
            found.push_back(st);
          } else {
            REQUIRE(std::abs(st - z) < 1e-3);  // nothing moves outside the cage
          }
          const bool shows =
              st.real() >= 0 && st.real() <= kSide && st.imag() >= 0 && st.imag() <= kSide;
          const float coverage = map.coverage[index_of(map, c, r)];
          if (coverage == 0 || coverage == 1) REQUIRE(shows == (coverage == 1));
        }
      REQUIRE(inside.size() > 100);
      const SampledMap exact = timed.at(timed.frame({}), inside);
      double worst = 0;
      for (size_t i = 0; i < inside.size(); ++i)
        worst = std::max(worst, scale * std::abs(exact.f[static_cast<Index>(i)] - found[i]));
      CHECK(worst <= kStAccuracy);
    }
}

TEST_CASE("Extended ST-maps are finite and keep what they show") {
  for (const unsigned seed : seeds_of("extended", {8})) {
    INFO("seed " << seed);
    const Scene scene = moved_star("cage", seed);
    TimedMap timed(scene);
    const StMap map = st_map_of(timed, opaque_picture(), {.overscan = 20});
    StMap extended = map;
    extend(extended);
    int filled = 0, far = 0;
    for (int r = 0; r < map.height; ++r)
      for (int c = 0; c < map.width; ++c) {
        const Complex before = entry(map, c, r), after = entry(extended, c, r);
        REQUIRE(is_finite(after));
        if (is_finite(before)) {
          REQUIRE(before == after);
          continue;
        }
        ++filled;
        if (r % 5 != 0 || c % 5 != 0) continue;
        double nearest = 1e9, of_value = 1e9;  // the value comes from one of the nearest pixels
        for (int y = 0; y < map.height; ++y)
          for (int x = 0; x < map.width; ++x)
            if (is_finite(entry(map, x, y))) {
              const double distance = std::hypot(x - c, y - r);
              nearest = std::min(nearest, distance);
              if (entry(map, x, y) == after) of_value = std::min(of_value, distance);
            }
        far += of_value > nearest + 0.5;
      }
    CHECK(filled > 100);
    CHECK(far == 0);
  }
  StMap nothing{2, 1, 0, std::vector<float>(4, NAN), {0, 0}};
  extend(nothing);
  CHECK(nothing.st == std::vector<float>(4, 0.0f));
}

TEST_CASE("What is transparent does not hide what is beneath it") {
  const Scene scene = bent_bar(220);  // the end on top is transparent
  TimedMap timed(scene);
  for (const bool transparent : {false, true}) {
    Image picture = opaque_picture();
    if (transparent)
      for (int r = 0; r < kSide; ++r)
        for (int c = kSide / 2; c < kSide; ++c) picture.at(c, r)[3] = 0;
    const StMap map = st_map_of(timed, picture);
    CHECK((entry(map, 75, kSide - 120).real() > kSide / 2.0) == !transparent);
  }
}

}  // namespace holomorph::st_map_test
