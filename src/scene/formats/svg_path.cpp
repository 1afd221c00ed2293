// pugixml parses the file. PathReader parses the path data, which has a syntax of its own.
#include "scene/formats/svg_path.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "core/error.h"
#include "scene/budget.h"

namespace holomorph {
namespace {

/// Reads path data command by command and collects the control points of each segment, subpath by
/// subpath.
class PathReader {
 public:
  /// Lines of length zero are dropped unless `keeps_points` is true.
  PathReader(const std::string& data, std::string name, bool keeps_points)
      : data_(data), name_(std::move(name)), keeps_points_(keeps_points) {}

  std::vector<std::vector<Points>> loops() {
    while (skip_blanks()) read_command();
    if (!started_) fail("the path is empty");
    if (open_) finish_loop();
    return std::move(loops_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::bad_input,
                name_ + ": path data, character " + std::to_string(at_ + 1) + ": " + what);
  }

  bool skip_blanks() {
    while (at_ < data_.size() &&
           (std::isspace(static_cast<unsigned char>(data_[at_])) || data_[at_] == ','))
      ++at_;
    return at_ < data_.size();
  }

  bool number_follows() {
    if (!skip_blanks()) return false;
    const auto begins = [](char c) {
      return std::isdigit(static_cast<unsigned char>(c)) || c == '.';
    };
    const bool is_signed = data_[at_] == '-' || data_[at_] == '+';
    return begins(data_[at_]) || (is_signed && at_ + 1 < data_.size() && begins(data_[at_ + 1]));
  }

  double number() {
    if (!number_follows()) fail("expected a number");
    const char* from = data_.data() + at_ + (data_[at_] == '+');
    double x = 0;
    const auto [end, wrong] = std::from_chars(from, data_.data() + data_.size(), x);
    if (wrong == std::errc::result_out_of_range) fail("the number is too large or too small");
    if (wrong != std::errc{}) fail("not a number");
    at_ = static_cast<size_t>(end - data_.data());
    return x;
  }

  /// Reads a point. Lower-case commands give points relative to the current point.
  Complex point(bool relative) {
    const double x = number(), y = number();
    return (relative ? here_ : Complex(0)) + Complex(x, y);
  }

  void read_command() {
    const char letter = data_[at_++];
    const bool relative = std::islower(static_cast<unsigned char>(letter));
    const char command = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    if (command == 'Z' || command == 'M') last_ = command;
    if (command == 'Z') {
      if (open_) finish_loop();
      here_ = start_;
      return;
    }
    if (command == 'M') {
      if (open_) finish_loop();
      start_ = here_ = point(relative);
      started_ = open_ = true;
      while (number_follows()) line_to(point(relative));
      return;
    }
    if (!started_) fail("a path must begin with M");
    if (!open_) fail("a new subpath must begin with M");
    do {
      read_segment(command, relative);
      last_ = command;
    } while (number_follows());
  }

  void read_segment(char command, bool relative) {
    const Complex before = here_;
    switch (command) {
      case 'L':
        return line_to(point(relative));
      case 'H':
        return line_to({number() + (relative ? here_.real() : 0), here_.imag()});
      case 'V':
        return line_to({here_.real(), number() + (relative ? here_.imag() : 0)});
      case 'C': {
        const Complex a = point(relative), b = point(relative);
        return curve_to({before, a, b}, point(relative), b);
      }
      case 'S': {
        const Complex a = last_ == 'C' || last_ == 'S' ? 2.0 * here_ - control_ : here_;
        const Complex b = point(relative);
        return curve_to({before, a, b}, point(relative), b);
      }
      case 'Q': {
        const Complex a = point(relative);
        return curve_to({before, a}, point(relative), a);
      }
      case 'T': {
        const Complex a = last_ == 'Q' || last_ == 'T' ? 2.0 * here_ - control_ : here_;
        return curve_to({before, a}, point(relative), a);
      }
      case 'A':
        fail("arcs are not supported; convert them to curves in the drawing program");
      default:
        --at_;
        fail(std::string("'") + data_[at_] + "' is not a path command");
    }
  }

  void line_to(Complex to) {
    if (to != here_ || keeps_points_) segments_.push_back({here_});
    here_ = to;
  }

  void curve_to(Points controls, Complex to, Complex control) {
    segments_.push_back(std::move(controls));
    control_ = control;
    here_ = to;
  }

  /// Closes the loop with a line, unless it is closed already. A subpath without segments is only a
  /// point and is left out.
  void finish_loop() {
    double size = 0;
    for (const Points& segment : segments_) size = std::max(size, std::abs(segment[0] - start_));
    if (std::abs(here_ - start_) > 1e-9 * size) segments_.push_back({here_});
    if (!segments_.empty() || loops_.empty()) loops_.push_back(std::move(segments_));
    segments_.clear();
    open_ = false;
  }

