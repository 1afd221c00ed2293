// A drawing that is bent by the identity or by a turn looks as before. The judge is rsvg-convert.
#include "scene/formats/bent_drawing.h"

#include "core/error.h"
#include "core/geometry/affine.h"
#include "scene/formats/image_formats.h"
#include "scene/formats/path_data.h"
#include "support/catch.h"
#include "support/complaint.h"

namespace holomorph::drawing_test {

namespace {

const std::string kDrawing = R"svg(<?xml version="1.0"?>
<!DOCTYPE svg [<!ENTITY ns "http://www.w3.org/2000/svg"> <!ENTITY red "#c03020">]>
<svg xmlns="&ns;" xmlns:xlink="http://www.w3.org/1999/xlink" width="60mm" height="40mm" viewBox="0 0 300 200">
  <style>.outline{fill:none;stroke:#203040;stroke-width:4} g > rect{stroke-linejoin:round}
         #dashed{stroke-dasharray:12 5}</style>
  <defs>
    <linearGradient id="sky" x2="0" y2="1"><stop offset="0" stop-color="#88c"/><stop offset="1" stop-color="#efe"/></linearGradient>
    <radialGradient id="sun" gradientUnits="userSpaceOnUse" cx="60" cy="50" r="35"><stop offset="0" stop-color="#fe8"/><stop offset="1" stop-color="&red;"/></radialGradient>
    <clipPath id="window"><circle cx="210" cy="110" r="60"/></clipPath>
    <clipPath id="half" clipPathUnits="objectBoundingBox"><rect width="0.5" height="1"/></clipPath>
    <mask id="fade"><rect x="0" y="100" width="300" height="100" fill="url(#grey)"/></mask>
    <linearGradient id="grey"><stop offset="0" stop-color="#000"/><stop offset="1" stop-color="#fff"/></linearGradient>
    <symbol id="leaf" viewBox="0 0 10 10"><path d="M1 5a4 4 0 1 1 8 0q-4 6-8 0z" fill="#397"/></symbol>
  </defs>
  <rect x="5" y="5" width="290" height="190" rx="20" fill="url(#sky)"/>
  <circle cx="60" cy="50" r="35" style="fill:url(#sun)"/>
  <g transform="translate(150 20) rotate(10) scale(1.5 0.8)">
    <rect class="outline" width="60" height="40" ry="8"/>
    <ellipse id="dashed" class="outline" cx="30" cy="20" rx="20" ry="12"/>
  </g>
  <g clip-path="url(#window)">
    <polygon points="150,60 270,80 250,170 160,150" fill="&red;"/>
    <path d="M150 110h120m-60-60v120" stroke="#fff" stroke-width="6"/>
  </g>
  <polyline points="20,180 60,120 100,170 140,130" class="outline" clip-path="url(#half)"/>
  <g mask="url(#fade)"><rect x="10" y="175" width="280" height="15"/></g>
  <use xlink:href="#leaf" x="110" y="60" width="40" height="40"/>
  <use href="#leaf" x="110" y="105" width="30" height="20" transform="skewX(-10)"/>
</svg>)svg";

Image drawn(const std::string& svg) {
  PixelBudget budget;
  return decode_svg(svg, "drawing.svg", budget);
}

std::string document_of(const BentDrawing& bent, const std::string& size) {
  return "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' " +
         size + ">" + bent.group + "</svg>";
}

/// The average difference of two pictures of the same size, over white, in 255ths.
double difference(const Image& a, const Image& b) {
  REQUIRE(a.width == b.width);
  REQUIRE(a.height == b.height);
  double sum = 0;
  for (size_t i = 0; i < a.pixels.size(); i += 4)
    for (size_t k = 0; k < 3; ++k) {
      const auto over_white = [&](const Image& of) {
        return 255 + (of.pixels[i + k] - 255) * (of.pixels[i + 3] / 255.0);
      };
      sum += std::abs(over_white(a) - over_white(b));
    }
  return sum / (0.75 * static_cast<double>(a.pixels.size()));
}

std::vector<PointMap::Value> identity(std::span<const Complex> points) {
  std::vector<PointMap::Value> values;
  for (const Complex& z : points) values.push_back({z, 1, 0});
  return values;
}

}  // namespace

TEST_CASE("A drawing is opened in its own size, enlarged if it is small") {
  const Image image = drawn(kDrawing);
  CHECK(image.width == 1024);
  CHECK(image.height == 683);
  CHECK(drawn("<svg width='3000' height='10'/>").width == 3000);
  CHECK(drawn("<svg width='600' height='400'/>").width == 600);
  CHECK(drawn("<svg width='6000' height='3000'/>").height == 2048);
  CHECK(drawn("<svg viewBox='0 0 9 18'/>").height == 1024);
  const Image content = drawn("<svg><rect x='-5' y='3' width='20' height='10' fill='red'/></svg>");
  CHECK(content.width == 1024);
  CHECK(content.height == 512);
  CHECK(content.at(0, 0)[0] == 255);
}

TEST_CASE("What has no area is not filled when it is bent") {
  const PointValues square = [](std::span<const Complex> points) {
    std::vector<PointMap::Value> values;
    for (const Complex& z : points) values.push_back({z + 0.0002 * z * z, 1.0 + 0.0004 * z, 0});
    return values;
  };
  const auto bent = [&](const std::string& shape) {
    return bent_drawing("<svg width='900' height='900'>" + shape + "</svg>", "a.svg", square, {})
        .group;
  };
  const auto is_filled = [&](const std::string& shape) {
    return bent(shape).find("fill:none") == std::string::npos;
  };
  CHECK_FALSE(is_filled("<path d='M9 9L500 700' stroke='red'/>"));
  CHECK_FALSE(is_filled("<line x1='9' x2='400' y2='700' stroke='red'/>"));
  CHECK_FALSE(is_filled("<polyline points='9,9 99,99 999,999' style='stroke:red;fill:blue'/>"));
  CHECK(is_filled("<path d='M9 9L500 700L0 800' stroke='red'/>"));
  // Where nothing is stroked, the edge that closes a shape is bent, too.
  CHECK(bent("<path d='M9 9L500 700L0 800'/>").find("Z\"") != std::string::npos);
  CHECK(bent("<path d='M9 9L500 700L0 800' stroke='red'/>").find("Z\"") == std::string::npos);
}

TEST_CASE("A drawing that is bent by the identity looks as before") {
  const BentDrawing bent = bent_drawing(kDrawing, "drawing.svg", identity,
                                        {.upper_left = Complex(0, 683), .prefix = "a-"});
  CHECK(bent.losses.empty());
  CHECK(bent.width == Approx(60 / 25.4 * 96));
  const Image before = drawn(kDrawing),
              after = drawn(document_of(bent, "width='1024' height='683'"));
  CHECK(difference(before, after) < 0.2);
  CHECK(difference(before, drawn("<svg width='1024' height='683'/>")) > 20);
}

TEST_CASE("A drawing that is turned looks turned, with its strokes and gradients") {
  const Image before = drawn(kDrawing);
  // By 90 degrees, about the lower left corner.
  const auto turn = [](std::span<const Complex> points) {
    std::vector<PointMap::Value> values;
    for (const Complex& z : points) values.push_back({kI * z + 683.0, kI, 0});
    return values;
  };
  const BentDrawing bent =
      bent_drawing(kDrawing, "drawing.svg", turn, {.upper_left = Complex(0, 1024)});
  const Image after = drawn(document_of(bent, "width='683' height='1024'"));
  CHECK(difference(upright(before, 8), after) < 0.4);
}

TEST_CASE("What cannot be bent is named, and mistakes are explained") {
  const auto losses = [](const std::string& content) {
    return bent_drawing("<svg width='10' height='10'>" + content + "</svg>", "d.svg", identity, {})
        .losses;
  };
  CHECK(losses("<path d='M0 0'/>").empty());
  CHECK(losses("<text>a</text>") ==
        std::vector<std::string>{"its texts are moved and turned, but not bent"});
  CHECK(losses("<circle r='3'><animate/></circle>") ==
        std::vector<std::string>{"its animation is left out"});
  CHECK(losses("<style>a:hover{fill:red}</style>") ==
        std::vector<std::string>{"some of its style rules are ignored"});
  const auto complaint = [](const std::string& text) {
    return error_message_of([&] { bent_drawing(text, "d.svg", identity, {}); });
  };
  using Catch::Contains;
  CHECK_THAT(complaint("nothing"), Contains("d.svg: not an SVG file"));
  CHECK_THAT(complaint("<svg/>"), Contains("no size"));
  std::string bomb = "<g id='a0'><path d='M0 0h1'/></g>";
  for (int k = 0; k < 30; ++k) {
    const std::string use = "<use href='#a" + std::to_string(k) + "'/>";
    bomb += "<g id='a" + std::to_string(k + 1) + "'>" + use + use + "</g>";
  }
  CHECK_THAT(complaint("<svg width='9' height='9'>" + bomb + "</svg>"),
             Contains("200,000 elements"));
  CHECK(losses("<g id='a'><use href='#a'/></g>").empty());
}

TEST_CASE("Many entities are replaced in linear time") {
  std::string type, path = "M0 0";
  for (int k = 0; k < 20000; ++k) {
    const std::string name = "e" + std::to_string(k);
    type += "<!ENTITY " + name + " 'h1'>";
    path += "&" + name + ";&lt;";
  }
  const std::string text = "<!DOCTYPE svg [" + type + "]><svg width='9' height='9'><title>" + path +
                           "</title><path d='M0 0&e19999;v1'/></svg>";
  const BentDrawing bent = bent_drawing(text, "d.svg", identity, {});
  CHECK(bent.group.find("h1&lt;h1") != std::string::npos);
  CHECK(bent.group.find("M0 1024L113.778 1024L113.778 1137.778") == std::string::npos);
  CHECK(bent.group.find("d=\"M0 -1024L") != std::string::npos);
}

TEST_CASE("Arcs are within 5e-6 of the ellipse") {
  const PathData path = path_data_of("M10 20a30 15 40 0150 9zl5 5");
  REQUIRE(path.problem.empty());
  REQUIRE(path.subpaths.size() == 2);
  CHECK(path.subpaths[1].start == Complex(10, 20));
  CHECK(path.subpaths[0].end() == Complex(60, 29));
  for (const bool large : {false, true})
    for (const bool sweep : {false, true}) {
      double length = 0;
      for (const Points& c : arc_cubics({100, 0}, {0, 100}, 100, 100, 0, large, sweep)) {
        length += std::abs(c.back() - c.front());
        const Complex center = large == sweep ? Complex(100, 100) : Complex(0, 0);
        for (int k = 0; k <= 20; ++k) {
          const double t = k / 20.0, s = 1 - t;
          const Complex z =
              s * s * s * c[0] + 3 * s * s * t * c[1] + 3 * s * t * t * c[2] + t * t * t * c[3];
          CHECK(std::abs(std::abs(z - center) - 100) < 5e-4);
        }
      }
      CHECK(length == Approx(large ? 459 : 153).epsilon(0.02));
    }
}

}  // namespace holomorph::drawing_test
