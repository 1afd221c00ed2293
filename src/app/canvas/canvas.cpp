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

/// A layer that is drawn.
struct ShownLayer {
  const Layer& layer;
  size_t index = 0;  ///< in the scene
  LayerPainter& painter;
  std::optional<Similarity> original = {};  ///< where its original lies, if the layer may show it
};

/// Draws layers between two fractions of the canvas's width.
class PartDrawer {
 public:
  PartDrawer(const Workspace& workspace, const CanvasFrame& at, RenderFrame frame,
             std::vector<ShownLayer> shown)
      : workspace_(workspace),
        scene_(workspace.document.scene()),
        at_(at),
        frame_(std::move(frame)),
        shown_(std::move(shown)) {}

  /// The pictures at rest. If `edited_only`, there is only the edited layer.
  void show_at_rest(bool edited_only) {
    at_rest_ = true;
    placed_ = !edited_only;
  }
  /// The layers lie over their originals.
  void show_originals() {
    has_originals_ = true;
    for (ShownLayer& shown : shown_) shown.original = workspace_.original_placement(shown.index);
  }

  /// Whether the layers must be combined away from the window, because of opacities and blending
  /// modes, or to find the gaps that originals fill. Opaque originals can be drawn behind the
  /// layers as they are.
  bool combines() const {
    return std::ranges::any_of(shown_, [&](const ShownLayer& shown) {
      if (is_blended(shown.layer)) return true;
      if (!has_originals_) return false;
      return !shown.painter.is_opaque() || !shown.original || !is_identity(*shown.original);
    });
  }

  /// The page alone, as layers that are combined or were moved away from it need it.
  void draw_page(const ShownLayer& of) {
    RenderFrame page = frame_;
    page.content = Content::nothing;
    paint(of, page);
  }
  void draw(Compositor* compositor) {
    compositor_ = compositor;
    const bool places = has_originals_ || !is_identity(workspace_.placement(shown_[0].index));
    if (compositor_ || places) draw_page(shown_[0]);
    if (compositor_) compositor_->begin(frame_.window_width, frame_.window_height);
    if (has_originals_ && compositor_) fill_gaps();
    if (has_originals_ && !compositor_)
      for (const ShownLayer& shown : shown_) draw_original(shown);
    const std::vector<OnionSkin> skins = workspace_.onion_skins();
    for (const ShownLayer& shown : shown_) {
      RenderFrame posed = posed_frame(shown);
      if (is_edited(shown)) {
        posed.wireframe = workspace_.display.show_mesh;
        for (const OnionSkin& skin : skins)
          posed.ghosts.push_back({as_span(skin.f), onion_color(skin.later)});
      }
      draw(shown, std::move(posed));
    }
    if (!compositor_) return;
    const auto px = [](double value) { return static_cast<int>(value); };
    const int bottom = frame_.window_height - px(frame_.canvas_top) - px(frame_.canvas_height),
              first = static_cast<int>(std::lround(frame_.from * px(frame_.canvas_width))),
              last = static_cast<int>(std::lround(frame_.to * px(frame_.canvas_width)));
    compositor_->finish(px(frame_.canvas_left) + first, bottom, last - first,
                        px(frame_.canvas_height));
  }

 private:
  bool is_edited(const ShownLayer& shown) const { return &shown.layer == &scene_.layer(); }

  RenderFrame posed_frame(const ShownLayer& shown) const {
    RenderFrame drawing = frame_;
    const Similarity resting =
        placement_of(scene_, shown.index, [](size_t) { return Similarity{}; });
    set_view(drawing,
             at_rest_ && placed_ ? workspace_.display.viewport.of_layer(resting)
                                 : workspace_.layer_view(shown.index),
             at_);
    if (at_rest_ || (is_edited(shown) && workspace_.at_rest()))
      drawing.placement = Placement::at_rest;
    return drawing;
  }

  /// Adds what fills the gaps of each layer, together with what is clipped to it.
  void fill_gaps() {
    for (size_t first = 0, end; first < shown_.size(); first = end) {
      end = first + 1;
      while (end < shown_.size() && canvas_ink(scene_, shown_[end].index).clipped) ++end;
      const ShownLayer& base = shown_[first];
      const bool may_have_gaps =
          base.layer.deformation.has_cage() || base.original != workspace_.placement(base.index);
      if (!base.original || !may_have_gaps) continue;
      for (size_t i = first; i < end; ++i) draw(shown_[i], posed_frame(shown_[i]));
      compositor_->keep();
      for (size_t i = first; i < end; ++i) draw_original(shown_[i]);
      compositor_->fill_gaps(static_cast<int>(base.layer.blending));
    }
  }

  void draw_original(const ShownLayer& shown) {
    if (!shown.original) return;
    RenderFrame drawing = frame_;
    drawing.content = Content::original;
    set_view(drawing, workspace_.display.viewport.of_layer(*shown.original), at_);
    draw(shown, std::move(drawing));
  }

  void draw(const ShownLayer& shown, RenderFrame drawing) {
    if (!compositor_) return paint(shown, std::move(drawing));
    drawing.over = true;
    compositor_->begin_layer();
    paint(shown, std::move(drawing));
    compositor_->end_layer(canvas_ink(scene_, shown.index));
  }

  void paint(const ShownLayer& shown, RenderFrame drawing) {
    shown.painter.draw(workspace_.maps.of(shown.layer.id),
                       is_edited(shown) ? workspace_.display.view : View::image,
                       std::move(drawing));
    frame_.over = true;
  }

  const Workspace& workspace_;
  const Scene& scene_;
  const CanvasFrame& at_;
  RenderFrame frame_;
  std::vector<ShownLayer> shown_;
  bool at_rest_ = false, placed_ = false, has_originals_ = false;
  Compositor* compositor_ = nullptr;  ///< null: layers are drawn directly
};

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
  std::vector<ShownLayer> shown;
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    const bool shows = edited_only || is_shown(scene, i);
    if (&layer != &edited && (edited_only || !shows)) continue;
    update_picture(workspace, layer);
    if (!shows) continue;
    LayerPainter& painter = painter_of(layer);
    painter.update_map(workspace.maps.of(layer.id),
                       &layer == &edited ? workspace.display.view : View::image,
                       workspace.display.automatic_range);
    if (painter.is_settling()) wake_();
    shown.push_back({layer, i, painter});
  }
  if (at.page_alone) shown.clear();
  const bool is_empty = shown.empty();
  PartDrawer drawer(workspace, at, std::move(frame), std::move(shown));
  if (is_empty) return drawer.draw_page({edited, scene.edited, *edited_});
  if (original)
    drawer.show_at_rest(edited_only);
  else if (scene.background.fill == Background::Fill::original && !edited_only)
    drawer.show_originals();
  const bool combines = !edited_only && drawer.combines();
  if (combines && !compositor_) compositor_ = std::make_unique<Compositor>();
  drawer.draw(combines ? compositor_.get() : nullptr);
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