  const std::string& data_;
  std::string name_;
  size_t at_ = 0;
  Complex start_, here_, control_;
  char last_ = ' ';
  bool keeps_points_, started_ = false, open_ = false;
  std::vector<Points> segments_;            ///< of the current subpath
  std::vector<std::vector<Points>> loops_;  ///< finished subpaths
};

/// Throws Error if groups are nested deeper than the budget allows.
void check_levels(pugi::xml_document& document, const std::string& name) {
  struct Deepest : pugi::xml_tree_walker {  // does not recurse
    bool for_each(pugi::xml_node&) override {
      levels = std::max(levels, depth());
      return true;
    }
    int levels = 0;
  } deepest;
  document.traverse(deepest);
  check_budget(&Budget::groups, deepest.levels, name + ": its groups have");
}

/// The paths of a document in document order, except paths that are only definitions for other
/// elements.
std::vector<pugi::xml_node> paths_of(const pugi::xml_node& document) {
  static const std::set<std::string> kUnseen{"defs",   "clipPath", "mask",
                                             "marker", "pattern",  "symbol"};
  std::vector<pugi::xml_node> paths, waiting{document};
  while (!waiting.empty()) {  // no recursion: groups may be deep
    const pugi::xml_node node = waiting.back();
    waiting.pop_back();
    std::string tag = node.name();
    if (const size_t colon = tag.find(':'); colon != std::string::npos) tag.erase(0, colon + 1);
    if (tag == "path") paths.push_back(node);
    if (kUnseen.contains(tag)) continue;
    for (pugi::xml_node child = node.last_child(); child; child = child.previous_sibling())
      waiting.push_back(child);
  }
  return paths;
}

/// The path with this id, or the first one.
pugi::xml_node path_of(const pugi::xml_node& document, const std::string& id) {
  const std::vector<pugi::xml_node> paths = paths_of(document);
  for (const pugi::xml_node& path : paths)
    if (path.attribute("id").as_string() == id) return path;
  return paths.empty() ? pugi::xml_node() : paths.front();
}

/// Whether a node has a transform, as an attribute or in its style.
bool is_transformed(const pugi::xml_node& node) {
  if (node.attribute("transform")) return true;
  std::istringstream style(node.attribute("style").as_string());
  std::string property;
  while (std::getline(style, property, ';')) {
    std::erase_if(property, [](unsigned char c) { return std::isspace(c); });
    if (property.starts_with("transform:") && property != "transform:none") return true;
  }
  return false;
}

/// Moves each tangent handle that coincides with its point slightly along the curve.
void separate_handles(Cage& cage) {
  constexpr double kPull = 1e-3;
  for (Index e = 0; e < cage.size(); ++e) {
    Points& c = cage.segments[e];
    const Points all = cage.controls(e);
    const size_t n = all.size() - 1;
    if (n < 2) continue;
    const auto first_other =
        std::find_if(all.begin(), all.end(), [&](Complex z) { return z != all[0]; });
    const auto last_other =
        std::find_if(all.rbegin(), all.rend(), [&](Complex z) { return z != all[n]; });
    if (first_other == all.end()) continue;
    if (all[1] == all[0]) c[1] = all[0] + kPull * (*first_other - all[0]);
    if (all[n - 1] == all[n]) c[n - 1] = all[n] + kPull * (*last_other - all[n]);
  }
}

}  // namespace

Cage cage_of_svg(const std::string& text, const std::string& name, double height, PathUse use) {
  static constexpr const char* kIds[] = {"rest", "pose", "outline"};
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  if (!result)
    throw Error(ErrorKind::bad_input, name + ": not an SVG file: " + result.description());
  check_levels(document, name);
  const pugi::xml_node path = path_of(document, kIds[static_cast<int>(use)]);
  if (!path) throw Error(ErrorKind::bad_input, name + ": the file has no path");
  for (pugi::xml_node node = path; node; node = node.parent())
    if (is_transformed(node))
      throw Error(ErrorKind::bad_input, name +
                                            ": the path or its group has a transform; apply it in "
                                            "the drawing program and save again");
  if (!(height > 0)) {
    const pugi::xml_node root = document.document_element();
    height = root.attribute("height").as_double(0);
  }
  auto loops = PathReader(path.attribute("d").as_string(), name, use == PathUse::pose).loops();
  if (use == PathUse::outline && loops.size() > 1)
    throw Error(ErrorKind::bad_input,
                name + ": the path has several subpaths; an outline is one closed loop");
  if (loops.size() > kMaxHoles + 1)
    throw Error(ErrorKind::bad_input, name + ": the path has " + std::to_string(loops.size()) +
                                          " subpaths; at most 101 are allowed");
  for (auto& loop : loops)
    for (Points& segment : loop)
      for (Complex& z : segment) z = {z.real(), height - z.imag()};
  // The subpath with the largest area is the outer loop; the others are holes.
  const auto outer = std::ranges::max_element(loops, {}, [](const std::vector<Points>& loop) {
    return std::abs(signed_area(outline_of(Cage{loop})));
  });
  std::rotate(loops.begin(), outer, outer + 1);
  Cage cage{loops[0]};
  for (size_t l = 1; l < loops.size(); ++l) add_hole(cage, loops[l]);
  if (cage.size() > static_cast<Index>(kMaxSegments))
    throw Error(ErrorKind::bad_input, name + ": the path has " + std::to_string(cage.size()) +
                                          " segments; at most 5000 are allowed");
  for (const auto& loop : loops)
    if (loop.size() < 3 && use != PathUse::outline)
      throw Error(ErrorKind::bad_input,
                  name + ": " + (loops.size() > 1 ? "a subpath has " : "the path has ") +
                      std::to_string(loop.size()) +
                      " segments; a cage and its holes need at least three");
  if (use == PathUse::rest) separate_handles(cage);
  return cage;
}

namespace {

std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

std::string point(Complex z, double height) {
  return number(z.real()) + " " + number(height - z.imag());
}

/// The cubic with the same end points and end tangents as a curve.
Points cubic_of(const Points& c) {
  const double n = static_cast<double>(c.size()) - 1, arm = n / 3;
  return {c.front(), c.front() + arm * (c[1] - c.front()),
          c.back() + arm * (c[c.size() - 2] - c.back()), c.back()};
}

/// A bound on the distance between a curve and its cubic. Their difference is a Bezier curve, which
/// lies in the convex hull of its control points.
double distance_from_cubic(const Points& c) {
  const Points cubic = elevated(cubic_of(c), static_cast<int>(c.size()) - 1);
  double off = 0;
  for (size_t m = 0; m < c.size(); ++m) off = std::max(off, std::abs(c[m] - cubic[m]));
  return off;
}

/// The curve split into `count` pieces with parameter intervals of equal length.
std::vector<Points> pieces_of(Points c, int count) {
  std::vector<Points> pieces;
  for (; count > 1; --count) {
    SplitCurve halves = split(c, 1.0 / count);
    pieces.push_back(std::move(halves.before));
    c = std::move(halves.after);
  }
  pieces.push_back(std::move(c));
  return pieces;
}

/// The number of cubics that approximate a curve to kOffCubic of its size. It is 1 up to degree 3.
int cubic_count(const Points& c) {
  constexpr double kOffCubic = 1e-4;
  const double allowed = kOffCubic * box_of(c).diagonal();
  int count = 1;
  if (c.size() > 4)
    while (std::ranges::any_of(pieces_of(c, count), [&](const Points& piece) {
      return distance_from_cubic(piece) > allowed;
    }))
      count *= 2;
  return count;
}

/// The path data of a cage with segment i split into counts[i] pieces.
std::string path_data(const Cage& cage, const std::vector<int>& counts, double height) {
  std::string data;
  const Loops loops = cage.loops();
  for (Index l = 0; l < loops.count(); ++l) {
    data += (l == 0 ? "M " : " M ") + point(cage.vertex(loops.first(l)), height);
    for (Index i = loops.first(l); i < loops.end(l); ++i)
      for (Points piece : pieces_of(cage.controls(i), counts[static_cast<size_t>(i)])) {
        if (piece.size() > 4) piece = cubic_of(piece);
        data += piece.size() == 2 ? " L" : piece.size() == 3 ? " Q" : " C";
        for (size_t m = 1; m < piece.size(); ++m) data += " " + point(piece[m], height);
      }
    data += " Z";
  }
  return data;
}

}  // namespace

std::string svg_of(const Deformation& deformation, const std::optional<ImageReference>& image) {
  Box box = box_of(outline_of(deformation.pose));
  for (const Complex& z : outline_of(deformation.rest)) box.include(z);
  double height = box.height();
  if (image && image->width > 0) {
    height = image->height;
    box.include({0, 0});
    box.include({static_cast<double>(image->width), height});
  }
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(box.width()) +
                    "\" height=\"" + number(box.height()) + "\" viewBox=\"" + number(box.left) +
                    " " + number(height - box.top) + " " + number(box.width()) + " " +
                    number(box.height()) + "\">\n";
  std::vector<int> counts;  // the same for both cages, to keep segments in correspondence
  for (Index i = 0; i < deformation.rest.size(); ++i)
    counts.push_back(std::max(cubic_count(deformation.rest.controls(i)),
                              cubic_count(deformation.pose.controls(i))));
  const auto add_path = [&](const Cage& cage, const std::string& look) {
    svg += "  <path d=\"" + path_data(cage, counts, height) + "\" fill=\"none\" " + look + "/>\n";
  };
  if (deformation.has_cage()) {
    if (deformation.rest != deformation.pose)
      add_path(deformation.rest, "id=\"rest\" stroke=\"#808080\" stroke-dasharray=\"4 4\"");
    add_path(deformation.pose, "id=\"pose\" stroke=\"#1a7f37\" stroke-width=\"2\"");
  }
  for (const Pin& pin :
       method_named(deformation.method).uses_pins ? deformation.pins : std::vector<Pin>{})
    svg += "  <circle cx=\"" + number(pin.pose.real()) + "\" cy=\"" +
           number(height - pin.pose.imag()) + "\" r=\"4\" fill=\"#b35900\"/>\n";
  return svg + "</svg>\n";
}

}  // namespace holomorph
