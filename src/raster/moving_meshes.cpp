// Positions come from the method at full precision, as `holomorph map` prints them.
#include "raster/moving_meshes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "core/error.h"
#include "core/mesh/coarser.h"
#include "raster/bleed.h"
#include "raster/fewest_frames.h"
#include "scene/attachments.h"
#include "scene/fringe.h"
#include "scene/keyframes.h"
#include "scene/layers.h"
#include "scene/timed_map.h"

namespace holomorph {
namespace {

using Time = std::optional<double>;

/// One layer's map at any time, and the mesh that is exported of it.
class LayerMesh {
 public:
  LayerMesh(const Layer& layer, bool linear_blend, const Image* picture,
            const MovingMeshOptions& options)
      : layer_(layer) {
    if (!layer.deformation.has_cage()) {
      set_plain(picture);
      return;
    }
    map_ = std::make_unique<TimedMap>(layer.deformation, linear_blend);
    rest_ = map_->mesh().vertices;
    std::shared_ptr<const Mesh> drawn = map_->prepared().mesh;
    for (size_t v = 0; v < rest_.size(); ++v) kept_.push_back(static_cast<int>(v));
    if (options.vertices && *options.vertices < rest_.size())
      coarser_ = coarser_mesh(*drawn, *options.vertices, some_poses(options));
    else if (options.vertex_tolerance)
      choose_fewest_vertices(*drawn, options);
    if (coarser_) {
      kept_ = coarser_->kept;
      drawn = std::make_shared<const Mesh>(coarser_->mesh);
    }
    if (!options.edited_only) drawn = drawn_mesh(drawn, layer.deformation);
    triangles_ = drawn->triangles;
    if (!options.edited_only && picture) fringe_ = fringe_of(map_->mesh(), *picture);
  }

  /// The positions of the layer's own mesh in its own plane.
  const Points& positions(const Time& time) {
    if (!map_) return rest_;
    if (const auto known = known_.find(time); known != known_.end()) return known->second;
    constexpr size_t kMostBytes = size_t{256} << 20;
    if ((known_.size() + 1) * rest_.size() * sizeof(Complex) > kMostBytes) known_.clear();
    const VectorXc f = map_->on_mesh(map_->frame(time)).f;
    return known_.emplace(time, Points(f.begin(), f.end())).first->second;
  }

  Similarity motion(const Time& time, const Attachment& attachment) {
    if (!map_) return {};
    if (!anchor_ || !anchor_->is_for(map_->prepared().mesh, layer_.deformation, attachment))
      anchor_.emplace(map_->prepared().mesh, layer_.deformation, attachment);
    return anchor_->motion(positions(time));
  }

