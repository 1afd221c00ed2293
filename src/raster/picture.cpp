// Exports use the same mesh and precision as the canvas, so both show the same picture.
#include "raster/picture.h"

#include "core/error.h"
#include "core/maps/distortion.h"
#include "raster/compose.h"
#include "scene/keyframes.h"
#include "scene/layers.h"
#include "scene/motion.h"

namespace holomorph {

RasterResult picture_of(const Scene& scene, const Image* source, const PictureOptions& options,
                        const Pictures& other_pictures) {
  return PictureMaker(scene, source, other_pictures).picture(options);
}

/// One layer, prepared when it is first drawn.
class PictureMaker::LayerMaker {
 public:
  LayerMaker(const Layer& layer, bool linear_blend, const Image* source)
      : layer_(layer),
        deformation_(layer.deformation),
        linear_blend_(linear_blend),
        source_(source) {}

  const Image* source() const { return source_; }
  bool visible() const { return layer_.visible && source_; }
  LayerInk ink() const { return ink_of(layer_); }

  RasterResult picture(const PictureOptions& options, double top) {
    RasterJob job = job_of(options, top);
    if (!deformation_.has_cage()) {
      if (options.view != View::image)
        throw Error(ErrorKind::bad_input, "this view needs a cage, and the scene has none yet");
      return rasterized(job);
    }
    if (!source_ && options.view == View::image)
      throw Error(ErrorKind::bad_input,
                  "the scene has no picture; choose the view checker, angle, area or stretch");
    const SampledMap map = map_at(options.time, is_heat(options.view));
    if (is_heat(options.view)) {
      job.heat = heat_values(options.view, distortion_of(map));
      job.scale = heat_scale(options.view, job.heat, options.automatic_range);
    }
    if (!drawn_) drawn_ = drawn_mesh(prepared_->mesh, depths_of(deformation_));
    job.mesh = drawn_.get();
    job.positions = as_span(map.f);
    return rasterized(job);
  }

  /// The undeformed picture.
  RasterResult original(const PictureOptions& options, double top) const {
    return rasterized(job_of(options, top));
  }

  /// Extends `box` to contain all positions of the mesh during the motion. Returns false if
  /// `keep_going` returns false.
  bool include_motion(Box& box, const std::function<bool()>& keep_going) {
    if (!deformation_.has_cage()) return true;
    const auto map = [&](double time) { return map_at(time, false).f; };
    VectorXc before = map(0);
    for (const Complex& z : before) box.include(z);
    for (const auto& [from, to, held] : motion_.key_intervals()) {
      // A piece that turns by at most 45 degrees is short enough to estimate how the paths bend.
      const double turn = motion_.rotation_at(to) - motion_.rotation_at(from);
      const int pieces =
          held ? 0 : 2 + static_cast<int>(std::min(std::abs(turn) / (kPi / 4), kMaxPieces));
      for (int i = 0; i < pieces; ++i) {
        const double start = from + (to - from) * i / pieces,
                     end = from + (to - from) * (i + 1) / pieces;
        VectorXc after = map(end);
        if (!include_between(start, end, before, after, box, keep_going, kMaxHalvings))
          return false;
        before = std::move(after);
      }
      if (!held) continue;
      before = map(to);
      for (const Complex& z : before) box.include(z);
    }
    return true;
  }
  void include_picture(Box& box) const {
    if (!source_) return;
    box.include(0);
    box.include({static_cast<double>(source_->width), static_cast<double>(source_->height)});
  }

 private:
  static constexpr int kMaxHalvings = 10;
  static constexpr double kMaxPieces = 2000;

  /// Extends `box` to contain the motion from one time to another. Halves the interval until the
  /// path of each vertex hardly bends. The path is then bounded by its ends and its middle, up to a
  /// margin.
  bool include_between(double from, double to, const VectorXc& at_from, const VectorXc& at_to,
                       Box& box, const std::function<bool()>& keep_going, int halves) {
    const double kBend = std::max(1.0, 1e-3 * box.diagonal());  // plane units
    if (!keep_going()) return false;
    const double middle = 0.5 * (from + to);
    const VectorXc at_middle = map_at(middle, false).f;
    // A parabola deviates from the chords of its halves by an eighth of `bend`. The margin below is
    // twice that.
    const double bend = (at_from - 2 * at_middle + at_to).cwiseAbs().maxCoeff();
    if (bend > kBend && halves > 0)
      return include_between(from, middle, at_from, at_middle, box, keep_going, halves - 1) &&
             include_between(middle, to, at_middle, at_to, box, keep_going, halves - 1);
    Box here;
    for (const VectorXc* f : {&at_from, &at_middle, &at_to})
      for (const Complex& z : *f) here.include(z);
    const Complex margin(bend / 4, bend / 4);
    box.include(Complex(here.left, here.bottom) - (bend > 1e-3 ? margin : 0));
    box.include(Complex(here.right, here.top) + (bend > 1e-3 ? margin : 0));
    return true;
  }

