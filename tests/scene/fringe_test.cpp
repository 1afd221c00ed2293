// Faint pixels outside a cut-out's cage.
#include "scene/fringe.h"

#include "core/cauchy/cauchy.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/pictures.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::fringe_test {

namespace {

constexpr int kSize = 120;

/// An opaque disk in a halo of an opacity that falls from 40 % to nothing.
Image glowing_disk(double radius, double reach) {
  Image image(kSize, kSize);
  for (int row = 0; row < kSize; ++row)
    for (int column = 0; column < kSize; ++column) {
      const double r = std::hypot(column + 0.5 - kSize / 2, row + 0.5 - kSize / 2);
      const double halo = std::clamp(1 - (r - radius) / reach, 0.0, 1.0);
      image.at(column, row)[3] =
          static_cast<std::uint8_t>(r < radius ? 255 : std::lround(0.4 * 255 * halo));
    }
  return image;
}

Points around_disk(int count, double radius) {
  Points polygon;
  for (int i = 0; i < count; ++i)
    polygon.push_back(Complex(kSize / 2, kSize / 2) + std::polar(radius, 2 * kPi * i / count));
  return polygon;
}

}  // namespace

TEST_CASE("fringe: it covers the faint pixels, and follows similarities exactly") {
  for (const unsigned seed : seeds_of("fringe", {1, 2})) {
    std::mt19937 random(seed);
    const Image image = glowing_disk(20 + 10 * std::abs(random_complex(random)), 22);
    const Mesh mesh = domain_mesh(around_disk(17 + static_cast<int>(seed % 9), 38), {500});
    const auto fringe = fringe_of(mesh, image);
    REQUIRE(fringe);
    for (int row = 0; row < kSize; ++row)
      for (int column = 0; column < kSize; ++column) {
        const Complex z(column + 0.5, kSize - row - 0.5);
        if (image.at(column, row)[3] == 0) continue;
        const bool covered =
            locate(mesh, mesh.vertices, z) || locate(fringe->mesh, fringe->mesh.vertices, z);
        CHECK(covered);
      }
    const Complex factor = std::polar(1.5, 3 * random_complex(random).real()),
                  shift = 100.0 * random_complex(random);
    Points moved;
    for (const Complex& z : mesh.vertices) moved.push_back(factor * z + shift);
    const Points at = fringe->positions(moved);
    REQUIRE(at.size() == fringe->mesh.vertices.size());
    double worst = 0;
    for (size_t i = 0; i < at.size(); ++i)
      worst = std::max(worst, std::abs(at[i] - (factor * fringe->mesh.vertices[i] + shift)));
    CHECK(worst < 1e-9);
  }
}

TEST_CASE("fringe: near the cage, it follows the nearest edge") {
  const Image image = glowing_disk(25, 25);
  const Mesh mesh = domain_mesh(around_disk(24, 35), {500});
  const auto fringe = fringe_of(mesh, image);
  REQUIRE(fringe);
  const auto map = [](Complex z) { return z + 4e-3 * (z - 60.0) * (z - 60.0); };
  Points moved;
  for (const Complex& z : mesh.vertices) moved.push_back(map(z));
  const Points at = fringe->positions(moved);
  for (size_t i = 0; i < at.size(); ++i) {
    const Complex z = fringe->mesh.vertices[i];
    const double beyond = std::abs(z - Complex(60, 60)) - 35;
    if (beyond < 3) CHECK(std::abs(at[i] - map(z)) < 0.5);
  }
}

TEST_CASE("fringe: there is none if something solid, or nothing, lies outside the cage") {
  const Mesh mesh = domain_mesh(around_disk(20, 38), {300});
  Image image = glowing_disk(25, 10);
  CHECK_FALSE(fringe_of(mesh, image));  // the halo ends inside the cage
  image = glowing_disk(25, 30);
  CHECK(fringe_of(mesh, image));
  CHECK_FALSE(fringe_of(mesh, image, [] { return false; }));
  // A cage may cut a little into the edge.
  const Mesh tight = domain_mesh(around_disk(40, 24.4), {300});
  CHECK(fringe_of(tight, image));
  image.at(2, 3)[3] = 128;
  CHECK_FALSE(fringe_of(mesh, image));
  // A translucent picture is solid everywhere.
  Image pale(kSize, kSize);
  for (size_t i = 3; i < pale.pixels.size(); i += 4) pale.pixels[i] = 90;
  CHECK_FALSE(fringe_of(mesh, pale));
}

TEST_CASE("fringe: holes of the cage have one, too") {
  Image image = glowing_disk(30, 25);
  for (int row = 0; row < kSize; ++row)
    for (int column = 0; column < kSize; ++column)
      if (std::hypot(column + 0.5 - 60, row + 0.5 - 60) < 14) image.at(column, row)[3] = 30;
  Cage cage = polygon_cage(around_disk(24, 38));
  add_hole(cage, polygon_cage(around_disk(12, 10)).segments);
  const Mesh mesh = domain_mesh(cage, {600});
  const auto fringe = fringe_of(mesh, image);
  REQUIRE(fringe);
  CHECK(locate(fringe->mesh, fringe->mesh.vertices, {60, 60}));
  CHECK_FALSE(locate(fringe->mesh, fringe->mesh.vertices, {60, 85}));
}

TEST_CASE("fringe: parts have their own, which moves with them alone") {
  // A ring with a disk in it, and a disk beside them, all with halos.
  const auto distance = [](Complex z) {
    return std::min({std::abs(std::abs(z - Complex(50, 60)) - 30) - 8,
                     std::abs(z - Complex(50, 60)) - 8, std::abs(z - Complex(140, 60)) - 25});
  };
  Image image(190, 120);
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const double d = distance(Complex(column + 0.5, image.height - row - 0.5));
      image.at(column, row)[3] = static_cast<std::uint8_t>(
          d < 0 ? 255 : std::lround(100 * std::clamp(1 - d / 6, 0.0, 1.0)));
    }
  const auto around = [](Complex at, double radius) {
    Points polygon;
    for (int i = 0; i < 24; ++i) polygon.push_back(at + std::polar(radius, 2 * kPi * i / 24));
    return polygon_cage(polygon);
  };
  Cage cage = around({50, 60}, 39);
  add_hole(cage, reversed(around({50, 60}, 21)).segments);
  add_part(cage, around({50, 60}, 9));
  add_part(cage, around({140, 60}, 26));
  const Mesh mesh = domain_mesh(cage, {900});
  const auto fringe = fringe_of(mesh, image);
  REQUIRE(fringe);
  int faint = 0, covered = 0;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const Complex z(column + 0.5, image.height - row - 0.5);
      if (image.at(column, row)[3] == 0 || contains(cage, z)) continue;
      ++faint;
      covered += locate(fringe->mesh, fringe->mesh.vertices, z).has_value();
    }
  CHECK(covered >= 0.97 * faint);
  // One part moves away, and nothing is drawn out between it and the others.
  const PartFinder finder(cage);
  Points moved = mesh.vertices;
  for (Complex& z : moved)
    if (finder.at(z) == 2) z += 500.0;
  const Points at = fringe->positions(moved);
  for (const Triangle& t : fringe->mesh.triangles)
    for (int k = 0; k < 3; ++k)
      CHECK(std::abs(at[static_cast<size_t>(t[(k + 1) % 3])] - at[static_cast<size_t>(t[k])]) < 60);
}

}  // namespace holomorph::fringe_test
