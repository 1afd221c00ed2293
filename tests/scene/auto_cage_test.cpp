// Cages around a picture's content.
#include "scene/auto_cage.h"

#include <algorithm>
#include <span>

#include "core/cauchy/boundary_basis.h"
#include "core/error.h"
#include "core/maps/distortion.h"
#include "core/mesh/mesh.h"
#include "core/mesh/mesher.h"
#include "scene/content_parts.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"
#include "system/file.h"

namespace holomorph::auto_cage_test {

namespace {

Image blob(int width, int height, double (*radius)(double)) {
  Image image(width, height);
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c) {
      const Complex z(c - width / 2.0, height / 2.0 - r);
      image.at(c, r)[3] = std::abs(z) < radius(std::arg(z)) * std::min(width, height) ? 255 : 0;
    }
  return image;
}

auto pixels_of(const std::vector<std::uint8_t>& part, int width) {
  return [part, width](int c, int r) { return part[static_cast<size_t>(r) * width + c] != 0; };
}

/// The number of pixels with `solid(column, row)` whose point the loop does not wind around exactly
/// once. A pixel's point is its upper left corner plus `offset`, in the plane.
template <typename Solid>
int points_outside(const Image& image, const Solid& solid, const Points& loop, Complex offset) {
  int outside = 0;
  std::vector<std::pair<double, int>> crossings;  // where, and how much the winding changes
  for (int r = 0; r < image.height; ++r) {
    const double y = image.height - r + offset.imag();
    crossings.clear();
    for (size_t k = 0; k < loop.size(); ++k) {
      const Complex a = loop[k], b = loop[(k + 1) % loop.size()];
      if ((a.imag() <= y) != (b.imag() <= y))
        crossings.emplace_back(
            a.real() + (y - a.imag()) / (b.imag() - a.imag()) * (b.real() - a.real()),
            a.imag() <= y ? -1 : 1);
    }
    std::sort(crossings.begin(), crossings.end());
    int winding = 0;
    size_t next = 0;
    for (int c = 0; c < image.width; ++c) {
      while (next < crossings.size() && crossings[next].first < c + offset.real())
        winding += crossings[next++].second;
      outside += solid(c, r) && winding != 1;
    }
  }
  return outside;
}

}  // namespace

TEST_CASE(
    "The automatic cage contains the largest part, is simple and has about the requested size") {
  double (*const radii[])(double) = {
      [](double) { return 0.3; }, [](double a) { return 0.3 + 0.12 * std::sin(7 * a); },
      [](double a) { return 0.25 + 0.2 * std::cos(3 * a); },
      [](double a) { return 0.05 + 0.4 * std::pow(std::cos(2 * a), 8); }};
  for (const auto radius : radii)
    for (const auto& [width, height] :
         {std::pair(90, 70), std::pair(400, 300), std::pair(1700, 1300)}) {
      if (width > 1000 && radius != radii[1] && !soaks()) continue;
      Image image = blob(width, height, radius);
      image.at(1, 1)[3] = 255;  // a speck outside the largest part
      const auto in_part = pixels_of(largest_part(image), image.width);
      for (const int vertices : {12, 30, 80}) {
        const Points cage = vertices_of(auto_cage(image, {vertices}));
        CHECK(static_cast<int>(cage.size()) <= std::max(vertices, 45));
        CHECK_FALSE(self_crossing(cage));
        CHECK(signed_area(cage) > 0);
        for (const Complex corner : {Complex(0, 0), Complex(1, 0), Complex(1, -1), Complex(0, -1)})
          CHECK(points_outside(image, in_part, cage, corner) == 0);
        CHECK(domain_mesh(cage, {300}).triangles.size() > 100);
      }
    }
}

