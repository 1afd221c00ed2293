// Exports use the same mesh and precision as the canvas, so both show the same picture.
#include "raster/picture.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/maps/distortion.h"
#include "raster/compose.h"
#include "raster/motion_box.h"
#include "scene/attachments.h"
#include "scene/clips.h"
#include "scene/fringe.h"
#include "scene/keyframes.h"
#include "scene/layers.h"
#include "scene/motion.h"
#include "scene/original.h"

namespace holomorph {

namespace {

/// Adds the corners of a box that was moved.
void add_corners(VectorXc& points, const Box& box, const Similarity& moved) {
  const Index count = points.size();
  points.conservativeResize(count + 4);
  std::ranges::transform(box.corners(), points.begin() + count, moved);
}

}  // namespace

RasterResult picture_of(const Scene& scene, const Image* source, const PictureOptions& options,
                        const Pictures& other_pictures) {
  return PictureMaker(scene, source, other_pictures).picture(options);
}

/// One layer, prepared when it is first drawn.
class PictureMaker::LayerMaker {
 public:
  LayerMaker(const Layer& layer, bool linear_blend, const Image* source,
             std::shared_ptr<Footage> footage)
      : layer_(layer),
        deformation_(layer.deformation),
        linear_blend_(linear_blend),
        given_(source),
        source_(source),
        footage_(std::move(footage)) {
    if (source) page_ = source->page();
  }

  void show(const Image& picture) {
    const auto& image = layer_.image;
    if (!source_)
      page_ = image && image->width > 0 && image->height > 0 ? image->page() : picture.page();
    source_ = &picture;
    footage_.reset();
    forget_pixels();
  }

  /// Shows the frame of the layer's film at a time, if the layer has one; without a time, the
  /// picture that was given.
  void show_frame(const std::optional<double>& time) {
    if (!footage_) return;
    if (!time) {
      if (source_ != given_) forget_pixels();
      source_ = given_;
      frame_.reset();
      return;
    }
    auto frame = footage_->frame(clip_frame_at(*clip_of(layer_), *time));
    if (frame == frame_) return;
    frame_ = std::move(frame);
    source_ = frame_.get();
    forget_pixels();
  }

  const Image* source() const { return source_; }
  bool visible() const { return layer_.visible && source_; }

  RasterResult picture(const Frame& frame, const Similarity& placement) {
    const PictureOptions& options = frame.options;
    show_frame(options.time);
    RasterJob job = job_of(options, frame.top);
    job.stage = frame.stage;
    job.placement = placement;
    if (!deformation_.has_cage()) {
      if (options.view != View::image)
        throw Error(ErrorKind::bad_input, "this view needs a cage, and the scene has none yet");
      return rasterized(job);
    }
    if (!source_ && options.view == View::image)
      throw Error(ErrorKind::bad_input,
                  "the scene has no picture; choose the view checker, angle, area or stretch");
    if (is_heat(options.view)) {
      const SampledMap map = map_at(options.time, true);
      job.heat = heat_values(options.view, distortion_of(map));
      job.scale = heat_scale(options.view, job.heat, options.automatic_range);
      keep(options.time, map.f);
    }
    const VectorXc& f = positions_at(options.time);
    if (!drawn_) drawn_ = drawn_mesh(prepared_->mesh, deformation_);
    job.mesh = drawn_.get();
    job.positions = as_span(f);
    Points around;
    if (const Fringe* fringe = this->fringe()) {
      around = fringe->positions(as_span(f));
      job.fringe = &fringe->mesh;
      job.fringe_positions = around;
    }
    return rasterized(job);
  }

  /// The rectangle of the picture, or of the canvas on which it lies.
  const Box& page() const { return page_; }

  /// The undeformed picture.
  RasterResult original(const Frame& frame, const Similarity& placement) {
    show_frame(frame.options.time);
    RasterJob job = job_of(frame.options, frame.top);
    job.stage = frame.stage;
    job.placement = placement;
    return rasterized(job);
  }
  std::optional<Similarity> placing_motion(const std::optional<double>& time) {
    if (!source_ || !deformation_.has_cage()) return Similarity{};
    const VectorXc& f = positions_at(time);
    return holomorph::placing_motion(deformation_, is_resized() ? page_ : source_->box(),
                                     *prepared_->mesh, as_span(f));
  }
  /// Whether the undeformed picture covers its rectangle.
  bool is_opaque(const std::optional<double>& time) {
    show_frame(time);
    if (!opaque_) opaque_ = source_ && holomorph::is_opaque(*source_);
    return *opaque_;
  }

