// Pictures with several parts: cages around each of them or around all, in files and drawings.
#include <cmath>

#include "core/cauchy/inside.h"
#include "core/mesh/mesh.h"
#include "scene/auto_cage.h"
#include "scene/content_parts.h"
#include "scene/formats/scene_json.h"
#include "scene/formats/svg_path.h"
#include "scene/joined_cage.h"
#include "scene/keyframes.h"
#include "scene/prepared_map.h"
#include "scene/solving_mesh.h"
#include "support/catch.h"
#include "support/complaint.h"
#include "support/part_pictures.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::scene_parts_test {

namespace {

using Catch::Contains;

/// Parts with gaps of at least four pixels, and now and then one in the middle of a ring.
std::vector<Drawn> random_parts(std::mt19937& random, int width, int height) {
  std::vector<Drawn> parts;
  const size_t wanted = 2 + random() % 6;
  for (int tries = 0; parts.size() < wanted && tries < 500; ++tries) {
    const Complex unit = random_complex(random);
    const double radius = 15 + 50 * std::abs(random_complex(random).real());
    const Drawn drawn{Complex(0.5 * width * (1 + unit.real()), 0.5 * height * (1 + unit.imag())),
                      radius, static_cast<int>(random() % 3)};
    if (std::ranges::all_of(parts, [&](const Drawn& other) {
          return std::abs(other.at - drawn.at) > other.radius + drawn.radius + 4;
        }))
      parts.push_back(drawn);
  }
  const size_t rings = parts.size();
  for (size_t i = 0; i < rings; ++i)
    if (parts[i].kind == 1 && parts[i].radius > 40 && random() % 2 == 0)
      parts.push_back({parts[i].at, 0.3 * parts[i].radius, 0});
  return parts;
}

/// The text with the first occurrence of a part replaced.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  REQUIRE(text.find(from) != std::string::npos);
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("Parts: each one that can be seen has an outline, and joined they have one") {
  for (const unsigned seed : seeds_of("parts of pictures", {1, 2, 3, 4}))
    for (const bool curved : {false, true}) {
      std::mt19937 random(seed);
      CAPTURE(seed, curved);
      const int width = 420, height = 300;
      const Image image = picture_of(width, height, random_parts(random, width, height));
      const MaskParts content = parts_of_mask(content_of(image));
      size_t visible = 0;
      for (const size_t size : content.sizes)
        visible += static_cast<double>(size) >= kLeastPart * width * height;
      if (is_opaque(image) || visible < 2) continue;
      const Cage apart = auto_cage(image, {.curved = curved, .parts = PartChoice::apart}),
                 joined = auto_cage(image, {.curved = curved, .parts = PartChoice::joined});
      CHECK(!rest_fault(apart));
      CHECK(!rest_fault(joined));
      CHECK(joined.part_count() == 1);
      CHECK(apart.part_count() == static_cast<Index>(visible));
      if (apart.part_count() != static_cast<Index>(visible)) continue;
      std::vector<Inside> insides;
      for (Index p = 0; p < apart.part_count(); ++p) insides.emplace_back(part_of(apart, p));
      const Inside together(joined);
      std::vector<Index> part_of_label(content.sizes.size(), -1);
      int outside = 0, strangers = 0;
      for (int r = 0; r < height; ++r)
        for (int c = 0; c < width; ++c) {
          const int label = content.label(c, r);
          if (label < 0 || static_cast<double>(content.sizes[static_cast<size_t>(label)]) <
                               kLeastPart * width * height)
            continue;
          const Complex z(c + 0.5, height - r - 0.5);
          Index in = -1;
          for (size_t p = 0; p < insides.size(); ++p)
            if (insides[p].contains(z)) in = static_cast<Index>(p);
          Index& known = part_of_label[static_cast<size_t>(label)];
          if (known < 0) known = in;
          outside += in < 0 || !together.contains(z);
          strangers += in != known;
        }
      CHECK(outside == 0);
      CHECK(strangers == 0);
      CHECK(parts_outside(image, joined).empty());
      // A cage around one part leaves the others out.
      CHECK(parts_outside(image, part_of(apart, 0)).size() == visible - 1);
      // The meshes fit.
      if (curved) continue;
      const Mesh mesh = solving_mesh(apart);
      CHECK(mesh.boundary_loops().count() == apart.loops().count());
      CHECK(parts_of(mesh, apart).size() == static_cast<size_t>(visible));
    }
}

TEST_CASE("Parts: wide gaps between small parts are bridged, however wide they are") {
  for (const int side : {24, 60}) {
    Image image(900, 900);
    for (int r = 0; r < side; ++r)
      for (int c = 0; c < side; ++c)
        for (const int k : {0, 1, 2}) {
          const int column = k == 1 ? 899 - c : c, row = k == 2 ? 899 - r : r;
          image.at(column, k == 1 ? 450 + r : row)[3] = 255;
        }
    const Cage joined = auto_cage(image);
    CHECK(joined.part_count() == 1);
    CHECK(!rest_fault(joined));
    CHECK(parts_outside(image, joined).empty());
  }
}

TEST_CASE("Parts: a disk in a ring is a part, even if the gap is narrow") {
  for (const double gap : {5.0, 6.0, 12.0, 40.0}) {
    const Image image =
        picture_of(500, 420, {{{200, 200}, 150, 1}, {{200, 200}, 90 - gap, 0}, {{440, 60}, 40, 2}});
    for (const bool curved : {false, true}) {
      CAPTURE(gap, curved);
      const Cage cage = auto_cage(image, {.curved = curved, .parts = PartChoice::apart});
      CHECK(!rest_fault(cage));
      CHECK(cage.part_count() == 3);
      CHECK(part_of(cage, 0).has_holes());
    }
  }
}

TEST_CASE("Parts: specks are left out, and pieces that nearly touch are one part") {
  Image image = picture_of(400, 300, {{{100, 150}, 80, 0}, {{300, 150}, 80, 0}});
  image.at(200, 20)[3] = 255;
  const Cage two = auto_cage(image, {.parts = PartChoice::apart});
  CHECK(two.part_count() == 2);
  for (int c = 150; c < 250; ++c) image.at(c, 150)[3] = 255;
  for (const int gap : {0, 1, 2, 3, 8}) {
    Image cut = image;
    for (int c = 200; c < 200 + gap; ++c) cut.at(c, 150)[3] = 0;
    const Cage cage = auto_cage(cut, {.parts = PartChoice::apart});
    CAPTURE(gap);
    CHECK(!rest_fault(cage));
    CHECK(cage.part_count() == (gap < 3 ? 1 : 2));
    // Nothing is left out, apart or together.
    for (const PartChoice choice : {PartChoice::apart, PartChoice::joined})
      CHECK(parts_outside(cut, auto_cage(cut, {.parts = choice})).empty());
  }
  CHECK(auto_cage(image, {.parts = PartChoice::largest}).part_count() == 1);
  // Files have room for a hundred parts.
  Image many(600, 600);
  for (int i = 0; i < 225; ++i)
    for (int r = 0; r < 25; ++r)
      for (int c = 0; c < 25; ++c) many.at(40 * (i % 15) + c, 40 * (i / 15) + r)[3] = 255;
  const Cage hundred = auto_cage(many, {.parts = PartChoice::apart});
  CHECK(hundred.part_count() == static_cast<Index>(kMaxParts));
  CHECK(hundred.segments.size() <= kMaxSegments);
}

TEST_CASE("Parts: files keep them, with their holes, poses and unknown keys") {
  const Scene scene = scene_with_parts();
  const Cage& rest = scene.deformation().rest;
  REQUIRE(rest.part_count() == 3);
  REQUIRE(part_of(rest, 0).has_holes());
  const std::string text = json_of(scene);
  CHECK_THAT(text, Contains("\"version\": 4") && Contains("\"parts\""));
  CHECK(scene_from_json(text, "again") == scene);
  // Unknown keys stay with their part.
  std::string named = text;
  const size_t at = named.find("\"parts\": [");
  named.insert(named.find('{', at) + 1, "\"name\": \"eye\", ");
  const Scene with_name = scene_from_json(named, "named");
  CHECK_THAT(json_of(with_name), Contains("\"name\": \"eye\""));

  const auto complaint = [&](const std::string& from, const std::string& to) {
    return error_message_of([&] { scene_from_json(replaced(text, from, to), "scene.json"); });
  };
  CHECK_THAT(complaint("\"id\": \"sheet\"", "\"id\": \"cage\""),
             Contains("/cage/parts") && Contains("one outline"));
  CHECK_THAT(complaint("\"parts\": [", "\"parts\": [{\"rest\": [[[0,0]],[[1,0]]]},"),
             Contains("/cage/parts/0/rest") && Contains("at least three"));
  CHECK_THAT(complaint("\"parts\": [", "\"parts\": 7, \"p\": ["), Contains("/cage/parts"));
}

TEST_CASE("Parts: drawings have a subpath for each loop, and are read back") {
  const Deformation deformation = scene_with_parts().deformation();
  const std::string svg = svg_of(deformation, {});
  CHECK(cage_of_svg(svg, "a.svg", 0, PathUse::rest) == deformation.rest);
  const Cage lone =
      cage_of_svg("<svg><path d='M0 0 M10 10h50v50h-50z M20 20h10v10h-10z M80 10h9v9h-9z'/></svg>",
                  "b.svg", 99);
  CHECK(lone.part_count() == 2);
  CHECK(part_of(lone, 0).has_holes());
  Deformation posed = deformation;
  posed.pose.segments[0][0] += 1.0;
  const Cage pose = cage_of_svg(svg_of(posed, {}), "a.svg", 0, PathUse::pose, &posed.rest);
  CHECK(pose.starts == posed.pose.starts);
  CHECK(pose.parts == posed.pose.parts);
  for (Index e = 0; e < pose.size(); ++e)
    CHECK(std::abs(pose.vertex(e) - posed.pose.vertex(e)) < 1e-9);
}

}  // namespace holomorph::scene_parts_test
