// Flat and small; strings in it are identifiers that need no escaping.
#include "app/state_file.h"

#include "core/error.h"
#include "scene/report.h"

namespace holomorph {

void StateFile::write(const Workspace& workspace, const PartsState& parts) {
  static constexpr const char* kTools[] = {"select",  "pen",   "pin",  "stroke",
                                           "outline", "angle", "brush"};
  const Viewport& view = workspace.viewport;
  char text[1900];
  std::snprintf(
      text, sizeof text,
      "{\"left\": %.17g, \"top\": %.17g, \"width\": %.17g, \"height\": %.17g,\n"
      " \"center\": [%.17g, %.17g], \"zoom\": %.17g,\n"
      " \"tool\": \"%s\", \"posture\": \"%s\", \"view\": \"%s\", \"method\": \"%s\",\n"
      " \"cage_points\": %d, \"pins\": %d, \"strokes\": %d, \"outline_points\": %d, \"selected\": "
      "%d, \"history\": "
      "%d, \"step\": %d,\n"
      " \"modified\": %s, \"busy\": %s, \"gesture\": %s, \"empty\": %s, \"error\": %s,\n"
      " \"status\": \"%s\", \"boundary_turns\": %.6f, \"folds\": %s, \"iteration\": %d, "
      "\"iterations\": %d, \"playing\": %s,\n"
      "  \"zeros\": %d, \"compared_rows\": %d, \"on_surface\": %s, \"exporting\": %s, \"yaw\": "
      "%.6f, "
      "\"distance\": %.6f, \"corners\": %d, \"keys\": %d, \"time\": %.6f, \"shows_time\": %s, "
      "\"runs\": %s, \"layers\": %d, \"edited_layer\": %d, \"locked\": %s, \"visible\": %s, "
      "\"split\": "
      "%.4f, \"slowest_ms\": %.1f, \"asking\": %s, \"pending\": %s}\n",
      view.left, view.top, view.width, view.height, view.center.real(), view.center.imag(),
      view.zoom, kTools[static_cast<int>(workspace.tool)],
      workspace.posture == Posture::rest ? "rest" : "pose",
      kViewNames[static_cast<size_t>(workspace.view)], workspace.scene().method.c_str(),
      static_cast<int>(workspace.scene().rest.size()),
      static_cast<int>(workspace.scene().pins.size()),
      static_cast<int>(workspace.scene().strokes.size()),
      static_cast<int>(workspace.scene().outline.size()),
      static_cast<int>(workspace.selection.size()),
      static_cast<int>(workspace.document.history().entries().size()),
      static_cast<int>(workspace.document.history().index()),
      workspace.document.modified() ? "true" : "false",
      workspace.map().busy() || parts.settling ? "true" : "false", parts.gesture ? "true" : "false",
      workspace.document.empty() ? "true" : "false", workspace.map().error() ? "true" : "false",
      name_of(workspace.map().map().status), workspace.map().injectivity().boundary_turns,
      workspace.map().injectivity().folds() ? "true" : "false", workspace.map().map().iterations,
      static_cast<int>(workspace.map().map().energies.size()),
      workspace.playback.playing ? "true" : "false",
      static_cast<int>(workspace.map().map().zeros.size()), parts.compared_rows,
      parts.on_surface ? "true" : "false", parts.exporting ? "true" : "false", parts.yaw,
      parts.distance, static_cast<int>(workspace.scene().corners.size()),
      static_cast<int>(workspace.document.scene().keyframes.size()), workspace.timeline.time,
      workspace.timeline.shows ? "true" : "false", workspace.timeline.playing ? "true" : "false",
      static_cast<int>(layer_count(workspace.document.scene())),
      static_cast<int>(edited_layer(workspace.document.scene())),
      workspace.document.scene().layer.locked ? "true" : "false",
      workspace.document.scene().layer.visible ? "true" : "false", workspace.split.value_or(-1),
      parts.slowest_ms, parts.asking ? "true" : "false", parts.pending ? "true" : "false");
  if (text == last_) return;
  last_ = text;
  try {
    write_file(path_, last_);
  } catch (const Error&) {
    // Whoever reads the file will notice that it is missing.
  }
}

}  // namespace holomorph
