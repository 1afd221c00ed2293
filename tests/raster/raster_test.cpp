// Exported pixels: identities, conservation of area, and no seams.
#include "raster/raster.h"

#include <cstring>

#include "core/error.h"
#include "core/mesh/mesher.h"
#include "raster/bleed.h"
#include "raster/picture.h"
#include "raster/picture_rows.h"
#include "raster/textured.h"
#include "scene/auto_cage.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::raster_test {

namespace {

/// Random colors and alphas, including hidden colors of transparent pixels.
Image noise(int width, int height, unsigned seed, bool opaque = false) {
  std::mt19937 random(seed);
  Image image(width, height);
  for (auto& byte : image.pixels) byte = static_cast<std::uint8_t>(random());
  for (size_t i = 3; i < image.pixels.size(); i += 4) {
    if (opaque)
      image.pixels[i] = 255;
    else if (random() % 3 == 0)
      image.pixels[i] = 0;
  }
  return image;
}

RasterJob job_of(const Mesh& mesh, const Points& positions, const Image& image) {
  RasterJob job;
  job.mesh = &mesh;
  job.positions = positions;
  job.source = &image;
  return job;
}

}  // namespace

TEST_CASE("The identity pose gives the source back bit for bit, with any cage") {
  const Image image = noise(220, 190, 1);
  for (const Points& polygon : {shapes::l_shape(), shapes::star(17, 0.4, 2),
                                shapes::rectangle(220, 190), shapes::comb(6)}) {
    const Mesh mesh = domain_mesh(polygon, {700});
    const RasterResult result = rasterized(job_of(mesh, mesh.vertices, image));
    CHECK(result.image.width == image.width);
    CHECK(result.image.height == image.height);
    CHECK(result.image == image);
    Deformation deformation = with_cage(Deformation{}, polygon);
    CHECK(picture_of(scene_of(deformation), &image).image == image);
    deformation.method = "pins";
    deformation.pins = {{{30, 30}, {30, 30}, {}, {}}, {{40, 60}, {40, 60}, 0.0, {}}};
    CHECK(picture_of(scene_of(deformation), &image).image == image);
  }
}

TEST_CASE("A translation by whole pixels copies pixels exactly") {
  const Image image = noise(80, 60, 3, true);
  const Mesh mesh = domain_mesh(Points{{-4, -4}, {84, -4}, {84, 64}, {-4, 64}}, {500});
  Points moved = mesh.vertices;
  for (Complex& z : moved) z += Complex(7, -5);
  const RasterResult result = rasterized(job_of(mesh, moved, image));
  CHECK(result.image.width == 87);
  CHECK(result.image.height == 65);
  CHECK(result.corner == Complex(0, -5));
  int different = 0;
  for (int r = 0; r < 60; ++r)
    for (int c = 0; c < 80; ++c)
      different += std::memcmp(result.image.at(c + 7, r + 5), image.at(c, r), 4) != 0;
  CHECK(different == 0);
}

TEST_CASE("A uniform color stays uniform: no seams, no dark fringes") {
  Image image(200, 200);
  for (size_t i = 0; i < image.pixels.size(); i += 4)
    std::memcpy(&image.pixels[i], "\xc8\x64\x32\xff", 4);
  const Mesh mesh = domain_mesh(shapes::rectangle(200, 200), {900});
  Points bent = mesh.vertices;
  for (Complex& z : bent)
    z = z + Complex(12 * std::sin(z.imag() / 31), 9 * std::cos(z.real() / 23));
  const RasterResult result = rasterized(job_of(mesh, bent, image));
  double alpha = 0;
  int wrong = 0, holes = 0;
  for (int r = 0; r < result.image.height; ++r)
    for (int c = 0; c < result.image.width; ++c) {
      const std::uint8_t* p = result.image.at(c, r);
      alpha += p[3] / 255.0;
      if (p[3] > 0)
        wrong += std::abs(p[0] - 200) > 1 || std::abs(p[1] - 100) > 1 || std::abs(p[2] - 50) > 1;
      const bool deep =
          c > 30 && r > 30 && c < result.image.width - 30 && r < result.image.height - 30;
      holes += deep && p[3] != 255;
    }
  CHECK(wrong == 0);
  CHECK(holes == 0);
  double area = 0;
  for (const Triangle& t : mesh.triangles)
    area += 0.5 * cross(bent[t[1]] - bent[t[0]], bent[t[2]] - bent[t[0]]);
  // Coverage adds up to the area, except at the source's own border, which fades over a pixel:
  // where an edge cuts a pixel at the fraction x, both coverage and alpha are x, and the mean of x
  // - x^2 is 1/6.
  Points border;
  for (const int v : mesh.boundary) border.push_back(bent[v]);
  CHECK(alpha == Approx(area - perimeter(border) / 6).epsilon(5e-4));
}

