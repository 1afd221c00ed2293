// Holes of cages in scenes: files, SVG paths, mirrored poses, films and cages made from pictures.
#include <random>

#include "core/error.h"
#include "core/geometry/orientation.h"
#include "core/mesh/mesher.h"
#include "scene/auto_cage.h"
#include "scene/check_scene.h"
#include "scene/formats/scene_json.h"
#include "scene/formats/svg_path.h"
#include "scene/keyframes.h"
#include "scene/mirror.h"
#include "scene/timed_map.h"
#include "support/catch.h"
#include "support/complaint.h"
#include "support/scenes.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::holes_test {

namespace {

const char* const kText = R"({
  "format": "holomorph", "version": 3,
  "cage": {"rest": [[[0,0]], [[200,0]], [[200,100]], [[0,100]]],
           "pose": [[[0,0]], [[200,0]], [[220,100]], [[0,100]]],
           "holes": [{"rest": [[[20,20]], [[60,20]], [[40,60]]],
                      "pose": [[[20,20]], [[60,20],[70,30],[50,50]], [[45,65]]], "label": "ear"},
                     {"rest": [[[120,40]], [[150,80]], [[170,40]]]}]},
  "keyframes": [{"time": 0, "pose": {"cage": [[[0,0]], [[200,0]], [[200,100]], [[0,100]]]}},
                {"time": 1, "pose": {"cage": [[[0,0]], [[200,0]], [[200,120]], [[0,100]]],
                 "holes": [[[[20,20]], [[60,20]], [[40,70]]], [[[120,40]], [[150,80]], [[170,40]]]]}}]
})";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// Whether all pixels above the threshold of the content lie inside the cage, and how many empty
/// pixels do.
struct Covered {
  int lost = 0, empty_inside = 0;
};
Covered covered(const Image& image, const Cage& cage) {
  const Polygon outline = outline_of(cage);
  Covered result;
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c) {
      const Complex center(c + 0.5, image.height - r - 0.5);
      if (image.at(c, r)[3] > 8) {
        for (const Complex corner : {Complex(-.5, -.5), {.5, -.5}, {.5, .5}, {-.5, .5}})
          result.lost += !encloses(outline, center + corner);
      } else {
        result.empty_inside += encloses(outline, center);
      }
    }
  return result;
}

/// Content where `is_in` holds for the center of a pixel, y up.
template <class IsIn>
Image picture(int width, int height, IsIn is_in) {
  Image image(width, height);
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c)
      image.at(c, r)[3] = is_in(Complex(c + 0.5, height - r - 0.5)) ? 255 : 0;
  return image;
}

}  // namespace

TEST_CASE("Holes survive writing and reading, with keyframes and unknown keys") {
  const Scene scene = scene_from_json(kText, "scene.json");
  const Deformation& deformation = scene.deformation();
  CHECK(deformation.rest.starts == std::vector<Index>{4, 7});
  CHECK(deformation.pose.degree(5) == 3);
  CHECK(loop_of(deformation.pose, 2) == loop_of(deformation.rest, 2));
  CHECK(playing_keys(deformation).size() == 2);
  CHECK(loop_of(deformation.keyframes[0].pose.cage, 1) == loop_of(deformation.rest, 1));
  CHECK(deformation.keyframes[1].pose.cage.vertex(6) == Complex(40, 70));
  const std::string written = json_of(scene);
  CHECK_THAT(written, Catch::Contains("\"version\": 3") && Catch::Contains("\"ear\""));
  CHECK(scene_from_json(written, "again") == scene);
  check_scene(scene);
  // Without holes, files keep the version that older programs read.
  Scene plain = scene;
  change_layer(plain, [](Layer& layer) {
    Deformation& changed = layer.deformation;
    for (const Index loop : {2, 1}) {
      for (Keyframe& key : changed.keyframes) erase_hole(key.pose.cage, loop);
      for (Cage* cage : {&changed.rest, &changed.pose}) erase_hole(*cage, loop);
    }
    changed.loop_extras.clear();
  });
  CHECK_THAT(json_of(plain), Catch::Contains("\"version\": 1") && !Catch::Contains("holes"));
  CHECK(scene_from_json(json_of(plain), "plain") == plain);
}

