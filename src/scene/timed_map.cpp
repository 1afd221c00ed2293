// Poses are asked of the deformer; what lies between keyframes is known on the mesh.
#include "scene/timed_map.h"

#include <utility>

#include "core/mesh/mesher.h"
#include "scene/keyframes.h"

namespace holomorph {
namespace {

/// A map that is linear in each triangle of a mesh.
class MeshPointMap final : public PointMap {
 public:
  MeshPointMap(std::shared_ptr<const Mesh> mesh, VectorXc f)
      : mesh_(std::move(mesh)), f_(std::move(f)) {}

  Value at(Complex z) const override {
    const Location place = locate_near(*mesh_, z);
    const Triangle& t = mesh_->triangles[static_cast<size_t>(place.triangle)];
    const auto [fz, fzbar] = derivatives_in(*mesh_, t, f_);
    return {place.in(*mesh_, {f_.data(), static_cast<size_t>(f_.size())}), fz, fzbar};
  }

 private:
  std::shared_ptr<const Mesh> mesh_;
  VectorXc f_;
};

constexpr char kBetween[] = "Between keyframes: blended, and not proved";

}  // namespace

TimedMap::TimedMap(const Scene& scene)
    : scene_(scene), prepared_(prepared_map(scene, Precision::full, MeshOptions{})) {}

TimedMap::Frame TimedMap::frame(std::optional<double> time) {
  if (!time || scene_.keyframes.empty()) return {scene_, pose_of(scene_), {}};
  if (playing_keys(scene_).empty()) throw no_key_plays();
  motion_.follow(scene_, prepared_);
  if (motion_.error()) throw Error(*motion_.error());
  if (const Pose* pose = motion_.pose_at(*time)) {
    const Scene posed = posed_as(scene_, *pose);
    return {posed, pose_of(posed), {}};
  }
  VectorXc f = motion_.map_at(*time);
  Scene posed = motion_.scene_at(scene_, *time, f);
  return {std::move(posed), {}, std::move(f)};
}

SampledMap TimedMap::on_mesh(const Frame& frame) const {
  SampledMap map;
  if (frame.pose) {
    prepared_->deformer->deform(*frame.pose, map, {true});
    return map;
  }
  map.f = frame.between;
  VertexDerivatives slopes = vertex_derivatives(*prepared_->mesh, map.f);
  map.fz = std::move(slopes.fz);
  map.fzbar = std::move(slopes.fzbar);
  map.note = kBetween;
  return map;
}

SampledMap TimedMap::at(const Frame& frame, const Points& points) {
  SampledMap map;
  if (frame.pose) {
    if (!at_points_ || points_ != points) {
      Rest rest = prepared_->rest;
      rest.samples = points_ = points;
      rest.derivative_samples.clear();
      at_points_ = method_named(prepared_->method).prepare(rest, nullptr);
    }
    at_points_->deform(*frame.pose, map, {true});
    return map;
  }
  const MeshPointMap between(prepared_->mesh, frame.between);
  const Index count = static_cast<Index>(points.size());
  for (VectorXc* part : {&map.f, &map.fz, &map.fzbar}) part->resize(count);
  for (Index i = 0; i < count; ++i) {
    const PointMap::Value value = between.at(points[static_cast<size_t>(i)]);
    map.f[i] = value.f;
    map.fz[i] = value.fz;
    map.fzbar[i] = value.fzbar;
  }
  map.note = kBetween;
  return map;
}

std::unique_ptr<TimedMap::Inverse> TimedMap::inverse(const Frame& frame) const {
  std::unique_ptr<PointMap> map;
  if (frame.pose)
    map = prepared_->deformer->point_map(*frame.pose);
  else
    map = std::make_unique<MeshPointMap>(prepared_->mesh, frame.between);
  if (!map) return nullptr;
  const VectorXc f = frame.pose ? on_mesh(frame).f : frame.between;
  return std::make_unique<Inverse>(std::move(map), scene_.rest, mesh(), f);
}

}  // namespace holomorph
