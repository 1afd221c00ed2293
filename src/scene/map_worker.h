// Prepares and solves the maps of one layer on its own thread.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

#include "core/error.h"
#include "core/maps/deformer.h"
#include "scene/motion.h"
#include "scene/posed_map.h"

namespace holomorph {

/// The input of a MapWorker.
struct MapRequest {
  Deformation deformation;
  EvalOptions options;
  bool keys = false;  ///< wants the maps at the keyframes; its own pose only if they do not play
  bool linear_blend = false;
};

/// The result of a MapWorker.
struct MapAnswer {
  unsigned number = 0;                    ///< of the request
  std::shared_ptr<PreparedMap> prepared;  ///< null after an error in the preparation
  std::optional<PosedMap> posed;
  std::optional<Motion> motion;
  double key_milliseconds = 0;  ///< average time per keyframe
  std::optional<Error> error;
  bool complete = true;  ///< false if a better answer to the same request follows
};

/// Answers the newest request; an unanswered request is replaced by a newer one. A final answer
/// ends early when a newer request arrives, if the method supports this; a draft does not. If the
/// method iterates, a final answer is preceded by a draft that continues from the last map, and the
/// worker improves a draft until it no longer changes.
class MapWorker {
 public:
  explicit MapWorker(MeshOptions options) : options_(options) {}
  ~MapWorker();
  MapWorker(const MapWorker&) = delete;
  MapWorker& operator=(const MapWorker&) = delete;

  /// Sets a function that the worker calls after each answer. Set it before the first request.
  void on_answer(std::function<void()> wake) { wake_ = std::move(wake); }

  /// Returns the request's number.
  unsigned request(MapRequest request);
  /// The newest answer that has not been taken yet.
  std::optional<MapAnswer> take();
  /// Drops the request and the answer, even those in progress.
  void discard();
  /// Waits until the worker has nothing to do.
  void wait();

 private:
  void run();
  void prepare_playback(std::unique_lock<std::mutex>& lock);
  void answer(const MapRequest& request, unsigned number);
  void improve(const MapRequest& request, unsigned number);
  void prepare(const MapRequest& request);
  PosedMap posed(const MapRequest& request, const EvalOptions& options);
  void deliver(MapAnswer answer);
  bool is_newest(unsigned number);
  std::stop_token stop_token();

  MeshOptions options_;
  std::function<void()> wake_;

  // Used by the worker's thread only.
  std::shared_ptr<PreparedMap> prepared_, played_;  ///< played_: prepare_playback has tried it
  std::optional<Deformation> prepared_for_;
  std::optional<PosedMap> last_;
  Motion motion_;

  std::mutex mutex_;  ///< guards the members below
  std::condition_variable changed_;
  std::optional<MapRequest> waiting_;
  std::optional<MapAnswer> answer_;
  unsigned number_ = 0;   ///< of the newest request
  unsigned dropped_ = 0;  ///< requests up to this number were dropped
  bool working_ = false, stop_ = false;
  std::stop_source interrupt_;  ///< ends final answers
  std::thread thread_;          ///< started by the first request
};

}  // namespace holomorph
