// There are no dirty flags. Inputs are compared by value, and the worker receives a request when
// the input of the preparation changes.
#include "scene/live_map.h"

#include <algorithm>
#include <utility>

#include "core/clock.h"
#include "scene/keyframes.h"

namespace holomorph {

void LiveMap::order(const Deformation& deformation) {
  std::vector<Depth> depths = depths_of(deformation);
  if (drawn_ && depths == depths_) return;
  depths_ = std::move(depths);
  drawn_ = drawn_mesh(prepared_->mesh, depths_);
}

LiveMap::LiveMap(MeshOptions options) : options_(options) {}

LiveMap::~LiveMap() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  if (worker_.joinable()) worker_.join();
}

void LiveMap::work() {
  std::unique_lock lock(mutex_);
  constexpr auto kIdle = std::chrono::milliseconds(300);
  std::shared_ptr<PreparedMap> tried;  ///< the map whose in-betweens were last attempted
  while (true) {
    const auto wanted_now = [this] { return stop_ || waiting_; };
    if (!base_ || base_ == tried || base_->between.load()) {
      changed_.wait(lock, wanted_now);
    } else if (!changed_.wait_for(lock, kIdle, wanted_now)) {
      // The worker is idle, so it prepares what playback will need.
      const std::shared_ptr<PreparedMap> base = tried = base_;
      lock.unlock();
      try {
        inbetween_of(*base);
      } catch (const std::exception&) {
        // Playback will fail for the same reason and report it.
      }
      lock.lock();
      continue;
    }
    if (stop_) return;
    const Deformation deformation = *std::exchange(waiting_, std::nullopt);
    const bool with_keys = waiting_keys_, linear_blend = waiting_blend_;
    const std::shared_ptr<PreparedMap> base = base_;
    const unsigned wanted = generation_, document = document_;
    working_ = true;
    lock.unlock();
    std::shared_ptr<PreparedMap> result;
    std::optional<Error> failure;
    Motion motion;
    double milliseconds = 0;
    try {
      result = prepared_map(deformation, Precision::single, options_, base.get());
      const double start = now_ms();
      if (with_keys) motion.follow(deformation, linear_blend, result);
      if (const size_t keys = playing_keys(deformation).size(); with_keys && keys > 0)
        milliseconds = (now_ms() - start) / static_cast<double>(keys);
    } catch (const Error& error) {
      failure = error;
    } catch (const std::exception& error) {
      failure = Error(ErrorKind::failed, "the map could not be prepared: " + what_of(error));
    }
    lock.lock();
    working_ = false;
    if (result) base_ = result;
    // If the deformation has changed in the meantime, the map of the earlier state is displayed
    // until the next map is ready. Errors of the earlier state are ignored.
    if (document == document_ && (result || wanted == generation_)) {
      finished_ = true;
      result_ = std::move(result);
      result_motion_ = std::move(motion);
      if (milliseconds > 0) result_milliseconds_ = milliseconds;
      result_deformation_ = deformation;
      failure_ = std::move(failure);
    }
    changed_.notify_all();
    if (wake_) wake_();
  }
}

void LiveMap::adopt_result(const Deformation& deformation, EvalOptions options) {
  const std::lock_guard lock(mutex_);
  busy_ = working_ || waiting_;
  if (!std::exchange(finished_, false)) return;
  error_ = std::move(failure_);
  failed_ = error_.has_value();
  failure_.reset();
  if (!result_) return;
  prepared_ = std::move(result_);
  drawn_.reset();
  motion_ = std::exchange(result_motion_, Motion());
  solve_milliseconds_ = std::max(solve_milliseconds_, std::exchange(result_milliseconds_, 0));
  posed_.reset();
  map_ = SampledMap{};
  ++preparation_;
  // Mesh and map must match. If the rest state has changed since the request, pose the deformation
  // that was requested.
  pose(same_rest(*result_deformation_, deformation) ? deformation : *result_deformation_, options);
}

