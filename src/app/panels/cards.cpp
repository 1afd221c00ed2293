// Cards over the canvas that offer help while a cage or a picture is missing.
#include <algorithm>

#include "app/panels/panels.h"

namespace holomorph {

void draw_missing_picture(Workspace& workspace, double scale, float above) {
  const std::vector<size_t> missing = workspace.document.layers_without_picture();
  if (missing.empty()) return;
  const Path file = workspace.document.scene().layers[missing.front()]->image->file;
  const float s = static_cast<float>(scale);
  const Viewport& view = workspace.display.viewport;
  const float bottom = static_cast<float>(view.top + view.height) - std::max(24 * s, above);
  begin_card("Missing picture", {static_cast<float>(view.left + view.width / 2), bottom},
             {0.5f, 1.0f}, scale);
  const std::string others =
      missing.size() > 1 ? ", and " + std::to_string(missing.size() - 1) + " more" : "";
  const bool withheld = workspace.document.pictures().withheld().contains(file.string());
  ImGui::Text("\uf071  %s %s%s", file.filename().c_str(),
              withheld ? "is not in the scene's folder" : "could not be read", others.c_str());
  ImGui::PushTextWrapPos(static_cast<float>(std::min(420 * scale, view.width - 48 * scale)));
  ImGui::TextDisabled(withheld ? "Hidden until you allow it: %s" : "The scene expects it in %s.",
                      withheld ? file.c_str() : file.parent_path().c_str());
  ImGui::PopTextWrapPos();
  if (withheld) {
    if (ImGui::Button("Show it...")) workspace.request = Request::show_withheld;
    ImGui::SameLine();
  }
  if (ImGui::Button("Find it...")) run("file.find_picture", workspace);
  end_card();
}

float draw_cage_offer(Workspace& workspace, double scale) {
  if (!workspace.document.image() || workspace.shown.deformation().has_cage()) return 0;
  const float s = static_cast<float>(scale);
  const Viewport& view = workspace.display.viewport;
  begin_card("Cage offer",
             {static_cast<float>(view.left + view.width / 2),
              static_cast<float>(view.top + view.height) - 24 * s},
             {0.5f, 1.0f}, scale);
  ImGui::TextUnformatted("To bend this picture, set pins in it, or put a cage around it.");
  // Use one row if there is room, else two.
  const bool row = view.width > 600 * scale;
  bool ends_row = true;
  const auto button = [&](const char* face, const char* id, float width) {
    if (ImGui::Button(face, {width * s, 0})) run(id, workspace);
    tooltip_of(workspace.actions.named(id));
    ends_row = !ends_row;
    if (row || !ends_row) ImGui::SameLine();
  };
  button("\uf08d  Set pins", "tool.pin", 120);
  button("\uf0d0  Make from picture", "cage.from_picture", 190);
  button("\uf040  Draw it", "tool.pen", 120);
  button("\uf047  Place", "cage.box", 120);
  if (row) ImGui::NewLine();
  detail_slider(workspace, 190 * s);
  ImGui::SameLine();
  ImGui::Checkbox("Curved", &workspace.tools.auto_cage.curved);
  const float height = ImGui::GetWindowHeight();
  end_card();
  return height + 32 * s;
}

}  // namespace holomorph
