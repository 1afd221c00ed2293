// Poses are asked of the deformer; what lies between keyframes is known on the mesh.
#include "scene/timed_map.h"

#include <algorithm>
#include <utility>

#include "core/distortion.h"
#include "core/mesher.h"
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
    Value value{};
    double area = 0;
    for (size_t a = 0; a < 3; ++a) {
      const Complex side = vertex(t[(a + 2) % 3]) - vertex(t[(a + 1) % 3]);
      value.f += place.weights[a] * f_[t[a]];
      value.fz += -kI * std::conj(side) * f_[t[a]];
      value.fzbar += kI * side * f_[t[a]];
    }
    area = cross(vertex(t[1]) - vertex(t[0]), vertex(t[2]) - vertex(t[0]));
    value.fz /= 2 * area;
    value.fzbar /= 2 * area;
    return value;
  }

 private:
  Complex vertex(int v) const { return mesh_->vertices[static_cast<size_t>(v)]; }

  std::shared_ptr<const Mesh> mesh_;
  VectorXc f_;
};

}  // namespace

TimedMap::TimedMap(const Scene& scene)
    : scene_(scene), prepared_(prepared_map(scene, Precision::full, MeshOptions{})) {}

TimedMap::Frame TimedMap::frame(std::optional<double> time) {
  Frame frame;
  frame.scene = scene_;
  frame.pose = pose_of(scene_);
  if (time && !scene_.keyframes.empty()) {
    motion_.follow(scene_, prepared_);
    if (motion_.error()) throw Error(*motion_.error());
    if (motion_.plays()) {
      frame.map.f = motion_.map_at(*time);
      frame.scene = motion_.scene_at(scene_, *time, frame.map.f);
      const std::vector<size_t> keys = playing_keys(scene_);
      const double at = std::clamp(*time, scene_.keyframes[keys.front()].time,
                                   scene_.keyframes[keys.back()].time);
      frame.pose.reset();
      for (const size_t key : keys)
        if (std::abs(scene_.keyframes[key].time - at) < 1e-9)
          frame.pose = pose_of(posed_as(scene_, scene_.keyframes[key].pose));
    }
  }
  if (frame.pose) {
    prepared_->deformer->deform(*frame.pose, frame.map, {true});
    return frame;
  }
  VertexDerivatives slopes = vertex_derivatives(*prepared_->mesh, frame.map.f);
  frame.map.fz = std::move(slopes.fz);
  frame.map.fzbar = std::move(slopes.fzbar);
  frame.map.note = "Between keyframes: blended, and not proved";
  return frame;
}

SampledMap TimedMap::at(const Frame& frame, const Points& points) const {
  SampledMap map;
  if (frame.pose) {
    Rest rest = prepared_->rest;
    rest.samples = points;
    rest.derivative_samples.clear();
    method_named(prepared_->method).prepare(rest, nullptr)->deform(*frame.pose, map, {true});
    return map;
  }
  const MeshPointMap between(prepared_->mesh, frame.map.f);
  const Index count = static_cast<Index>(points.size());
  map.f.resize(count);
  map.fz.resize(count);
  map.fzbar.resize(count);
  for (Index i = 0; i < count; ++i) {
    const PointMap::Value value = between.at(points[static_cast<size_t>(i)]);
    map.f[i] = value.f;
    map.fz[i] = value.fz;
    map.fzbar[i] = value.fzbar;
  }
  map.note = frame.map.note;
  return map;
}

std::unique_ptr<PointMap> TimedMap::point_map(const Frame& frame) const {
  if (frame.pose) return prepared_->deformer->point_map(*frame.pose);
  return std::make_unique<MeshPointMap>(prepared_->mesh, frame.map.f);
}

}  // namespace holomorph