bool LiveMap::pose(const Deformation& deformation, EvalOptions options) {
  if (!prepared_ ||
      (posed_ == deformation && posed_options_ == options && posed_moment_ == moment_))
    return false;
  const double start = now_ms();
  timed_.reset();
  try {
    const bool timed = moment_.time && !deformation.keyframes.empty();
    if (timed) motion_.follow(deformation, moment_.linear_blend, prepared_);
    SampledMap map;
    if (timed && motion_.plays()) {
      map = blended_map(*prepared_->mesh, motion_.map_at(*moment_.time), options.derivatives);
      if (motion_.error()) map.note = "does not play: " + std::string(motion_.error()->what());
      timed_ = motion_.deformation_at(deformation, *moment_.time, map.f);
    } else {
      map = prepared_->deformer->deform(pose_of(deformation), options, map_.solution.get());
      if (!options.draft) solve_milliseconds_ = now_ms() - start;
    }
    map_ = std::move(map);
    error_.reset();
  } catch (const Error& error) {
    error_ = error;
    return false;
  }
  pose_milliseconds_ = now_ms() - start;
  order(deformation);
  evaluate_map();
  posed_ = deformation;
  posed_options_ = options;
  posed_moment_ = moment_;
  return true;
}

Points LiveMap::images_at(double time, std::span<const Complex> rest) {
  Points places(rest.begin(), rest.end());
  follow_keys();
  if (!motion_.plays()) return places;
  const VectorXc f = motion_.map_at(time);
  for (Complex& z : places)
    if (const auto at = locate(*prepared_->mesh, prepared_->mesh->vertices, z))
      z = at->in(*prepared_->mesh, as_span(f));
  return places;
}

std::optional<Complex> LiveMap::pin_image(const Deformation& deformation, size_t i) const {
  return posed_ && same_rest(*posed_, deformation) ? pin_image(i) : std::nullopt;
}

std::optional<Complex> LiveMap::pin_image(size_t i) const {
  if (!has_map() || map_.ignores_pins || i >= prepared_->pins.size() || !prepared_->pins[i])
    return {};
  return prepared_->pins[i]->in(*prepared_->mesh, as_span(map_.f));
}

/// Computes the injectivity and the images of the zeros of a newly posed map.
void LiveMap::evaluate_map() {
  const Mesh& mesh = *prepared_->mesh;
  injectivity_ = injectivity_of(mesh, map_.f);
  zero_images_.clear();
  for (const Complex& zero : map_.zeros)
    if (const auto at = locate(mesh, mesh.vertices, zero))
      zero_images_.push_back(at->in(mesh, as_span(map_.f)));
}

void LiveMap::clear() {
  prepared_.reset();
  drawn_.reset();
  map_ = SampledMap{};
  posed_.reset();
  timed_.reset();
  motion_.clear();
  requested_.reset();
  error_.reset();
  failed_ = false;
  injectivity_ = {};
  zero_images_.clear();
  const std::lock_guard lock(mutex_);
  ++generation_;
  ++document_;
  waiting_.reset();
  result_.reset();
  finished_ = false;
}

/// Whether the maps at keyframes are needed and computing them would noticeably block the caller.
/// Keys that still lack a map after a request have no valid map and are not requested again.
bool LiveMap::needs_worker(const Deformation& deformation) const {
  constexpr double kNoticed = 50, kShape = 4;  // ms; kShape is the time for the logarithms of a key
  if (!moment_.time || !prepared_ || busy_ || failed_) return false;
  if (requested_keys_ && requested_->keyframes == deformation.keyframes) return false;
  if (posed_moment_.time && posed_ && posed_->keyframes == deformation.keyframes) return false;
  return static_cast<double>(motion_.unknown(deformation, prepared_)) *
             (solve_milliseconds_ + kShape) >
         kNoticed;
}

bool LiveMap::update(const Deformation& deformation, EvalOptions options, const Moment& moment) {
  const unsigned before = preparation_;
  moment_ = moment;
  adopt_result(deformation, options);
  if (!deformation.has_cage()) {
    const bool changed = prepared_ != nullptr;
    clear();
    return changed;
  }
  if (!requested_ || !same_rest(*requested_, deformation) || needs_worker(deformation)) {
    if (!worker_.joinable()) worker_ = std::thread([this] { work(); });
    requested_ = deformation;
    requested_keys_ = moment_.time.has_value();
    error_.reset();
    failed_ = false;
    const std::lock_guard lock(mutex_);
    ++generation_;
    waiting_ = deformation;
    waiting_keys_ = requested_keys_;
    waiting_blend_ = moment_.linear_blend;
    busy_ = true;
    changed_.notify_all();
    return before != preparation_;
  }
  if (busy_ || failed_) return before != preparation_;
  return pose(deformation, options) || before != preparation_;
}

void LiveMap::finish(const Deformation& deformation, EvalOptions options) {
  update(deformation, options);
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !working_ && !waiting_; });
  }
  update(deformation, options);
}

}  // namespace holomorph