TEST_CASE("A curved automatic cage contains the largest part, with fewer control points") {
  double (*const radii[])(double) = {
      [](double) { return 0.3; }, [](double a) { return 0.3 + 0.12 * std::sin(7 * a); },
      [](double a) { return 0.05 + 0.4 * std::pow(std::cos(2 * a), 8); }};
  for (const auto radius : radii)
    for (const int vertices : {8, 20, 40}) {
      const Image image = blob(400, 300, radius);
      const Cage cage = auto_cage(image, {.vertices = vertices, .curved = true});
      check_rest_cage(cage);
      CHECK_FALSE(is_straight(cage));
      CHECK(cage.size() <= std::max(2 * vertices, 45));
      const Polygon flat = outline_of(cage, 64);
      CHECK(signed_area(flat) > 0);
      CHECK(points_outside(image, pixels_of(largest_part(image), image.width), flat.points,
                           {0.5, -0.5}) == 0);
    }
}

TEST_CASE("Curved automatic cages have meshes without inverted triangles, and a boundary basis") {
  // At sharp corners between curves, refinement places vertices on the chords, which are nearer to
  // interior vertices than the curves are.
  for (const auto& [name, vertices] :
       {std::pair("giraffe", 30), std::pair("fish", 30), std::pair("octopus", 30),
        std::pair("sunflower", 30), std::pair("gecko", 20)}) {
    const std::string path = std::string(HOLOMORPH_SOURCE "/assets/") + name + ".png";
    AutoCageOptions options{vertices};
    options.curved = true;
    const Cage cage = auto_cage(decode_image(read_file(path), name), options);
    const Mesh mesh = domain_mesh(cage, {8000});
    INFO(name);
    CHECK(flipped_triangles(
              mesh, Eigen::Map<const VectorXc>(mesh.vertices.data(),
                                               static_cast<Index>(mesh.vertices.size()))) == 0);
    CHECK(BoundaryBasis(cage, 50, 300).size() <= 150);
  }
}

namespace {

/// A body with parallel limbs, rotated: random widths, at least `gap` pixels between the limbs.
struct Limbs {
  Image image{1, 1};
  std::vector<Points> gaps;  ///< points in the middle of each gap
};

Limbs limbs_of(std::mt19937& random, double gap) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<>(0, 1)(random);
  };
  const int side = static_cast<int>(between(200, 900)), count = static_cast<int>(between(2, 6));
  const double length = between(0.3, 0.6) * side, angle = between(0, 2 * kPi);
  std::vector<double> widths;
  double across = -gap;
  for (int k = 0; k < count; ++k) {
    widths.push_back(between(5, 0.5 * side / count));
    across += widths.back() + gap;
  }
  Limbs limbs;
  limbs.image = Image(side, side);
  const Complex center(side / 2.0, side / 2.0), turn = std::polar(1.0, angle);
  for (int r = 0; r < side; ++r)
    for (int c = 0; c < side; ++c) {
      const Complex z = (Complex(c + 0.5, side - r - 0.5) - center) / turn;
      bool solid = std::abs(z.real()) <= across / 2 && z.imag() > 0 && z.imag() < 0.2 * side;
      double left = -across / 2;
      for (const double width : widths) {
        solid = solid || (z.real() >= left && z.real() <= left + width && z.imag() <= 0 &&
                          z.imag() >= -length);
        left += width + gap;
      }
      limbs.image.at(c, r)[3] = solid ? 255 : 0;
    }
  double left = -across / 2;
  for (size_t k = 0; k + 1 < widths.size(); ++k) {
    left += widths[k];
    limbs.gaps.emplace_back();
    const double deep = 0.08 * side;  // the end of a gap may be rounded off
    for (double at = deep; at < length; at += 1) {
      // The picture's edge may cut off the limbs; then the gap ends with the shorter one.
      const auto in_picture = [&](double across_gap) {
        const Complex z = center + turn * Complex(across_gap, -at);
        return std::min(z.real(), z.imag()) > 0 && std::max(z.real(), z.imag()) < side;
      };
      if (in_picture(left - 1) && in_picture(left + gap + 1))
        limbs.gaps.back().push_back(center + turn * Complex(left + gap / 2, -at));
    }
    left += gap;
  }
  return limbs;
}

}  // namespace

