// The map of a deformation that is being edited: prepared on a worker thread, posed on the
// caller's.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "core/error.h"
#include "core/maps/injectivity.h"
#include "scene/motion.h"

namespace holomorph {

/// Follows a deformation. update() never waits: while a changed rest, or the maps of many
/// keyframes, are prepared on the worker the last map stays; errors are kept for showing and leave
/// it, too.
class LiveMap {
 public:
  explicit LiveMap(MeshOptions options = {});
  ~LiveMap();
  LiveMap(const LiveMap&) = delete;
  LiveMap& operator=(const LiveMap&) = delete;

  /// Called by the worker when a preparation has ended, to wake an event loop. Set before use.
  void on_ready(std::function<void()> wake) { wake_ = std::move(wake); }

  /// Takes what the worker has finished, asks for what the deformation needs, and poses the map
  /// when it fits the deformation. Returns whether the map changed. At a time, where there are
  /// keyframes that play, the map is theirs.
  bool update(const Deformation& deformation, EvalOptions options, const Moment& moment = {});
  /// Forgets deformation, map and whatever the worker is busy with.
  void clear();
  /// update(), then waits for the worker until the map is the deformation's or failed. For tests.
  void finish(const Deformation& deformation, EvalOptions options);

  const PreparedMap* prepared() const { return shown_.get(); }
  /// The prepared mesh as it is drawn and picked in.
  const std::shared_ptr<const Mesh>& drawn() const { return drawn_; }
  /// The map at mesh->vertices; empty until there is one.
  const SampledMap& map() const { return map_; }
  bool has_map() const { return shown_ && map_.f.size() > 0; }
  bool busy() const { return busy_; }
  const std::optional<Error>& error() const { return error_; }
  /// Of the shown map.
  const Injectivity& injectivity() const { return injectivity_; }
  /// Where the map takes the place that pin `i` of a deformation holds at rest; none when pins have
  /// no say or the deformation has other pins by now.
  std::optional<Complex> pin_place(const Deformation& deformation, size_t i) const;
  /// Where the map takes the zeros that it reports.
  const Points& zero_places() const { return zero_places_; }
  /// The deformation that map() shows; it may lag behind the one being edited.
  const std::optional<Deformation>& posed() const { return posed_; }
  /// The deformation with its handles at the shown time; none where no time is shown.
  const std::optional<Deformation>& timed() const { return timed_; }
  /// The maps at the posed deformation's keyframes: up to date where a time is shown, and after
  /// follow_keys().
  const Motion& motion() const { return motion_; }
  void follow_keys() {
    if (shown_ && posed_) motion_.follow(*posed_, moment_.linear_blend, shown_);
  }
  /// Where the keyframes of the posed deformation take places at rest; those outside the mesh stay.
  Points places_at(double time, std::span<const Complex> rest);
  double pose_milliseconds() const { return pose_milliseconds_; }
  /// Grows by one whenever a newly prepared map is taken over.
  unsigned preparation() const { return preparation_; }

 private:
  void work();
  bool needs_worker(const Deformation& deformation) const;
  void take_result(const Deformation& deformation, EvalOptions options);
  bool pose(const Deformation& deformation, EvalOptions options);
  void describe();
  void order(const Deformation& deformation);

  MeshOptions options_;
  std::function<void()> wake_;
  std::shared_ptr<PreparedMap> shown_;
  std::shared_ptr<const Mesh> drawn_;
  std::vector<Depth> depths_;  ///< that it is ordered by
  SampledMap map_;
  std::optional<Error> error_;
  Injectivity injectivity_;
  Points zero_places_;
  std::optional<Deformation> requested_;  ///< the deformation whose rest was last asked for
  bool requested_keys_ = false;           ///< and whether with the maps at its keyframes
  EvalOptions posed_options_;
  std::optional<Deformation> posed_;  ///< the deformation that map_ shows
  Motion motion_;
  Moment moment_, posed_moment_;
  std::optional<Deformation> timed_;
  bool busy_ = false, failed_ = false;
  double pose_milliseconds_ = 0;
  double solve_milliseconds_ = 0;  ///< of a final pose, in-betweens aside
  unsigned preparation_ = 0;

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  std::optional<Deformation> waiting_;
  bool waiting_keys_ = false, waiting_blend_ = false;
  Motion result_motion_;
  double result_milliseconds_ = 0;  ///< of one of its keys
  std::shared_ptr<PreparedMap> base_, result_;
  std::optional<Error> failure_;
  std::optional<Deformation> result_scene_;
  unsigned generation_ = 0;  ///< grows with every request
  unsigned document_ = 0;    ///< grows when all is forgotten: what the worker has is dropped then
  bool working_ = false, finished_ = false, stop_ = false;
  std::thread worker_;
};

}  // namespace holomorph
