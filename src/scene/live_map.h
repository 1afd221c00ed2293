// The map of a deformation that is being edited.
#pragma once

#include <functional>

#include "core/maps/deformer.h"
#include "scene/map_worker.h"

namespace holomorph {

/// Keeps the map of a deformation up to date. update() never waits: a worker prepares changed rest
/// states, solves the poses of methods that iterate, and finds the maps of many keyframes.
/// Meanwhile, the newest map that is ready is displayed. Other poses take little time, and update()
/// computes them itself. The last map also remains available after an error; error() returns that
/// error. Threads: functions of different maps may run at the same time.
class LiveMap {
 public:
  explicit LiveMap(MeshOptions options = {}) : worker_(options) {}

  /// Sets a function that the worker calls after each answer, for example to wake an event loop.
  /// Set it before any other call.
  void on_ready(std::function<void()> wake) { worker_.on_answer(std::move(wake)); }

  /// Adopts what the worker has found, and either requests the deformation's map or computes it. If
  /// `moment` has a time and any keyframes play, the map is the animation's map at that time.
  /// Returns whether the map changed.
  bool update(const Deformation& deformation, EvalOptions options, const Moment& moment = {});
  /// Discards the deformation, the map, and the worker's request.
  void clear();
  /// Calls update() and waits until the map is ready or has failed. Drafts are improved as far as
  /// possible. Used by tests.
  void finish(const Deformation& deformation, EvalOptions options);

  const PreparedMap* prepared() const { return prepared_.get(); }
  /// The prepared mesh with its triangles in drawing order. Used for drawing and picking.
  const std::shared_ptr<const Mesh>& drawn() const { return posed_.drawn; }
  /// The map at the mesh's vertices; empty until the first map is ready.
  const SampledMap& map() const { return posed_.map; }
  bool has_map() const { return prepared_ && posed_.map.f.size() > 0; }
  /// Whether the displayed map is the draft of a method that iterates.
  bool shows_draft() const;
  /// Whether a better map than the displayed one is being prepared or solved.
  bool busy() const { return busy_; }
  const std::optional<Error>& error() const { return error_; }
  /// The injectivity of the displayed map.
  const Injectivity& injectivity() const { return posed_.injectivity; }
  /// The image of the rest position of pin `i` of a deformation. None if the map ignores pins, if
  /// the pin lies outside the mesh, or if the map belongs to another rest state.
  std::optional<Complex> pin_image(const Deformation& deformation, size_t i) const;
  /// Like the overload above, but does not check the rest state. Use it for a deformation with the
  /// same rest state as posed().
  std::optional<Complex> pin_image(size_t i) const;
  /// The rotation of the picture at that pin, in radians. Whole turns count if the map knows them.
  std::optional<double> pin_turn(const Deformation& deformation, size_t i) const;
  /// The images of the zeros of f_z that the map reports.
  const Points& zero_images() const { return posed_.zero_images; }
  /// The deformation to which map() belongs. It may be an earlier state of the edited deformation.
  const std::optional<Deformation>& posed() const { return posed_.deformation; }
  /// The deformation with its handles at the displayed time; none if no time is displayed.
  const std::optional<Deformation>& timed() const { return timed_; }
  /// The maps at the posed deformation's keyframes. They are up to date while a time is displayed,
  /// and after follow_keys() has returned true.
  const Motion& motion() const { return motion_; }
  Motion& motion() { return motion_; }
  /// Brings motion() up to date. If that would take long, requests it and returns false.
  bool follow_keys();
  /// The images of rest positions under the posed deformation's animation at a time. Call
  /// follow_keys() before. Positions outside the mesh are returned unchanged.
  Points images_at(double time, std::span<const Complex> rest);
  double pose_milliseconds() const { return posed_.milliseconds; }
  /// A counter that increases by one whenever a newly prepared map is adopted.
  unsigned preparation() const { return preparation_; }
  /// A counter that increases whenever the displayed map changes.
  unsigned revision() const { return revision_; }

 private:
  bool plays(const Deformation& deformation) const;
  bool displays(const Deformation& deformation, EvalOptions options) const;
  bool needs_keys(const Deformation& deformation) const;
  bool needs_request(const Deformation& deformation, const EvalOptions& options) const;
  void request(MapRequest request);
  void display(PosedMap posed);
  void adopt(MapAnswer answer);
  bool pose(const Deformation& deformation, EvalOptions options);
  bool pose_at_time(const Deformation& deformation, EvalOptions options);

  std::shared_ptr<PreparedMap> prepared_;
  PosedMap posed_;
  Moment moment_, posed_moment_;
  std::optional<Deformation> timed_;
  Motion motion_;
  std::optional<Error> error_;
  std::optional<MapRequest> requested_;  ///< the last request
  unsigned number_ = 0;                  ///< its number
  bool busy_ = false, failed_ = false;
  double key_milliseconds_ = 0;  ///< time to compute the map at a keyframe
  unsigned preparation_ = 0, revision_ = 0;
  MapWorker worker_;
};

}  // namespace holomorph
