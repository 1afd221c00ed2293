// Shapes are converted as SVG 2, chapter 10, prescribes. Circles start where it says, because
// dashes do.
#include "scene/formats/svg_shapes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "core/geometry/curve.h"
#include "scene/formats/svg_styles.h"

namespace holomorph {
namespace {

/// The numbers in a text, whatever separates them.
std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  for (size_t at = 0; at < text.size();) {
    double x = 0;
    const char* from = text.data() + at + (text[at] == '+');
    const auto [end, wrong] = std::from_chars(from, text.data() + text.size(), x);
    if (wrong == std::errc{} && std::isfinite(x)) {
      numbers.push_back(x);
      at = static_cast<size_t>(end - text.data());
    } else {
      ++at;
    }
  }
  return numbers;
}

Affine turned(double degrees) {
  return {.linear = std::polar(1.0, degrees * kPi / 180)};
}

Affine transform_named(const std::string& name, const std::vector<double>& n) {
  const size_t count = n.size();
  if (name == "matrix" && count == 6) return affine_of_matrix(n[0], n[1], n[2], n[3], n[4], n[5]);
  if (name == "translate" && count >= 1) return {.shift = {n[0], count > 1 ? n[1] : 0}};
  if (name == "scale" && count >= 1)
    return affine_of_matrix(n[0], 0, 0, count > 1 ? n[1] : n[0], 0, 0);
  if (name == "rotate" && count >= 3) {
    const Complex center{n[1], n[2]};
    return composed({.shift = center}, composed(turned(n[0]), {.shift = -center}));
  }
  if (name == "rotate" && count >= 1) return turned(n[0]);
  if (name == "skewX" && count == 1)
    return affine_of_matrix(1, 0, std::tan(n[0] * kPi / 180), 1, 0, 0);
  if (name == "skewY" && count == 1)
    return affine_of_matrix(1, std::tan(n[0] * kPi / 180), 0, 1, 0, 0);
  return {};
}

Subpath polyline(const std::vector<Complex>& points, bool closed) {
  Subpath path{points[0], {}, closed};
  for (size_t i = 1; i < points.size(); ++i) path.segments.push_back({points[i - 1], points[i]});
  return path;
}

void append_arc(Subpath& path, Complex to, double rx, double ry) {
  for (Points& cubic : arc_cubics(path.end(), to, rx, ry, 0, false, true))
    path.segments.push_back(std::move(cubic));
}

void append_line(Subpath& path, Complex to) {
  if (path.end() != to) path.segments.push_back({path.end(), to});
}

Subpath ellipse(Complex center, double rx, double ry) {
  Subpath path{center + rx};
  for (const Complex to : {Complex(0, ry), Complex(-rx, 0), Complex(0, -ry), Complex(rx, 0)})
    append_arc(path, center + to, rx, ry);
  path.closed = true;
  return path;
}

Subpath rectangle(Box box, double rx, double ry) {
  const double left = box.left, right = box.right, top = box.bottom, bottom = box.top;  // y down
  if (!(rx > 0) || !(ry > 0))
    return polyline({{left, top}, {right, top}, {right, bottom}, {left, bottom}}, true);
  Subpath path{{left + rx, top}};
  append_line(path, {right - rx, top});
  append_arc(path, {right, top + ry}, rx, ry);
  append_line(path, {right, bottom - ry});
  append_arc(path, {right - rx, bottom}, rx, ry);
  append_line(path, {left + rx, bottom});
  append_arc(path, {left, bottom - ry}, rx, ry);
  append_line(path, {left, top + ry});
  append_arc(path, {left + rx, top}, rx, ry);
  path.closed = true;
  return path;
}

const std::set<std::string>& shape_attributes() {
  static const std::set<std::string> all{"x",  "y",  "width", "height", "rx", "ry", "r",
                                         "cx", "cy", "x1",    "y1",     "x2", "y2", "points"};
  return all;
}

}  // namespace

double Viewport::diagonal() const {
  return std::hypot(width, height) / std::sqrt(2.0);
}

std::optional<double> length_of(const std::string& text, std::optional<double> whole) {
  const size_t first = text.find_first_not_of(" \t\r\n+");
  if (first == std::string::npos) return {};
  double x = 0;
  const auto [end, wrong] = std::from_chars(text.data() + first, text.data() + text.size(), x);
  if (wrong != std::errc{} || !std::isfinite(x)) return {};
  std::string unit(end, text.data() + text.size());
  while (!unit.empty() && std::isspace(static_cast<unsigned char>(unit.back()))) unit.pop_back();
  if (unit == "%") return whole ? std::optional(x / 100 * *whole) : std::nullopt;
  constexpr double kInch = 96;
  for (const auto& [name, size] : {std::pair{"", 1.0},
                                   {"px", 1.0},
                                   {"in", kInch},
                                   {"cm", kInch / 2.54},
                                   {"mm", kInch / 25.4},
                                   {"pt", kInch / 72},
                                   {"pc", kInch / 6},
                                   {"em", 16.0},
                                   {"ex", 8.0}})
    if (unit == name) return x * size;
  return {};
}

