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

/// How much more rotation than the picture has a frame asks for, at most, in radians.
constexpr double kMostBehind = kPi / 6;

}  // namespace

SheetHandles::SheetHandles(const Rest& rest, const SheetDomain& domain, const SheetEnergy& energy,
                           const Settings& settings)
    : handles_(rest, {}), mesh_(domain.mesh), domain_(domain) {
  for (size_t row = 0; row < stations().size(); ++row) {
    const Location at = domain.locator.near(stations()[row]);
    if (row < handles_.pins().size()) places_.push_back(at);
    holds_.rows.push_back({smooth_row(*mesh_, domain.gradients, at)});
    springs_.push_back(usual_spring(rest, row, energy, settings));
  }
  for (size_t row = 0; row < pins().size(); ++row) {
    disks_.push_back(disk_of(rest, row));
    if (rest.pins[pins()[row]].has_frame) framed_.push_back(row);
  }
  for (const size_t row : framed_)
    for (const auto& [v, share] : disks_[row]) holds_.rows.push_back(arm(row, v));
  if (rest.frame != Frame::free) add_frame(rest);
  if (rest.held_beyond && !pins().empty()) hold_beyond(*rest.held_beyond);
}

/// At a distance from both sides of a limb that equals its half width h, the force F stretches the
/// limb to about F A / (2 h s) times its length, where s is the stiffness. Pins at an edge pull
/// half as hard.
Spring SheetHandles::usual_spring(const Rest& rest, size_t row, const SheetEnergy& energy,
                                  const Settings& settings) const {
  const double weight = settings.pin_weight / (domain_.size * domain_.size);
  if (moves_cage())
    return {kCagePull * weight * handles_.isometric().weights[static_cast<Index>(row)]};
  constexpr double kNarrowest = 0.05;  // of the size; a tip still turns its limb
  constexpr double kFar = 0.1;         // of the force, added where a pin misses by the size
  const Complex z = stations()[row];
  double width = std::max(domain_.width.at(z), kNarrowest * domain_.size);
  if (row < pins().size() && rest.pins[pins()[row]].has_frame)
    width = std::max(width, rest.pins[pins()[row]].radius.value_or(0));
  const double depth = nearest_on_polygon(outline_of(rest.cage), z).distance,
               force = settings.stretch_limit * (width + depth) *
                       std::pow(10, stiffness_level(rest.stiffness, z)) / energy.stiff_area();
  return {weight, 1 / force, kFar * force / (2 * domain_.size)};
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
  for (const auto& [v, share] : shares) disk.emplace_back(v, share / all);
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

std::vector<SheetRow> SheetHandles::moving_rows() const {
  return {holds_.rows.begin(), holds_.rows.begin() + static_cast<Index>(stations().size())};
}

std::optional<double> SheetHandles::turn(size_t row, const Target& target) const {
  const auto framed = std::ranges::find(framed_, row);
  if (framed == framed_.end()) return target.turns[row];
  return target.frames[static_cast<size_t>(framed - framed_.begin())].imag();
}

int SheetHandles::whole_turns(const Target& target, const std::vector<double>& rotations) const {
  if (!holds_.fixed.empty()) return 0;
  std::map<int, int> votes;
  for (size_t row = 0; row < pins().size(); ++row) {
    const double wanted = turn(row, target).value_or(rotations[row]);
    ++votes[static_cast<int>(std::round((wanted - rotations[row]) / (2 * kPi)))];
  }
  int best = 0;
  for (const auto& [turns, count] : votes) {
    const int most = votes.contains(best) ? votes.at(best) : 0;
    if (count > most || (count == most && std::abs(turns) < std::abs(best))) best = turns;
  }
  return best;
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
  for (const size_t row : framed_) target.turns[row].reset();
  return target;
}

std::optional<Similarity> SheetHandles::rigid(const Target& target) const {
  Points from = stations(), to = straight(target, 1);
  for (size_t k = 0; k < framed_.size(); ++k) {  // a second point turns with each frame
    from.push_back(stations()[framed_[k]] + domain_.size);
    to.push_back(wanted(framed_[k], target) + domain_.size * std::exp(target.frames[k]));
  }
  if (!holds_.fixed.empty() && from != to) return {};
  const std::optional<Similarity> rigid = rigid_motion(from, to);
  if (!rigid) return {};
  // A ring that has gone once around twists the picture, unless the picture goes with it.
  const double turn = std::arg(rigid->factor),
               all = turn + 2 * kPi * whole_turns(target, std::vector(pins().size(), turn));
  for (const Complex& frame : target.frames)
    if (std::abs(frame.imag() - all) > kPi) return {};
  return rigid;
}

Points SheetHandles::straight(const Target& target, double part) const {
  Points at;
  for (size_t i = 0; i < stations().size(); ++i)
    at.push_back(stations()[i] + part * target.displacements[static_cast<Index>(i)]);
  return at;
}

/// Pins that stay near rest hold more firmly than those that go far. Otherwise, a hand that is
/// pulled away would take the feet with it.
Spring SheetHandles::spring(size_t row, const Target& target) const {
  constexpr double kFirmer = 3, kNear = 0.05;  // of the size
  const double moved =
      std::abs(target.displacements[static_cast<Index>(row)]) / (kNear * domain_.size);
  Spring spring = springs_[row];
  spring.inverse_force /= 1 + kFirmer / (1 + moved);
  return spring;
}

/// The image of a vertex as seen from that of a pin.
SheetRow SheetHandles::arm(size_t row, int vertex) const {
  std::map<int, double> parts{{vertex, 1}};
  for (const auto& [v, part] : holds_.rows[row].terms) parts[v] -= part;
  return {{parts.begin(), parts.end()}};
}
Complex SheetHandles::arm_at_rest(size_t row, int vertex) const {
  return mesh_->vertices[static_cast<size_t>(vertex)] - stations()[row];
}
Spring SheetHandles::arm_spring(size_t row, double share) const {
  constexpr double kForce = 8;  // of a pin's limit; turning takes more of it than pulling
  const Spring& own = springs_[row];
  return share *
         Spring{kDiskPull * own.weight, own.inverse_force / kForce, kForce * own.far_weight};
}

bool SheetHandles::is_behind(const Target& target, const std::vector<double>& turns) const {
  for (size_t k = 0; k < framed_.size(); ++k)
    if (std::abs(target.frames[k].imag() - turns[framed_[k]]) > kMostBehind) return true;
  return false;
}

SheetPull SheetHandles::pull(const Target& target, const Points& at, double part,
                             const std::vector<double>& turns) const {
  SheetPull pull;
  for (size_t row = 0; row < at.size(); ++row) pull.rows.push_back({at[row], spring(row, target)});
  for (size_t k = 0; k < framed_.size(); ++k) {
    const size_t row = framed_[k];
    const Complex wanted = part * target.frames[k];
    const double turn =
        std::clamp(wanted.imag(), turns[row] - kMostBehind, turns[row] + kMostBehind);
    const Complex by = std::polar(std::exp(wanted.real()), turn);
    for (const auto& [v, share] : disks_[row])
      pull.rows.push_back({by * arm_at_rest(row, v), arm_spring(row, share)});
  }
  return pull;
}

void SheetHandles::add_turns(const Target& target, double part, double strength,
                             SheetPull& pull) const {
  for (size_t row = 0; row < pins().size(); ++row) {
    if (!target.turns[row] || is_framed(row)) continue;
    const Complex center = pull.rows[row].target, turn = std::polar(1.0, part * *target.turns[row]);
    for (const auto& [v, share] : disks_[row])
      pull.vertices.push_back(
          {v, center + turn * arm_at_rest(row, v), arm_spring(row, strength * share).firm()});
  }
}

}  // namespace holomorph
