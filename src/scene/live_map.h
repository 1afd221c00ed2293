// The map of a deformation that is being edited. It is prepared on a worker thread and posed on the
// caller's thread.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "core/error.h"
#include "core/maps/injectivity.h"
#include "scene/motion.h"

namespace holomorph {

/// Keeps the map of a deformation up to date. update() never waits. While the worker prepares a
/// changed rest state or the maps of many keyframes, the previous map remains available. It also
/// remains available after an error; error() returns that error.
class LiveMap {
 public:
  explicit LiveMap(MeshOptions options = {});
  ~LiveMap();
  LiveMap(const LiveMap&) = delete;
  LiveMap& operator=(const LiveMap&) = delete;

  /// Sets a function that the worker calls at the end of each preparation, for example to wake an
  /// event loop. Set it before any other call.
  void on_ready(std::function<void()> wake) { wake_ = std::move(wake); }

  /// Adopts any finished result of the worker. Requests a new preparation if the deformation needs
  /// one, and otherwise poses the map. If `moment` has a time and any keyframes play, the map is
  /// the animation's map at that time. Returns whether the map changed.
  bool update(const Deformation& deformation, EvalOptions options, const Moment& moment = {});
  /// Discards the deformation, the map, and the preparation in progress.
  void clear();
  /// Calls update() and waits until the worker has prepared the deformation's map or has failed.
  /// Used by tests.
  void finish(const Deformation& deformation, EvalOptions options);

  const PreparedMap* prepared() const { return prepared_.get(); }
  /// The prepared mesh with its triangles in drawing order. Used for drawing and picking.
  const std::shared_ptr<const Mesh>& drawn() const { return drawn_; }
  /// The map at the mesh's vertices; empty until the first map is ready.
  const SampledMap& map() const { return map_; }
  bool has_map() const { return prepared_ && map_.f.size() > 0; }
  bool busy() const { return busy_; }
  const std::optional<Error>& error() const { return error_; }
  /// The injectivity of the displayed map.
  const Injectivity& injectivity() const { return injectivity_; }
  /// The image of the rest position of pin `i` of a deformation. None if the map ignores pins, if
  /// the pin lies outside the mesh, or if the map belongs to another rest state.
  std::optional<Complex> pin_image(const Deformation& deformation, size_t i) const;
  /// Like the overload above, but does not check the rest state. Use it for a deformation with the
  /// same rest state as posed().
  std::optional<Complex> pin_image(size_t i) const;
  /// The images of the zeros of f_z that the map reports.
  const Points& zero_images() const { return zero_images_; }
  /// The deformation to which map() belongs. It may be an earlier state of the edited deformation.
  const std::optional<Deformation>& posed() const { return posed_; }
  /// The deformation with its handles at the displayed time; none if no time is displayed.
  const std::optional<Deformation>& timed() const { return timed_; }
  /// The maps at the posed deformation's keyframes. They are up to date while a time is displayed,
  /// and after follow_keys().
  const Motion& motion() const { return motion_; }
  Motion& motion() { return motion_; }
  void follow_keys() {
    if (prepared_ && posed_) motion_.follow(*posed_, moment_.linear_blend, prepared_);
  }
  /// The images of rest positions under the posed deformation's animation at a time. Positions
  /// outside the mesh are returned unchanged.
  Points images_at(double time, std::span<const Complex> rest);
  double pose_milliseconds() const { return pose_milliseconds_; }
  /// A counter that increases by one whenever a newly prepared map is adopted.
  unsigned preparation() const { return preparation_; }

 private:
  void work();
  bool needs_worker(const Deformation& deformation) const;
  void adopt_result(const Deformation& deformation, EvalOptions options);
  bool pose(const Deformation& deformation, EvalOptions options);
  void evaluate_map();
  void order(const Deformation& deformation);

  MeshOptions options_;
  std::function<void()> wake_;
  std::shared_ptr<PreparedMap> prepared_;
  std::shared_ptr<const Mesh> drawn_;
  std::vector<Depth> depths_;  ///< the depths that determine the order of drawn_
  SampledMap map_;
  std::optional<Error> error_;
  Injectivity injectivity_;
  Points zero_images_;
  std::optional<Deformation> requested_;  ///< the deformation whose rest state was last requested
  bool requested_keys_ = false;           ///< whether the maps at its keyframes were requested too
  EvalOptions posed_options_;
  std::optional<Deformation> posed_;  ///< the deformation to which map_ belongs
  Motion motion_;
  Moment moment_, posed_moment_;
  std::optional<Deformation> timed_;
  bool busy_ = false, failed_ = false;
  double pose_milliseconds_ = 0;
  double solve_milliseconds_ = 0;  ///< time to compute a final pose, without in-betweens
  unsigned preparation_ = 0;

  std::mutex mutex_;  ///< guards the members below
  std::condition_variable changed_;
  std::optional<Deformation> waiting_;
  bool waiting_keys_ = false, waiting_blend_ = false;
  Motion result_motion_;
  double result_milliseconds_ = 0;  ///< per keyframe
  std::shared_ptr<PreparedMap> base_, result_;
  std::optional<Error> failure_;
  std::optional<Deformation> result_deformation_;
  unsigned generation_ = 0;  ///< increases with every request
  unsigned document_ = 0;    ///< increases in clear(), to discard the worker's result
  bool working_ = false, finished_ = false, stop_ = false;
  std::thread worker_;  ///< started by the first request
};

}  // namespace holomorph
