// A pin with a frame adds the points of its disk. Their positions prescribe the pin's angle and
// scale.
#include "core/methods/handles.h"

#include "core/error.h"
#include "core/maps/held_disk.h"
#include "core/methods/linear.h"

namespace holomorph {

HandlePoints::HandlePoints(const Rest& rest) : rest_(rest) {
  check(rest.mesh != nullptr, "handle points: the rest has a mesh");
  for (size_t i = 0; i < rest.pins.size(); ++i) {
    const Index pin = static_cast<Index>(i);
    const size_t before = rest_points_.size();
    add(rest.pins[i].position, pin, 0);
    if (rest_points_.size() == before && note_.empty())
      note_ = "Ignored: pin " + std::to_string(i + 1) + " (outside the cage)";
    if (!rest.pins[i].has_frame) continue;
    const Points disk = held_disk(rest.cage, rest.pins[i]);
    for (size_t k = 1; k < disk.size(); ++k) add(disk[k], pin, disk[k] - rest.pins[i].position);
  }
  pins_ = !rest_points_.empty();
  for (Index v = 0; !pins_ && v < rest.cage.size(); ++v) add(rest.cage.vertex(v), v, 0);
}

void HandlePoints::add(Complex z, Index source, Complex arm) {
  const auto at = locate(*rest_.mesh, rest_.mesh->vertices, z);
  if (!at) return;
  rest_points_.push_back(z);
  locations_.push_back(*at);
  sources_.push_back({source, arm});
}

Points HandlePoints::targets(const Pose& pose) const {
  check_pose(rest_, pose);
  Points targets;
  for (const auto& [handle, arm] : sources_) {
    if (!pins_) {
      targets.push_back(pose.cage.vertex(handle));
      continue;
    }
    const PosePin& pin = pose.pins[static_cast<size_t>(handle)];
    targets.push_back(pin.position + arm * std::polar(pin.scale, pin.angle));
  }
  return targets;
}

std::optional<Similarity> rigid_motion(const Points& from, const Points& to) {
  if (to == from) return Similarity{1, 0, 0};
  Similarity rigid = similarity_between(from, to);
  rigid.factor /= std::abs(rigid.factor);
  double size = 0;
  for (size_t i = 0; i < to.size(); ++i)
    size = std::max({size, std::abs(from[i]), std::abs(to[i])});
  constexpr double kRounding = 1e-13;
  for (size_t i = 0; i < to.size(); ++i)
    if (std::abs(rigid(from[i]) - to[i]) > kRounding * size) return {};
  return rigid;
}

}  // namespace holomorph
