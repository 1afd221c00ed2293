#include "core/methods/sheet_handles.h"

#include <algorithm>
#include <cmath>

#include "core/maps/held_disk.h"
#include "core/methods/handles.h"
#include "core/sheet/smooth_map.h"

namespace holomorph {
namespace {

/// The pulls of all of a disk and of all of the cage, in units of a pin's.
constexpr double kDiskPull = 10, kCagePull = 100;

}  // namespace

SheetHandles::SheetHandles(const Rest& rest, const SheetDomain& domain, double weight)
    : handles_(rest, {}),
      mesh_(domain.mesh),
      domain_(domain),
      weight_(weight / (domain.size * domain.size)) {
  const IsometricHandles& all = handles_.isometric();
  for (size_t i = 0; i < all.stations.size(); ++i) {
    const Location at = domain.locator.near(all.stations[i]);
    if (i < handles_.pins().size()) places_.push_back(at);
    const double pull = handles_.moves_cage() ? kCagePull : 1;
    holds_.rows.push_back({smooth_row(*mesh_, domain.gradients, at),
                           pull * weight_ * all.weights[static_cast<Index>(i)]});
  }
  for (size_t row = 0; row < pins().size(); ++row) {
    guides_.push_back(disk_of(rest, row));
    if (rest.pins[pins()[row]].has_frame) framed_.push_back(row);
  }
  if (rest.frame != Frame::free) add_frame(rest);
  if (rest.held_beyond && !pins().empty()) hold_beyond(*rest.held_beyond);
}

/// Half of a limb's half width, so that a ring on a head turns the head, and the neck bends.
double SheetHandles::usual_radius(Complex pin) const {
  constexpr double kPart = 0.5, kMost = 0.08;  // of the half width and of the size
  return std::min(kPart * domain_.width.at(pin), kMost * domain_.size);
}

/// Vertices count by the area around them, and at the edge of the disk only in part, so that the
/// pull hardly depends on the mesh.
SheetHandles::Disk SheetHandles::disk_of(const Rest& rest, size_t row) const {
  const RestPin& pin = rest.pins[pins()[row]];
  const Complex center = pin.position;
  const Location at = domain_.locator.near(center);
  const Triangle& own = mesh_->triangles[static_cast<size_t>(at.triangle)];
  const double edge = std::sqrt(2 * area_of(*mesh_, own)),
               radius = pin.radius.value_or(usual_radius(center));
  std::map<int, double> shares;
  for (const Triangle& t : mesh_->triangles)
    for (const int v : t) {
      const double distance = std::abs(mesh_->vertices[static_cast<size_t>(v)] - center);
      const double share = std::clamp((radius - distance) / edge + 0.5, 0.0, 1.0);
      if (share > 0) shares[v] += share * area_of(*mesh_, t);
    }
  // A disk that reaches over a gap does not hold what is behind it.
  constexpr double kAlmost = 0.999;  // of the way: vertices may lie on the outline
  const Polygon outline = outline_of(rest.cage);
  std::erase_if(shares, [&](const auto& each) {
    const Complex way = mesh_->vertices[static_cast<size_t>(each.first)] - center;
    return !sees(outline, center, center + kAlmost * way);
  });
  for (const int v : own)  // a disk smaller than a triangle
    shares.try_emplace(v, 1e-3 * area_of(*mesh_, own));
  double all = 0;
  for (const auto& [v, share] : shares) all += share;
  Disk disk;
  for (const auto& [v, share] : shares) disk.emplace_back(v, kDiskPull * weight_ * share / all);
  return disk;
}

void SheetHandles::add_frame(const Rest& rest) {
  holds_.fixed.resize(mesh_->vertices.size());
  const auto at = [&](int v) { return mesh_->vertices[static_cast<size_t>(v)]; };
  const Loops loops = mesh_->boundary_loops();
  for (Index i = loops.first(0); i < loops.end(0); ++i) {
    const int v = mesh_->boundary[static_cast<size_t>(i)];
    for (const Index next : {loops.next(i), loops.before(i)}) {
      const Complex way = at(mesh_->boundary[static_cast<size_t>(next)]) - at(v);
      const bool slides = rest.frame == Frame::slide;
      auto& [x, y] = holds_.fixed[static_cast<size_t>(v)];
      x = x || !slides || way.imag() != 0;
      y = y || !slides || way.real() != 0;
    }
  }
}

void SheetHandles::hold_beyond(double radius) {
  holds_.fixed.resize(mesh_->vertices.size());
  for (size_t v = 0; v < mesh_->vertices.size(); ++v)
    if (std::ranges::all_of(std::span(stations()).first(pins().size()), [&](const Complex& pin) {
          return std::abs(mesh_->vertices[v] - pin) > radius;
        }))
      holds_.fixed[v] = {true, true};
}

double SheetHandles::Target::farthest() const {
  return displacements.size() == 0 ? 0 : displacements.cwiseAbs().maxCoeff();
}

double SheetHandles::Target::largest_turn() const {
  double largest = 0;
  for (const Complex& frame : frames) largest = std::max(largest, std::abs(frame.imag()));
  for (const auto& turn : turns) largest = std::max(largest, std::abs(turn.value_or(0)));
  return largest;
}

bool SheetHandles::Target::has_turns() const {
  return std::ranges::any_of(turns, [](const auto& turn) { return turn.value_or(0) != 0; });
}

SheetHandles::Target SheetHandles::target(const Pose& pose) const {
  Target target;
  target.displacements = handles_.target(pose).stations;
  for (const size_t row : framed_) {
    const PosePin& pin = pose.pins[pins()[row]];
    target.frames.emplace_back(std::log(pin.scale), pin.angle);
  }
  target.turns = handles_.turns(pose);
  return target;
}

std::optional<Similarity> SheetHandles::rigid(const Target& target) const {
  Points from = stations(), to = straight(target, 1);
  for (size_t k = 0; k < framed_.size(); ++k) {  // a second point turns with each frame
    from.push_back(stations()[framed_[k]] + domain_.size);
    to.push_back(wanted(framed_[k], target) + domain_.size * std::exp(target.frames[k]));
  }
  if (!holds_.fixed.empty() && from != to) return {};
  return rigid_motion(from, to);
}

Points SheetHandles::straight(const Target& target, double part) const {
  Points at;
  for (size_t i = 0; i < stations().size(); ++i)
    at.push_back(stations()[i] + part * target.displacements[static_cast<Index>(i)]);
  return at;
}

SheetPull SheetHandles::pull(const Target& target, Points at, double part, double guide) const {
  SheetPull pull{std::move(at)};
  const auto turn_around = [&](size_t row, Complex by, double strength) {
    for (const auto& [v, weight] : guides_[row]) {
      const Complex arm = mesh_->vertices[static_cast<size_t>(v)] - stations()[row];
      pull.vertices.push_back({v, pull.targets[row] + by * arm, strength * weight});
    }
  };
  for (size_t k = 0; k < framed_.size(); ++k)
    turn_around(framed_[k], std::exp(part * target.frames[k]), 1);
  for (size_t row = 0; guide > 0 && row < pins().size(); ++row)
    if (target.turns[row] && std::ranges::find(framed_, row) == framed_.end())
      turn_around(row, std::polar(1.0, part * *target.turns[row]), guide);
  return pull;
}

}  // namespace holomorph
