// One function for each kind of field.
#include "core/methods/check_rest.h"

#include <algorithm>

#include "core/error.h"
#include "core/polyline.h"

namespace holomorph {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorKind::bad_input, what);
}

void check_finite(const Points& points, const char* what) {
  if (!std::ranges::all_of(points, is_finite)) refuse(std::string(what) + " is not finite");
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
    refuse("the mesh has no triangles, or no boundary");
  check_finite(mesh.vertices, "a vertex of the mesh");
  if (!std::ranges::all_of(mesh.triangles, known) || !known(mesh.boundary) ||
      !known(mesh.cage_vertices))
    refuse("the mesh names vertices that it does not have");
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
      refuse("the mesh is not one of this cage: " + point_text(corner) +
             " is not one of its vertices");
  if (mesh.cage_vertices.size() != corners.size())
    refuse("the mesh is not one of this cage: it has another number of cage vertices");
}

void check_parameter(const ParameterSpec& spec, const Parameters& values) {
  const auto found = values.find(spec.key);
  if (found == values.end()) return;
  const double value = found->second;
  const std::string name = "parameter " + spec.key;
  if (!std::isfinite(value)) refuse(name + " is not finite");
  if (spec.kind == ParameterSpec::Kind::number && !(value >= spec.lowest && value <= spec.highest))
    refuse(name + " is outside its range");
  if (spec.kind == ParameterSpec::Kind::choice &&
      !(value >= 0 && value < static_cast<double>(spec.options.size())))
    refuse(name + " is not one of its options");
}

void check_corners(const std::vector<Index>& corners, const Cage& cage) {
  if (!std::ranges::is_sorted(corners) || std::ranges::adjacent_find(corners) != corners.end() ||
      (!corners.empty() && (corners.front() < 0 || corners.back() >= cage.size())))
    refuse("corners must be vertices of the cage, each once and in order");
}

}  // namespace

void check_rest(const Method& method, const Rest& rest) {
  check_rest_cage(rest.cage);
  check_finite(rest.samples, "a sample");
  check_finite(rest.derivative_samples, "a derivative sample");
  if (!rest.derivative_samples.empty() && rest.derivative_samples.size() != rest.samples.size())
    refuse("there must be as many derivative samples as samples, or none");
  for (const RestPin& pin : rest.pins)
    if (!is_finite(pin.position)) refuse("a pin is not finite");
  for (const Points& stroke : rest.strokes) {
    if (stroke.empty()) refuse("a stroke has no points");
    check_stroke(stroke);
  }
  check_finite(rest.outline, "a point of the outline");
  check_corners(rest.corners, rest.cage);
  for (const Dab& dab : rest.stiffness)
    if (!is_finite(dab.at) || !std::isfinite(dab.level) || !(dab.radius > 0) ||
        !std::isfinite(dab.radius))
      refuse("a touch of the stiffness brush is not finite, or its radius not positive");
  for (const ParameterSpec& spec : method.parameters) check_parameter(spec, rest.parameters);
  if (method.needs_mesh && !rest.mesh)
    refuse("method " + method.id + " needs the domain's triangles: the rest has no mesh");
  if (rest.mesh) check_mesh(*rest.mesh, rest.cage);
}

}  // namespace holomorph
