// Values are compared instead of dirty flags: the worker is asked when same_rest is false.
#include "scene/live_map.h"

#include <algorithm>
#include <utility>

#include "core/clock.h"
#include "core/maps/distortion.h"
#include "core/mesh/mesher.h"
#include "scene/budget.h"
#include "scene/keyframes.h"

namespace holomorph {

namespace {

/// The highest degree of each posed segment, in the pose and in keyframes.
std::vector<int> posed_degrees(const Scene& scene) {
  std::vector<int> degrees(static_cast<size_t>(scene.pose.size()), 1);
  const auto include = [&](const Cage& cage) {
    for (Index i = 0; i < cage.size(); ++i)
      degrees[static_cast<size_t>(i)] = std::max(degrees[static_cast<size_t>(i)], cage.degree(i));
  };
  include(scene.pose);
  for (const Keyframe& key : scene.keyframes)
    if (fits(scene, key.pose)) include(key.pose.cage);
  return degrees;
}

}  // namespace

namespace {

std::vector<Depth> depths_of(const Scene& scene) {
  std::vector<Depth> depths;
  if (!method_named(scene.method).uses_pins) return depths;
  for (const Pin& pin : scene.pins) depths.push_back({pin.rest, pin.depth});
  return depths;
}

bool differ(const std::vector<Depth>& depths) {
  return std::ranges::any_of(depths, [&](const Depth& d) { return d.depth != depths[0].depth; });
}

std::shared_ptr<const Mesh> ordered(std::shared_ptr<const Mesh> mesh,
                                    const std::vector<Depth>& depths) {
  if (!differ(depths)) return mesh;
  auto drawn = std::make_shared<Mesh>(*mesh);
  drawn->triangles = draw_order(*mesh, depths);
  return drawn;
}

}  // namespace

namespace {

/// Control points; those of curves take much longer to compute.
double cost_of(const Cage& cage) {
  double cost = 0;
  for (Index i = 0; i < cage.size(); ++i) cost += cage.degree(i) > 1 ? 2.0 * cage.degree(i) : 1.0;
  return cost;
}

}  // namespace

void check_affordable(std::span<const Scene> layers) {
  const double vertices = MeshOptions{}.vertices;
  double controls = 0, keys = 0;
  for (const Scene& layer : layers) {
    controls += cost_of(layer.rest);
    keys += layer.has_cage() ? static_cast<double>(layer.keyframes.size()) : 0;
  }
  check_budget(&Budget::coordinates, controls * vertices,
               "the cages have " + std::to_string(static_cast<long>(controls)) +
                   " control points and their meshes some " +
                   std::to_string(static_cast<long>(vertices)) + " vertices:");
  check_budget(&Budget::operators, keys * vertices * sizeof(Complex),
               "the maps at " + std::to_string(static_cast<long>(keys)) + " keyframes need");
}

std::shared_ptr<const Inbetween> inbetween_of(PreparedMap& prepared) {
  std::shared_ptr<const Inbetween> between = prepared.between.load();
  if (between) return between;
  between = std::make_shared<const Inbetween>(prepared.mesh);
  prepared.between.store(between);
  return between;
}

std::shared_ptr<const Mesh> drawn_mesh(std::shared_ptr<const Mesh> mesh, const Scene& scene) {
  return ordered(std::move(mesh), depths_of(scene));
}

void LiveMap::order(const Scene& scene) {
  std::vector<Depth> depths = depths_of(scene);
  if (drawn_ && depths == depths_) return;
  depths_ = std::move(depths);
  drawn_ = ordered(shown_->mesh, depths_);
}

bool same_rest(const Scene& a, const Scene& b) {
  if (a.method != b.method || a.parameters != b.parameters || a.rest != b.rest) return false;
  if (posed_degrees(a) != posed_degrees(b)) return false;
  const Method& method = method_named(a.method);
  if (a.method == "bounded" && a.other_parameters != b.other_parameters) return false;
  const auto same_pin = [](const Pin& p, const Pin& q) {
    return p.rest == q.rest && p.angle.has_value() == q.angle.has_value();
  };
  const auto same_stroke = [](const Stroke& s, const Stroke& t) { return s.rest == t.rest; };
  if (method.uses_pins && !std::ranges::equal(a.pins, b.pins, same_pin)) return false;
  if (method.uses_outline && a.outline != b.outline) return false;
  const auto same_corner = [](const Corner& c, const Corner& d) { return c.vertex == d.vertex; };
  if (method.uses_corners && !std::ranges::equal(a.corners, b.corners, same_corner)) return false;
  if (method.uses_stiffness && a.stiffness != b.stiffness) return false;
  if (method.uses_strokes && !std::ranges::equal(a.strokes, b.strokes, same_stroke)) return false;
  return true;
}

namespace {

/// Before they are computed.
void check_coordinates(const Rest& rest, Index places) {
  check_budget(&Budget::coordinates, cost_of(rest.cage) * static_cast<double>(places),
               "the cage has " + std::to_string(rest.cage.control_count()) +
                   " control points and its mesh " + std::to_string(places) + " vertices:");
}

/// The same place for every segment, whatever degrees straight ones are written with.
bool is_same_curve(const Cage& a, const Cage& b) {
  return a == b || (vertices_of(a) == vertices_of(b) && is_straight(a) && is_straight(b));
}

}  // namespace

std::unique_ptr<PreparedMap> prepared_map(const Scene& scene, Precision precision,
                                          const MeshOptions& options, const PreparedMap* previous) {
  const double start = now_ms();
  auto prepared = std::make_unique<PreparedMap>();
  prepared->rest = rest_of(scene, precision);
  prepared->method = scene.method;
  const bool same_cage =
      previous && previous->mesh && is_same_curve(previous->rest.cage, prepared->rest.cage);
  check_coordinates(prepared->rest, options.vertices);
  prepared->mesh =
      same_cage ? previous->mesh : std::make_shared<const Mesh>(domain_mesh(scene.rest, options));
  check_coordinates(prepared->rest, static_cast<Index>(prepared->mesh->vertices.size()));
  prepared->rest.samples = prepared->mesh->vertices;
  prepared->rest.mesh = prepared->mesh;
  if (same_cage) prepared->between.store(previous->between.load());
  prepared->rest.derivative_samples =
      same_cage ? previous->rest.derivative_samples : derivative_samples(*prepared->mesh);
  const bool same_method = previous && previous->method == scene.method;
  prepared->deformer =
      method_named(scene.method)
          .prepare(prepared->rest, same_method ? previous->deformer.get() : nullptr);
  for (const RestPin& pin : prepared->rest.pins)
    prepared->pins.push_back(locate(*prepared->mesh, prepared->mesh->vertices, pin.position));
  prepared->milliseconds = now_ms() - start;
  return prepared;
}

LiveMap::LiveMap(MeshOptions options) : options_(options), worker_([this] { work(); }) {}

LiveMap::~LiveMap() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

void LiveMap::work() {
  std::unique_lock lock(mutex_);
  constexpr auto kIdle = std::chrono::milliseconds(300);
  std::shared_ptr<PreparedMap> tried;  ///< the one that was made ready for playing, if it could be
  while (true) {
    const auto wanted_now = [this] { return stop_ || waiting_; };
    if (!base_ || base_ == tried || base_->between.load()) {
      changed_.wait(lock, wanted_now);
    } else if (!changed_.wait_for(lock, kIdle, wanted_now)) {
      // Nobody waits: what playing will need is made before.
      const std::shared_ptr<PreparedMap> base = tried = base_;
      lock.unlock();
      try {
        inbetween_of(*base);
      } catch (const std::exception&) {
        // Playing the keyframes will fail in the same way, and say why.
      }
      lock.lock();
      continue;
    }
    if (stop_) return;
    const Scene scene = *std::exchange(waiting_, std::nullopt);
    const bool with_keys = waiting_keys_;
    const std::shared_ptr<PreparedMap> base = base_;
    const unsigned wanted = wanted_, document = document_;
    working_ = true;
    lock.unlock();
    std::shared_ptr<PreparedMap> result;
    std::optional<Error> failure;
    Motion motion;
    double milliseconds = 0;
    try {
      result = prepared_map(scene, Precision::single, options_, base.get());
      const double start = now_ms();
      if (with_keys) motion.follow(scene, result);
      if (const size_t keys = playing_keys(scene).size(); with_keys && keys > 0)
        milliseconds = (now_ms() - start) / static_cast<double>(keys);
    } catch (const Error& error) {
      failure = error;
    } catch (const std::exception& error) {
      failure = Error(ErrorKind::failed, "the map could not be prepared: " + what_of(error));
    }
    lock.lock();
    working_ = false;
    if (result) base_ = result;
    // When the scene has moved on meanwhile, what it was like is shown until the next one is ready;
    // an error of then is not.
    if (document == document_ && (result || wanted == wanted_)) {
      finished_ = true;
      result_ = std::move(result);
      result_motion_ = std::move(motion);
      if (milliseconds > 0) result_milliseconds_ = milliseconds;
      result_scene_ = scene;
      failure_ = std::move(failure);
    }
    changed_.notify_all();
    if (wake_) wake_();
  }
}

void LiveMap::take_result(const Scene& scene, Wanted wanted) {
  const std::lock_guard lock(mutex_);
  busy_ = working_ || waiting_;
  if (!std::exchange(finished_, false)) return;
  error_ = std::move(failure_);
  failed_ = error_.has_value();
  failure_.reset();
  if (!result_) return;
  shown_ = std::move(result_);
  drawn_.reset();
  motion_ = std::exchange(result_motion_, Motion());
  solve_milliseconds_ = std::max(solve_milliseconds_, std::exchange(result_milliseconds_, 0));
  posed_.reset();
  map_ = SampledMap{};
  ++preparation_;
  // Mesh and map always belong together: when the scene has moved on, it is posed as it was asked
  // for.
  pose(same_rest(*result_scene_, scene) ? scene : *result_scene_, wanted);
}

bool LiveMap::pose(const Scene& scene, Wanted wanted) {
  if (!shown_ || (posed_ == scene && posed_wanted_ == wanted && posed_time_ == time_)) return false;
  const double start = now_ms();
  timed_.reset();
  try {
    if (time_ && !scene.keyframes.empty()) motion_.follow(scene, shown_);
    SampledMap map;
    if (time_ && !scene.keyframes.empty() && motion_.plays()) {
      map = map_at_time(scene, wanted);
    } else {
      shown_->deformer->deform(pose_of(scene), map, wanted);
      if (!wanted.draft) solve_milliseconds_ = now_ms() - start;
    }
    map_ = std::move(map);
    error_.reset();
  } catch (const Error& error) {
    error_ = error;
    return false;
  }
  pose_milliseconds_ = now_ms() - start;
  order(scene);
  describe();
  posed_ = scene;
  posed_wanted_ = wanted;
  posed_time_ = time_;
  return true;
}

Points LiveMap::places_at(double time, std::span<const Complex> rest) {
  Points places(rest.begin(), rest.end());
  follow_keys();
  if (!motion_.plays()) return places;
  const VectorXc f = motion_.map_at(time);
  for (Complex& z : places)
    if (const auto at = locate(*shown_->mesh, shown_->mesh->vertices, z))
      z = at->in(*shown_->mesh, {f.data(), static_cast<size_t>(f.size())});
  return places;
}

SampledMap LiveMap::map_at_time(const Scene& scene, Wanted wanted) {
  SampledMap map;
  map.f = motion_.map_at(*time_);
  timed_ = motion_.scene_at(scene, *time_, map.f);
  if (motion_.error()) map.note = "does not play: " + std::string(motion_.error()->what());
  if (!wanted.derivatives) return map;
  VertexDerivatives derivatives = vertex_derivatives(*shown_->mesh, map.f);
  map.fz = std::move(derivatives.fz);
  map.fzbar = std::move(derivatives.fzbar);
  return map;
}

std::optional<Complex> LiveMap::pin_place(const Scene& scene, size_t i) const {
  if (!posed_ || !same_rest(*posed_, scene)) return {};
  if (!has_map() || map_.ignores_pins || i >= shown_->pins.size() || !shown_->pins[i]) return {};
  return shown_->pins[i]->in(*shown_->mesh, {map_.f.data(), static_cast<size_t>(map_.f.size())});
}

/// What there is to say of a map that was just posed.
void LiveMap::describe() {
  const Mesh& mesh = *shown_->mesh;
  injectivity_ = injectivity_of(mesh, map_.f);
  zero_places_.clear();
  for (const Complex& zero : map_.zeros)
    if (const auto at = locate(mesh, mesh.vertices, zero))
      zero_places_.push_back(at->in(mesh, {map_.f.data(), static_cast<size_t>(map_.f.size())}));
}

void LiveMap::clear() {
  shown_.reset();
  drawn_.reset();
  map_ = SampledMap{};
  posed_.reset();
  timed_.reset();
  motion_.clear();
  requested_.reset();
  error_.reset();
  failed_ = false;
  injectivity_ = {};
  zero_places_.clear();
  const std::lock_guard lock(mutex_);
  ++wanted_;
  ++document_;
  waiting_.reset();
  result_.reset();
  finished_ = false;
}

/// Whether the maps at keyframes are wanted and would hold up whoever asks. Keys that were asked
/// for and have none cannot be mapped.
bool LiveMap::needs_worker(const Scene& scene) const {
  constexpr double kNoticed = 50, kShape = 4;  // ms; a key's logarithms
  if (!time_ || !shown_ || busy_ || failed_) return false;
  if (requested_keys_ && requested_->keyframes == scene.keyframes) return false;
  if (posed_time_ && posed_ && posed_->keyframes == scene.keyframes) return false;
  return static_cast<double>(motion_.unknown(scene, shown_)) * (solve_milliseconds_ + kShape) >
         kNoticed;
}

bool LiveMap::update(const Scene& scene, Wanted wanted, std::optional<double> time) {
  const unsigned before = preparation_;
  time_ = time;
  take_result(scene, wanted);
  if (!scene.has_cage()) {
    const bool changed = shown_ != nullptr;
    clear();
    return changed;
  }
  if (!requested_ || !same_rest(*requested_, scene) || needs_worker(scene)) {
    requested_ = scene;
    requested_keys_ = time_.has_value();
    error_.reset();
    failed_ = false;
    const std::lock_guard lock(mutex_);
    ++wanted_;
    waiting_ = scene;
    waiting_keys_ = requested_keys_;
    busy_ = true;
    changed_.notify_all();
    return before != preparation_;
  }
  if (busy_ || failed_) return before != preparation_;
  return pose(scene, wanted) || before != preparation_;
}

void LiveMap::finish(const Scene& scene, Wanted wanted) {
  update(scene, wanted);
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !working_ && !waiting_; });
  }
  update(scene, wanted);
}

}  // namespace holomorph
