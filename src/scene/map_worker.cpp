// Prepared maps and motions are kept from one request to the next, so that each request repeats
// only the work whose input has changed.
#include "scene/map_worker.h"

#include <utility>

#include "core/clock.h"
#include "scene/keyframes.h"

namespace holomorph {

MapWorker::~MapWorker() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    interrupt_.request_stop();
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

unsigned MapWorker::request(MapRequest request) {
  if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
  const std::lock_guard lock(mutex_);
  ++number_;
  waiting_ = std::move(request);
  interrupt_.request_stop();
  changed_.notify_all();
  return number_;
}

std::optional<MapAnswer> MapWorker::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(answer_, std::nullopt);
}

void MapWorker::discard() {
  const std::lock_guard lock(mutex_);
  dropped_ = ++number_;
  waiting_.reset();
  answer_.reset();
  interrupt_.request_stop();
}

void MapWorker::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !working_ && !waiting_; });
}

std::stop_token MapWorker::stop_token() {
  const std::lock_guard lock(mutex_);
  return interrupt_.get_token();
}

bool MapWorker::is_newest(unsigned number) {
  const std::lock_guard lock(mutex_);
  return number == number_ && !stop_;
}

void MapWorker::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    prepare_playback(lock);
    changed_.wait(lock, [this] { return stop_ || waiting_; });
    if (stop_) return;
    const MapRequest request = *std::exchange(waiting_, std::nullopt);
    const unsigned number = number_;
    interrupt_ = std::stop_source();
    working_ = true;
    lock.unlock();
    try {
      answer(request, number);
      improve(request, number);
    } catch (const Stopped&) {
      // The answer is no longer wanted.
    }
    lock.lock();
    working_ = false;
    changed_.notify_all();
  }
}

/// Prepares what playback will need, if no request arrives for a while.
void MapWorker::prepare_playback(std::unique_lock<std::mutex>& lock) {
  constexpr auto kIdle = std::chrono::milliseconds(300);
  if (!prepared_ || prepared_ == played_ || prepared_->between.load()) return;
  if (changed_.wait_for(lock, kIdle, [this] { return stop_ || waiting_; })) return;
  played_ = prepared_;
  lock.unlock();
  try {
    inbetween_of(*prepared_);
  } catch (const std::exception&) {
    // Playback will fail for the same reason and report it.
  }
  lock.lock();
}

void MapWorker::prepare(const MapRequest& request) {
  if (prepared_ && same_rest(*prepared_for_, request.deformation)) return;
  prepared_ = prepared_map(request.deformation, Precision::single, options_, prepared_.get());
  prepared_for_ = request.deformation;
  last_.reset();
}

PosedMap MapWorker::posed(const MapRequest& request, const EvalOptions& options) {
  last_ = posed_map(*prepared_, request.deformation, options, last_ ? &*last_ : nullptr);
  return *last_;
}

void MapWorker::answer(const MapRequest& request, unsigned number) {
  MapAnswer found;
  found.number = number;
  try {
    prepare(request);
    found.prepared = prepared_;
    const std::stop_token stop = stop_token();
    if (request.keys) {
      const double start = now_ms();
      motion_.follow(request.deformation, request.linear_blend, prepared_, stop);
      const size_t keys = playing_keys(request.deformation).size();
      found.key_milliseconds = (now_ms() - start) / static_cast<double>(std::max<size_t>(1, keys));
      found.motion = motion_;
    }
    if (!request.keys || !motion_.plays()) {
      const bool iterates = method_named(request.deformation.method).iterates;
      EvalOptions options = request.options;
      if (iterates && last_ && !options.draft && !options.iteration) {
        options.draft = true;
        options.released = false;
        found.complete = false;
        found.posed = posed(request, options);
        deliver(found);
        found.complete = true;
      }
      options = request.options;
      if (!options.draft) options.stop = stop;
      found.posed = posed(request, options);
    }
  } catch (const Error& error) {
    found.error = error;
  } catch (const Stopped&) {
    throw;
  } catch (const std::exception& error) {
    found.error = Error(ErrorKind::failed, "the map could not be prepared: " + what_of(error));
  }
  deliver(std::move(found));
}

/// Continues a draft until it no longer moves or a newer request arrives.
void MapWorker::improve(const MapRequest& request, unsigned number) {
  constexpr double kStill = 1e-5;  // relative to the size
  constexpr int kMost = 200;
  if (!request.options.draft || !last_ || last_->deformation != request.deformation ||
      !method_named(request.deformation.method).iterates)
    return;
  const double size = box_of(prepared_->mesh->vertices).diagonal();
  for (int i = 0; i < kMost && is_newest(number); ++i) {
    const VectorXc before = last_->map.f;
    MapAnswer better;
    better.number = number;
    better.prepared = prepared_;
    try {
      better.posed = posed(request, request.options);
    } catch (const std::exception&) {
      return;  // the last draft stays
    }
    const double moved = (better.posed->map.f - before).cwiseAbs().maxCoeff();
    if (!(moved > kStill * size)) return;
    deliver(std::move(better));
  }
}

void MapWorker::deliver(MapAnswer answer) {
  {
    const std::lock_guard lock(mutex_);
    // Errors of an earlier state do not matter any more. Its map is shown until the next is ready.
    if (answer.number <= dropped_ || (answer.error && answer.number != number_)) return;
    // A motion that has not been taken yet must not be lost.
    if (answer_ && answer_->motion && !answer.motion && answer_->prepared == answer.prepared) {
      answer.motion = std::move(answer_->motion);
      answer.key_milliseconds = answer_->key_milliseconds;
    }
    answer_ = std::move(answer);
  }
  if (wake_) wake_();
}

}  // namespace holomorph