  RasterJob job_of(const PictureOptions& options, double top) const {
    RasterJob job;
    job.source = source_;
    job.view = options.view;
    job.pixels_per_unit = options.scale;
    job.region = options.region;
    job.crop = options.crop;
    job.top = top;
    return job;
  }

  SampledMap map_at(const std::optional<double>& time, bool derivatives) {
    if (!prepared_) prepared_ = prepared_map(deformation_, Precision::single, MeshOptions{});
    if (!time || deformation_.keyframes.empty())
      return prepared_->deformer->deform(pose_of(deformation_), {derivatives});
    motion_.follow(deformation_, linear_blend_, prepared_);
    if (motion_.error()) throw Error(*motion_.error());
    if (!motion_.plays()) return map_at({}, derivatives);
    return motion_.sampled_at(*time, derivatives);
  }

  const Layer& layer_;
  const Deformation& deformation_;
  bool linear_blend_;
  const Image* source_;
  std::shared_ptr<PreparedMap> prepared_;
  std::shared_ptr<const Mesh> drawn_;
  Motion motion_;
};

PictureMaker::PictureMaker(const Scene& scene, const Image* source, const Pictures& other_pictures)
    : scene_(scene) {
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    layers_.push_back(
        std::make_unique<LayerMaker>(layer, scene.animation.linear_blend,
                                     i == scene.edited ? source : other_pictures.of(layer)));
  }
}

PictureMaker::~PictureMaker() = default;

Box PictureMaker::rectangle() const {
  Box box;
  for (const auto& layer : layers_)
    if (box.empty() && layer->visible()) layer->include_picture(box);
  return box;
}

RasterResult PictureMaker::picture(const PictureOptions& asked) {
  PictureOptions options = asked;
  if (options.time && has_keyframes(scene_) && !has_playing_keys(scene_)) throw no_key_plays();
  LayerMaker& edited = *layers_[scene_.edited];
  if (options.view != View::image || !has_layers(scene_)) {
    const double top = edited.source() ? edited.source()->height : 0;
    RasterResult result = edited.picture(options, top);
    if (options.view != View::image) return result;
    if (scene_.background.fill == Background::Fill::original)
      result = composed(edited.original(options, top), result, options.scale);
    if (options.crops_to_filled) result = cropped_to_filled(std::move(result), options.scale);
    if (scene_.background.fill == Background::Fill::color)
      composite_onto_color(result.image, scene_.background.color);
    return result;
  }
  const Box rectangle = this->rectangle();
  if (options.crop && !options.region && !rectangle.empty()) options.region = rectangle;
  const double top = rectangle.empty() ? 0 : rectangle.top;
  std::optional<RasterResult> result;
  const auto add = [&](RasterResult over, const LayerInk& ink = {}) {
    if (result) {
      result = composed(std::move(*result), over, options.scale, ink);
    } else {
      fade(over.image, ink);
      result = std::move(over);
    }
  };
  if (scene_.background.fill == Background::Fill::original)
    for (const auto& layer : layers_)
      if (layer->visible() && layer->source()) add(layer->original(options, top));
  for (const auto& layer : layers_)
    if (layer->visible()) add(layer->picture(options, top), layer->ink());
  if (!result) throw Error(ErrorKind::bad_input, "there is nothing to draw: no layer is visible");
  if (options.crops_to_filled) *result = cropped_to_filled(std::move(*result), options.scale);
  if (scene_.background.fill == Background::Fill::color)
    composite_onto_color(result->image, scene_.background.color);
  return std::move(*result);
}

std::optional<Box> PictureMaker::motion_region(const std::function<bool()>& keep_going) {
  Box box;
  for (const auto& layer : layers_)
    if (layer->visible()) layer->include_picture(box);
  for (const auto& layer : layers_)
    if ((layer->visible() || !has_layers(scene_)) && !layer->include_motion(box, keep_going))
      return {};
  // Rounding errors of single-precision operators must not add a row of pixels.
  constexpr double kRounding = 1e-3;
  return Box{box.left + kRounding, box.bottom + kRounding, box.right - kRounding,
             box.top - kRounding};
}

}  // namespace holomorph
