// There are no dirty flags. Inputs are compared by value, and the worker receives a request when
// they change.
//
// A deformer is used by one thread at a time: by the worker while busy_ is true or if the method
// iterates, and otherwise by the caller of update().
#include "scene/live_map.h"

#include <algorithm>
#include <utility>

#include "core/clock.h"
#include "core/maps/distortion.h"
#include "scene/keyframes.h"

namespace holomorph {
namespace {

bool iterates(const Deformation& deformation) {
  return method_named(deformation.method).iterates;
}

/// Whether two deformations have the same map. Their keyframes may differ.
bool same_map(const Deformation& a, const Deformation& b) {
  return a == b || (same_rest(a, b) && pose_of(a) == pose_of(b) && depths_of(a) == depths_of(b));
}

}  // namespace

/// Whether the deformation's animation is wanted, not its own pose.
bool LiveMap::plays(const Deformation& deformation) const {
  return moment_.time && !deformation.keyframes.empty();
}

/// Whether the map of the deformation's own pose is displayed. A map that follows a drag and has
/// other turns is not that of the pose.
bool LiveMap::displays(const Deformation& deformation, EvalOptions options) const {
  if (posed_.map.better_turns.empty()) options.released = posed_.options.released;
  return !posed_moment_.time && posed_.deformation && posed_.options == options &&
         same_map(*posed_.deformation, deformation);
}

/// Whether the maps at keyframes are unknown and computing them here would take long. Keys that
/// still lack a map after a request have no valid map and are not requested again.
bool LiveMap::needs_keys(const Deformation& deformation) const {
  constexpr double kNoticed = 50, kShape = 4;  // ms; kShape is the time for the logarithms of a key
  if (requested_ && requested_->keys && requested_->linear_blend == moment_.linear_blend &&
      requested_->deformation.keyframes == deformation.keyframes &&
      same_rest(requested_->deformation, deformation))
    return false;
  const size_t unknown = motion_.unknown(deformation, prepared_);
  if (iterates(deformation)) return unknown > 0;
  const double each = std::max(key_milliseconds_, posed_.milliseconds) + kShape;
  return static_cast<double>(unknown) * each > kNoticed;
}

bool LiveMap::needs_request(const Deformation& deformation, const EvalOptions& options) const {
  if (!requested_ || !same_rest(requested_->deformation, deformation)) return true;
  if (failed_) return false;
  if (prepared_ && plays(deformation)) {
    if (needs_keys(deformation)) return true;
    if (busy_ || motion_.plays()) return false;
  }
  if (displays(deformation, options)) return false;
  // The maps at keyframes can wait, and a pose is wanted even if they have failed.
  if (requested_->keys && !plays(deformation) && (busy_ || error_)) return true;
  if (!iterates(deformation)) return false;
  return !(requested_->options == options && same_map(requested_->deformation, deformation)) ||
         (!busy_ && !error_);
}

void LiveMap::request(MapRequest request) {
  requested_ = request;
  busy_ = true;
  failed_ = false;
  number_ = worker_.request(std::move(request));
}

void LiveMap::display(PosedMap posed) {
  posed_ = std::move(posed);
  ++revision_;
}

void LiveMap::adopt(MapAnswer answer) {
  if (answer.number == number_ && answer.complete) busy_ = false;
  error_ = std::move(answer.error);
  failed_ = !answer.prepared;
  if (failed_) return;
  if (answer.prepared != prepared_) {
    prepared_ = std::move(answer.prepared);
    display({});
    timed_.reset();
    motion_.clear();
    ++preparation_;
  }
  if (answer.motion) {
    motion_ = std::move(*answer.motion);
    key_milliseconds_ = answer.key_milliseconds;
  }
  if (!answer.posed) return;
  display(std::move(*answer.posed));
  posed_moment_ = {};
  timed_.reset();
}

bool LiveMap::update(const Deformation& deformation, EvalOptions options, const Moment& moment) {
  bool changed = false;
  moment_ = moment;
  if (std::optional<MapAnswer> answer = worker_.take()) {
    adopt(std::move(*answer));
    changed = true;
  }
  if (!deformation.has_cage()) {
    changed = changed || prepared_;
    clear();
    return changed;
  }
  if (needs_request(deformation, options))
    request({deformation, options, plays(deformation), moment.linear_blend});
  if (!prepared_ || failed_ || !same_rest(requested_->deformation, deformation)) return changed;
  const bool timed = plays(deformation);
  if (timed && !busy_ && pose_at_time(deformation, options)) return true;
  if (timed && motion_.plays()) return changed;
  if (displays(deformation, options)) {
    if (posed_.deformation != deformation) posed_.deformation = deformation;  // of other keyframes
  } else if (!busy_ && !iterates(deformation)) {
    return pose(deformation, options) || changed;
  }
  return changed;
}

bool LiveMap::pose(const Deformation& deformation, EvalOptions options) {
  try {
    display(posed_map(*prepared_, deformation, options, &posed_));
  } catch (const Error& error) {
    error_ = error;
    return false;
  }
  posed_moment_ = {};
  timed_.reset();
  error_.reset();
  return true;
}

bool LiveMap::shows_draft() const {
  return prepared_ && !timed_ && posed_.options.draft && method_named(prepared_->method).iterates;
}

bool LiveMap::pose_at_time(const Deformation& deformation, EvalOptions options) {
  if (posed_.deformation == deformation && posed_.options == options && posed_moment_ == moment_)
    return false;
  const double start = now_ms();
  try {
    // Only the worker may use the deformer of a method that iterates.
    if (!iterates(deformation) || motion_.unknown(deformation, prepared_) == 0)
      motion_.follow(deformation, moment_.linear_blend, prepared_);
    if (!motion_.plays()) return false;
    SampledMap map = motion_.sampled_at(*moment_.time, options.derivatives);
    if (motion_.error()) map.note = "does not play: " + std::string(motion_.error()->what());
    timed_ = motion_.deformation_at(deformation, *moment_.time, map.f);
    display(examined_map(*prepared_, deformation, options, std::move(map), &posed_));
  } catch (const Error& error) {
    error_ = error;
    return false;
  }
  posed_.milliseconds = now_ms() - start;
  posed_moment_ = moment_;
  error_.reset();
  return true;
}

bool LiveMap::follow_keys() {
  if (!prepared_ || failed_ || !posed_.deformation) return false;
  const Deformation& deformation = *posed_.deformation;
  const bool known = motion_.unknown(deformation, prepared_) == 0;
  if (!known && busy_) return false;
  if (!known && needs_keys(deformation)) {
    request({deformation, posed_.options, true, moment_.linear_blend});
    return false;
  }
  if (known || !iterates(deformation)) motion_.follow(deformation, moment_.linear_blend, prepared_);
  return true;
}

Points LiveMap::images_at(double time, std::span<const Complex> rest) {
  Points places(rest.begin(), rest.end());
  if (!motion_.plays()) return places;
  const VectorXc f = motion_.map_at(time);
  for (Complex& z : places)
    if (const auto at = locate(*prepared_->mesh, prepared_->mesh->vertices, z))
      z = at->in(*prepared_->mesh, as_span(f));
  return places;
}

std::optional<Complex> LiveMap::pin_image(const Deformation& deformation, size_t i) const {
  return posed() && same_rest(*posed(), deformation) ? pin_image(i) : std::nullopt;
}

std::optional<Complex> LiveMap::pin_image(size_t i) const {
  if (!has_map() || map().ignores_pins || i >= prepared_->pins.size() || !prepared_->pins[i])
    return {};
  return prepared_->pins[i]->in(*prepared_->mesh, as_span(map().f));
}

std::optional<double> LiveMap::pin_turn(const Deformation& deformation, size_t i) const {
  if (!pin_image(deformation, i)) return {};
  if (i < map().turns.size() && map().turns[i]) return map().turns[i];
  const Mesh& mesh = *prepared_->mesh;
  const Triangle& at = mesh.triangles[static_cast<size_t>(prepared_->pins[i]->triangle)];
  return std::arg(derivatives_in(mesh, at, map().f).fz);
}

void LiveMap::clear() {
  if (!requested_) return;
  worker_.discard();
  prepared_.reset();
  display({});
  posed_moment_ = {};
  timed_.reset();
  motion_.clear();
  requested_.reset();
  error_.reset();
  busy_ = failed_ = false;
}

void LiveMap::finish(const Deformation& deformation, EvalOptions options) {
  update(deformation, options);
  worker_.wait();
  update(deformation, options);
}

}  // namespace holomorph
