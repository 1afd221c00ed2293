// pugixml parses the file, and path_data_of the path data, which has a syntax of its own.
#include "scene/formats/svg_path.h"

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "core/error.h"
#include "scene/formats/path_data.h"
#include "scene/formats/svg_document.h"
#include "scene/formats/svg_styles.h"

namespace holomorph {
namespace {

/// The closed loops of a path, as the segments of a Cage. Lines of length zero are dropped unless
/// `keeps_points`. A subpath without segments is only a point and is left out.
std::vector<std::vector<Points>> loops_of(const std::string& text, const std::string& name,
                                          bool keeps_points) {
  const PathData path = path_data_of(text);
  if (!path.problem.empty()) throw Error(ErrorKind::bad_input, name + ": " + path.problem);
  std::vector<std::vector<Points>> loops;
  for (const Subpath& subpath : path.subpaths) {
    std::vector<Points> loop;
    double size = 0;
    for (const Points& segment : subpath.segments) {
      if (segment.size() == 2 && segment[0] == segment[1] && !keeps_points) continue;
      size = std::max(size, std::abs(segment[0] - subpath.start));
      loop.push_back({segment.begin(), segment.end() - 1});
    }
    if (std::abs(subpath.end() - subpath.start) > 1e-9 * size) loop.push_back({subpath.end()});
    if (!loop.empty() || loops.empty()) loops.push_back(std::move(loop));
  }
  return loops;
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
    const std::string tag = local_name(node);
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

/// A cage with these loops and the holes and parts of another one.
Cage cage_like(const Cage& other, const std::vector<std::vector<Points>>& loops) {
  Cage cage;
  for (Index part = 0; part < other.part_count(); ++part) {
    const auto [first, end] = loops_of_part(other, part);
    Cage own{loops[static_cast<size_t>(first)]};
    for (Index l = first + 1; l < end; ++l) add_hole(own, loops[static_cast<size_t>(l)]);
    if (part == 0)
      cage = std::move(own);
    else
      add_part(cage, own);
  }
  return cage;
}

/// A cage of loops in any order. If all but one lie inside that one, they are its holes. Loops that
/// touch or cross are holes of the largest one, so that the cage is refused with a reason.
Cage nested_cage(std::vector<std::vector<Points>> loops) {
  std::erase_if(loops, [](const std::vector<Points>& loop) { return loop.empty(); });
  if (loops.empty()) return {};
  const auto area = [](const std::vector<Points>& loop) {
    return std::abs(signed_area(outline_of(Cage{loop})));
  };
  Polygon all;
  for (const std::vector<Points>& loop : loops) {
    if (!all.points.empty()) all.starts.push_back(static_cast<Index>(all.points.size()));
    const Polygon outline = outline_of(Cage{loop});
    all.points.insert(all.points.end(), outline.begin(), outline.end());
  }
  const bool simple = loops.size() > 1 && !self_crossing(all);
  const std::vector<int> around = simple ? nesting_of(all) : std::vector<int>{};
  if (!simple || std::ranges::count_if(around, [](int n) { return n % 2 == 0; }) == 1) {
    const auto outer = std::ranges::max_element(loops, {}, area);
    std::rotate(loops.begin(), outer, outer + 1);
    Cage cage{loops[0]};
    for (size_t l = 1; l < loops.size(); ++l) add_hole(cage, loops[l]);
    return cage;
  }
  Cage cage;
  for (size_t outline = 0; outline < loops.size(); ++outline) {
    if (around[outline] % 2 == 1) continue;
    Cage part{loops[outline]};
    const Points edge = outline_of(part).points;
    for (size_t l = 0; l < loops.size(); ++l)
      if (around[l] == around[outline] + 1 && winding_number(edge, loops[l][0][0]) != 0)
        add_hole(part, loops[l]);
    if (cage.size() == 0)
      cage = std::move(part);
    else
      add_part(cage, part);
  }
  return cage;
}

}  // namespace

Cage cage_of_svg(const std::string& text, const std::string& name, double height, PathUse use,
                 const Cage* rest) {
  static constexpr const char* kIds[] = {"rest", "pose", "outline"};
  const pugi::xml_document document = xml_of(text, name);
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
  auto loops = loops_of(path.attribute("d").as_string(), name, use == PathUse::pose);
  if (use == PathUse::outline && loops.size() > 1)
    throw Error(ErrorKind::bad_input,
                name + ": the path has several subpaths; an outline is one closed loop");
  constexpr size_t kMost = kMaxHoles + kMaxParts;
  if (loops.size() > kMost)
    throw Error(ErrorKind::bad_input, name + ": the path has " + std::to_string(loops.size()) +
                                          " subpaths; at most " + std::to_string(kMost) +
                                          " are allowed");
  for (auto& loop : loops)
    for (Points& segment : loop)
      for (Complex& z : segment) z = {z.real(), height - z.imag()};
  Cage cage = rest && rest->loops().count() == static_cast<Index>(loops.size())
                  ? cage_like(*rest, loops)
                  : nested_cage(std::move(loops));
  if (cage.size() > static_cast<Index>(kMaxSegments))
    throw Error(ErrorKind::bad_input, name + ": the path has " + std::to_string(cage.size()) +
                                          " segments; at most 5000 are allowed");
  for (Index l = 0; l < cage.loops().count(); ++l)
    if (const Index length = cage.loops().length(l); length < 3 && use != PathUse::outline)
      throw Error(ErrorKind::bad_input,
                  name + ": " + (cage.loops().count() > 1 ? "a subpath has " : "the path has ") +
                      std::to_string(length) +
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
    const Box page = image->page();
    height = page.top;
    for (const Complex& corner : page.corners()) box.include(corner);
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
