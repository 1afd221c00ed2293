// A vertex is smooth if its tangents point in opposite directions. There is no separate flag that
// could contradict them.
#include "edit/edits/curve_edits.h"

#include <algorithm>

#include "edit/edits/rest_edits.h"

namespace holomorph {
namespace {

constexpr double kInLine = 0.02;  ///< sine of the angle between opposite tangents

Cage& cage_of(Deformation& deformation, EditMode mode) {
  return mode == EditMode::rest ? deformation.rest : deformation.pose;
}

void set_controls(Cage& cage, Index segment, Points controls) {
  controls.pop_back();
  cage.segments[segment] = std::move(controls);
}

void raise_to(Cage& cage, Index segment, int degree) {
  if (cage.degree(segment) < degree)
    set_controls(cage, segment, elevated(cage.controls(segment), degree));
}

}  // namespace

Tangents tangents_of(const Deformation& deformation, Index vertex, EditMode mode) {
  const Cage& cage = cage_of(deformation, mode);
  const Index before = cage.before(vertex);
  Tangents tangents;
  if (cage.degree(before) > 1)
    tangents.before = Handle{Handle::Kind::cage, before, cage.degree(before) - 1};
  if (cage.degree(vertex) > 1) tangents.after = Handle{Handle::Kind::cage, vertex, 1};
  return tangents;
}

bool is_smooth(const Deformation& deformation, Index vertex, EditMode mode) {
  const auto [before, after] = tangents_of(deformation, vertex, mode);
  if (!before || !after) return false;
  const Complex z = cage_of(deformation, mode).vertex(vertex);
  const Complex in = position_of(deformation, *before, mode) - z,
                out = position_of(deformation, *after, mode) - z;
  return dot(in, out) < 0 && std::abs(cross(in, out)) <= kInLine * std::abs(in) * std::abs(out);
}

namespace {

void move_tangent(Deformation& deformation, Handle tangent, Complex to, EditMode mode,
                  bool breaks) {
  const Cage& cage = cage_of(deformation, mode);
  std::vector<std::pair<Index, Handle>> opposite;  // a vertex and its opposite tangent
  for (const Index vertex : {tangent.index, cage.next(tangent.index)}) {
    if (breaks || !is_smooth(deformation, vertex, mode)) continue;
    const auto [before, after] = tangents_of(deformation, vertex, mode);
    if (*before == tangent) opposite.push_back({vertex, *after});
    if (*after == tangent) opposite.push_back({vertex, *before});
  }
  Cage& moved = cage_of(deformation, mode);
  moved.segments[tangent.index][tangent.control] = to;
  for (const auto& [vertex, other] : opposite) {
    const Complex z = moved.vertex(vertex), arm = to - z;
    Complex& position = moved.segments[other.index][other.control];
    if (std::abs(arm) > 0) position = z - arm * (std::abs(position - z) / std::abs(arm));
  }
}

}  // namespace

Deformation tangent_moved(Deformation deformation, Handle tangent, Complex to, EditMode mode,
                          bool breaks) {
  return edited_in(mode, std::move(deformation),
                   [&](Deformation& edited) { move_tangent(edited, tangent, to, mode, breaks); });
}

namespace {

void smooth_vertex(Deformation& deformation, Index vertex, EditMode mode) {
  Cage& cage = cage_of(deformation, mode);
  const Index before = cage.before(vertex);
  raise_to(cage, before, 3);
  raise_to(cage, vertex, 3);
  const Complex z = cage.vertex(vertex), last = cage.vertex(before), next = cage.end_vertex(vertex);
  if (std::abs(next - last) == 0) return;
  const Complex along = (next - last) / std::abs(next - last);
  cage.segments[before].back() = z - along * (std::abs(z - last) / 3);
  cage.segments[vertex][1] = z + along * (std::abs(next - z) / 3);
}

void corner_vertex(Deformation& deformation, Index vertex, EditMode mode) {
  Cage& cage = cage_of(deformation, mode);
  const Index before = cage.before(vertex);
  const Complex z = cage.vertex(vertex);
  for (const Index e : {before, vertex})  // the two ends of a quadratic share one tangent handle
    if (cage.degree(e) == 2) raise_to(cage, e, 3);
  if (cage.degree(before) > 2) cage.segments[before].back() = z + (cage.vertex(before) - z) / 3.0;
  if (cage.degree(vertex) > 2) cage.segments[vertex][1] = z + (cage.end_vertex(vertex) - z) / 3.0;
}

}  // namespace

Deformation smoothed(Deformation deformation, Index vertex, EditMode mode) {
  return edited_in(mode, std::move(deformation),
                   [&](Deformation& edited) { smooth_vertex(edited, vertex, mode); });
}

Deformation cornered(Deformation deformation, Index vertex, EditMode mode) {
  return edited_in(mode, std::move(deformation),
                   [&](Deformation& edited) { corner_vertex(edited, vertex, mode); });
}

Deformation toggled_corners(Deformation deformation, const Selection& selection, EditMode mode) {
  std::vector<Index> vertices;
  for (const Handle& handle : selection)
    if (handle.kind == Handle::Kind::cage && handle.control == 0) vertices.push_back(handle.index);
  const bool all_smooth = std::all_of(vertices.begin(), vertices.end(),
                                      [&](Index v) { return is_smooth(deformation, v, mode); });
  for (const Index v : vertices)
    deformation = all_smooth ? cornered(std::move(deformation), v, mode)
                             : smoothed(std::move(deformation), v, mode);
  return deformation;
}

std::set<Index> segments_of(const Deformation& deformation, const Selection& selection,
                            EditMode mode) {
  std::set<Index> segments;
  for (const Handle& handle : selection)
    if (handle.kind == Handle::Kind::cage && exists(deformation, handle, mode))
      segments.insert(handle.index);
  if (segments.empty())
    for (Index e = 0; e < cage_of(deformation, mode).size(); ++e) segments.insert(e);
  return segments;
}

Deformation raised(Deformation deformation, const Selection& selection, EditMode mode) {
  const std::set<Index> segments = segments_of(deformation, selection, mode);
  return edited_in(mode, std::move(deformation), [&](Deformation& edited) {
    Cage& cage = cage_of(edited, mode);
    for (const Index e : segments) raise_to(cage, e, std::min(cage.degree(e) + 1, kHighestDegree));
  });
}

namespace {

/// Fits a curve of lower degree to a segment.
void lower_degree(Cage& cage, Index segment) {
  if (cage.degree(segment) == 1) return;
  const Points controls = cage.controls(segment);
  constexpr int kSamples = 48;
  Points samples;
  std::vector<double> parameters;
  for (int k = 0; k <= kSamples; ++k) {
    parameters.push_back(static_cast<double>(k) / kSamples);
    samples.push_back(bezier_point(controls, parameters.back()));
  }
  set_controls(cage, segment, fitted(samples, parameters, cage.degree(segment) - 1));
}

}  // namespace

Deformation lowered(Deformation deformation, const Selection& selection, EditMode mode) {
  const std::set<Index> segments = segments_of(deformation, selection, mode);
  return edited_in(mode, std::move(deformation), [&](Deformation& edited) {
    for (const Index e : segments) lower_degree(cage_of(edited, mode), e);
  });
}

}  // namespace holomorph
