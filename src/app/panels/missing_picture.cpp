// The card that names a missing picture and offers to find it.
#include <imgui.h>

#include "app/look/controls.h"
#include "app/panels/panels.h"
#include "edit/actions/icons.h"

namespace holomorph {

void draw_missing_picture(Workspace& workspace) {
  const std::vector<size_t> missing = workspace.document.layers_without_picture();
  if (missing.empty()) return;
  const Path file = workspace.document.scene().layers[missing.front()]->image->file;
  const Viewport& view = workspace.display.viewport;
  ImGui::SetNextWindowSize({std::min(px(420), static_cast<float>(view.width) - px(32)), 0});
  begin_card("Missing picture",
             {static_cast<float>(view.left + view.width / 2),
              static_cast<float>(view.top + view.height) - px(24)},
             {0.5f, 1.0f});
  const std::string others =
      missing.size() > 1 ? ", and " + std::to_string(missing.size() - 1) + " more" : "";
  const bool withheld = workspace.document.pictures().withheld().contains(file.string());
  const Layer& layer = *workspace.document.scene().layers[missing.front()];
  const bool unclear = !withheld && is_unclear(*layer.image);
  wrapped_text(std::string(icon_named("warning")) + "  " + file.filename().string() +
               (withheld  ? " is not in the scene's folder"
                : unclear ? ": it is not clear which layer \"" + name_in_file(layer) + "\" is now"
                          : " could not be read") +
               others);
  caption(withheld  ? "Hidden until you allow it: " + file.string()
          : unclear ? "The file has changed."
                    : "The scene expects it in " + file.parent_path().string() + ".");
  if (unclear) {
    if (button("Choose...", ButtonKind::primary)) workspace.request = Request::find_layers;
    return end_card();
  }
  if (withheld) {
    if (button("Show it...", ButtonKind::primary)) workspace.request = Request::show_withheld;
    ImGui::SameLine();
  }
  if (button("Find it...", withheld ? ButtonKind::secondary : ButtonKind::primary))
    run("file.find_picture", workspace);
  end_card();
}

}  // namespace holomorph