TEST_CASE("Limbs that are 3 px apart are apart in the cage, in any direction") {
  for (const unsigned seed : seeds_of("auto_cage_test", {1, 2, 3, 3145988102u})) {
    std::mt19937 random(seed);
    const int count = seed > 3 ? 12 : few_or_many(6, 12);  // the large seed failed once
    for (int i = 0; i < count; ++i) {
      // Squares of pixels reach into a slanted gap by up to 0.71 px at each side.
      const double gap = (i % 2 ? 3 : 3 + i) + 1.42;
      const Limbs limbs = limbs_of(random, gap);
      const Points cage = vertices_of(auto_cage(limbs.image));
      INFO("seed " << seed << ", number " << i << ", " << limbs.image.width << " px");
      CHECK(cage.size() <= 500);
      CHECK_FALSE(self_crossing(cage));
      int inside = 0;
      for (const Points& middle : limbs.gaps)
        for (const Complex& z : middle) inside += winding_number(cage, z) != 0;
      CHECK(inside == 0);
      const auto solid = [&](int c, int r) { return limbs.image.at(c, r)[3] != 0; };
      CHECK(points_outside(limbs.image, solid, cage, {0.5, -0.5}) == 0);
    }
  }
}

TEST_CASE("A comb with more teeth than a cage has points still gets a cage") {
  const int counts[] = {200, 120, 400};
  for (const int teeth : std::span(counts).first(few_or_many(1, 3))) {
    Image image(6 * teeth, 300);
    for (int r = 0; r < image.height; ++r)
      for (int c = 0; c < image.width; ++c)
        image.at(c, r)[3] = r < 60 || c % 6 < 2 ? 255 : 0;  // gaps of 4 px
    INFO(teeth);
    for (const double detail : {0.0, 50.0, 100.0}) {
      AutoCageOptions options;
      options.detail = detail;
      const Points cage = vertices_of(auto_cage(image, options));
      CHECK(cage.size() <= 500);
      CHECK_FALSE(self_crossing(cage));
      CHECK(winding_number(cage, {3.0 * teeth, 270}) == 1);
    }
  }
}

TEST_CASE("More detail gives a closer cage") {
  for (const std::string name : {"giraffe", "octopus", "gecko", "tiger"}) {
    INFO(name);
    const Image image = decode_image(read_file(HOLOMORPH_SOURCE "/assets/" + name + ".png"), name);
    double before = 1e300;
    for (const double detail : {0.0, 50.0, 100.0}) {
      AutoCageOptions options;
      options.detail = detail;
      const Points cage = vertices_of(auto_cage(image, options));
      const double area = signed_area(cage);
      CHECK(area < before);
      CHECK(cage.size() <= 500);
      before = area;
    }
  }
}

TEST_CASE("Without alpha the automatic cage is a rectangle around the picture") {
  Image image(40, 30);
  for (size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
  const Points cage = vertices_of(auto_cage(image, {30, 5}));
  REQUIRE(cage.size() == 4);
  CHECK(cage[0] == Complex(-5, -5));
  CHECK(cage[2] == Complex(45, 35));
  CHECK(vertices_of(auto_cage(image))[2] == Complex(40, 30));
  CHECK(auto_cage(Image(40, 30)).size() == 4);  // nothing opaque at all
  CHECK_THROWS_AS(auto_cage(image, {2, 5}), Error);
  CHECK_THROWS_AS(auto_cage(image, {30, 1e9}), Error);
  AutoCageOptions beyond;
  beyond.detail = 101;
  CHECK_THROWS_AS(auto_cage(image, beyond), Error);
}

}  // namespace holomorph::auto_cage_test