TEST_CASE("Errors about holes name the place and the reason") {
  using Catch::Contains;
  const auto complaint = [](const std::string& from, const std::string& to) {
    return error_message_of([&] { scene_from_json(replaced(kText, from, to), "scene.json"); });
  };
  CHECK_THAT(complaint("[[170,40]]]}]}", "[[170,400]]]}]}"),
             Contains("/cage") && Contains("hole 2 crosses the outer loop"));
  CHECK_THAT(complaint("[[150,80]], [[170,40]]]}]}", "[[150,80]]]}]}"),
             Contains("/cage/holes/1/rest") && Contains("at least three"));
  CHECK_THAT(complaint("[[45,65]]]", "[[45,65]], [[1,1]]]"),
             Contains("/cage/holes/0/pose") && Contains("must agree"));
  CHECK_THAT(complaint("[[20,20]], [[60,20]], [[40,60]]", "[[20,20]], [[60,20]], [[40,\"x\"]]"),
             Contains("/cage/holes/0/rest/2/0/1"));
  CHECK_THAT(
      complaint("\"rest\": [[[0,0]], [[200,0]], [[200,100]], [[0,100]]],\n           \"pose\": "
                "[[[0,0]], [[200,0]], [[220,100]], [[0,100]]]",
                "\"rest\": []"),
      Contains("/cage/holes") && Contains("no cage"));
  CHECK_THAT(complaint("\"version\": 3", "\"version\": 5"), Contains("newer"));
}

TEST_CASE("SVG: holes are subpaths, in any order, and are read back") {
  const Deformation deformation = scene_from_json(kText, "scene.json").deformation();
  const std::string svg = svg_of(deformation, {});
  CHECK(cage_of_svg(svg, "a.svg", 0, PathUse::rest) == deformation.rest);
  const Cage pose = cage_of_svg(svg, "a.svg", 0, PathUse::pose);
  CHECK(pose.starts == deformation.pose.starts);
  for (Index e = 0; e < pose.size(); ++e)
    CHECK(std::abs(pose.vertex(e) - deformation.pose.vertex(e)) < 1e-9);
  const Cage drawn = cage_of_svg(
      "<svg height='100'><path d='m20 20h20v20z m-10 -10 h60 v60 h-60 Z m 50 50 h5 v5 Z'/></svg>",
      "b.svg", 0);
  CHECK(drawn.starts == std::vector<Index>{4, 7});
  CHECK(drawn.vertex(0) == Complex(10, 90));
  CHECK(drawn.vertex(4) == Complex(20, 80));
  CHECK(drawn.vertex(7) == Complex(60, 40));
  check_rest_cage(drawn);
  // A new subpath begins without a curve to continue.
  const Cage curved = cage_of_svg(
      "<svg><path d='M0 0 C0 30 0 60 0 90 L90 90 L90 0 Z M20 20 S30 50 40 20 L30 10 Z'/></svg>",
      "c.svg", 0, PathUse::pose);
  REQUIRE(curved.starts == std::vector<Index>{4});
  CHECK(curved.controls(4)[1] == curved.controls(4)[0]);
  CHECK_THAT(error_message_of([&] {
               cage_of_svg("<svg><path d='M0 0h9v9z M2 2h2v2z'/></svg>", "c.svg", 0,
                           PathUse::outline);
             }),
             Catch::Contains("several subpaths"));
}

TEST_CASE("A pose with holes is mirrored, whichever way the holes run") {
  Deformation deformation;
  deformation.rest = polygon_cage(shapes::rectangle(200, 100));
  const Points left{{20, 20}, {60, 20}, {40, 60}};
  Points right{{180, 20}, {140, 20}, {160, 60}};
  for (const bool turned : {false, true}) {
    if (turned) std::ranges::reverse(right);
    Cage cage = deformation.rest;
    add_hole(cage, polygon_cage(left).segments);
    add_hole(cage, polygon_cage(right).segments);
    Deformation holed = with_cage({}, cage);
    holed.pose.segments[4][0] += Complex(3, 5);
    const Mirror mirror(holed);
    const Pose once = mirrored(holed, whole_pose_of(holed));
    CHECK(mirrored(holed, once) == whole_pose_of(holed));
    int moved = 0;
    for (Index e = 7; e < 10; ++e)
      if (once.cage.vertex(e) != cage.vertex(e)) {
        ++moved;
        CHECK(once.cage.vertex(e) == mirror(holed.pose.vertex(4)));
      }
    CHECK(moved == 1);
  }
}

