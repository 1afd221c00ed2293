// The picture is drawn from the maps that are on the canvas, on another thread.
#include "app/last_picture_view.h"

#include <algorithm>
#include <cmath>

#include "app/canvas/marks.h"
#include "app/thumbnails.h"
#include "core/clock.h"
#include "raster/compose.h"
#include "raster/raster.h"
#include "scene/attachments.h"
#include "scene/fringe.h"
#include "scene/layers.h"

namespace holomorph {
namespace {

constexpr double kSlowMs = 300;  ///< scenes that take longer to solve have pictures
constexpr double kSignMs = 150;  ///< when the sign appears
constexpr int kLongestPictureSide = 1400;

/// All that is needed to draw a layer on another thread.
struct LayerSnapshot {
  std::shared_ptr<const Mesh> mesh;
  VectorXc f;
  std::shared_ptr<const Image> picture;
  Similarity placement;
  std::optional<Similarity> original;  ///< where the undeformed picture lies behind the layers
  LayerInk ink;
};

/// Whether a layer can be displayed, together with what follows it.
bool has_answer(const Workspace& workspace, size_t number) {
  const Scene& scene = workspace.document.scene();
  const Layer& layer = *scene.layers[number];
  return (!layer.visible && !carries_others(scene, number)) || !layer.deformation.has_cage() ||
         workspace.maps.of(layer.id).has_map() || workspace.maps.of(layer.id).error();
}

/// The time in which the displayed maps were prepared and solved.
double solve_milliseconds(const Workspace& workspace) {
  double sum = 0;
  for (const SharedLayer& layer : workspace.document.scene().layers) {
    const LiveMap& map = workspace.maps.of(layer->id);
    if (map.has_map()) sum += map.prepared()->milliseconds + map.pose_milliseconds();
  }
  return sum;
}

bool has_answers(const Workspace& workspace) {
  for (size_t i = 0; i < workspace.document.scene().layers.size(); ++i)
    if (!has_answer(workspace, i)) return false;
  return true;
}

bool is_settled(const Workspace& workspace) {
  return has_answers(workspace) && !workspace.shown.preview &&
         std::ranges::none_of(workspace.document.scene().layers, [&](const SharedLayer& layer) {
           return workspace.maps.of(layer->id).busy();
         });
}

RasterResult rasterized(const LayerSnapshot& layer, const Box& box, double scale) {
  RasterJob job;
  job.mesh = layer.mesh.get();
  job.positions = as_span(layer.f);
  const auto fringe = layer.mesh ? fringe_of(*layer.mesh, *layer.picture) : nullptr;
  const Points around = fringe ? fringe->positions(as_span(layer.f)) : Points();
  if (fringe) job.fringe = &fringe->mesh;
  job.fringe_positions = around;
  job.source = layer.picture.get();
  job.placement = layer.placement;
  job.pixels_per_unit = scale;
  job.region = box;
  job.top = box.top;
  return holomorph::rasterized(job);
}

LastPicture picture_of(const std::vector<LayerSnapshot>& layers) {
  Box box;
  for (const LayerSnapshot& layer : layers) {
    for (const Complex& z : layer.picture->page().corners()) box.include(layer.placement(z));
    for (const Complex& z : layer.f) box.include(layer.placement(z));
    if (!layer.original) continue;
    for (const Complex& z : layer.picture->page().corners()) box.include((*layer.original)(z));
  }
  const double scale = std::min(1.0, kLongestPictureSide / std::max(box.width(), box.height()));
  LayerStack stack(scale, Originals::in_gaps);
  for (const LayerSnapshot& layer : layers) {
    std::optional<RasterResult> original;
    if (layer.original)
      original = rasterized({nullptr, {}, layer.picture, *layer.original, {}, {}}, box, scale);
    stack.add(rasterized(layer, box, scale), layer.ink, std::move(original));
  }
  RasterResult result = std::move(stack).result();
  LastPicture picture;
  picture.box.include(result.corner);
  picture.box.include(result.corner + Complex(result.image.width, result.image.height) / scale);
  picture.image = std::move(result.image);
  return picture;
}

}  // namespace

void LastPictureView::opened(const Workspace& workspace) {
  texture_.reset();
  const auto& layers = workspace.document.scene().layers;
  waits_ = std::ranges::any_of(
      layers, [](const SharedLayer& layer) { return layer->deformation.has_cage(); });
  opened_ms_ = now_ms();
  slowest_ms_ = 0;
  kept_hash_.clear();
  if (!waits_) return;
  if (auto picture = last_picture_of(workspace.document.file_hash())) {
    texture_.emplace(picture->image.width, picture->image.height, picture->image.pixels.data());
    box_ = picture->box;
  }
}

void LastPictureView::update(const Workspace& workspace) {
  if (job_ && job_->ended()) job_.reset();
  if (waits_) {
    if (has_answers(workspace)) {
      waits_ = solving_ = false;
      texture_.reset();
    } else {
      solving_ = texture_ || now_ms() - opened_ms_ > kSignMs;
      if (!solving_) wake_();
      return;
    }
  }
  const Document& document = workspace.document;
  if (!is_settled(workspace)) return;
  slowest_ms_ = std::max(slowest_ms_, solve_milliseconds(workspace));
  if (slowest_ms_ < kSlowMs || kept_hash_ == document.file_hash() || document.modified() || job_ ||
      workspace.at_rest())
    return;
  // The next session opens at the start of the timeline.
  if (workspace.shown.time_of_layers().value_or(0) > 0) return;
  keep(workspace);
}

void LastPictureView::keep(const Workspace& workspace) {
  kept_hash_ = workspace.document.file_hash();
  std::vector<LayerSnapshot> layers;
  const Scene& scene = workspace.document.scene();
  const bool has_originals = scene.background.fill == Background::Fill::original;
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    const auto picture = workspace.document.pictures().shared(layer);
    const std::optional<size_t> base = clip_base(scene, i);
    const bool has_base = !base || workspace.document.pictures().shared(*scene.layers[*base]);
    if (!is_shown(scene, i) || !picture || !has_base) continue;
    const LiveMap& map = workspace.maps.of(layer.id);
    const bool bent = layer.deformation.has_cage() && map.has_map();
    layers.push_back({bent ? map.drawn() : nullptr, bent ? map.map().f : VectorXc(), picture,
                      workspace.placement(i),
                      has_originals ? workspace.original_placement(i) : std::nullopt,
                      ink_of(scene, i)});
  }
  if (layers.empty()) return;
  job_ = std::make_unique<Job>(
      "Keeping the picture",
      [layers = std::move(layers), hash = kept_hash_](Job::Progress& progress) {
        const LastPicture picture = picture_of(layers);
        if (!progress.cancelled()) keep_last_picture(hash, picture);
      },
      wake_);
}

void LastPictureView::draw(const Workspace& workspace) const {
  const Viewport& view = workspace.display.viewport;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 from = vec({view.left, view.top}),
               to = vec({view.left + view.width, view.top + view.height});
  if (texture_) {
    list.PushClipRect(from, to);
    list.AddImage(reinterpret_cast<void*>(static_cast<std::uintptr_t>(texture_->id())),
                  vec(view.px_at_plane({box_.left, box_.top})),
                  vec(view.px_at_plane({box_.right, box_.bottom})));
    list.PopClipRect();
  }
  MarkList marks(list);
  if (solving_) draw_chip(marks, {from.x + px(16), from.y + px(16)}, "Solving");
}

}  // namespace holomorph
