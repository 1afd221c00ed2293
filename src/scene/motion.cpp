// The deformer computes the maps at keys. Maps between keys are interpolated from the shapes of the
// keys.
#include "scene/motion.h"

#include <algorithm>

#include "core/maps/distortion.h"
#include "scene/budget.h"
#include "scene/keyframes.h"

namespace holomorph {
namespace {

constexpr double kTie = 1e-3;

/// The progress of the motion, 0 to 1, at the fraction u of the time between two keys.
double eased(Ease ease, double u) {
  return ease == Ease::smooth ? u * u * (3 - 2 * u) : u;
}

/// The expected rotation of the picture from one pose to another, including whole turns. It is the
/// rotation of the first pin with an angle, or else of the first pin with known turns, or else the
/// average rotation of the corners.
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
  size_t count = 0;
  for (size_t k = 0; k < playing.size(); ++k) {
    const Pose& pose = deformation.keyframes[playing[k]].pose;
    const bool at_same_place = k < keys_.size() && keys_[k].pose == pose;  // the usual case
    if (!at_same_place && std::ranges::find(keys_, pose, &Key::pose) == keys_.end()) ++count;
  }
  return count;
}

void Motion::follow(const Deformation& deformation, bool linear_blend,
                    std::shared_ptr<PreparedMap> prepared, const std::stop_token& stop) {
  bool changed = linear_blend_ != linear_blend || stopped_;
  linear_blend_ = linear_blend;
  if (prepared != prepared_) {
    if (!between_ || &between_->mesh() != prepared->mesh.get()) {
      between_ = inbetween_of(*prepared);
      locations_.clear();
    }
    prepared_ = prepared;
    keys_.clear();
    changed = true;
  }
  std::vector<Key> keys;
  const std::vector<size_t> playing = playing_keys(deformation);
  check_budget(
      &Budget::operators,
      static_cast<double>(playing.size() * prepared->mesh->vertices.size() * sizeof(Complex)),
      "the maps at " + std::to_string(playing.size()) + " keyframes need");
  const auto is_known = [&](size_t i, const Key& key) {
    const Keyframe& frame = deformation.keyframes[i];
    return frame.time == key.time && frame.ease == key.ease && frame.turns == key.turns &&
           frame.pose == key.pose;
  };
  if (!changed && std::ranges::equal(playing, keys_, is_known)) {
    error_.reset();
    return;
  }
  stopped_ = true;
  std::optional<Error> wrong;
  for (const size_t i : playing) {
    const Keyframe& frame = deformation.keyframes[i];
    const auto known = std::ranges::find(keys_, frame.pose, &Key::pose);
    Key key{frame.time, frame.ease, frame.turns, frame.pose, {}, {}, {}, {}};
    if (known != keys_.end()) {
      key.f = known->f;
      key.solution = known->solution;
      key.extremes = known->extremes;
      key.note = known->note;
    } else {
      try {
        throw_if_stopped(stop);
        EvalOptions options;
        options.stop = stop;
        SampledMap map =
            prepared->deformer->deform(pose_of(posed_as(deformation, frame.pose)), options);
        key.f = std::move(map.f);
        if (map.status == SampledMap::Status::certified) key.extremes = map.extremes;
        if (key.extremes) {
          key.solution = std::move(map.solution);
          key.note = std::move(map.note);
        }
      } catch (const Stopped&) {
        for (Key& found : keys)
          if (std::ranges::find(keys_, found.pose, &Key::pose) == keys_.end())
            keys_.push_back(std::move(found));
        throw;
      } catch (const Error& error) {
        char when[48];
        std::snprintf(when, sizeof when, "the keyframe at %.2f s: ", frame.time);
        if (!wrong) wrong = Error(error.kind(), when + std::string(error.what()), error.where());
        continue;
      }
    }
    keys.push_back(std::move(key));
  }
  const auto same = [](const Key& a, const Key& b) {
    return a.time == b.time && a.ease == b.ease && a.turns == b.turns && a.pose == b.pose;
  };
  stopped_ = false;
  error_ = wrong;
  if (!changed && std::ranges::equal(keys, keys_, same)) return;
  keys_ = std::move(keys);
  proved_ = keys_.size() > 1 ? prepared->deformer->motion() : nullptr;
  align(deformation);
}

/// Determines how many whole turns the picture makes from key to key.
void Motion::align(const Deformation& deformation) {
  shapes_.clear();
  slopes_.reset();
  least_moving_.reset();
  interval_.reset();
  Inbetween::Shape before;
  for (size_t i = 0; i < keys_.size(); ++i) {
    Key& key = keys_[i];
    Inbetween::Shape shape =
        i == 0 ? between_->shape_of(key.f)
               : between_->shape_of(
                     key.f, &before,
                     expected_rotation(deformation, keys_[i - 1].pose, key.pose, key.turns));
    key.whole_turns = shape.turns;
    key.turned = shape.logarithm.imag().mean();
    before = std::move(shape);
  }
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
  return shapes_.emplace(key, between_->shape_of(keys_[key].f, keys_[key].whole_turns))
      .first->second;
}

/// Whether smooth motion passes through a key without stopping.
bool Motion::passes(size_t key) const {
  return key > 0 && key + 1 < keys_.size() && keys_[key - 1].ease == Ease::smooth &&
         keys_[key].ease == Ease::smooth;
}

VectorXc Motion::slopes_at(size_t key) {
  if (!passes(key)) return between_->slopes(nullptr, shape_at(key), nullptr, 1, 1);
  return between_->slopes(&shape_at(key - 1), shape_at(key), &shape_at(key + 1),
                          keys_[key].time - keys_[key - 1].time,
                          keys_[key + 1].time - keys_[key].time);
}

const Motion::Slopes& Motion::slopes_from(size_t key) {
  if (!slopes_ || slopes_->from != key) slopes_ = Slopes{key, slopes_at(key), slopes_at(key + 1)};
  return *slopes_;
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

double Motion::rotation_at(double time) const {
  const auto [i, u] = position_of(time);
  const double from = keys_[i].turned;
  if (u == 0) return from;
  const double s = eased(keys_[i].ease, u);
  return from + s * (keys_[i + 1].turned - from);
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
    if ((!is_new(from) && !is_new(to)) || !motion.covers(from.time) || !motion.covers(to.time))
      continue;
    const double given = expected_rotation(before, pose_at(from), pose_at(to), 0).radians,
                 beyond = motion.rotation_at(to.time) - motion.rotation_at(from.time) - given;
    const int turns = static_cast<int>(std::abs(beyond) / (2 * kPi) + 0.5 + kTie);
    to.turns = std::min(turns, kMaxTurns) * (beyond < 0 ? -1 : 1);
  }
}

const MotionInterval* Motion::interval_from(size_t key) {
  if (!proved_ || linear_blend_) return nullptr;
  if (interval_ && interval_->from == key) return interval_->interval.get();
  std::vector<MotionKey> keys;
  for (size_t k = key > 0 ? key - 1 : 0; k < std::min(keys_.size(), key + 3); ++k) {
    const Key& own = keys_[k];
    keys.push_back({own.solution, own.extremes, &own.pose, &own.f, own.turned, own.time});
  }
  const size_t at = key > 0 ? 1 : 0;
  interval_ = {key, proved_->interval(passes(key) ? &keys[at - 1] : nullptr, keys[at], keys[at + 1],
                                      passes(key + 1) ? &keys[at + 2] : nullptr,
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

VectorXc Motion::map_at(double time) {
  const auto [i, u] = position_of(time);
  const Key& from = keys_[i];
  if (u == 0) return from.f;
  if (const MotionInterval* interval = interval_from(i)) return interval->at(u, false).f;
  const Key& to = keys_[i + 1];
  const bool smooth = from.ease == Ease::smooth;
  VectorXc f;
  if (linear_blend_) {
    const double share = eased(from.ease, u);
    f = (1 - share) * from.f + share * to.f;
  } else {
    const Slopes* slopes = smooth ? &slopes_from(i) : nullptr;
    if (!least_moving_ || least_moving_->first != i)
      least_moving_ = {i, least_moving_point(between_->mesh(), from.f, to.f)};
    between_->blend(
        {shape_at(i), shape_at(i + 1), to.time - from.time, slopes ? &slopes->at_from : nullptr,
         slopes ? &slopes->at_to : nullptr, &least_moving_->second},
        u, f);
  }
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

Deformation Motion::deformation_at(const Deformation& deformation, double time,
                                   const VectorXc& map) {
  const auto [i, u] = position_of(time);
  const Key& a = keys_[i];
  if (u == 0) return posed_as(deformation, a.pose);
  const Key& b = keys_[i + 1];
  const double s = eased(a.ease, u);
  // A handle with the same position at both keys stays there. Other handles follow the picture.
  const auto carried = [&](Complex rest, Complex at_a, Complex at_b) {
    if (at_a == at_b && b.turns == 0) return at_a;
    const LocalMap now = local_map_at(rest, map), before = local_map_at(rest, a.f),
                   after = local_map_at(rest, b.f);
    return now.f +
           now.fz * ((1 - s) * (at_a - before.f) / before.fz + s * (at_b - after.f) / after.fz);
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
                    (1 - s) * from.angle + s * to.angle,
                    std::pow(from.scale, 1 - s) * std::pow(to.scale, s),
                    {}};
    if (from.turn && to.turn) pose.pins[p].turn = (1 - s) * *from.turn + s * *to.turn;
  }
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
    pose.corners[c] = {(1 - s) * from.before + s * to.before, (1 - s) * from.after + s * to.after,
                       (1 - s) * from.tension + s * to.tension};
  }
  return posed_as(deformation, pose);
}

}  // namespace holomorph