TEST_CASE("The result does not depend on the number of threads") {
  const Image image = noise(150, 170, 9);
  const Mesh mesh = domain_mesh(shapes::star(12, 0.3, 5), {600});
  Points bent = mesh.vertices;
  for (Complex& z : bent) z = z * Complex(0.9, 0.2) + Complex(30, 3 * std::sin(z.real() / 9));
  RasterJob job = job_of(mesh, bent, image);
  job.threads = 1;
  const Image one = rasterized(job).image;
  job.threads = 5;
  CHECK(rasterized(job).image == one);
}

TEST_CASE("Rows drawn eight pixels at a time have the bits of the portable code") {
  const SpanDrawer fast = span_drawer_avx2();
  if (fast.draw == kPortableSpans.draw) WARN("this processor has no AVX2");
  for (const unsigned seed : seeds_of("rows of pixels", {1, 2, 3})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto unit = [&] { return std::uniform_real_distribution(-1.0, 1.0)(random); };
    for (int round = 0; round < 300; ++round) {
      const Image source = noise(30, 20, random(), round % 3 == 0);
      const int width = 1 + static_cast<int>(random() % 40);
      Image before = noise(width, 1, random(), round % 5 == 0);
      if (round % 2) std::ranges::fill(before.pixels, std::uint8_t{0});
      std::vector<int> slots(static_cast<size_t>(width));
      for (int& slot : slots) slot = static_cast<int>(random() % 8) - 7;
      for (int& slot : slots) slot = slot < kInCage ? kFree : slot;
      SourceMap map{15 + 20 * unit(), 1.5 * unit(), unit(), 10 + 15 * unit(), unit(), unit()};
      if (round % 4 == 0) map = {std::round(map.u0), 1, 0, std::round(map.v0), 0, 1};
      if (round % 7 == 0) map.taps_x = 1 + round % 3, map.taps_y = 2;
      PixelSpan span{static_cast<int>(random() % 20), 0, width, width};
      span.begin = static_cast<int>(random() % static_cast<unsigned>(width));
      span.end =
          span.begin + static_cast<int>(random() % static_cast<unsigned>(width + 1 - span.begin));
      span.slots = slots.data();
      span.outside = random() % 2;
      const auto drawn_by = [&](const auto& draw) {
        Image row = before;
        PixelSpan own = span;
        own.pixels = row.at(0, 0);
        draw(own);
        return row;
      };
      const Image portable = drawn_by([&](const PixelSpan& s) { draw_span(source, map, s); });
      CHECK(drawn_by([&](const PixelSpan& s) { fast.draw(source, map, s); }) == portable);
      CHECK(drawn_by([&](const PixelSpan& s) { draw_span_fast(source, map, s); }) == portable);
      const Image texels = noise(width, 1, random());
      CHECK(drawn_by([&](const PixelSpan& s) { fast.copy(texels.at(0, 0), s); }) ==
            drawn_by([&](const PixelSpan& s) { copy_span(texels.at(0, 0), s); }));
    }
  }
}

