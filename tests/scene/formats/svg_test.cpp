// Cages written to SVG files and read back.

#include "core/error.h"
#include "scene/formats/svg_path.h"
#include "support/catch.h"
#include "support/complaint.h"
#include "support/shapes.h"

namespace holomorph::svg_test {

TEST_CASE("SVG paths: all commands, absolute and relative, give the same loop") {
  const auto loop = [](const std::string& d) {
    return cage_of_svg("<svg height='100'><g><path d='" + d + "'/></g></svg>", "p.svg", 0);
  };
  const Cage expected = [] {
    Cage cage;
    cage.segments = {{{10, 90}},
                     {{50, 90}, {60, 80}, {60, 60}},
                     {{50, 50}, {40, 40}, {30, 30}},
                     {{20, 50}, {15, 60}}};
    return cage;
  }();
  for (const char* d : {"M10 10 L50 10 C60 20 60 40 50 50 C40 60 30 70 20 50 Q15 40 10 10 Z",
                        "M10,10H50C60,20,60,40,50,50S30,70,20,50Q15,40,10,10",
                        "m10 10h40c10 10 10 30 0 40s-20 20-30 0q-5-10-10-40z",
                        "M 10 10 50 10 C 60 20 60 40 50 50 40 60 30 70 20 50 Q 15 40 10 10 z"}) {
    const Cage cage = loop(d);
    REQUIRE(cage.size() == expected.size());
    for (Index e = 0; e < cage.size(); ++e) {
      REQUIRE(cage.degree(e) == expected.degree(e));
      for (int m = 0; m < cage.degree(e); ++m)
        CHECK(std::abs(cage.segments[e][m] - expected.segments[e][m]) < 1e-12);
    }
  }
  CHECK(loop("M0 0 Q10 0 10 10 T20 20 V0 z").segments[1][1] == Complex(10, 80));
  CHECK(loop("M0 0V10H10v-10z").size() == 4);
  // Handles that coincide with their points are moved away from them.
  const Cage freed = loop("M0 0 C0 0 10 10 10 10 L10 0 L5 -3 z");
  CHECK(freed.segments[0][1] != freed.segments[0][0]);
  check_rest_cage(freed);
  const Cage posed =
      cage_of_svg("<svg height='100'><path d='M0 0 C0 0 10 10 10 10 L10 0 L5 -3 z'/></svg>",
                  "p.svg", 0, PathUse::pose);
  CHECK(posed.segments[0][1] == posed.segments[0][0]);  // a pose has no such restriction
}

TEST_CASE("SVG files without a cage are rejected with the reason") {
  const auto complaint = [](const std::string& text) {
    return error_message_of([&] { cage_of_svg(text, "p.svg", 0); });
  };
  using Catch::Contains;
  CHECK_THAT(complaint("hello"), Contains("p.svg"));
  CHECK_THAT(complaint("<svg><rect/></svg>"), Contains("no path"));
  const auto path = [](const std::string& d) { return "<svg><path d='" + d + "'/></svg>"; };
  CHECK_THAT(complaint(path("")), Contains("empty"));
  CHECK_THAT(complaint(path("M0 0 L1 x")), Contains("character 9") && Contains("number"));
  CHECK_THAT(complaint(path("M0 0 A1 1 0 2 0 2 2")), Contains("expected 0 or 1"));
  CHECK_THAT(complaint(path("M0 0 L1 0 L1 1 z L5 5")), Contains("a subpath has 2"));
  CHECK_THAT(complaint(path("M0 0 L9 0 L9 9 z M5 5 L6 5 z")), Contains("a subpath has 2"));
  CHECK_THAT(complaint(path("L0 0 L1 1")), Contains("must begin with M"));
  CHECK_THAT(complaint(path("M0 0 L1 0")), Contains("at least three"));
  CHECK_THAT(complaint("<svg><g transform='scale(2)'><path d='M0 0 L1 0 L1 1'/></g></svg>"),
             Contains("transform"));
  CHECK_THAT(
      complaint("<svg><path style='fill:red; transform: scale(2)' d='M0 0 L1 0 L1 1'/></svg>"),
      Contains("transform"));
  for (const char* style : {"text-transform:none", "transform: none", "transform-origin:0 0"})
    CHECK(complaint("<svg><path style='fill:red;" + std::string(style) +
                    "' d='M0 0 L1 0 L1 1'/></svg>") == "");
  CHECK_THAT(complaint("<svg><defs><path d='M0 0 L1 0 L1 1'/></defs></svg>"), Contains("no path"));
  CHECK_THAT(complaint(path("M0 0 L1e999 0 L1 1")), Contains("too large"));
  CHECK_THAT(complaint(path("M0 0 L1 +-1 L1 1")), Contains("expected a number"));
  CHECK_THAT(complaint(path("M0 0 L0x10 0 L1 1")), Contains("character 8"));
}

namespace {

void check_equal(const Cage& a, const Cage& b) {
  REQUIRE(a.size() == b.size());
  for (Index e = 0; e < a.size(); ++e) {
    REQUIRE(a.degree(e) == b.degree(e));
    for (int m = 0; m < a.degree(e); ++m)
      CHECK(std::abs(a.segments[e][m] - b.segments[e][m]) < 1e-9);
  }
}

}  // namespace

TEST_CASE("A cage survives SVG to 1e-9, at rest and posed, with and without a picture") {
  Deformation deformation = with_cage(Deformation{}, shapes::curved_star(9, 3, 0.3, 4));
  deformation.pose = shapes::curved_star(9, 2, 0.2, 7);
  deformation.pose.segments[3].resize(1);
  for (const int picture : {0, 400}) {
    std::optional<ImageReference> image;
    if (picture) image = ImageReference{"x.png", "", picture, picture, {}, "", ""};
    check_equal(cage_of_svg(svg_of(deformation, image), "p.svg", picture, PathUse::pose),
                deformation.pose);
    check_equal(cage_of_svg(svg_of(deformation, image), "p.svg", picture, PathUse::rest),
                deformation.rest);
  }
}

TEST_CASE("A pose whose points coincide keeps all of its segments in SVG") {
  Deformation deformation = with_cage(Deformation{}, shapes::l_shape());
  for (const Index v : {1, 2, 5}) deformation.pose.segments[v][0] = deformation.pose.segments[0][0];
  check_equal(cage_of_svg(svg_of(deformation, {}), "p.svg", 0, PathUse::pose), deformation.pose);
}

TEST_CASE(
    "Curves of high degree are written as cubics, with as many pieces at rest as in the pose") {
  Deformation deformation = with_cage(Deformation{}, polygon_cage(shapes::l_shape()));
  deformation.pose.segments[0] = {{0, 0}, {0, -60}, {50, -90}, {130, -60}};
  // Equal to its cubic at a quarter, a half and three quarters, and far from it in between.
  Points bent;
  for (int m = 0; m < 7; ++m) bent.push_back({200.0, 100.0 * m / 7});
  const double off[] = {0, 0, -89.285714, 232.142857, -232.142857, 89.285714, 0};
  for (int m = 0; m < 7; ++m) bent[static_cast<size_t>(m)] += off[m];
  deformation.pose.segments[1] = bent;
  const std::string svg = svg_of(deformation, {});
  const Cage rest = cage_of_svg(svg, "p.svg", 0, PathUse::rest),
             pose = cage_of_svg(svg, "p.svg", 0, PathUse::pose);
  REQUIRE(rest.size() == pose.size());
  CHECK(vertices_of(rest).front() == vertices_of(deformation.rest).front());
  const Polygon fine = outline_of(pose, 256);
  constexpr double kChord = 1e-3;  // how far the chords of the fine outline are off
  const double allowed = 1e-4 * box_of(controls_of(deformation.pose)).diagonal() + kChord;
  for (const Complex& z : outline_of(deformation.pose, 500))
    CHECK(nearest_on_polygon(fine, z).distance < allowed);
}

}  // namespace holomorph::svg_test
