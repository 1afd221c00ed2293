// The deformer evaluates poses. Maps between keyframes come from the motion.
#include "scene/timed_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/cauchy/inside.h"
#include "core/mesh/mesher.h"
#include "core/parallel.h"
#include "scene/budget.h"
#include "scene/keyframes.h"

namespace holomorph {
namespace {

constexpr char kBetween[] = "Between keyframes: blended, not certified";

}  // namespace

TimedMap::TimedMap(const Deformation& deformation, bool linear_blend)
    : deformation_(deformation),
      linear_blend_(linear_blend),
      prepared_(prepared_map(deformation, Precision::full, MeshOptions{})) {}

TimedFrame TimedMap::frame(std::optional<double> time) {
  if (!time || deformation_.keyframes.empty()) return {deformation_, pose_of(deformation_), {}};
  if (playing_keys(deformation_).empty()) throw no_key_plays();
  motion_.follow_at(*time, deformation_, linear_blend_, prepared_);
  if (const Pose* pose = motion_.pose_at(*time)) {
    const Deformation posed = posed_as(deformation_, *pose);
    return {posed, pose_of(posed), {}};
  }
  SampledMap map = motion_.sampled_at(*time, true, true);
  if (map.note.empty()) map.note = kBetween;
  Deformation posed = motion_.deformation_at(deformation_, *time, map.f);
  return {std::move(posed), {}, std::move(map)};
}

SampledMap TimedMap::on_mesh(const TimedFrame& frame) const {
  if (frame.pose) return prepared_->deformer->deform(*frame.pose, {true});
  return frame.between;
}

SampledMap TimedMap::at(const TimedFrame& frame, const Points& points) {
  if (frame.pose) {
    if (!at_points_ || points_ != points) {
      Rest rest = prepared_->rest;
      rest.samples = points_ = points;
      rest.derivative_samples.clear();
      rest.drawn.reset();
      at_points_ = method_named(prepared_->method).prepare(rest, nullptr);
    }
    return at_points_->deform(*frame.pose, {true});
  }
  SampledMap map;
  const std::vector<PointMap::Value> values = motion_.point_map(frame.between)->values_at(points);
  const Index count = static_cast<Index>(points.size());
  for (VectorXc* part : {&map.f, &map.fz, &map.fzbar}) part->resize(count);
  for (Index i = 0; i < count; ++i) {
    const PointMap::Value& value = values[static_cast<size_t>(i)];
    map.f[i] = value.f;
    map.fz[i] = value.fz;
    map.fzbar[i] = value.fzbar;
  }
  map.note = frame.between.note;
  map.status = frame.between.status;
  return map;
}

size_t TimedMap::block_size() const {
  constexpr double kBudgetFraction = 0.25;
  const double controls = static_cast<double>(prepared_->rest.cage.control_count());
  return static_cast<size_t>(std::max(1.0, kBudgetFraction * budget().coordinates / controls));
}

SampledMap TimedMap::values_in_cage(const TimedFrame& frame, const Points& points,
                                    const std::function<void()>& keep_going) {
  const size_t block = block_size();
  SampledMap all;
  for (VectorXc* part : {&all.f, &all.fz, &all.fzbar})
    part->resize(static_cast<Index>(points.size()));
  const Inside cage(deformation_.rest);
  for (size_t first = 0; first < points.size(); first += block) {
    keep_going();
    const size_t count = std::min(block, points.size() - first);
    const auto start = points.begin() + static_cast<std::ptrdiff_t>(first);
    Points some(start, start + static_cast<std::ptrdiff_t>(count));
    // Maps refuse numbers that are not finite.
    std::ranges::replace_if(
        some, [](Complex z) { return !is_moderate(z); }, deformation_.rest.vertex(0));
    const SampledMap map = at(frame, some);
    all.note = map.note;
    all.status = map.status;
    constexpr size_t kTask = 1024;
    parallel_for(static_cast<int>((count + kTask - 1) / kTask), [&](int task) {
      const size_t from = static_cast<size_t>(task) * kTask;
      for (size_t i = from; i < std::min(from + kTask, count); ++i) {
        const Complex z = points[first + i], none(NAN, NAN);
        const bool is_inside = is_moderate(z) && cage.contains(z);
        const auto k = static_cast<Index>(i), n = static_cast<Index>(first + i);
        all.f[n] = is_inside ? map.f[k] : none;
        all.fz[n] = is_inside ? map.fz[k] : none;
        all.fzbar[n] = is_inside ? map.fzbar[k] : none;
      }
    });
  }
  return all;
}

FineMap TimedMap::fine(const TimedFrame& frame, double tolerance,
                       const std::function<void()>& keep_going) const {
  const std::shared_ptr<const Mesh> drawn = drawn_mesh(prepared_->mesh, frame.deformation);
  const std::unique_ptr<PointMap> map = point_map(frame);
  if (!map) {
    const VectorXc f = on_mesh(frame).f;
    return {*drawn, {f.begin(), f.end()}};
  }
  if (map->is_linear_in_triangles()) {
    Points f;
    for (const PointMap::Value& at : map->values_at(drawn->vertices)) f.push_back(at.f);
    return {*drawn, std::move(f)};
  }
  const auto values_at = [&](std::span<const Complex> points) {
    return values_on_all_cores(*map, points, keep_going);
  };
  return fine_map(prepared_->rest.cage, *drawn, tolerance, values_at, map->is_piecewise());
}

std::vector<std::vector<Preimage>> TimedMap::Inverse::at(
    std::span<const Complex> points, const std::function<void(size_t)>& progress) const {
  constexpr size_t kBlock = 64;
  std::vector<std::vector<Preimage>> found(points.size());
  const auto find = [&](int block) {
    const size_t first = static_cast<size_t>(block) * kBlock;
    for (size_t i = first; i < std::min(first + kBlock, points.size()); ++i)
      found[i] = inverse.at(points[i]);
  };
  parallel_for(static_cast<int>((points.size() + kBlock - 1) / kBlock), find, [&](int blocks) {
    if (progress) progress(static_cast<size_t>(blocks) * kBlock);
  });
  return found;
}

std::unique_ptr<PointMap> TimedMap::point_map(const TimedFrame& frame) const {
  if (frame.pose) return prepared_->deformer->point_map(*frame.pose);
  return motion_.point_map(frame.between);
}

std::unique_ptr<TimedMap::Inverse> TimedMap::inverse(const TimedFrame& frame) const {
  std::unique_ptr<PointMap> map = point_map(frame);
  if (!map) return nullptr;
  return std::make_unique<Inverse>(std::move(map), deformation_.rest,
                                   drawn_mesh(prepared_->mesh, frame.deformation),
                                   on_mesh(frame).f);
}

}  // namespace holomorph