TEST_CASE("Shrinking averages instead of skipping pixels") {
  Image stripes(256, 256);
  for (int r = 0; r < 256; ++r)
    for (int c = 0; c < 256; ++c) {
      const std::uint8_t value = c % 2 ? 255 : 0;
      std::memset(stripes.at(c, r), value, 3);
      stripes.at(c, r)[3] = 255;
    }
  const Deformation deformation =
      with_cage(Deformation{}, Points{{-8, -8}, {264, -8}, {264, 264}, {-8, 264}});
  PictureOptions options;
  options.scale = 0.25;
  const Image small = picture_of(scene_of(deformation), &stripes, options).image;
  CHECK(small.width == 64);
  for (int c = 4; c < 60; ++c) CHECK(std::abs(small.at(c, 30)[0] - 128) <= 8);
}

TEST_CASE("Later triangles lie on top, and a fold is drawn") {
  Image image = noise(40, 40, 4, true);
  const Mesh mesh = domain_mesh(shapes::rectangle(40, 40), {200});
  Points mirrored = mesh.vertices;
  for (Complex& z : mirrored) z = {40 - z.real(), z.imag()};
  const Image flipped = rasterized(job_of(mesh, mirrored, image)).image;
  int different = 0;
  for (int r = 0; r < 40; ++r)
    for (int c = 0; c < 40; ++c)
      different += std::memcmp(flipped.at(39 - c, r), image.at(c, r), 4) != 0;
  CHECK(different == 0);
}

TEST_CASE("Nothing is cut off without crop") {
  const Image image = noise(50, 40, 6, true);
  Deformation deformation =
      with_cage(Deformation{}, Points{{-2, -2}, {52, -2}, {52, 42}, {-2, 42}});
  for (Points& segment : deformation.pose.segments) segment[0] *= 2.0;
  const RasterResult whole = picture_of(scene_of(deformation), &image);
  CHECK(whole.image.width == 100);
  CHECK(whole.image.height == 80);
  PictureOptions twice;
  twice.scale = 2;
  CHECK(picture_of(scene_of(at_rest(deformation)), &image, twice).image.width == 100);
  PictureOptions options;
  options.crop = true;
  CHECK(picture_of(scene_of(deformation), &image, options).image.width == 50);
}

TEST_CASE("Pictures that are too large or empty are refused") {
  const Image image = noise(10, 10, 6, true);
  PictureOptions options;
  for (const double scale : {1e6, 1e9, 0.0, -1.0, std::nan("")}) {
    options.scale = scale;
    CHECK_THROWS_AS(picture_of(scene_of(with_cage({}, shapes::rectangle(10, 10))), &image, options),
                    Error);
    CHECK_THROWS_AS(picture_of(Scene{}, &image, options), Error);
    options.crop = true;
    CHECK_THROWS_AS(picture_of(scene_of(with_cage({}, shapes::rectangle(10, 10))), &image, options),
                    Error);
    options.crop = false;
  }
  CHECK_THROWS_AS(picture_of(Scene{}, nullptr), Error);
  CHECK_THROWS_AS(picture_of(scene_of(with_cage({}, shapes::rectangle(10, 10))), nullptr), Error);
  options = {};
  options.view = View::area;
  CHECK(picture_of(scene_of(with_cage({}, shapes::rectangle(10, 10))), nullptr, options)
            .image.width == 10);
}