  /// The exported mesh, without frames.
  MovingMesh mesh() const {
    MovingMesh mesh;
    mesh.opacity = layer_.opacity;
    for (const int v : kept_) mesh.rest.push_back(rest_[static_cast<size_t>(v)]);
    if (fringe_) {
      const int first = static_cast<int>(kept_.size());
      mesh.rest.insert(mesh.rest.end(), fringe_->mesh.vertices.begin(),
                       fringe_->mesh.vertices.end());
      for (const Triangle& t : fringe_->mesh.triangles)  // below the cut-out itself
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    mesh.triangles.insert(mesh.triangles.end(), triangles_.begin(), triangles_.end());
    return mesh;
  }

  /// The positions of the exported mesh's vertices in the layer's own plane.
  Points exported(const Time& time) {
    const Points& all = positions(time);
    Points kept;
    for (const int v : kept_) kept.push_back(all[static_cast<size_t>(v)]);
    if (fringe_) {
      const Points around = fringe_->positions(all);
      kept.insert(kept.end(), around.begin(), around.end());
    }
    return kept;
  }

  /// The largest distance between the layer's own mesh at a time and the exported one with these
  /// positions.
  double distance(const Time& time, const Points& exported) {
    const Points& all = positions(time);
    const std::span<const Complex> kept(exported.data(),
                                        coarser_ ? coarser_->kept.size() : rest_.size());
    double farthest = 0;
    for (size_t v = 0; v < all.size(); ++v) {
      const Complex there = coarser_ ? coarser_->locations[v].in(coarser_->mesh, kept) : kept[v];
      farthest = std::max(farthest, std::abs(there - all[v]));
    }
    return farthest;
  }

 private:
  /// The positions at about 24 of the times and near some of the keyframes, or in the scene's own
  /// pose.
  std::vector<Points> some_poses(const MovingMeshOptions& options) {
    if (options.times.empty()) return {positions({})};
    constexpr size_t kSome = 24;
    std::set<double> chosen{options.times.back()};
    const size_t step = 1 + options.times.size() / kSome;
    for (size_t i = 0; i < options.times.size(); i += step) chosen.insert(options.times[i]);
    const std::vector<Keyframe>& keys = layer_.deformation.keyframes;
    for (size_t k = 0; k < keys.size(); k += 1 + keys.size() / kSome)
      if (const auto time = std::ranges::lower_bound(options.times, keys[k].time);
          time != options.times.end())
        chosen.insert(*time);
    std::vector<Points> poses;
    for (const double time : chosen) poses.push_back(positions(time));
    return poses;
  }

  /// Chooses a mesh that is close at some of the times, and adds the times at which it is not close
  /// until there are none. If there are always some, all vertices stay.
  void choose_fewest_vertices(const Mesh& all, const MovingMeshOptions& options) {
    constexpr int kRounds = 12;
    constexpr size_t kAtOnce = 8;
    constexpr double kSlack = 1.25;  // for errors that are only just too large
    // Errors are measured where the layer lies.
    const double tolerance = *options.vertex_tolerance / std::abs(layer_.placement.factor);
    std::vector<Points> poses = some_poses(options);
    for (int round = 0; round < kRounds; ++round) {
      coarser_ = coarsest_mesh(all, poses, tolerance);
      std::vector<std::pair<double, double>> off;  // how far, and when
      for (const double time : options.times) {
        Points kept;
        const Points& here = positions(time);
        for (const int v : coarser_->kept) kept.push_back(here[static_cast<size_t>(v)]);
        const double far = distance(time, kept);
        if (far > kSlack * tolerance) off.emplace_back(far, time);
      }
      if (off.empty()) return;
      std::ranges::sort(off, std::greater<>{});
      for (size_t i = 0; i < std::min(kAtOnce, off.size()); ++i)
        poses.push_back(positions(off[i].second));
    }
    coarser_.reset();
  }

  /// The rectangle of a picture without a cage.
  void set_plain(const Image* picture) {
    if (!picture) return;
    const auto corners = picture->box().corners();
    rest_ = {corners.begin(), corners.end()};
    kept_ = {0, 1, 2, 3};
    triangles_ = {{0, 1, 2}, {0, 2, 3}};
  }

  const Layer& layer_;
  std::unique_ptr<TimedMap> map_;  ///< null without a cage
  Points rest_;
  std::vector<int> kept_;               ///< the exported vertices of the layer's own mesh
  std::optional<CoarserMesh> coarser_;  ///< none if all are exported
  std::vector<Triangle> triangles_;
  std::shared_ptr<const Fringe> fringe_;
  std::map<Time, Points> known_;  ///< the last positions
  std::optional<Anchor> anchor_;
};

/// A picture with transparent pixels around it.
Image with_border(const Image& picture) {
  Image larger(picture.width + 2, picture.height + 2);
  larger.left = picture.left - 1;
  larger.bottom = picture.bottom - 1;
  for (int r = 0; r < picture.height; ++r)
    std::copy_n(picture.at(0, r), 4 * picture.width, larger.at(1, r + 1));
  return larger;
}

/// The picture with the colors of its edge carried on into the transparent pixels, which engines
/// mix into the edge. Beyond a texture, engines repeat its outermost pixels, so these are
/// transparent if the mesh is larger than the picture.
Image texture_of(const Image& picture, const Points& mesh) {
  constexpr double kReach = 8;  // pixels
  const Box box = picture.box();
  const bool is_inside = std::ranges::all_of(mesh, [&](Complex z) { return box.contains(z); });
  Image texture = is_inside ? picture : with_border(picture);
  std::vector<bool> filled;
  for (size_t i = 3; i < texture.pixels.size(); i += 4) filled.push_back(texture.pixels[i] > 0);
  bleed(texture, filled, kReach, [](int, int) { return false; });
  return texture;
}

/// The exporter's state: the layers, and what has been exported of them.
class Exporter {
 public:
  Exporter(const Scene& scene, const Image* picture, const Pictures& others,
           const MovingMeshOptions& options)
      : scene_(scene),
        picture_(picture),
        others_(others),
        options_(options),
        layers_(scene.layers.size()) {
    for (size_t i = 0; i < scene.layers.size(); ++i) {
      if (options.edited_only ? i != scene.edited : !is_shown(scene, i)) continue;
      MovingMesh mesh = layer(i).mesh();
      if (mesh.rest.empty()) continue;
      mesh.name = title_of_layer(scene, i);
      if (const Image* own = picture_of_layer(i)) mesh.texture = texture_of(*own, mesh.rest);
      meshes_.push_back(std::move(mesh));
      exported_.push_back(i);
    }
    if (meshes_.empty())
      throw Error(ErrorKind::bad_input, "there is nothing to export: no visible layer has a mesh");
  }

