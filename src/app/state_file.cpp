// Flat and small.
#include "app/state_file.h"

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "scene/report.h"

namespace holomorph {
namespace {

nlohmann::ordered_json state_of(const Workspace& workspace, const PartsState& parts) {
  static constexpr const char* kTools[] = {"select",  "pen",   "pin",  "stroke",
                                           "outline", "angle", "brush"};
  static constexpr const char* kThemes[] = {"dark", "light", "contrast"};
  const Viewport& view = workspace.viewport;
  const Document& document = workspace.document;
  const Scene &scene = workspace.scene(), &kept = document.scene();
  const LiveMap& map = workspace.map();
  const Complex first = scene.has_cage() ? scene.rest.vertex(0) : 0;
  return {
      {"left", view.left},
      {"top", view.top},
      {"width", view.width},
      {"height", view.height},
      {"center", {view.center.real(), view.center.imag()}},
      {"zoom", view.zoom},
      {"first_point", {first.real(), first.imag()}},  // of the cage at rest
      {"tool", kTools[static_cast<int>(workspace.tool)]},
      {"posture", workspace.posture == Posture::rest ? "rest" : "pose"},
      {"view", kViewNames[static_cast<size_t>(workspace.view)]},
      {"split", workspace.split.value_or(-1)},
      {"theme", kThemes[static_cast<int>(parts.theme)]},
      {"scale", parts.scale},
      {"method", scene.method},
      {"cage_points", scene.rest.size()},
      {"pins", scene.pins.size()},
      {"strokes", scene.strokes.size()},
      {"outline_points", scene.outline.size()},
      {"corners", scene.corners.size()},
      {"selected", workspace.selection.size()},
      {"layers", layer_count(kept)},
      {"edited_layer", edited_layer(kept)},
      {"locked", kept.layer.locked},
      {"visible", kept.layer.visible},
      {"pictured", document.image() != nullptr},
      {"keys", kept.keyframes.size()},
      {"time", workspace.timeline.time},
      {"shows_time", workspace.timeline.shows},
      {"runs", workspace.timeline.playing},
      {"history", document.history().entries().size()},
      {"step", document.history().index()},
      {"modified", document.modified()},
      {"empty", document.empty()},
      {"error", map.error().has_value()},
      {"status", name_of(map.map().status)},
      {"boundary_turns", map.injectivity().boundary_turns},
      {"folds", map.injectivity().folds()},
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
      {"slowest_ms", parts.slowest_ms},
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
    // Whoever reads the file will notice that it is missing.
  }
}

}  // namespace holomorph
