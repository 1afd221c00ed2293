// Each kind of field is checked by its own function.
#include "core/methods/check_rest.h"

#include <algorithm>
#include <cstdio>

#include "core/error.h"
#include "core/geometry/polyline.h"
#include "core/mesh/mesh.h"

namespace holomorph {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorKind::bad_input, what);
}

/// Throws an Error such as "sample 7 is (nan, 0); coordinates must be finite and at most 1e70".
void check_finite(const Points& points, const std::string& what) {
  const auto wrong = std::ranges::find_if_not(points, is_moderate);
  if (wrong != points.end())
    refuse(what + " " + std::to_string(wrong - points.begin() + 1) + " is " + point_text(*wrong) +
           "; coordinates must be finite and at most 1e70");
}

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

bool is_index(int i, size_t count) {
  return i >= 0 && static_cast<size_t>(i) < count;
}

void check_mesh(const Mesh& mesh, const Cage& cage) {
  const size_t count = mesh.vertices.size();
  const auto known = [count](const auto& list) {
    return std::ranges::all_of(list, [count](int i) { return is_index(i, count); });
  };
  if (mesh.triangles.empty() || mesh.boundary.size() < 3)
    refuse("the mesh has no triangles or no boundary");
  check_finite(mesh.vertices, "mesh vertex");
  if (!std::ranges::all_of(mesh.triangles, known) || !known(mesh.boundary) ||
      !known(mesh.cage_vertices))
    refuse("the mesh refers to vertices that it does not have");
  for (const auto& [a, b, c] : mesh.triangles)
    if (!(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]) > 0))
      refuse("a triangle of the mesh is flat or clockwise");
  std::vector<char> used(count, 0);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) used[static_cast<size_t>(v)] = 1;
  if (std::ranges::find(used, 0) != used.end())
    refuse("a vertex of the mesh belongs to no triangle");
  const Points corners = vertices_of(cage);
  for (const Complex& corner : corners)
    if (std::ranges::none_of(mesh.cage_vertices, [&](int v) { return mesh.vertices[v] == corner; }))
      refuse("the mesh does not belong to this cage: the cage vertex " + point_text(corner) +
             " is not one of its cage_vertices; make the mesh with mesh_of or domain_mesh");
  const Index loops = cage.loops().count();
  if (static_cast<Index>(mesh.starts.size()) != loops - 1 ||
      !std::ranges::is_sorted(mesh.starts, std::less_equal{}) ||
      std::ranges::any_of(mesh.starts, [&](Index first) {
        return first < 3 || first + 3 > static_cast<Index>(mesh.boundary.size());
      }))
    refuse("the mesh does not belong to this cage: its boundary must have " +
           std::to_string(loops) + " loops, each with at least three vertices");
  if (mesh.cage_vertices.size() != corners.size())
    refuse("the mesh does not belong to this cage: it has " +
           std::to_string(mesh.cage_vertices.size()) +
           " cage_vertices; the number of vertices of the cage is " +
           std::to_string(corners.size()));
}

void check_parameter(const ParameterSpec& spec, const Parameters& values) {
  const auto found = values.find(spec.key);
  if (found == values.end()) return;
  const double value = found->second;
  const std::string is = "parameter " + spec.key + " is " + number_text(value) + "; ";
  if (spec.type == ParameterSpec::Type::number && !(value >= spec.lowest && value <= spec.highest))
    refuse(is + "it must be from " + number_text(spec.lowest) + " to " + number_text(spec.highest));
  if (spec.type == ParameterSpec::Type::choice &&
      !(value >= 0 && value < static_cast<double>(spec.options.size())))
    refuse(is + "it must be the number of one of its " + std::to_string(spec.options.size()) +
           " options");
  if (!std::isfinite(value)) refuse(is + "it must be 0 or 1");
}

void check_corners(const std::vector<Index>& corners, const Cage& cage) {
  if (!std::ranges::is_sorted(corners) || std::ranges::adjacent_find(corners) != corners.end() ||
      (!corners.empty() && (corners.front() < 0 || corners.back() >= cage.size())))
    refuse("corners must be vertices of the cage, each once and in order");
}

}  // namespace

void check_rest(const Method& method, const Rest& rest) {
  check_rest_cage(rest.cage);
  check_finite(rest.samples, "sample");
  check_finite(rest.derivative_samples, "derivative sample");
  if (!rest.derivative_samples.empty() && rest.derivative_samples.size() != rest.samples.size())
    refuse("there are " + std::to_string(rest.derivative_samples.size()) +
           " derivative samples; there must be none, or as many as the " +
           std::to_string(rest.samples.size()) + " samples");
  Points pins;
  for (const RestPin& pin : rest.pins) pins.push_back(pin.position);
  check_finite(pins, "pin");
  for (const Points& stroke : rest.strokes) {
    if (stroke.empty()) refuse("a stroke has no points");
    check_stroke(stroke);
  }
  check_finite(rest.outline, "outline point");
  check_corners(rest.corners, rest.cage);
  for (const BrushDab& dab : rest.stiffness)
    if (!is_finite(dab.at) || !std::isfinite(dab.level) || !(dab.radius > 0) ||
        !std::isfinite(dab.radius))
      refuse("a dab of the stiffness brush is not finite, or its radius is not positive");
  for (const ParameterSpec& spec : method.parameters) check_parameter(spec, rest.parameters);
  for (const Method& other : methods())
    for (const ParameterSpec& spec : other.parameters)
      check_parameter(spec, parameters_of(rest, other));
  if (!method.allows_parts && !rest.cage.parts.empty())
    refuse("\"" + method.label + "\" needs a cage with one part; this one has " +
           std::to_string(rest.cage.part_count()) + "; draw one outline around all of them");
  if (!method.allows_holes && rest.cage.has_holes())
    refuse("\"" + method.label +
           "\" does not work in a cage with holes; fill the holes or choose "
           "another method");
  if (method.needs_mesh && !rest.mesh)
    refuse("method " + method.id + " needs a mesh of the cage, but the rest has no mesh");
  if (rest.mesh) check_mesh(*rest.mesh, rest.cage);
}

}  // namespace holomorph