  /// How the layer moves what is attached to it.
  Similarity motion(const std::optional<double>& time, const Attachment& attachment) {
    if (!deformation_.has_cage()) return {};
    const VectorXc& f = positions_at(time);
    auto known = std::ranges::find(anchors_, attachment, &std::pair<Attachment, Anchor>::first);
    if (known == anchors_.end())
      known =
          anchors_.insert(known, {attachment, Anchor(prepared_->mesh, deformation_, attachment)});
    return known->second.motion(as_span(f));
  }

  /// The intervals between the keys that play.
  std::vector<Motion::KeyInterval> key_intervals() {
    if (deformation_.keyframes.empty() || !deformation_.has_cage()) return {};
    prepare();
    motion_.follow(deformation_, linear_blend_, prepared_);
    if (motion_.error()) throw Error(*motion_.error());
    return motion_.key_intervals();
  }
  /// How many pieces of an interval are short enough to estimate how paths bend: each turns by at
  /// most 45 degrees.
  int pieces_between(double from, double to) {
    if (key_intervals().empty()) return 0;
    constexpr double kMaxPieces = 2000;
    const double turn = motion_.rotation_between(from, to);
    return 2 + static_cast<int>(std::min(std::abs(turn) / (kPi / 4), kMaxPieces));
  }

  /// What determines the extent of the layer at a time, in its own plane: the positions of the
  /// mesh, and the corners of the picture if it moves as a whole.
  VectorXc extent_at(double time, bool with_picture) {
    VectorXc points = deformation_.has_cage() ? positions_at(time) : VectorXc();
    if (const Fringe* fringe = this->fringe()) {
      const Points around = fringe->positions(as_span(points));
      const Index count = points.size();
      points.conservativeResize(count + static_cast<Index>(around.size()));
      std::ranges::copy(around, points.begin() + count);
    }
    if (with_picture && source_)
      add_corners(points, is_resized() ? page_ : source_->box(), Similarity{});
    return points;
  }
  void include_page(Box& box, const Similarity& placement) const {
    if (!source_) return;
    for (const Complex& z : page_.corners()) box.include(placement(z));
  }

 private:
  /// The map without derivatives. It is kept, because layers that follow this one ask for the same
  /// time again, and so does a film that first looks for the pixels that are filled.
  const VectorXc& positions_at(const std::optional<double>& time) {
    const auto known = positions_.find(moment(time));
    return known != positions_.end() ? known->second : keep(time, map_at(time, false).f);
  }

  const VectorXc& keep(const std::optional<double>& time, VectorXc positions) {
    constexpr size_t kMostKept = size_t{1} << 27;  // bytes
    const size_t each = sizeof(Complex) * static_cast<size_t>(positions.size());
    if (positions_.size() > 1 && (positions_.size() + 1) * each > kMostKept)
      positions_.erase(newest_);  // the first times of a film are asked for first again
    newest_ = moment(time);
    return positions_.insert_or_assign(newest_, std::move(positions)).first->second;
  }

  /// Without keyframes, all times have the same map.
  std::optional<double> moment(const std::optional<double>& time) const {
    return deformation_.keyframes.empty() ? std::nullopt : time;
  }

  RasterJob job_of(const PictureOptions& options, double top) const {
    RasterJob job;
    job.source = source_;
    if (is_resized()) job.box = page_;
    job.view = options.view;
    job.pixels_per_unit = options.scale;
    job.region = options.region;
    job.crop = options.crop;
    job.top = top;
    job.fine = options.fine;
    return job;
  }

  void prepare() {
    if (!prepared_) prepared_ = prepared_map(deformation_, Precision::single, MeshOptions{});
  }

  SampledMap map_at(const std::optional<double>& time, bool derivatives) {
    prepare();
    if (!time || deformation_.keyframes.empty())
      return prepared_->deformer->deform(pose_of(deformation_), {derivatives});
    motion_.follow_at(*time, deformation_, linear_blend_, prepared_);
    if (!motion_.plays()) return map_at({}, derivatives);
    return motion_.sampled_at(*time, derivatives);
  }

  /// The fringe of the picture; null if it has none. The map must have been prepared.
  const Fringe* fringe() {
    if (!source_ || !prepared_) return nullptr;
    if (!fringe_) fringe_ = new_fringe();
    return fringe_->get();
  }