TEST_CASE("A picture of another size fills the same rectangle") {
  for (const unsigned seed : seeds_of("another size", {1, 2})) {
    std::mt19937 random(seed);
    const int width = 60 + static_cast<int>(random() % 60),
              height = 50 + static_cast<int>(random() % 60);
    // Colors that are linear in the place, so that no resolution is better than another one.
    const auto gradient = [&](int columns, int rows) {
      Image image(columns, rows);
      for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
          std::uint8_t* pixel = image.at(c, r);
          pixel[0] = static_cast<std::uint8_t>(std::lround(250 * (c + 0.5) / columns));
          pixel[1] = static_cast<std::uint8_t>(std::lround(250 * (r + 0.5) / rows));
          pixel[3] = 255;
        }
      return image;
    };
    Deformation deformation;
    deformation.method = "harmonic";
    deformation.rest = polygon_cage(
        Points{{8, 8}, {width - 8.0, 8}, {width - 8.0, height - 8.0}, {8, height - 8.0}});
    deformation.pose = deformation.rest;
    for (Points& segment : deformation.pose.segments)
      for (Complex& z : segment) z += 6.0 * random_complex(random);
    const Scene scene = scene_of(deformation);
    const Image usual = gradient(width, height);
    const PictureOptions options{.crop = true};
    const RasterResult expected = picture_of(scene, &usual, options);
    PictureMaker maker(scene, &usual);
    for (int i = 0; i < 4; ++i) {
      const Image other =
          gradient(40 + static_cast<int>(random() % 200), 40 + static_cast<int>(random() % 200));
      INFO("seed " << seed << ": " << width << " x " << height << " by " << other.width << " x "
                   << other.height);
      maker.show(other);
      const RasterResult drawn = maker.picture(options);
      REQUIRE(drawn.image.width == width);
      REQUIRE(drawn.image.height == height);
      REQUIRE(drawn.corner == expected.corner);
      // Outermost pixels are constant, so gradients are not linear there.
      const int rim = 4 + std::max(width / 40, height / 40);
      for (int r = rim; r < height - rim; ++r)
        for (int c = rim; c < width - rim; ++c)
          for (int k = 0; k < 4; ++k)
            REQUIRE(std::abs(drawn.image.at(c, r)[k] - expected.image.at(c, r)[k]) <= 2);
    }
    maker.show(usual);
    CHECK(maker.picture(options).image.pixels == expected.image.pixels);
  }
}

TEST_CASE("Bleeding copies the nearest covered pixel within reach and keeps all other pixels") {
  std::mt19937 random(5);
  const int w = 61, h = 47;
  const Image before = noise(w, h, 8);
  std::vector<bool> covered(static_cast<size_t>(w * h));
  for (size_t i = 0; i < covered.size(); ++i) covered[i] = random() % 60 == 0;
  const double reach = 6;
  Image after = before;
  bleed(after, covered, reach, [](int, int) { return true; });
  int bled = 0, kept = 0;
  for (int r = 0; r < h; ++r)
    for (int c = 0; c < w; ++c) {
      double nearest = 1e9, taken = 1e9;
      for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
          if (!covered[static_cast<size_t>(y * w + x)]) continue;
          const double distance = std::hypot(x - c, y - r);
          nearest = std::min(nearest, distance);
          if (std::memcmp(after.at(c, r), before.at(x, y), 4) == 0)
            taken = std::min(taken, distance);
        }
      const bool same = std::memcmp(after.at(c, r), before.at(c, r), 4) == 0;
      if (nearest == 0 || nearest > reach + 0.5) {
        REQUIRE(same);
        ++kept;
      } else if (nearest <= reach - 0.5) {
        REQUIRE(taken <= nearest + 0.5);
        ++bled;
      }
    }
  CHECK((bled > 500 && kept > 30));
  Image none = before;
  bleed(none, std::vector<bool>(covered.size()), 100, [](int, int) { return true; });
  CHECK(none.pixels == before.pixels);
  Image hidden = before;
  bleed(hidden, covered, reach, [](int, int) { return false; });
  for (size_t i = 0; i < covered.size(); ++i) {
    const bool changed = std::memcmp(&hidden.pixels[4 * i], &before.pixels[4 * i], 3) != 0;
    if (changed) REQUIRE(hidden.pixels[4 * i + 3] == 0);
  }
  CHECK(none.pixels == before.pixels);
}

