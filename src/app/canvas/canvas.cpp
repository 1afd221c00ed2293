// Layers are drawn from bottom to top. The first one drawn clears the canvas.
#include "app/canvas/canvas.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/attachments.h"
#include "scene/layers.h"

namespace holomorph {
namespace {

/// Texture px per plane unit. It is a power of two, so it does not change when the box grows by one
/// pixel.
double texture_zoom(const Box& box) {
  const double most = is_software_driver() ? 1024 : 2048;
  return std::exp2(std::floor(std::log2(most / std::max({box.width(), box.height(), 1e-6}))));
}

void set_view(RenderFrame& frame, const Viewport& view, const CanvasFrame& at) {
  frame.center = view.center;
  frame.zoom = view.zoom * at.ratio;
  frame.turn = view.turn;
}

RenderFrame frame_at(const Viewport& view, const CanvasFrame& at) {
  RenderFrame frame;
  frame.window_width = at.window_width;
  frame.window_height = at.window_height;
  frame.canvas_left = view.left * at.ratio;
  frame.canvas_top = view.top * at.ratio;
  frame.canvas_width = view.width * at.ratio;
  frame.canvas_height = view.height * at.ratio;
  set_view(frame, view, at);
  frame.background = at.background;
  frame.backdrop = at.page_a;
  frame.other_backdrop = at.page_b;
  frame.cell = at.cell * at.ratio;
  frame.shadow = at.shadow * at.ratio;
  frame.shadow_alpha = at.shadow_alpha;
  return frame;
}

bool is_moved(const Workspace& workspace, const Layer& layer) {
  return !is_identity(workspace.placement(layer_index(workspace.document.scene(), layer.id)));
}

/// Where a layer was placed, on undeformed layers.
Similarity resting_placement(const Scene& scene, const Layer& layer) {
  return placement_of(scene, layer_index(scene, layer.id), [](size_t) { return Similarity{}; });
}

Ink canvas_ink(const Scene& scene, size_t layer) {
  const Layer& it = *scene.layers[layer];
  return {static_cast<int>(it.blending), it.opacity, clip_base(scene, layer).has_value()};
}

/// The color of a solid background, which replaces the theme's background.
Color color_of(const Background& background) {
  Color color;
  for (size_t k = 0; k < 3; ++k) color[k] = static_cast<float>(background.color[k]) / 255;
  return color;
}

}  // namespace

Color onion_color(bool later) {
  return later ? Color{0.35f, 0.67f, 1} : Color{1, 0.55f, 0.31f};
}

LayerPainter& Canvas::painter_of(const Layer& layer) {
  std::unique_ptr<LayerPainter>& painter = painters_[layer.id];
  if (!painter) painter = std::make_unique<LayerPainter>(wake_);
  return *painter;
}

void Canvas::update_picture(Workspace& workspace, const Layer& layer) {
  const Pictures& pictures = workspace.document.pictures();
  const bool moves = pictures.footage(layer) != nullptr;
  const int factor = painter_of(layer).update_picture(pictures.shared(layer), moves);
  if (painter_of(layer).is_uploading()) wake_();
  if (factor > 1)
    workspace.messages.say(
        "The picture is too large for the graphics driver. The canvas shows it at 1/" +
        std::to_string(factor) + " of its size; export uses all pixels.");
}

bool Canvas::allocate_texture() {
  for (auto& [id, painter] : painters_)
    if (painter->allocate_texture()) return true;
  return false;
}

void Canvas::draw(Workspace& workspace, const CanvasFrame& at) {
  if (std::exchange(forgets_, false)) painters_.clear();
  std::erase_if(painters_, [&](const auto& entry) {
    return layer_index(workspace.document.scene(), entry.first) ==
           workspace.document.scene().layers.size();
  });
  const double split = workspace.display.split.value_or(0);
  draw_part(workspace, at, split, 1, workspace.display.show_original);
  if (split > 0) draw_part(workspace, at, 0, split, true);
}

void Canvas::draw_part(Workspace& workspace, const CanvasFrame& at, double from, double to,
                       bool original) {
  const Scene& scene = workspace.document.scene();
  // Map views and the rest shape show only the edited layer.
  const bool edited_only =
      workspace.display.view != View::image || workspace.mode == EditMode::rest;
  RenderFrame frame = frame_at(workspace.display.viewport, at);
  frame.from = from;
  frame.to = to;
  // The color fills the whole canvas, as in exports.
  if (scene.background.fill == Background::Fill::color)
    frame.background = frame.backdrop = frame.other_backdrop = color_of(scene.background);
  const Layer& edited = scene.layer();
  edited_ = &painter_of(edited);
  std::vector<const Layer*> drawn;
  for (const SharedLayer& shared : scene.layers) {
    const Layer& layer = *shared;
    const bool shows = edited_only || is_shown(scene, layer_index(scene, layer.id));
    if (&layer != &edited && (edited_only || !shows)) continue;
    update_picture(workspace, layer);
    if (!shows) continue;
    painter_of(layer).update_map(workspace.maps.of(layer.id),
                                 &layer == &edited ? workspace.display.view : View::image,
                                 workspace.display.automatic_range);
    if (painter_of(layer).is_settling()) wake_();
    drawn.push_back(&layer);
  }
  if (at.page_alone) drawn.clear();
  const bool has_originals = scene.background.fill == Background::Fill::original && !edited_only;
  // With opacities or blending modes, the page is drawn alone, and the layers are combined away
  // from the window. The page is also drawn alone if its layer has been moved away from it.
  const auto original_placement = [&](const Layer& layer) {
    return workspace.original_placement(layer_index(scene, layer.id),
                                        layer_index(scene, drawn.front()->id));
  };
  const bool combines =
      !edited_only &&
      (std::ranges::any_of(drawn, [](const Layer* layer) { return is_blended(*layer); }) ||
       // Opaque originals can be drawn behind the layers as they are.
       (has_originals && !std::ranges::all_of(drawn, [&](const Layer* layer) {
          return painter_of(*layer).is_opaque() && is_identity(original_placement(*layer));
        })));
  const auto paint = [&](const Layer& layer, RenderFrame drawing) {
    painter_of(layer).draw(workspace.maps.of(layer.id),
                           &layer == &edited ? workspace.display.view : View::image,
                           std::move(drawing));
    frame.over = true;
  };
  const bool places = has_originals || (!drawn.empty() && is_moved(workspace, *drawn.front()));
  if (drawn.empty() || combines || places) {
    RenderFrame page = frame;
    page.content = Content::nothing;
    paint(drawn.empty() ? edited : *drawn.front(), page);
  }
  if (drawn.empty()) return;
  if (combines) {
    if (!compositor_) compositor_ = std::make_unique<Compositor>();
    compositor_->begin(frame.window_width, frame.window_height);
  }
  const auto draw = [&](const Layer& layer, RenderFrame drawing) {
    if (!combines) return paint(layer, std::move(drawing));
    drawing.over = true;
    compositor_->begin_layer();
    paint(layer, std::move(drawing));
    compositor_->end_layer(canvas_ink(scene, layer_index(scene, layer.id)));
  };
  const std::vector<OnionSkin> skins = workspace.onion_skins();
  const auto posed = [&](const Layer& layer) {
    RenderFrame drawing = frame;
    if (original && !edited_only)
      set_view(drawing, workspace.display.viewport.of_layer(resting_placement(scene, layer)), at);
    else
      set_view(drawing, workspace.layer_view(layer_index(scene, layer.id)), at);
    if (original || (&layer == &edited && workspace.at_rest()))
      drawing.placement = Placement::at_rest;
    return drawing;
  };
  const auto as_it_was = [&](const Layer& layer) {
    RenderFrame drawing = frame;
    drawing.content = Content::original;
    set_view(drawing, workspace.display.viewport.of_layer(original_placement(layer)), at);
    return drawing;
  };
  if (has_originals && !combines)
    for (const Layer* layer : drawn) draw(*layer, as_it_was(*layer));
  if (has_originals && combines) {
    for (size_t first = 0, end; first < drawn.size(); first = end) {
      end = first + 1;  // a layer, and what is clipped to it
      while (end < drawn.size() && canvas_ink(scene, layer_index(scene, drawn[end]->id)).clipped)
        ++end;
      for (size_t i = first; i < end; ++i) draw(*drawn[i], posed(*drawn[i]));
      compositor_->keep();
      for (size_t i = first; i < end; ++i) draw(*drawn[i], as_it_was(*drawn[i]));
      compositor_->fill_gaps(static_cast<int>(drawn[first]->blending));
    }
  }
  for (const Layer* layer : drawn) {
    RenderFrame drawing = posed(*layer);
    if (layer == &edited) {
      drawing.wireframe = workspace.display.show_mesh;
      for (const OnionSkin& skin : skins)
        drawing.ghosts.push_back({as_span(skin.f), onion_color(skin.later)});
    }
    draw(*layer, std::move(drawing));
  }
  if (combines) {
    const auto px = [](double value) { return static_cast<int>(value); };
    const int bottom = frame.window_height - px(frame.canvas_top) - px(frame.canvas_height),
              first = static_cast<int>(std::lround(from * px(frame.canvas_width))),
              last = static_cast<int>(std::lround(to * px(frame.canvas_width)));
    compositor_->finish(px(frame.canvas_left) + first, bottom, last - first,
                        px(frame.canvas_height));
  }
}

Box Canvas::whole_pixels(const Box& box) {
  const double zoom = texture_zoom(box), width = std::ceil(zoom * box.width() + 1) / zoom,
               height = std::ceil(zoom * box.height() + 1) / zoom;
  Box whole;
  whole.include(box.center() - 0.5 * Complex(width, height));
  whole.include(box.center() + 0.5 * Complex(width, height));
  return whole;
}

void Canvas::draw_map(const Workspace& workspace, const Box& box, Framebuffer& into, Color clay) {
  RenderFrame frame;
  frame.zoom = texture_zoom(box);
  frame.window_width = static_cast<int>(std::lround(frame.zoom * box.width()));
  frame.window_height = static_cast<int>(std::lround(frame.zoom * box.height()));
  frame.canvas_width = frame.window_width;
  frame.canvas_height = frame.window_height;
  frame.center = box.center();
  frame.map_alone = true;
  frame.background = {0, 0, 0};
  frame.backdrop = clay;
  into.bind(frame.window_width, frame.window_height);
  painter_of(workspace.document.scene().layer())
      .draw(workspace.map(), workspace.display.view, frame);
  into.release();
}

}  // namespace holomorph