  std::shared_ptr<const Fringe> new_fringe() const {
    if (!is_resized()) return fringe_of(*prepared_->mesh, *source_);
    if (holomorph::is_opaque(*source_)) return nullptr;  // saves resizing the frames of a film
    RasterResult resized = rasterized(job_of({}, page_.top));
    resized.image.left = static_cast<int>(std::lround(resized.corner.real()));
    resized.image.bottom = static_cast<int>(std::lround(resized.corner.imag()));
    return fringe_of(*prepared_->mesh, resized.image);
  }

  /// Another picture is shown.
  void forget_pixels() {
    fringe_.reset();
    opaque_.reset();
  }

  /// Whether the picture is shown in place of one with another page, which it then fills.
  bool is_resized() const { return source_ && source_->page() != page_; }

  const Layer& layer_;
  const Deformation& deformation_;
  bool linear_blend_;
  const Image* given_;                  ///< the source at first
  const Image* source_;                 ///< the picture that is drawn
  std::shared_ptr<Footage> footage_;    ///< null: the source does not move
  std::shared_ptr<const Image> frame_;  ///< the source, if it is a frame of the film
  Box page_{0, 0, 0, 0};
  std::shared_ptr<PreparedMap> prepared_;
  std::shared_ptr<const Mesh> drawn_;
  std::optional<std::shared_ptr<const Fringe>> fringe_;  ///< null: there is none
  std::optional<bool> opaque_;
  Motion motion_;
  std::map<std::optional<double>, VectorXc> positions_;  ///< by time
  std::optional<double> newest_;                         ///< the time that was added last
  std::vector<std::pair<Attachment, Anchor>> anchors_;
};

PictureMaker::PictureMaker(const Scene& scene, const Image* source, const Pictures& other_pictures)
    : scene_(scene) {
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    layers_.push_back(std::make_unique<LayerMaker>(
        layer, scene.animation.linear_blend, i == scene.edited ? source : other_pictures.of(layer),
        other_pictures.footage(layer)));
  }
}

PictureMaker::~PictureMaker() = default;

void PictureMaker::show(const Image& picture) {
  layers_[scene_.edited]->show(picture);
}

Box PictureMaker::rectangle() const {
  Box box;
  for (size_t i = 0; i < layers_.size(); ++i)
    if (box.empty() && layers_[i]->visible())
      layers_[i]->include_page(box, scene_.layers[i]->placement);
  return box;
}

PictureMaker::Frame PictureMaker::frame_of(const PictureOptions& options) const {
  Frame frame{options};
  if (options.view != View::image || !has_layers(scene_)) {
    frame.stage = layers_[scene_.edited]->page();
    frame.top = frame.stage->top;
    return frame;
  }
  const Box rectangle = this->rectangle();
  if (options.crop && !options.region && !rectangle.empty()) frame.options.region = rectangle;
  frame.top = rectangle.empty() ? 0 : rectangle.top;
  if (!rectangle.empty()) frame.stage = rectangle;
  return frame;
}

std::optional<RasterResult> PictureMaker::layer(size_t number, const PictureOptions& options) {
  if (!layers_[number]->source()) return {};
  const Frame frame = frame_of(options);
  return layers_[number]->picture(frame, placement(number, options.time));
}

std::optional<RasterResult> PictureMaker::original(size_t number, const PictureOptions& options) {
  LayerMaker& layer = *layers_[number];
  const auto placement = original_placement(number, options.time);
  if (!layer.source() || !placement) return {};
  return layer.original(frame_of(options), *placement);
}

bool PictureMaker::has_opaque_originals(const std::optional<double>& time) {
  for (size_t i = 0; i < layers_.size(); ++i) {
    if (!draws(i)) continue;
    if (is_blended(*scene_.layers[i]) || !layers_[i]->is_opaque(time)) return false;
    const auto placement = original_placement(i, time);
    if (!placement || !is_identity(*placement)) return false;
  }
  return true;
}

bool PictureMaker::may_have_gaps(size_t layer, const std::optional<double>& time) {
  return scene_.layers[layer]->deformation.has_cage() ||
         original_placement(layer, time) != placement(layer, time);
}

LayerStack PictureMaker::stack(const PictureOptions& options, bool with_originals) {
  const Frame frame = frame_of(options);
  const bool whole = with_originals && has_opaque_originals(options.time);
  LayerStack stack(options.scale, whole ? Originals::whole : Originals::in_gaps);
  for (size_t i = 0; i < layers_.size(); ++i) {
    if (!draws(i)) continue;
    std::optional<RasterResult> original;
    if (with_originals && may_have_gaps(clip_base(scene_, i).value_or(i), options.time))
      original = this->original(i, options);
    stack.add(layers_[i]->picture(frame, placement(i, options.time)), ink_of(scene_, i),
              std::move(original));
  }
  return stack;
}

