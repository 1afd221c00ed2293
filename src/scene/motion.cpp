// The deformer computes the maps at keys. Maps between keys are interpolated from the shapes of the
// keys.
#include "scene/motion.h"

#include <algorithm>

#include "core/arithmetic.h"
#include "core/maps/distortion.h"
#include "core/maps/mesh_point_map.h"
#include "scene/budget.h"
#include "scene/keyframes.h"

namespace holomorph {
namespace {

constexpr double kTie = 1e-3;

/// The progress of the motion, 0 to 1, at the fraction u of the time between two keys.
double eased(Ease ease, double u) {
  return ease == Ease::smooth ? smoothstep(u) : u;
}

/// The expected rotation of the picture from one pose to another, including whole turns. It is the
/// rotation of the first pin with an angle, or else of the first pin with known turns. If two pins
/// or more stay, the first of them turns as little as possible. Otherwise, it is the average
/// rotation of the corners.
ExpectedTurn expected_rotation(const Deformation& deformation, const Pose& from, const Pose& to,
                               int turns) {
  ExpectedTurn expected;
  // Using slightly less than whole turns selects the smaller of two equally close rotations.
  expected.radians = 2 * kPi * turns * (1 - kTie);
  const Method& method = method_named(deformation.method);
  if (method.uses_pins) {
    const auto rotated_by = [&](size_t i, double radians) {
      expected.at = deformation.pins[i].rest;
      expected.radians += radians;
      return expected;
    };
    for (size_t i = 0; i < deformation.pins.size(); ++i)
      if (deformation.pins[i].angle) return rotated_by(i, to.pins[i].angle - from.pins[i].angle);
    for (size_t i = 0; i < deformation.pins.size(); ++i)
      if (from.pins[i].turn && to.pins[i].turn)
        return rotated_by(i, *to.pins[i].turn - *from.pins[i].turn);
    std::vector<size_t> still;
    for (size_t i = 0; i < deformation.pins.size(); ++i)
      if (from.pins[i].position == to.pins[i].position) still.push_back(i);
    if (still.size() > 1) return rotated_by(still.front(), 0);
  }
  if (!method.uses_corners || deformation.corners.empty()) return expected;
  const auto turned = [](const Pose& pose) {
    double sum = 0;
    for (const PoseCorner& corner : pose.corners) sum += 0.5 * (corner.before + corner.after);
    return sum;
  };
  expected.radians += (turned(to) - turned(from)) / static_cast<double>(deformation.corners.size());
  return expected;
}

/// The control points of a rest segment, elevated to a degree. If the segment has a higher degree,
/// returns points along the curve instead.
Points rest_controls(const Cage& rest, Index segment, int degree) {
  const Points controls = rest.controls(segment);
  if (static_cast<int>(controls.size()) - 1 <= degree) return elevated(controls, degree);
  Points along;
  for (int m = 0; m <= degree; ++m)
    along.push_back(bezier_point(controls, static_cast<double>(m) / degree));
  return along;
}

}  // namespace

SampledMap blended_map(const Mesh& mesh, VectorXc f, bool derivatives) {
  SampledMap map;
  map.f = std::move(f);
  if (!derivatives) return map;
  VertexDerivatives slopes = vertex_derivatives(mesh, map.f);
  map.fz = std::move(slopes.fz);
  map.fzbar = std::move(slopes.fzbar);
  return map;
}

size_t Motion::unknown(const Deformation& deformation,
                       const std::shared_ptr<PreparedMap>& prepared) const {
  const std::vector<size_t> playing = playing_keys(deformation);
  if (prepared != prepared_) return playing.size();
  const auto is_known = [](const Key& key, const Pose& pose) {
    return key.f.size() > 0 && key.pose == pose;
  };
  size_t count = 0;
  for (size_t k = 0; k < playing.size(); ++k) {
    const Pose& pose = deformation.keyframes[playing[k]].pose;
    const bool at_same_place = k < keys_.size() && is_known(keys_[k], pose);  // the usual case
    count += !at_same_place &&
             std::ranges::none_of(keys_, [&](const Key& key) { return is_known(key, pose); });
  }
  return count;
}

/// Updates the list of keys. Known maps are kept.
void Motion::list_keys(const Deformation& deformation, bool linear_blend,
                       std::shared_ptr<PreparedMap> prepared) {
  bool changed = linear_blend_ != linear_blend || prepared != prepared_;
  linear_blend_ = linear_blend;
  if (prepared != prepared_) {
    if (!between_ || &between_->mesh() != prepared->mesh.get()) {
      between_ = inbetween_of(*prepared);
      locations_.clear();
    }
    prepared_ = std::move(prepared);
    keys_.clear();
    invalid_.clear();
  }
  error_.reset();
  std::vector<size_t> playing = playing_keys(deformation);
  std::erase_if(playing, [&](size_t i) {
    const Pose& pose = deformation.keyframes[i].pose;
    const auto found = std::ranges::find(invalid_, pose, &std::pair<Pose, Error>::first);
    if (found != invalid_.end() && !error_) error_ = found->second;
    return found != invalid_.end();
  });
  check_budget(
      &Budget::operators,
      static_cast<double>(playing.size() * prepared_->mesh->vertices.size() * sizeof(Complex)),
      "the maps at " + std::to_string(playing.size()) + " keyframes need");
  const auto is_listed = [&](size_t i, const Key& key) {
    const Keyframe& frame = deformation.keyframes[i];
    return frame.time == key.time && frame.ease == key.ease && frame.turns == key.turns &&
           frame.pose == key.pose;
  };
  changed = changed || !std::ranges::equal(playing, keys_, is_listed);
  if (!changed) return;
  std::vector<Key> keys;
  for (const size_t i : playing) {
    const Keyframe& frame = deformation.keyframes[i];
    const auto known = std::ranges::find(keys_, frame.pose, &Key::pose);
    keys.push_back(known != keys_.end() ? *known : Key{.pose = frame.pose});
    keys.back().time = frame.time;
    keys.back().ease = frame.ease;
    keys.back().turns = frame.turns;
  }
  keys_ = std::move(keys);
  count_turns(deformation);
}

/// Determines how far the picture is expected to turn from key to key, and forgets all intervals.
void Motion::count_turns(const Deformation& deformation) {
  for (size_t i = 1; i < keys_.size(); ++i)
    keys_[i].turn_before =
        expected_rotation(deformation, keys_[i - 1].pose, keys_[i].pose, keys_[i].turns);
  proved_ = keys_.size() > 1 ? prepared_->deformer->motion() : nullptr;
  shapes_.clear();
  blend_.reset();
  interval_.reset();
}

/// Computes the map at a key, unless it is known. Throws Error and Stopped.
void Motion::find_map(Key& key, const Deformation& deformation, const std::stop_token& stop) const {
  if (key.f.size() > 0) return;
  for (const Key& other : keys_)
    if (other.f.size() > 0 && other.pose == key.pose) {
      key.f = other.f;
      key.solution = other.solution;
      key.extremes = other.extremes;
      key.note = other.note;
      key.has_turns = other.has_turns;
      return;
    }
  throw_if_stopped(stop);
  EvalOptions options;
  options.stop = stop;
  try {
    SampledMap map = prepared_->deformer->deform(pose_of(posed_as(deformation, key.pose)), options);
    key.f = std::move(map.f);
    key.has_turns = !map.turns.empty();
    if (map.status != SampledMap::Status::certified || !map.extremes) return;
    key.extremes = map.extremes;
    key.solution = std::move(map.solution);
    key.note = std::move(map.note);
  } catch (const Error& error) {
    char when[48];
    std::snprintf(when, sizeof when, "the keyframe at %.2f s: ", key.time);
    throw Error(error.kind(), when + std::string(error.what()), error.where());
  }
}

void Motion::follow(const Deformation& deformation, bool linear_blend,
                    std::shared_ptr<PreparedMap> prepared, const std::stop_token& stop) {
  list_keys(deformation, linear_blend, std::move(prepared));
  stopped_ = true;
  for (size_t i = 0; i < keys_.size();) {
    try {
      find_map(keys_[i], deformation, stop);
      ++i;
    } catch (const Error& error) {
      if (!error_) error_ = error;
      invalid_.emplace_back(keys_[i].pose, error);
      keys_.erase(keys_.begin() + static_cast<std::ptrdiff_t>(i));
      count_turns(deformation);
    }
  }
  stopped_ = false;
}

void Motion::follow_at(double time, const Deformation& deformation, bool linear_blend,
                       std::shared_ptr<PreparedMap> prepared) {
  list_keys(deformation, linear_blend, std::move(prepared));
  stopped_ = false;
  if (keys_.empty()) return;
  const auto [i, u] = position_of(time);
  size_t first = i, last = i;
  if (u > 0) {
    first = passes(i) ? i - 1 : i;
    last = passes(i + 1) ? i + 2 : i + 1;
  }
  for (size_t k = first; k <= last; ++k) find_map(keys_[k], deformation, {});
}

const Inbetween::Shape& Motion::shape_at(size_t key) {
  constexpr size_t kKept = 12;
  const auto known = shapes_.find(key);
  if (known != shapes_.end()) return known->second;
  if (shapes_.size() >= kKept) {  // drop the shape farthest from the requested key
    const auto first = shapes_.begin(), last = std::prev(shapes_.end());
    const auto from = [&](size_t k) { return k > key ? k - key : key - k; };
    shapes_.erase(from(first->first) > from(last->first) ? first : last);
  }
  return shapes_.emplace(key, between_->shape_of(keys_[key].f)).first->second;
}

/// The shape at a key, with the whole turns that the picture makes since the key before it.
Inbetween::Shape Motion::shape_after(const Inbetween::Shape& before, size_t key) {
  return between_->shape_after(before, shape_at(key), keys_[key].turn_before);
}

/// The shape at a key, with the whole turns that the picture makes until the key after it.
Inbetween::Shape Motion::shape_before(const Inbetween::Shape& after, size_t key) {
  ExpectedTurn back = keys_[key + 1].turn_before;
  back.radians = -back.radians;
  return between_->shape_after(after, shape_at(key), back);
}

/// The average rotation from a key to the next one.
double Motion::rotation_after(size_t key) {
  const Inbetween::Shape from = shape_at(key);
  return (shape_after(from, key + 1).logarithm - from.logarithm).imag().mean();
}

/// Whether smooth motion passes through a key without stopping.
bool Motion::passes(size_t key) const {
  return key > 0 && key + 1 < keys_.size() && keys_[key - 1].ease == Ease::smooth &&
         keys_[key].ease == Ease::smooth;
}

/// Whole turns are counted from the first key of the interval, so that its maps do not depend on
/// keys farther away, not even in their rounding errors.
const Motion::Blend& Motion::blend_from(size_t key) {
  if (blend_ && blend_->from == key) return *blend_;
  Blend blend;
  blend.from = key;
  blend.at_from = shape_at(key);
  blend.at_to = shape_after(blend.at_from, key + 1);
  blend.still = least_moving_point(between_->mesh(), blend.at_from.f, blend.at_to.f);
  if (keys_[key].ease == Ease::smooth) {
    const auto time_after = [&](size_t k) { return keys_[k + 1].time - keys_[k].time; };
    std::optional<Inbetween::Shape> before, after;
    if (passes(key)) before = shape_before(blend.at_from, key - 1);
    if (passes(key + 1)) after = shape_after(blend.at_to, key + 2);
    blend.slope_from = between_->slopes(before ? &*before : nullptr, blend.at_from, &blend.at_to,
                                        before ? time_after(key - 1) : 0, time_after(key));
    blend.slope_to = between_->slopes(&blend.at_from, blend.at_to, after ? &*after : nullptr,
                                      time_after(key), after ? time_after(key + 1) : 0);
  }
  blend_ = std::move(blend);
  return *blend_;
}

Motion::TimePosition Motion::position_of(double time) const {
  const auto next = std::ranges::upper_bound(keys_, time, {}, &Key::time);
  if (next == keys_.begin()) return {0, 0};
  const size_t from = static_cast<size_t>(next - keys_.begin()) - 1;
  if (next == keys_.end() || keys_[from].ease == Ease::hold) return {from, 0};
  return {from, (time - keys_[from].time) / (next->time - keys_[from].time)};
}

const VectorXc* Motion::neighboring_key(double time, bool later) const {
  constexpr double kHere = 1e-3;
  const VectorXc* found = nullptr;
  for (const Key& key : keys_) {
    if (!later && key.time < time - kHere) found = &key.f;
    if (later && key.time > time + kHere) return &key.f;
  }
  return later ? nullptr : found;
}

const Pose* Motion::pose_at(double time) {
  constexpr double kHere = 1e-9;  // seconds; the times of frames are rounded
  for (const Key& key : keys_)
    if (std::abs(key.time - time) < kHere) return &key.pose;
  const auto [i, u] = position_of(time);
  if (u == 0) return &keys_[i].pose;
  // If two successive keys have the same pose, nothing moves between them, unless a smooth motion
  // passes through them.
  constexpr double kStill = 1e-9;  // relative to the size
  const Key &from = keys_[i], &to = keys_[i + 1];
  if (!(from.pose == to.pose) || to.turns != 0) return nullptr;
  const double moved = (map_at(time) - from.f).cwiseAbs().maxCoeff();
  return moved <= kStill * box_of(between_->mesh().vertices).diagonal() ? &from.pose : nullptr;
}

std::vector<Motion::KeyInterval> Motion::key_intervals() const {
  std::vector<KeyInterval> all;
  for (size_t i = 0; i + 1 < keys_.size(); ++i)
    all.push_back({keys_[i].time, keys_[i + 1].time, keys_[i].ease == Ease::hold});
  return all;
}

double Motion::rotation_between(double from, double to) {
  if (from > to) return -rotation_between(to, from);
  const TimePosition start = position_of(from), end = position_of(to);
  const auto part = [&](const TimePosition& at) {
    return at.u == 0 ? 0 : eased(keys_[at.from].ease, at.u) * rotation_after(at.from);
  };
  double rotation = part(end) - part(start);
  for (size_t k = start.from; k < end.from; ++k) rotation += rotation_after(k);
  return rotation;
}

double Motion::rotation_beyond(double from, double to, const ExpectedTurn& expected) {
  const Inbetween::Shape start = between_->shape_of(map_at(from)),
                         end =
                             between_->shape_after(start, between_->shape_of(map_at(to)), expected);
  const VectorXd rotation = (end.logarithm - start.logarithm).imag();
  double here = rotation.mean();
  const Mesh& mesh = between_->mesh();
  if (expected.at)
    if (const auto at = locate(mesh, mesh.vertices, *expected.at)) here = rotation[at->triangle];
  return rotation_between(from, to) + here - rotation.mean() - expected.radians;
}

void preserve_turns(Deformation& deformation, const Deformation& before, Motion& motion) {
  const auto is_new = [&](const Keyframe& key) {
    return key_at(before, key.time) == before.keyframes.size();
  };
  const auto pose_at = [&](const Keyframe& key) {
    return is_new(key)
               ? whole_pose_of(motion.deformation_at(before, key.time, motion.map_at(key.time)))
               : before.keyframes[key_at(before, key.time)].pose;
  };
  const std::vector<size_t> playing = playing_keys(deformation);
  for (size_t i = 1; i < playing.size(); ++i) {
    const Keyframe& from = deformation.keyframes[playing[i - 1]];
    Keyframe& to = deformation.keyframes[playing[i]];
    if (!is_new(from) && !is_new(to)) continue;
    if (!motion.covers(from.time)) to.turns = 0;  // the picture stood still there
    if (!motion.covers(from.time) || !motion.covers(to.time)) continue;
    const double beyond = motion.rotation_beyond(
        from.time, to.time, expected_rotation(before, pose_at(from), pose_at(to), 0));
    const int turns = static_cast<int>(std::abs(beyond) / (2 * kPi) + 0.5 + kTie);
    to.turns = std::min(turns, kMaxTurns) * (beyond < 0 ? -1 : 1);
  }
}

const MotionInterval* Motion::interval_from(size_t key) {
  if (!proved_ || linear_blend_) return nullptr;
  if (interval_ && interval_->from == key) return interval_->interval.get();
  const size_t first = passes(key) ? key - 1 : key, last = passes(key + 1) ? key + 2 : key + 1;
  // Whole turns are counted from the first key of the interval, as in blend_from().
  double rotation = shape_at(key).logarithm.imag().mean();
  if (first < key) rotation -= rotation_after(first);
  std::vector<MotionKey> keys;
  std::vector<Pose> poses;  // without handles that the method does not use
  poses.reserve(last - first + 1);
  for (size_t k = first; k <= last; ++k) {
    const Key& own = keys_[k];
    poses.push_back(used_by(method_named(prepared_->method), own.pose));
    keys.push_back({own.solution, own.extremes, &poses.back(), &own.f, rotation, own.time,
                    own.turn_before.radians});
    if (k < last) rotation += rotation_after(k);
  }
  const size_t at = key - first;
  interval_ = {key, proved_->interval(first < key ? &keys[0] : nullptr, keys[at], keys[at + 1],
                                      last > key + 1 ? &keys[at + 2] : nullptr,
                                      keys_[key].ease == Ease::smooth)};
  return interval_->interval.get();
}

SampledMap Motion::sampled_at(double time, bool derivatives, bool measures) {
  const auto [i, u] = position_of(time);
  if (u > 0)
    if (const MotionInterval* interval = interval_from(i)) return interval->at(u, measures);
  SampledMap map = blended_map(between_->mesh(), map_at(time), derivatives);
  if (const Key& key = keys_[i]; u == 0 && key.extremes) {
    map.status = SampledMap::Status::certified;
    map.extremes = key.extremes;
    map.note = key.note;
  }
  return map;
}

std::unique_ptr<PointMap> Motion::point_map(const SampledMap& map) const {
  if (proved_)
    if (auto own = proved_->point_map(map)) return own;
  return std::make_unique<MeshPointMap>(prepared_->mesh, map.f);
}

VectorXc Motion::map_at(double time) {
  const auto [i, u] = position_of(time);
  const Key& from = keys_[i];
  if (u == 0) return from.f;
  if (const MotionInterval* interval = interval_from(i)) return interval->at(u, false).f;
  const Key& to = keys_[i + 1];
  if (linear_blend_) {
    const double share = eased(from.ease, u);
    return (1 - share) * from.f + share * to.f;
  }
  const auto& [key, at_from, at_to, slope_from, slope_to, still] = blend_from(i);
  VectorXc f;
  between_->blend({at_from, at_to, to.time - from.time, slope_from ? &*slope_from : nullptr,
                   slope_to ? &*slope_to : nullptr, &still},
                  u, f);
  return f;
}

Motion::LocalMap Motion::local_map_at(Complex rest, const VectorXc& map) {
  const Mesh& mesh = between_->mesh();
  const auto [known, fresh] = locations_.try_emplace({rest.real(), rest.imag()});
  if (fresh) known->second = locate_near(mesh, rest);
  const Location& at = known->second;
  const Triangle& t = mesh.triangles[static_cast<size_t>(at.triangle)];
  LocalMap frame{at.in(mesh, as_span(map)), derivatives_in(mesh, t, map).fz};
  if (std::abs(frame.fz) < 1e-9) frame.fz = 1e-9;
  return frame;
}

/// Sets the turns of pins that have none to the rotation of the picture there. Otherwise, a pin
/// whose fixed rotation is beyond half a turn would twist the picture against them.
void Motion::add_turns(const Deformation& deformation, const VectorXc& map, Pose& pose) const {
  const auto fixed =
      std::ranges::find_if(deformation.pins, [](const Pin& pin) { return pin.angle.has_value(); });
  if (fixed == deformation.pins.end()) return;
  const Mesh& mesh = between_->mesh();
  const Inbetween::Shape shape = between_->shape_of(map);
  std::vector<double> rotations;
  for (const Pin& pin : deformation.pins)
    rotations.push_back(shape.logarithm[locate_near(mesh, pin.rest).triangle].imag());
  const auto first = static_cast<size_t>(fixed - deformation.pins.begin());
  const double whole =
      2 * kPi * std::round((pose.pins[first].angle - rotations[first]) / (2 * kPi));
  for (size_t p = 0; p < pose.pins.size(); ++p)
    if (!pose.pins[p].turn) pose.pins[p].turn = rotations[p] + whole;
}

Deformation Motion::deformation_at(const Deformation& deformation, double time,
                                   const VectorXc& map) {
  const auto [i, u] = position_of(time);
  const Key& a = keys_[i];
  if (u == 0) return posed_as(deformation, a.pose);
  const Key& b = keys_[i + 1];
  const double s = eased(a.ease, u);
  // Angles are those of the picture, but not wound up: whole turns are counted by the keys.
  const double turned = 2 * kPi * std::remainder(b.turns * s, 1.0);
  // A handle with the same position at both keys stays there, exactly, unless the picture makes
  // whole turns around another point. Other handles follow the picture.
  const double rounding = 1e-6 * box_of(between_->mesh().vertices).diagonal();
  const auto carried = [&](Complex rest, Complex at_a, Complex at_b) {
    if (at_a == at_b && b.turns == 0) return at_a;
    const LocalMap now = local_map_at(rest, map), before = local_map_at(rest, a.f),
                   after = local_map_at(rest, b.f);
    const Complex place = now.f + now.fz * ((1 - s) * (at_a - before.f) / before.fz +
                                            s * (at_b - after.f) / after.fz);
    return at_a == at_b && std::abs(place - at_a) <= rounding ? at_a : place;
  };
  Pose pose = a.pose;
  for (Index e = 0; e < deformation.rest.size(); ++e) {
    const int degree = std::max(a.pose.cage.degree(e), b.pose.cage.degree(e));
    const Points rest = rest_controls(deformation.rest, e, degree),
                 from = elevated(a.pose.cage.controls(e), degree),
                 to = elevated(b.pose.cage.controls(e), degree);
    Points& segment = pose.cage.segments[static_cast<size_t>(e)];
    segment.resize(static_cast<size_t>(degree));
    // If the cage prescribes only directions, the picture's boundary does not follow the cage.
    for (size_t m = 0; m < segment.size(); ++m)
      segment[m] = method_named(deformation.method).uses_corners ? (1 - s) * from[m] + s * to[m]
                                                                 : carried(rest[m], from[m], to[m]);
  }
  for (size_t p = 0; p < pose.pins.size(); ++p) {
    const PosePin &from = a.pose.pins[p], &to = b.pose.pins[p];
    pose.pins[p] = {carried(deformation.pins[p].rest, from.position, to.position),
                    (1 - s) * from.angle + s * to.angle + turned,
                    std::pow(from.scale, 1 - s) * std::pow(to.scale, s),
                    {}};
    if (from.turn && to.turn) pose.pins[p].turn = (1 - s) * *from.turn + s * *to.turn + turned;
  }
  if (a.has_turns && b.turns != 0) add_turns(deformation, map, pose);
  for (size_t k = 0; k < pose.strokes.size(); ++k) {
    const Points &from = a.pose.strokes[k], &to = b.pose.strokes[k],
                 &rest = deformation.strokes[k].rest;
    if (from.size() != to.size()) {  // redrawn: the points do not correspond
      pose.strokes[k] = s < 0.5 ? from : to;
      continue;
    }
    for (size_t m = 0; m < from.size(); ++m)
      pose.strokes[k][m] = from.size() == rest.size() ? carried(rest[m], from[m], to[m])
                                                      : (1 - s) * from[m] + s * to[m];
  }
  const auto corner = [](const Pose& of, size_t c) {
    return of.corners.empty() ? PoseCorner{} : of.corners[c];
  };
  pose.corners.resize(deformation.corners.size());
  for (size_t c = 0; c < pose.corners.size(); ++c) {
    const PoseCorner from = corner(a.pose, c), to = corner(b.pose, c);
    pose.corners[c] = {(1 - s) * from.before + s * to.before + turned,
                       (1 - s) * from.after + s * to.after + turned,
                       (1 - s) * from.tension + s * to.tension};
  }
  return posed_as(deformation, pose);
}

}  // namespace holomorph