  /// The positions of all meshes at a time.
  std::vector<Points> positions(const Time& time) {
    std::vector<Points> all;
    for (const size_t i : exported_) {
      all.push_back(layer(i).exported(time));
      const Similarity placed = placement(i, time);
      for (Complex& z : all.back()) z = placed(z);
    }
    return all;
  }

  void add_frame(const Time& time, std::vector<Points> positions) {
    for (size_t k = 0; k < meshes_.size(); ++k) {
      const size_t i = exported_[k];
      frame_error_ = std::max(frame_error_, error(i, time, layer(i).exported(time)));
      meshes_[k].frames.push_back(std::move(positions[k]));
    }
  }

  /// Measures the error at a time between two frames.
  void check(double time, const std::vector<double>& times) {
    const auto after = std::ranges::upper_bound(times, time);
    if (after == times.begin() || after == times.end()) return;
    const auto next = static_cast<size_t>(after - times.begin());
    const double u = (time - times[next - 1]) / (times[next] - times[next - 1]);
    for (size_t k = 0; k < meshes_.size(); ++k) {
      const size_t i = exported_[k];
      const Points &from = meshes_[k].frames[next - 1], &to = meshes_[k].frames[next];
      // Back to the layer's own plane, in which it is compared.
      const Similarity back = inverse(placement(i, time));
      Points between;
      for (size_t v = 0; v < from.size(); ++v)
        between.push_back(back((1 - u) * from[v] + u * to[v]));
      error_ = std::max(error_, error(i, time, between));
    }
  }

  MovingMeshes result(std::vector<double> times) && {
    return {std::move(times), std::move(meshes_), frame_error_, std::max(error_, frame_error_)};
  }

 private:
  const Image* picture_of_layer(size_t number) const {
    return number == scene_.edited ? picture_ : others_.of(*scene_.layers[number]);
  }

  /// A layer, prepared when it is first needed: hidden layers may carry others.
  LayerMesh& layer(size_t number) {
    std::unique_ptr<LayerMesh>& known = layers_[number];
    if (!known)
      known = std::make_unique<LayerMesh>(*scene_.layers[number], scene_.animation.linear_blend,
                                          picture_of_layer(number), options_);
    return *known;
  }

  double error(size_t number, const Time& time, const Points& points) {
    return std::abs(placement(number, time).factor) * layer(number).distance(time, points);
  }

  Similarity placement(size_t number, const Time& time) {
    if (options_.edited_only) return {};
    return placement_of(scene_, number, [&](size_t child) {
      const Layer& it = *scene_.layers[child];
      return layer(*parent_of(scene_, it)).motion(time, *it.attachment);
    });
  }

  const Scene& scene_;
  const Image* picture_;  ///< of the edited layer
  const Pictures& others_;
  const MovingMeshOptions& options_;
  std::vector<std::unique_ptr<LayerMesh>> layers_;  ///< null until needed
  std::vector<MovingMesh> meshes_;
  std::vector<size_t> exported_;  ///< the layer of each mesh
  double frame_error_ = 0, error_ = 0;
};

}  // namespace

MovingMeshes moving_meshes_of(const Scene& scene, const Image* picture, const Pictures& others,
                              const MovingMeshOptions& options,
                              const std::function<void(size_t done, size_t all)>& step) {
  if (!options.times.empty() && has_keyframes(scene) && !has_playing_keys(scene))
    throw no_key_plays();
  Exporter exporter(scene, picture, others, options);
  std::vector<double> times = options.times;
  if (times.empty()) {
    exporter.add_frame({}, exporter.positions({}));
    return std::move(exporter).result({0});
  }
  const bool chooses = options.frame_tolerance.has_value();
  const size_t all = (chooses ? 2 : 1) * times.size() + options.checked.size();
  size_t done = 0;
  const auto positions_at = [&](double time) {
    step(std::min(done++, all), all);
    return exporter.positions(time);
  };
  if (chooses) {
    Frames frames = fewest_frames(times, *options.frame_tolerance, positions_at);
    times = std::move(frames.times);
    for (size_t i = 0; i < times.size(); ++i)
      exporter.add_frame(times[i], std::move(frames.positions[i]));
  } else {
    for (const double time : times) exporter.add_frame(time, positions_at(time));
  }
  for (const double time : options.checked) {
    step(std::min(done++, all), all);
    exporter.check(time, times);
  }
  return std::move(exporter).result(std::move(times));
}

}  // namespace holomorph