TEST_CASE("The automatic cage keeps holes that are wide enough and empty") {
  const auto ring = [](Complex z) {
    return std::abs(z - Complex(150, 120)) < 100 && std::abs(z - Complex(160, 120)) > 50;
  };
  const Image image = picture(300, 240, ring);
  const Cage cage = auto_cage(image);
  check_rest_cage(cage);
  REQUIRE(cage.starts.size() == 1);
  const Covered kept = covered(image, cage);
  CHECK(kept.lost == 0);
  CHECK(kept.empty_inside < 0.1 * kPi * 100 * 100);
  // The hole is 100 px wide; the content's size is 283 px.
  CHECK(auto_cage(image, {.hole_width = 30}).starts.size() == 1);
  CHECK(auto_cage(image, {.hole_width = 40}).starts.empty());
  CHECK(auto_cage(image, {.hole_width = 100}).starts.empty());
  for (const AutoCageOptions& options :
       {AutoCageOptions{.vertices = 12}, AutoCageOptions{.margin = 4},
        AutoCageOptions{.curved = true}, AutoCageOptions{.detail = 0},
        AutoCageOptions{.detail = 100}}) {
    const Cage other = auto_cage(image, options);
    check_rest_cage(other);
    CHECK(other.starts.size() == 1);
    CHECK(covered(image, other).lost == 0);
  }
  // Something in the hole must stay inside the cage.
  const Image eye =
      picture(300, 240, [&](Complex z) { return ring(z) || std::abs(z - Complex(165, 120)) < 8; });
  CHECK(auto_cage(eye).starts.empty());
  CHECK_THROWS_AS(auto_cage(image, {.hole_width = -1}), Error);
  CHECK_THROWS_AS(auto_cage(image, {.hole_width = NAN}), Error);
}

TEST_CASE("The automatic cage has a valid hole for each of any number of random openings") {
  for (const unsigned seed : seeds_of("automatic holes", {1, 2, 3})) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    struct Opening {
      Complex at, along;
      double length, width;
    };
    std::vector<Opening> openings;  // capsules, none of which touch
    const double width = 200 + 400 * unit(random), height = 200 + 300 * unit(random);
    for (int tries = 0; tries < 40; ++tries) {
      const Opening next{{20 + (width - 40) * unit(random), 20 + (height - 40) * unit(random)},
                         std::polar(1.0, 7 * unit(random)),
                         60 * unit(random),
                         8 + 20 * unit(random)};
      const auto reach = [](const Opening& o) { return 0.5 * o.length + o.width + 4; };
      bool apart = true;
      for (const Opening& other : openings)
        apart = apart && std::abs(other.at - next.at) > reach(other) + reach(next);
      const double edge = std::min(
          {next.at.real(), width - next.at.real(), next.at.imag(), height - next.at.imag()});
      if (apart && edge > reach(next) + 15) openings.push_back(next);
    }
    const auto is_open = [&](Complex z) {
      return std::ranges::any_of(openings, [&](const Opening& o) {
        const Complex half = 0.5 * o.length * o.along;
        return nearest_on_segment(o.at - half, o.at + half, z).distance < 0.5 * o.width;
      });
    };
    const Image image = picture(static_cast<int>(width), static_cast<int>(height), [&](Complex z) {
      return z.real() > 8 && z.real() < width - 8 && z.imag() > 8 && z.imag() < height - 8 &&
             !is_open(z);
    });
    const double size = std::hypot(width - 16, height - 16);
    const Cage cage = auto_cage(image, {.hole_width = 0});
    check_rest_cage(cage);
    CHECK(covered(image, cage).lost == 0);
    size_t wide = 0;
    for (const Opening& opening : openings) wide += opening.width > 9;
    CHECK(cage.starts.size() >= wide);
    CHECK(cage.starts.size() <= openings.size());
    const double percent = 100 * 15 / size;
    size_t clearly = 0, perhaps = 0;
    for (const Opening& opening : openings) {
      clearly += opening.width > 17;
      perhaps += opening.width > 13;
    }
    const size_t kept = auto_cage(image, {.hole_width = percent}).starts.size();
    CHECK(kept >= clearly);
    CHECK(kept <= perhaps);
    CHECK(domain_mesh(cage, {500}).starts.size() == cage.starts.size());
  }
}

}  // namespace holomorph::holes_test
