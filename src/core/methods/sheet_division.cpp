#include "core/methods/sheet_division.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/maps/acting_pins.h"
#include "core/mesh/locator.h"
#include "core/methods/puppet_handles.h"

namespace holomorph {
namespace {

/// The point of one outline that is nearest to another, and its distance.
NearestPoint nearest_between(PolygonView outline, PolygonView other) {
  NearestPoint best;
  best.distance = std::numeric_limits<double>::infinity();
  const auto offer = [&best](Complex point, double distance) {
    if (distance < best.distance) best.point = point, best.distance = distance;
  };
  for (const Complex& z : other.points()) {
    const NearestPoint near = nearest_on_polygon(outline, z);
    offer(near.point, near.distance);
  }
  for (const Complex& z : outline.points()) offer(z, nearest_on_polygon(other, z).distance);
  return best;
}

/// The distance between boxes; 0 if they overlap.
double distance_between(const Box& a, const Box& b) {
  const double x = std::max({0.0, a.left - b.right, b.left - a.right}),
               y = std::max({0.0, a.bottom - b.top, b.bottom - a.top});
  return std::hypot(x, y);
}

}  // namespace

SheetDivision::SheetDivision(const Rest& rest, const SheetDivision* previous)
    : mesh_(rest.mesh), finder_(rest.cage) {
  const size_t count = static_cast<size_t>(rest.cage.part_count());
  if (count == 1) {
    Part whole{rest, {}, {}, {}, {}};
    for (size_t i = 0; i < rest.pins.size(); ++i) whole.pins.push_back(i);
    parts_.push_back(std::move(whole));
    return;
  }
  const bool same_mesh =
      previous && previous->mesh_ == rest.mesh && previous->parts_.size() == count;
  std::vector<PartMesh> meshes;
  if (!same_mesh) meshes = parts_of(*rest.mesh, rest.cage);
  for (size_t p = 0; p < count; ++p) {
    Part part{rest, {}, {}, {}, {}};
    part.rest.cage = part_of(rest.cage, static_cast<Index>(p));
    part.rest.mesh = same_mesh ? previous->parts_[p].rest.mesh
                               : std::make_shared<const Mesh>(std::move(meshes[p].mesh));
    part.rest.pins.clear();
    part.rest.samples.clear();
    part.rest.derivative_samples.clear();
    parts_.push_back(std::move(part));
  }
  share_handles(rest);
  share_samples(rest);
  find_leaders();
}

void SheetDivision::share_handles(const Rest& rest) {
  UsablePins usable = usable_pins(rest);
  note_ = std::move(usable.note);
  for (const size_t i : usable.used) {
    Part& part = parts_[part_at(rest.pins[i].position)];
    part.rest.pins.push_back(rest.pins[i]);
    part.pins.push_back(i);
  }
  for (size_t s = 0; s < rest.strokes.size(); ++s) {
    bool acts = false;
    for (const Part& part : parts_) {
      Rest alone = part.rest;
      alone.pins.clear();
      alone.strokes = {rest.strokes[s]};
      acts = acts || !PuppetHandles(alone, {}).moves_cage();
    }
    if (!acts)
      note_ += (note_.empty() ? "Stroke " : ". Stroke ") + std::to_string(s + 1) +
               " is outside the cage and has no effect";
  }
}

void SheetDivision::share_samples(const Rest& rest) {
  std::vector<MeshLocator> locators;
  for (const Part& part : parts_) locators.emplace_back(*part.rest.mesh);
  for (size_t i = 0; i < rest.samples.size(); ++i) {
    const Complex z = rest.samples[i];
    size_t p = 0;
    while (p < parts_.size() && !locators[p].at(z)) ++p;
    if (p == parts_.size()) p = part_at(z);  // just outside a mesh
    parts_[p].rest.samples.push_back(z);
    parts_[p].samples.push_back(static_cast<Index>(i));
  }
}

/// The loose part that is nearest to an attached one is attached first, and the others follow in
/// that order, as in Prim's algorithm. What is next to another loose part thus moves like that one,
/// such as the dot of an i like its stem.
void SheetDivision::find_leaders() {
  std::vector<size_t> attached, loose;
  for (size_t p = 0; p < parts_.size(); ++p)
    (PuppetHandles(parts_[p].rest, {}).moves_cage() ? loose : attached).push_back(p);
  if (attached.empty()) return;
  struct Link {
    size_t to = 0;
    NearestPoint nearest{0, 0, {}, std::numeric_limits<double>::infinity()};
  };
  std::vector<Link> links(parts_.size());  // from each loose part to the nearest attached one
  const auto offer = [&](size_t to) {
    for (const size_t p : loose) {
      const FlatCage &theirs = finder_.outline(static_cast<Index>(to)),
                     &own = finder_.outline(static_cast<Index>(p));
      if (distance_between(box_of(theirs), box_of(own)) >= links[p].nearest.distance) continue;
      const NearestPoint nearest = nearest_between(theirs, own);
      if (nearest.distance < links[p].nearest.distance) links[p] = {to, nearest};
    }
  };
  for (const size_t p : attached) offer(p);
  while (!loose.empty()) {
    const auto next =
        std::ranges::min_element(loose, {}, [&](size_t p) { return links[p].nearest.distance; });
    const size_t p = *next;
    loose.erase(next);
    const auto& [to, nearest] = links[p];
    parts_[p].leader = parts_[to].leader;
    if (!parts_[p].leader) {
      parts_[p].leader = {to, parts_[to].anchors.size(), nearest.point};
      parts_[to].anchors.push_back(nearest.point);
    }
    offer(p);
  }
}

Pose SheetDivision::pose_of(size_t p, const Pose& pose) const {
  if (parts_.size() == 1) return pose;
  const Part& part = parts_[p];
  Pose own;
  own.cage = part_of(pose.cage, static_cast<Index>(p));
  for (const size_t pin : part.pins) own.pins.push_back(pose.pins[pin]);
  own.strokes = pose.strokes;
  return own;
}

}  // namespace holomorph
