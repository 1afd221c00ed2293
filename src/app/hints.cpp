// What is done is read off the document, so that no step can be forgotten or done twice.
#include "app/hints.h"

#include <utility>

#include "app/panels.h"

namespace holomorph {

bool draw_hints(const Workspace& workspace, bool kept, double scale) {
  const Scene& scene = workspace.document.scene();
  const History& history = workspace.document.history();
  const bool caged = scene.has_cage(),
             bent = caged && history.can_undo() &&
                    whole_pose_of(scene) != whole_pose_of(history.entries()[0].scene) &&
                    (whole_pose_of(scene) != whole_pose_of(at_rest(scene)));
  struct Step {
    bool done;
    const char *what, *how;
  };
  const Step steps[] = {
      {caged, "Put a cage around the picture", "Make from picture, or draw it with P"},
      {bent, "Bend it", "Drag the cage's points with V; N sets pins to drag"},
      {bent && kept, "Keep it", "Ctrl+S saves the scene, Ctrl+E exports a picture"}};
  const float s = static_cast<float>(scale);
  const Viewport& view = workspace.viewport;
  ImGui::SetNextWindowPos(
      {static_cast<float>(view.left) + 12 * s, static_cast<float>(view.top) + 12 * s});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8 * s);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::Begin("First steps", nullptr, kPanel | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PushTextWrapPos(static_cast<float>(std::min(380.0 * scale, view.width - 48 * scale)));
  int number = 1;
  bool next = true;  // the first that is not done says how
  for (const Step& step : steps) {
    if (step.done)
      ImGui::TextDisabled("\uf00c  %s", step.what);
    else
      ImGui::Text("%d.  %s", number, step.what);
    if (!step.done && std::exchange(next, false)) {
      ImGui::Indent(24 * s);
      ImGui::TextDisabled("%s", step.how);
      ImGui::Unindent(24 * s);
    }
    ++number;
  }
  const bool all = next;
  if (all) ImGui::TextWrapped("F1 shows all keys, Ctrl+Shift+P finds everything.");
  ImGui::PopTextWrapPos();
  const bool closed = ImGui::SmallButton(all ? "Done" : "Do not show this again");
  ImGui::End();
  ImGui::PopStyleVar(2);
  return !closed;
}

}  // namespace holomorph
