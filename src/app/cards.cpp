// What is offered over the canvas while something is missing: a cage, a picture.
#include <algorithm>

#include "app/panels.h"

namespace holomorph {

void draw_missing_picture(Workspace& workspace, double scale, float above) {
  const std::vector<size_t> missing = workspace.document.without_picture();
  if (missing.empty()) return;
  const Path file = layer_at(workspace.document.scene(), missing.front()).image->file;
  const float s = static_cast<float>(scale);
  const Viewport& view = workspace.viewport;
  ImGui::SetNextWindowPos({static_cast<float>(view.left + view.width / 2),
                           static_cast<float>(view.top + view.height) - std::max(24 * s, above)},
                          ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8 * s);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::Begin("Missing picture", nullptr, kPanel | ImGuiWindowFlags_AlwaysAutoResize);
  std::error_code ignored;
  const bool is_there = std::filesystem::exists(file, ignored);
  ImGui::Text(
      "\uf071  %s %s%s", file.filename().c_str(), is_there ? "cannot be read" : "is missing",
      missing.size() > 1 ? (", and " + std::to_string(missing.size() - 1) + " more").c_str() : "");
  ImGui::PushTextWrapPos(static_cast<float>(std::min(420 * scale, view.width - 48 * scale)));
  ImGui::TextDisabled("It %s in %s.", is_there ? "is" : "was", file.parent_path().c_str());
  ImGui::PopTextWrapPos();
  if (ImGui::Button("Find it...")) run(action_named("file.find_picture"), workspace);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

float draw_cage_offer(Workspace& workspace, double scale) {
  if (!workspace.document.image() || workspace.scene().has_cage()) return 0;
  const float s = static_cast<float>(scale);
  const Viewport& view = workspace.viewport;
  ImGui::SetNextWindowPos({static_cast<float>(view.left + view.width / 2),
                           static_cast<float>(view.top + view.height) - 24 * s},
                          ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8 * s);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::Begin("Cage offer", nullptr, kPanel | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::TextUnformatted("This picture needs a cage before it can bend.");
  // Beside each other where there is room.
  const bool row = view.width > 600 * scale;
  const auto button = [&](const char* face, const char* id) {
    if (ImGui::Button(face, {190 * s, 0})) run(action_named(id), workspace);
    tooltip_of(id);
    if (row) ImGui::SameLine();
  };
  button("\uf0d0  Make from picture", "cage.from_picture");
  button("\uf040  Draw it", "tool.pen");
  button("\uf047  Only move and scale", "cage.box");
  if (row) ImGui::NewLine();
  points_slider(workspace, 190 * s);
  ImGui::SameLine();
  ImGui::Checkbox("curved", &workspace.auto_cage_curved);
  const float height = ImGui::GetWindowHeight();
  ImGui::End();
  ImGui::PopStyleVar(2);
  return height + 32 * s;
}

}  // namespace holomorph