Affine transform_of(const std::string& text) {
  Affine all;
  for (size_t at = 0; at < text.size();) {
    const size_t open = text.find('(', at), close = text.find(')', at);
    if (open == std::string::npos || close == std::string::npos || close < open) break;
    std::string name;
    for (const char c : text.substr(at, open - at))
      if (std::isalpha(static_cast<unsigned char>(c))) name += c;
    all = composed(all, transform_named(name, numbers_in(std::string_view(text).substr(
                                                  open + 1, close - open - 1))));
    at = close + 1;
  }
  return is_finite(all.linear) && is_finite(all.anti) && is_finite(all.shift) ? all : Affine{};
}

Affine transform_of(const pugi::xml_node& node) {
  return transform_of(property_of(node, "transform"));
}

std::string number_text(double x) {
  char number[40];
  const auto [end, wrong] =
      std::to_chars(number, number + sizeof number, x, std::chars_format::general, 9);
  return {number, end};
}

std::string matrix_text(const Affine& map) {
  std::string text;
  for (const double x : matrix_of(map)) text += (text.empty() ? "matrix(" : " ") + number_text(x);
  return text + ")";
}

std::optional<Box> viewbox_of(const pugi::xml_node& node) {
  const std::vector<double> n = numbers_in(node.attribute("viewBox").as_string());
  if (n.size() != 4 || !(n[2] > 0) || !(n[3] > 0)) return {};
  return Box{n[0], n[1], n[0] + n[2], n[1] + n[3]};
}

Affine viewbox_map(const pugi::xml_node& node, Complex corner, const Viewport& size) {
  const auto box = viewbox_of(node);
  if (!box) return {.shift = corner};
  double sx = size.width / box->width(), sy = size.height / box->height();
  const std::string how = node.attribute("preserveAspectRatio").as_string("xMidYMid");
  Complex free = 0;
  if (!how.starts_with("none")) {
    const bool slice = how.find("slice") != std::string::npos;
    sx = sy = slice ? std::max(sx, sy) : std::min(sx, sy);
    const auto share = [&](const std::string& axis) {
      return how.find(axis + "Min") != std::string::npos   ? 0.0
             : how.find(axis + "Max") != std::string::npos ? 1.0
                                                           : 0.5;
    };
    free = {share("x") * (size.width - sx * box->width()),
            share("Y") * (size.height - sy * box->height())};
  }
  return composed({.shift = corner + free},
                  affine_of_matrix(sx, 0, 0, sy, -sx * box->left, -sy * box->bottom));
}

bool is_shape(const pugi::xml_node& node) {
  static const std::set<std::string> all{"path", "rect",     "circle", "ellipse",
                                         "line", "polyline", "polygon"};
  return all.contains(local_name(node));
}

std::vector<Subpath> path_of_shape(const pugi::xml_node& node, const Viewport& viewport) {
  const std::string kind = local_name(node);
  const auto length = [&](const char* name, double whole) {
    return length_of(node.attribute(name).as_string(), whole);
  };
  const auto x = [&](const char* name) { return length(name, viewport.width).value_or(0); };
  const auto y = [&](const char* name) { return length(name, viewport.height).value_or(0); };
  if (kind == "path") return path_data_of(node.attribute("d").as_string()).subpaths;
  if (kind == "line") return {polyline({{x("x1"), y("y1")}, {x("x2"), y("y2")}}, false)};
  if (kind == "polyline" || kind == "polygon") {
    const std::vector<double> numbers = numbers_in(node.attribute("points").as_string());
    Points points;
    for (size_t i = 0; i + 1 < numbers.size(); i += 2)
      points.push_back({numbers[i], numbers[i + 1]});
    if (points.empty()) return {};
    return {polyline(points, kind == "polygon")};
  }
  const Complex center{x("cx"), y("cy")};
  if (kind == "circle") {
    const double r = length("r", viewport.diagonal()).value_or(0);
    return r > 0 ? std::vector{ellipse(center, r, r)} : std::vector<Subpath>();
  }
  // A radius that is missing is that of the other axis.
  const auto rx = length("rx", viewport.width), ry = length("ry", viewport.height);
  const double one = rx.value_or(ry.value_or(0)), other = ry.value_or(rx.value_or(0));
  if (kind == "ellipse")
    return one > 0 && other > 0 ? std::vector{ellipse(center, one, other)} : std::vector<Subpath>();
  const double width = x("width"), height = y("height");
  if (!(width > 0) || !(height > 0)) return {};
  return {rectangle({x("x"), y("y"), x("x") + width, y("y") + height}, std::min(one, width / 2),
                    std::min(other, height / 2))};
}

void include(Box& box, const std::vector<Subpath>& path, const Affine& map) {
  constexpr int kPoints = 16;  // of a segment
  for (const Subpath& subpath : path) {
    box.include(map(subpath.start));
    for (const Points& segment : subpath.segments)
      for (int k = 1; k <= kPoints; ++k)
        box.include(map(bezier_point(segment, static_cast<double>(k) / kPoints)));
  }
}

void become_path(pugi::xml_node shape, const std::string& data) {
  std::string name = shape.name();
  const size_t colon = name.find(':');
  name = (colon == std::string::npos ? "" : name.substr(0, colon + 1)) + "path";
  if (local_name(shape) != "path")
    for (const std::string& attribute : shape_attributes())
      shape.remove_attribute(attribute.c_str());
  shape.set_name(name.c_str());
  shape.remove_attribute("d");
  shape.append_attribute("d").set_value(data.c_str());
}

}  // namespace holomorph
