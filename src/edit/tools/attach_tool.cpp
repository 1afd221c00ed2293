// Attaches the edited layer to what is clicked on another layer: a pin, a stroke or a place of the
// picture. An action chooses it, and one click ends it.
#include "core/geometry/polyline.h"
#include "edit/picking.h"
#include "edit/tools/layer_drag.h"
#include "edit/tools/tool.h"

namespace holomorph {
namespace {

/// A target that can be clicked, and where it is displayed.
struct Choice {
  AttachmentTarget target;
  Points px;
};

/// The pins and strokes of the layers that the edited layer may follow.
std::vector<Choice> choices_in(const Workspace& w) {
  const Scene& scene = w.document.scene();
  std::vector<Choice> all;
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    if (!layer.visible || follows(scene, i, scene.edited)) continue;
    const Viewport view = w.layer_view(i);
    const LiveMap& map = w.maps.of(layer.id);
    const Deformation& deformation = layer.deformation;
    const Method& method = method_named(deformation.method);
    const auto image = [&](Complex rest) { return view.px_at_plane(posed_at(map, rest)); };
    for (size_t k = 0; method.uses_pins && k < deformation.pins.size(); ++k)
      all.push_back({{i, Attachment::To::pin, k}, {image(deformation.pins[k].rest)}});
    for (size_t k = 0; method.uses_strokes && k < deformation.strokes.size(); ++k) {
      all.push_back({{i, Attachment::To::stroke, k}, {}});
      for (const Complex& z : deformation.strokes[k].rest) all.back().px.push_back(image(z));
    }
  }
  return all;
}

double distance_to(const Points& line, Complex px) {
  if (line.size() < 2) return std::abs(line[0] - px);
  return Polyline(without_repeats(line), false).nearest(px).distance;
}

class AttachTool final : public Tool {
 public:
  ToolId id() const override { return ToolId::attach; }

  void input(const Input& input, Workspace& w) override {
    marks_.clear();
    target_.reset();
    if (!input.inside) return;
    const std::vector<Choice> choices = choices_in(w);
    double nearest = w.display.handle_px;
    size_t hovered = choices.size();
    for (size_t k = 0; k < choices.size(); ++k) {
      marks_.push_back({choices[k].px, choices[k].target.to == Attachment::To::pin});
      // Pins are drawn on top of strokes and picked first.
      const bool is_stroke = choices[k].target.to == Attachment::To::stroke;
      const double here = distance_to(choices[k].px, input.px) + (is_stroke ? nearest / 2 : 0);
      if (here < nearest) nearest = here, hovered = k;
    }
    if (hovered < choices.size()) {
      marks_[hovered].hovered = true;
      target_ = choices[hovered].target;
    } else {
      find_place(input, w);
    }
    if (input.pressed && target_) attach(w);
  }

  bool key(Key key, Workspace& w) override {
    if (key != Key::escape) return false;
    w.tools.active = ToolId::select;
    return true;
  }
  void cancel(Workspace&) override { marks_.clear(); }
  bool busy() const override { return false; }
  ToolOverlay overlay() const override {
    ToolOverlay overlay;
    overlay.targets = marks_;
    return overlay;
  }
  std::string hint(const Workspace& w) const override {
    const std::string name = title_of_layer(w.document.scene(), w.document.scene().edited);
    return "Click a pin, a stroke or a place of another layer that " + name +
           " should follow; Escape cancels";
  }

 private:
  /// The topmost other layer under the pointer.
  void find_place(const Input& input, const Workspace& w) {
    const Scene& scene = w.document.scene();
    for (size_t i = scene.layers.size(); i-- > 0 && !target_;) {
      if (follows(scene, i, scene.edited) || !shows_at(w, i, input.px)) continue;
      target_ = {i, Attachment::To::place, 0, *rest_in_layer(w, i, input.px)};
      marks_.push_back({{input.px}, false, true});
    }
  }

  void attach(Workspace& w) {
    const auto& [attachment, scene] = attachment_to(w.document.scene(), *target_);
    const size_t layer = scene.edited;
    const Layer& parent = *scene.layers[target_->layer];
    if (!w.require_placements()) return;
    if (parent.deformation.has_cage() && !w.maps.of(parent.id).has_map())
      return w.messages.say("The other layer is being prepared. Try again in a moment.");
    // The layer stays where it lies now.
    const Similarity carried =
        composed(w.placement(target_->layer), w.maps.motion(parent, attachment));
    const Scene attached =
        with_attachment(scene, layer, attachment, composed(inverse(carried), w.placement(layer)));
    if (!w.commit_layers("Attach layer", attached)) return;
    w.messages.say(title_of_layer(attached, layer) + " now follows " +
                   attachment_text(attached, layer) + ".");
    w.tools.active = ToolId::select;
  }

  std::vector<TargetMark> marks_;
  std::optional<AttachmentTarget> target_;
};

}  // namespace

std::unique_ptr<Tool> attach_tool() {
  return std::make_unique<AttachTool>();
}

}  // namespace holomorph
