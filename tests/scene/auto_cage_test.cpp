// Cages around a picture's content.
#include "scene/auto_cage.h"

#include <catch2/catch.hpp>

#include "core/cauchy/boundary_basis.h"
#include "core/error.h"
#include "core/maps/distortion.h"
#include "core/mesh/mesh.h"
#include "core/mesh/mesher.h"
#include "support/shapes.h"
#include "system/file.h"

using namespace holomorph;

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

}  // namespace

TEST_CASE(
    "The automatic cage contains the largest part, is simple and has about the requested size") {
  double (*const radii[])(double) = {
      [](double) { return 0.3; }, [](double a) { return 0.3 + 0.12 * std::sin(7 * a); },
      [](double a) { return 0.25 + 0.2 * std::cos(3 * a); },
      [](double a) { return 0.05 + 0.4 * std::pow(std::cos(2 * a), 8); }};
  for (const auto radius : radii)
    for (const auto& [width, height] :
         {std::pair(90, 70), std::pair(400, 300), std::pair(1700, 1300)})
      for (const int vertices : {12, 30, 80}) {
        Image image = blob(width, height, radius);
        image.at(1, 1)[3] = 255;  // a speck outside the largest part
        const Points cage = vertices_of(auto_cage(image, {vertices, -1}));
        CHECK(static_cast<int>(cage.size()) <= std::max(vertices, 45));
        CHECK_FALSE(self_crossing(cage));
        CHECK(signed_area(cage) > 0);
        const auto part = largest_part(image);
        int outside = 0;
        for (int r = 0; r < height; ++r)
          for (int c = 0; c < width; ++c)
            if (part[static_cast<size_t>(r) * width + c])
              for (const Complex corner :
                   {Complex(0, 0), Complex(1, 0), Complex(1, 1), Complex(0, 1)})
                outside += winding_number(cage, Complex(c, height - r - 1) + corner) != 1;
        CHECK(outside == 0);
        CHECK(domain_mesh(cage, {300}).triangles.size() > 100);
      }
}

TEST_CASE("A curved automatic cage contains the largest part, with fewer control points") {
  double (*const radii[])(double) = {
      [](double) { return 0.3; }, [](double a) { return 0.3 + 0.12 * std::sin(7 * a); },
      [](double a) { return 0.05 + 0.4 * std::pow(std::cos(2 * a), 8); }};
  for (const auto radius : radii)
    for (const int vertices : {8, 20, 40}) {
      const Image image = blob(400, 300, radius);
      const Cage cage = auto_cage(image, {vertices, -1, true});
      check_rest_cage(cage);
      CHECK_FALSE(is_straight(cage));
      CHECK(cage.size() <= std::max(2 * vertices, 45));
      const Points flat = outline_of(cage, 64);
      CHECK(signed_area(flat) > 0);
      const auto part = largest_part(image);
      int outside = 0;
      for (int r = 0; r < image.height; ++r)
        for (int c = 0; c < image.width; ++c)
          if (part[static_cast<size_t>(r) * image.width + c])
            outside += winding_number(flat, {c + 0.5, image.height - r - 0.5}) != 1;
      CHECK(outside == 0);
    }
}

TEST_CASE("Curved automatic cages have meshes without inverted triangles, and a boundary basis") {
  // At sharp corners between curves, refinement places vertices on the chords, which are nearer to
  // interior vertices than the curves are.
  for (const auto& [name, vertices] :
       {std::pair("giraffe", 30), std::pair("fish", 30), std::pair("octopus", 30),
        std::pair("sunflower", 30), std::pair("gecko", 20)}) {
    const std::string path = std::string(HOLOMORPH_SOURCE "/assets/") + name + ".png";
    AutoCageOptions options{vertices, -1};
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

TEST_CASE("Without alpha the automatic cage is a rectangle around the picture") {
  Image image(40, 30);
  for (size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
  const Points cage = vertices_of(auto_cage(image, {30, 5}));
  REQUIRE(cage.size() == 4);
  CHECK(cage[0] == Complex(-5, -5));
  CHECK(cage[2] == Complex(45, 35));
  CHECK(auto_cage(Image(40, 30)).size() == 4);  // nothing opaque at all
  CHECK_THROWS_AS(auto_cage(image, {2, 5}), Error);
  CHECK_THROWS_AS(auto_cage(image, {30, 1e9}), Error);
}
