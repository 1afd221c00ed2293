// The map of a scene that is being edited: prepared on a worker thread, posed on the caller's.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "core/error.h"
#include "core/maps/injectivity.h"
#include "core/mesh/draw_order.h"
#include "core/mesh/mesh.h"
#include "core/mesh/mesher.h"
#include "scene/motion.h"

namespace holomorph {

/// A domain mesh and a deformer over it: what a rest needs prepared. Immutable but for the
/// deformer.
struct PreparedMap {
  Rest rest;  ///< with samples
  std::string method;
  std::shared_ptr<const Mesh> mesh;
  std::unique_ptr<Deformer> deformer;
  std::vector<std::optional<Location>> pins;  ///< of the rest's pins; none outside the mesh
  double milliseconds = 0;                    ///< what preparing took
  /// For what lies between maps on the mesh; null until somebody needs it, or has time for it.
  std::atomic<std::shared_ptr<const Inbetween>> between = {};
};
/// Throws Error{bad_input} when the cages and keyframes of all layers together need more than the
/// budget has; meshes have about their usual size.
void check_affordable(std::span<const Scene> layers);
/// A prepared map's `between`, which is made if there is none yet.
std::shared_ptr<const Inbetween> inbetween_of(PreparedMap& prepared);

/// The mesh as it is to be drawn: its triangles from the lowest to the highest, by the depths of
/// the scene's pins; the same one where these do not differ.
std::shared_ptr<const Mesh> drawn_mesh(std::shared_ptr<const Mesh> mesh, const Scene& scene);

/// Prepares at once, on this thread. `previous`, when given, lends what it has in common: the mesh
/// of the same cage, the method's precomputation. Throws Error.
std::unique_ptr<PreparedMap> prepared_map(const Scene& scene, Precision precision,
                                          const MeshOptions& options,
                                          const PreparedMap* previous = nullptr);

/// Follows a scene. update() never waits: while a changed rest, or the maps of many keyframes, are
/// prepared on the worker the last map stays; errors are kept for showing and leave it, too.
class LiveMap {
 public:
  explicit LiveMap(MeshOptions options = {});
  ~LiveMap();
  LiveMap(const LiveMap&) = delete;
  LiveMap& operator=(const LiveMap&) = delete;

  /// Called by the worker when a preparation has ended, to wake an event loop. Set before use.
  void on_ready(std::function<void()> wake) { wake_ = std::move(wake); }

  /// Takes what the worker has finished, asks for what the scene needs, and poses the map when it
  /// fits the scene. Returns whether the map changed.
  /// With a time, and keyframes that play, the map is theirs at that time.
  bool update(const Scene& scene, Wanted wanted, std::optional<double> time = {});
  /// Forgets scene, map and whatever the worker is busy with.
  void clear();
  /// update(), then waits for the worker until the map is the scene's or failed. For tests.
  void finish(const Scene& scene, Wanted wanted);

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
  /// Where the map takes the place that pin `i` of a scene holds at rest; none when pins have no
  /// say or the scene has other pins by now.
  std::optional<Complex> pin_place(const Scene& scene, size_t i) const;
  /// Where the map takes the zeros that it reports.
  const Points& zero_places() const { return zero_places_; }
  /// The scene that map() shows; it may lag behind the one being edited.
  const std::optional<Scene>& posed() const { return posed_; }
  /// The scene with its handles at the shown time; none where no time is shown.
  const std::optional<Scene>& timed() const { return timed_; }
  /// The maps at the posed scene's keyframes: up to date where a time is shown, and after
  /// follow_keys().
  const Motion& motion() const { return motion_; }
  void follow_keys() {
    if (shown_ && posed_) motion_.follow(*posed_, shown_);
  }
  /// Where the keyframes of the posed scene take places at rest; those outside the mesh stay.
  Points places_at(double time, std::span<const Complex> rest);
  double pose_milliseconds() const { return pose_milliseconds_; }
  /// Grows by one whenever a newly prepared map is taken over.
  unsigned preparation() const { return preparation_; }

 private:
  void work();
  bool needs_worker(const Scene& scene) const;
  SampledMap map_at_time(const Scene& scene, Wanted wanted);
  void take_result(const Scene& scene, Wanted wanted);
  bool pose(const Scene& scene, Wanted wanted);
  void describe();
  void order(const Scene& scene);

  MeshOptions options_;
  std::function<void()> wake_;
  std::shared_ptr<PreparedMap> shown_;
  std::shared_ptr<const Mesh> drawn_;
  std::vector<Depth> depths_;  ///< that it is ordered by
  SampledMap map_;
  std::optional<Error> error_;
  Injectivity injectivity_;
  Points zero_places_;
  std::optional<Scene> requested_;  ///< the scene whose rest was last asked for
  bool requested_keys_ = false;     ///< and whether with the maps at its keyframes
  Wanted posed_wanted_;
  std::optional<Scene> posed_;  ///< the scene that map_ shows
  Motion motion_;
  std::optional<double> time_, posed_time_;
  std::optional<Scene> timed_;
  bool busy_ = false, failed_ = false;
  double pose_milliseconds_ = 0;
  double solve_milliseconds_ = 0;  ///< of a final pose, in-betweens aside
  unsigned preparation_ = 0;

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  std::optional<Scene> waiting_;
  bool waiting_keys_ = false;
  Motion result_motion_;
  double result_milliseconds_ = 0;  ///< of one of its keys
  std::shared_ptr<PreparedMap> base_, result_;
  std::optional<Error> failure_;
  std::optional<Scene> result_scene_;
  unsigned wanted_ = 0;    ///< grows with every request
  unsigned document_ = 0;  ///< grows when all is forgotten: what the worker has is dropped then
  bool working_ = false, finished_ = false, stop_ = false;
  std::thread worker_;
};

/// Whether two scenes need the same preparation.
bool same_rest(const Scene& a, const Scene& b);

}  // namespace holomorph
