// The state is one small, flat JSON object.
#include "app/state_file.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/look/items.h"
#include "core/error.h"
#include "scene/report.h"
#include "system/new_file.h"

namespace holomorph {
namespace {

/// The boxes of the named items in window px: left, top, right, bottom.
nlohmann::ordered_json boxes_of_items() {
  nlohmann::ordered_json boxes = nlohmann::ordered_json::object();
  for (const auto& [name, box] : item_boxes())
    boxes[name] = {std::lround(box.x), std::lround(box.y), std::lround(box.z), std::lround(box.w)};
  return boxes;
}

nlohmann::ordered_json state_of(const Workspace& workspace, const PartsState& parts) {
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
      {"theme", kThemes[static_cast<int>(parts.theme)]},
      {"scale", parts.scale},
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
      {"folds", !workspace.folds().empty()},
      {"zeros", map.map().zeros.size()},
      {"iteration", map.map().iterations},
      {"iterations", map.map().energies.size()},
      {"playing", workspace.playback.playing},
      {"compared_rows", parts.compared_rows},
      {"on_surface", parts.on_surface},
      {"yaw", parts.yaw},
      {"distance", parts.distance},
      {"busy", map.busy() || parts.settling},
      {"gesture", parts.gesture},
      {"exporting", parts.exporting},
      {"asking", parts.asking},
      {"question", parts.question},
      {"in_panel", parts.in_panel},
      {"pending", parts.pending},
      {"taken", parts.taken},
      {"pointer", {parts.pointer.first, parts.pointer.second}},
      {"slowest_ms", parts.slowest_ms},
      {"slowest_work_ms", parts.slowest_work_ms},
      {"moving", parts.moving},
      {"solving", parts.solving},
      {"last_picture", parts.last_picture},
      {"items", boxes_of_items()},
  };
}

}  // namespace

void StateFile::write(const Workspace& workspace, const PartsState& parts) {
  const std::string text =
      state_of(workspace, parts).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) +
      "\n";
  if (text == last_) return;
  last_ = text;
  try {
    write_file(path_, last_);
  } catch (const Error&) {
    // Ignored, because the script that reads the file will notice that it is missing.
  }
}

}  // namespace holomorph