TEST_CASE("A texture has the picture's colors up to the surface's edge and a little beyond") {
  Image image(200, 160);
  for (int r = 0; r < 160; ++r)
    for (int c = 0; c < 200; ++c)
      for (int k = 0; k < 4; ++k)
        image.at(c, r)[k] = static_cast<std::uint8_t>(k == 3 ? 255 : k == 0 ? c : 40);
  Deformation deformation =
      with_cage(Deformation{}, Points{{40, 30}, {160, 30}, {160, 130}, {40, 130}});
  const std::string file = std::string(HOLOMORPH_SOURCE) + "/assets/mask.obj";
  deformation.surface = SurfaceReference{file, Flattening::circle};
  Box onto;
  onto.include({40, -20});
  onto.include({160, 190});  // beyond the picture
  deformation.outline =
      flattened_onto(surface_of_obj(read_file(file), file).surface, Flattening::circle, onto)
          .outline();
  deformation.method = "outline";
  for (const double scale : {0.5, 1.0, 3.0}) {
    const TexturedSurface on =
        textured(flattened_surface_of(deformation), deformation, &image, scale);
    const int w = on.texture.width, h = on.texture.height;
    CHECK(on.texture.at(0, 0)[3] == 0);  // around the surface it is transparent
    for (const Complex& uv : on.coordinates) {
      REQUIRE(std::min({uv.real(), uv.imag(), 1 - uv.real(), 1 - uv.imag()}) > 0);
      for (const Complex& off : {Complex(0), Complex(1, 0), Complex(-1, 0), Complex(0, 1)}) {
        const int c = static_cast<int>(uv.real() * w + off.real()),
                  r = static_cast<int>((1 - uv.imag()) * h + off.imag());
        REQUIRE((c >= 0 && c < w && r >= 0 && r < h));
        REQUIRE(on.texture.at(c, r)[3] == 255);
        REQUIRE(on.texture.at(c, r)[1] == 40);
      }
    }
    // The coordinates are a similarity transform of the plane, so texture pixels are not stretched.
    const FlattenedSurface laid = flattened_surface_of(deformation);
    const Complex first = on.coordinates[0], last = on.coordinates.back();
    CHECK_THAT((last - first).real() * w,
               Catch::WithinAbs(scale * (laid.plane.back() - laid.plane[0]).real(), 1e-6));
    CHECK_THAT((last - first).imag() * h,
               Catch::WithinAbs(scale * (laid.plane.back() - laid.plane[0]).imag(), 1e-6));
  }
  CHECK_THROWS_AS(textured(flattened_surface_of(deformation), deformation, nullptr), Error);
}

TEST_CASE("The faint surroundings of a cut-out follow it") {
  Image image(60, 40);
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 60; ++column) {
      std::uint8_t* pixel = image.at(column, row);
      const bool solid = column >= 20 && column < 40 && row >= 10 && row < 30;
      pixel[0] = static_cast<std::uint8_t>(4 * column), pixel[1] = 90, pixel[2] = 30;
      pixel[3] = solid ? 255 : static_cast<std::uint8_t>(20 + column);
    }
  Layer layer;
  layer.image = reference_in("picture.png");
  layer.deformation = with_cage({}, Points{{18, 8}, {42, 8}, {42, 32}, {18, 32}});
  Scene scene = scene_of(layer);
  CHECK(picture_of(scene, &image).image == image);

  for (Points& segment : layer.deformation.pose.segments)
    for (Complex& z : segment) z += Complex(25, -13);
  const RasterResult moved = picture_of(scene_of(layer), &image, {.region = Box{25, -13, 85, 27}});
  CHECK(moved.image == image);
  const RasterResult all = picture_of(scene_of(layer), &image);
  size_t visible = 0;
  for (size_t i = 3; i < all.image.pixels.size(); i += 4) visible += all.image.pixels[i] > 0;
  CHECK(visible == 60 * 40);  // nothing stays behind
}

}  // namespace holomorph::raster_test
