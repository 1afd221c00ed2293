// The state is one small, flat JSON object.
#include "editor_state.h"

#include <imgui.h>

#include <cmath>

#include "app/look/items.h"
#include "app/panels/map_panel.h"
#include "scene/report.h"

namespace holomorph {
namespace {

/// The boxes of the named items in window px: left, top, right, bottom.
nlohmann::ordered_json boxes_of_items() {
  nlohmann::ordered_json boxes = nlohmann::ordered_json::object();
  for (const auto& [name, box] : item_boxes())
    boxes[name] = {std::lround(box.x), std::lround(box.y), std::lround(box.z), std::lround(box.w)};
  return boxes;
}

}  // namespace

nlohmann::ordered_json EditorState::json() const {
  const Workspace& workspace = editor_.workspace_;
  static constexpr const char* kTools[] = {"select",  "pen",   "pin",   "stroke",
                                           "outline", "angle", "brush", "attach"};
  static constexpr const char* kThemes[] = {"dark", "light", "contrast"};
  const Viewport& view = workspace.display.viewport;
  const Document& document = workspace.document;
  const Deformation& deformation = workspace.shown.deformation();
  const Scene& kept = document.scene();
  const LiveMap& map = workspace.map();
  const Complex first = deformation.has_cage() ? deformation.rest.vertex(0) : 0;
  return {
      {"left", view.left},
      {"top", view.top},
      {"width", view.width},
      {"height", view.height},
      {"center", {view.center.real(), view.center.imag()}},
      {"zoom", view.zoom},
      {"first_point", {first.real(), first.imag()}},  // position in the cage at rest
      {"tool", kTools[static_cast<int>(workspace.tools.active)]},
      {"posture", workspace.mode == EditMode::rest ? "rest" : "pose"},
      {"view", kViewNames[static_cast<size_t>(workspace.display.view)]},
      {"split", workspace.display.split.value_or(-1)},
      {"theme", kThemes[static_cast<int>(editor_.screen_.theme())]},
      {"scale", editor_.screen_.scale()},
      {"method", deformation.method},
      {"cage_points", deformation.rest.size()},
      {"pins", deformation.pins.size()},
      {"strokes", deformation.strokes.size()},
      {"outline_points", deformation.outline.size()},
      {"corners", deformation.corners.size()},
      {"selected", workspace.selection.size()},
      {"selected_keys", workspace.shown.timeline.keys.size()},
      {"layers", kept.layers.size()},
      {"edited_layer", kept.edited},
      {"locked", kept.layer().locked},
      {"visible", kept.layer().visible},
      {"pictured", document.image() != nullptr},
      {"entry", kept.layer().image ? kept.layer().image->entry : ""},
      {"keys", kept.deformation().keyframes.size()},
      {"time", workspace.shown.timeline.time},
      {"shows_time", workspace.shown.timeline.active},
      {"runs", workspace.shown.timeline.playing},
      {"history", document.history().entries().size()},
      {"step", document.history().index()},
      {"modified", document.modified()},
      {"empty", document.empty()},
      {"error", map.error().has_value()},
      {"status", name_of(map.map().status)},
      {"boundary_turns", map.injectivity().turning_number},
      {"note", map.map().note},
      {"folds", !workspace.folds().empty()},
      {"fold_state", fold_state(workspace).text},
      {"zeros", map.map().zeros.size()},
      {"iteration", map.map().iterations},
      {"iterations", map.map().energies.size()},
      {"playing", workspace.playback.playing},
      {"compared_rows", editor_.comparison_.rows()},
      {"on_surface", workspace.shows_surface() && editor_.surface_pane_.has_picture()},
      {"yaw", editor_.surface_pane_.camera().yaw},
      {"distance", editor_.surface_pane_.camera().distance},
      {"busy", map.busy() || editor_.fit_},
      {"gesture", editor_.current_tool().busy()},
      {"exporting", editor_.files_.busy()},
      {"asking", (editor_.files_.asking() && !editor_.files_.busy()) || editor_.palette_.open() ||
                     editor_.keys_.open()},
      {"question", editor_.files_.question()},
      {"in_panel", editor_.panel_focus_.held()},
      {"pending", editor_.screen_.has_events()},
      {"taken", editor_.screen_.taken()},
      {"pointer", {ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y}},
      {"moving", editor_.moving_},
      {"solving", editor_.last_picture_.solving()},
      {"last_picture", editor_.last_picture_.shows()},
      {"items", boxes_of_items()},
  };
}

}  // namespace holomorph
