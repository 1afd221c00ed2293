// Whether a step is done is derived from the document, so nothing has to be recorded.
#include "app/panels/hints.h"

#include <algorithm>
#include <iterator>

#include "app/panels/panels.h"

namespace holomorph {

bool draw_hints(const Workspace& workspace, bool kept, double scale) {
  const Deformation& deformation = workspace.shown.own();
  const History& history = workspace.document.history();
  const bool caged = deformation.has_cage(),
             bent = caged && history.can_undo() &&
                    whole_pose_of(deformation) !=
                        whole_pose_of(history.entries()[0].scene.deformation()) &&
                    (whole_pose_of(deformation) != whole_pose_of(at_rest(deformation)));
  struct Hint {
    bool done;
    const char* what;
    std::string how;
  };
  const Hint steps[] = {
      {caged, "Make a cage",
       "Make it from the picture, or draw it with " + workspace.actions.key_of("tool.pen")},
      {bent, "Bend the picture",
       has_cage_handles(deformation, EditMode::pose)
           ? "Drag cage points with " + workspace.actions.key_of("tool.select") + "; " +
                 workspace.actions.key_of("tool.pin") + " sets and drags pins"
           : "Set pins where the picture should stay, with " +
                 workspace.actions.key_of("tool.pin") + ", then drag a pin"},
      {bent && kept, "Save or export",
       workspace.actions.key_of("file.save") + " saves the scene, " +
           workspace.actions.key_of("file.export") + " exports a picture"}};
  const float s = static_cast<float>(scale);
  const Viewport& view = workspace.display.viewport;
  begin_card("First steps",
             {static_cast<float>(view.left) + 12 * s, static_cast<float>(view.top) + 12 * s},
             {0, 0}, scale);
  ImGui::PushTextWrapPos(static_cast<float>(std::min(380.0 * scale, view.width - 48 * scale)));
  const Hint* next = std::ranges::find(steps, false, &Hint::done);  // shows one step at a time
  const bool all = next == std::end(steps);
  if (!all) {
    ImGui::Text("%d of %d   %s", static_cast<int>(next - steps) + 1,
                static_cast<int>(std::size(steps)), next->what);
    ImGui::TextDisabled("%s", next->how.c_str());
  } else {
    const std::string done = "\uf00c  All done. " + workspace.actions.key_of("help.keys") +
                             " lists all keys, " + workspace.actions.key_of("help.palette") +
                             " finds any command.";
    ImGui::TextWrapped("%s", done.c_str());
  }
  ImGui::PopTextWrapPos();
  const bool closed = ImGui::SmallButton(all ? "Done" : "Don't show this again");
  end_card();
  return !closed;
}

}  // namespace holomorph