std::optional<RasterResult> PictureMaker::behind(const PictureOptions& options) {
  return stack(options, true).behind();
}

RasterResult PictureMaker::picture(const PictureOptions& options) {
  if (options.time && has_keyframes(scene_) && !has_playing_keys(scene_) && !has_clips(scene_))
    throw no_key_plays();
  if (options.view != View::image)
    return layers_[scene_.edited]->picture(frame_of(options),
                                           placement(scene_.edited, options.time));
  LayerStack layers = stack(options, scene_.background.fill == Background::Fill::original);
  if (layers.empty())
    throw Error(ErrorKind::bad_input, "there is nothing to draw: no layer is visible");
  RasterResult result = std::move(layers).result();
  if (options.crops_to_filled) result = cropped_to_filled(std::move(result), options.scale);
  if (scene_.background.fill == Background::Fill::color)
    composite_onto_color(result.image, scene_.background.color);
  return result;
}

bool PictureMaker::draws(size_t layer) const {
  if (!has_layers(scene_)) return true;
  const std::optional<size_t> base = clip_base(scene_, layer);
  return layers_[layer]->visible() && (!base || layers_[*base]->visible());
}

Similarity PictureMaker::placement(size_t layer, const std::optional<double>& time) {
  return placement_of(scene_, layer, [&](size_t child) {
    const Layer& it = *scene_.layers[child];
    return layers_[*parent_of(scene_, it)]->motion(time, *it.attachment);
  });
}

std::optional<Similarity> PictureMaker::original_placement(size_t layer,
                                                           const std::optional<double>& time) {
  size_t lowest = 0;
  while (lowest < layer && !layers_[lowest]->source()) ++lowest;
  return holomorph::original_placement(scene_, layer, lowest,
                                       [&](size_t i) { return layers_[i]->placing_motion(time); });
}

/// The parts of a layer's motion: between the keys of the layer itself and of those that carry it.
std::vector<MotionPart> PictureMaker::motion_parts(size_t layer) {
  std::vector<LayerMaker*> moving;
  std::vector<double> times;
  for (std::optional<size_t> i = layer; i; i = parent_of(scene_, *scene_.layers[*i])) {
    moving.push_back(layers_[*i].get());
    for (const auto& [from, to, held] : moving.back()->key_intervals())
      times.insert(times.end(), {from, to});
  }
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  std::vector<MotionPart> parts;
  for (size_t i = 0; i + 1 < times.size(); ++i) {
    MotionPart part{times[i], times[i + 1], 0};
    for (LayerMaker* each : moving) {
      const auto intervals = each->key_intervals();
      const bool moves = std::ranges::any_of(intervals, [&](const Motion::KeyInterval& interval) {
        return !interval.held && interval.from < part.to && part.from < interval.to;
      });
      if (moves) part.pieces = std::max(part.pieces, each->pieces_between(part.from, part.to));
    }
    parts.push_back(part);
  }
  return parts;
}

std::optional<Box> PictureMaker::motion_region(const std::function<bool()>& keep_going) {
  Box box;
  const auto is_moved = [&](size_t i) {
    return parent_of(scene_, *scene_.layers[i]) || !is_identity(scene_.layers[i]->placement);
  };
  const bool has_originals = scene_.background.fill == Background::Fill::original;
  for (size_t i = 0; i < layers_.size(); ++i) {
    if (!layers_[i]->visible()) continue;
    if (!is_moved(i)) layers_[i]->include_page(box, {});
  }
  for (size_t i = 0; i < layers_.size(); ++i) {
    LayerMaker& layer = *layers_[i];
    if (!layer.visible() && has_layers(scene_)) continue;
    const bool is_placed = is_moved(i);
    const auto points_at = [&](double time) {
      VectorXc points = layer.extent_at(time, is_placed);
      if (is_placed) {
        const Similarity placed = placement(i, time);
        for (Complex& z : points) z = placed(z);
      }
      if (has_originals && layer.source()) {
        // Without an original, nothing is added, but there are always as many points.
        const auto original = original_placement(i, time);
        add_corners(points, layer.page(),
                    original.value_or(Similarity{0, 0, points.size() > 0 ? points[0] : 0}));
      }
      return points;
    };
    if (!include_motion(box, points_at, motion_parts(i), keep_going)) return {};
  }
  // Rounding errors of single-precision operators must not add a row of pixels.
  constexpr double kRounding = 1e-3;
  return Box{box.left + kRounding, box.bottom + kRounding, box.right - kRounding,
             box.top - kRounding};
}

}  // namespace holomorph
