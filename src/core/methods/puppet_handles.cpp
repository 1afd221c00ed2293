#include "core/methods/puppet_handles.h"

#include <numeric>

#include "core/error.h"
#include "core/geometry/orientation.h"
#include "core/geometry/polyline.h"
#include "core/maps/acting_pins.h"
#include "core/maps/held_disk.h"
#include "core/methods/linear.h"

namespace holomorph {
namespace {

void append(VectorXd& values, double value) {
  values.conservativeResize(values.size() + 1);
  values[values.size() - 1] = value;
}

}  // namespace

PuppetHandles::PuppetHandles(const Rest& rest, const Settings& settings) : rest_(rest) {
  const double size = box_of(outline_of(rest.cage).points).diagonal();
  UsablePins usable = usable_pins(rest);
  note_ = std::move(usable.note);
  for (const size_t i : usable.used) {
    add_station(rest.pins[i].position, 1);
    pins_.push_back(i);
  }
  handles_.turned = static_cast<Index>(pins_.size());
  for (const size_t i : usable.used)
    if (rest.pins[i].has_frame) add_frame(rest.pins[i], i, settings);
  add_strokes(size);
  if (handles_.stations.empty()) add_cage();
}

void PuppetHandles::add_station(Complex z, double weight) {
  handles_.stations.push_back(z);
  append(handles_.weights, weight);
}

void PuppetHandles::add_frame(const RestPin& pin, size_t index, const Settings& settings) {
  const size_t before = handles_.frames.size();
  for (const Complex& z : held_disk(rest_.cage, pin)) handles_.frames.push_back(z);
  const size_t count = handles_.frames.size() - before;
  for (size_t k = 0; k < count; ++k) {
    append(handles_.frame_weights, settings.frame_weight / static_cast<double>(count));
    framed_.push_back(index);
  }
}

void PuppetHandles::add_strokes(double size) {
  constexpr double kSpacing = 0.05;  // in units of the size
  for (size_t s = 0; s < rest_.strokes.size(); ++s) {
    const Polyline line(without_repeats(rest_.strokes[s]), false);
    const int parts = std::max(1, static_cast<int>(std::ceil(line.length() / (kSpacing * size))));
    bool clipped = false;
    const size_t before = strokes_.size();
    for (int k = 0; k <= parts; ++k) {
      const double fraction = static_cast<double>(k) / parts;
      const Complex z = line.at(fraction * line.length());
      if (!contains(rest_.cage, z)) {
        clipped = true;
        continue;
      }
      add_station(z, 1);
      strokes_.push_back({s, fraction});
    }
    if (clipped)
      note_ += (note_.empty() ? "" : ". ") + ("Stroke " + std::to_string(s + 1)) +
               (strokes_.size() == before ? " is outside the cage and has no effect"
                                          : " leaves the cage; only the part inside has an effect");
  }
}

/// Points along the cage, with half the lengths to the next ones as their weights.
void PuppetHandles::add_cage() {
  constexpr double kStations = 300;
  const Cage cage = oriented(rest_.cage);
  const std::vector<double> lengths = lengths_of(cage);
  const double all = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  for (Index e = 0; e < cage.size(); ++e) {
    const double length = lengths[static_cast<size_t>(e)],
                 before = lengths[static_cast<size_t>(cage.loops().before(e))];
    const auto parts_for = [&](double own) {
      return std::max(3.0, std::ceil(kStations * own / all));
    };
    const double parts = parts_for(length);
    for (int k = 0; k < parts; ++k) {
      const double behind = k > 0 ? length / parts : before / parts_for(before);
      add_station(bezier_point(cage.controls(e), k / parts), 0.5 * (behind + length / parts) / all);
      cage_.push_back({e, k / parts});
    }
  }
}

IsometricTarget PuppetHandles::target(const Pose& pose) const {
  check_pose(rest_, pose);
  IsometricTarget target;
  target.stations.resize(static_cast<Index>(handles_.stations.size()));
  Index row = 0;
  for (const size_t i : pins_)
    target.stations[row++] = pose.pins[i].position - rest_.pins[i].position;
  std::vector<Polyline> posed;
  for (const Points& stroke : pose.strokes) posed.emplace_back(without_repeats(stroke), false);
  for (const StrokePoint& at : strokes_) {
    const Polyline& line = posed[at.stroke];
    // At rest, the displacement must be exactly zero.
    if (pose.strokes[at.stroke] == rest_.strokes[at.stroke])
      target.stations[row] = 0;
    else
      target.stations[row] =
          line.at(at.fraction * line.length()) - handles_.stations[static_cast<size_t>(row)];
    ++row;
  }
  if (!cage_.empty()) {
    const bool rests = pose.cage == rest_.cage;
    Cage cage = elevated_to(pose.cage, rest_.cage);
    cage = Orientation(rest_.cage).turned(cage);
    for (const auto& [segment, t] : cage_) {
      target.stations[row] = rests ? Complex(0)
                                   : bezier_point(cage.controls(segment), t) -
                                         handles_.stations[static_cast<size_t>(row)];
      ++row;
    }
  }
  for (const Complex& displacement : target.stations)
    if (!is_moderate(displacement))
      throw Error(ErrorKind::bad_input,
                  "a posed handle has a coordinate that is too large (more than 1e70)");
  target.frames.resize(static_cast<Index>(framed_.size()));
  for (size_t k = 0; k < framed_.size(); ++k) {
    const PosePin& pin = pose.pins[framed_[k]];
    target.frames[static_cast<Index>(k)] = {std::log(pin.scale), pin.angle};
  }
  return target;
}

Turns PuppetHandles::turns(const Pose& pose) const {
  Turns turns;
  for (const size_t i : pins_) turns.push_back(pose.pins[i].turn);
  return turns;
}

Complex PuppetHandles::image(Index station, const IsometricTarget& target,
                             const VectorXc& offsets) const {
  return handles_.stations[static_cast<size_t>(station)] + target.stations[station] +
         offsets[station];
}

}  // namespace holomorph
