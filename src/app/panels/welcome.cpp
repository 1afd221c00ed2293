// The welcome page of an empty window: samples, recent files and unsaved work.
#include <algorithm>

#include "app/panels/panels.h"

namespace holomorph {

PanelAnswer draw_welcome(Workspace& workspace, const Preferences& preferences,
                         const std::vector<Sample>& samples,
                         const std::vector<Recovery>& recoverable, double scale) {
  PanelAnswer answer;
  const float s = static_cast<float>(scale);
  const PanelSizes sizes = PanelSizes::at(scale);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, static_cast<float>(sizes.menu)});
  ImGui::SetNextWindowSize({display.x, display.y - static_cast<float>(sizes.menu + sizes.status)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {48 * s, 32 * s});
  ImGui::Begin("Welcome", nullptr, kPanel);
  ImGui::PushFont(title_font());
  ImGui::TextUnformatted("Holomorph");
  ImGui::PopFont();
  ImGui::TextDisabled("Bend a picture: give it a cage, then drag cage points and pins.");
  ImGui::Dummy({0, 8 * s});
  if (ImGui::Button("\uf07c  Open a picture or scene", {270 * s, 40 * s}))
    run("file.open", workspace);
  ImGui::SameLine();
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + (40 * s - ImGui::GetTextLineHeight()) / 2 - 5 * s);
  ImGui::TextDisabled("or drop a file on this window");
  if (!recoverable.empty()) {
    ImGui::Dummy({0, 8 * s});
    ImGui::PushStyleColor(ImGuiCol_Text, canvas_colors(preferences.theme).warning);
    ImGui::TextUnformatted("Unsaved work:");
    ImGui::PopStyleColor();
    for (const auto& [path, label, origin] : recoverable) {
      ImGui::PushID(path.c_str());
      ImGui::AlignTextToFramePadding();
      ImGui::TextUnformatted(label.c_str());
      ImGui::SameLine();
      if (ImGui::Button("Recover")) answer.recover = path;
      ImGui::SameLine();
      // Requires a second click, because discarding cannot be undone.
      bool& sure = *ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("sure"));
      if (ImGui::Button(sure ? "Really discard?###discard" : "Discard###discard")) {
        if (sure) answer.discard = path;
        sure = !sure;
      }
      ImGui::PopID();
    }
  }
  ImGui::Dummy({0, 10 * s});
  ImGui::TextUnformatted("Samples");
  // Put all tiles in one row unless that makes them too small.
  const float count = static_cast<float>(std::max<size_t>(samples.size(), 1)),
              tile = std::clamp((display.x - 116 * s) / count - 20 * s, 110 * s, 200 * s);
  for (size_t i = 0; i < samples.size(); ++i) {
    const Sample& sample = samples[i];
    ImGui::PushID(static_cast<int>(i));
    if (i > 0 && ImGui::GetItemRectMax().x + tile + 60 * s < display.x) ImGui::SameLine(0, 20 * s);
    ImGui::BeginGroup();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::Button("##tile", {tile, tile})) answer.sample = sample.scene;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (sample.thumbnail.id()) {
      const float w = static_cast<float>(sample.thumbnail.width()),
                  h = static_cast<float>(sample.thumbnail.height());
      const float fit = (tile - 24 * s) / std::max(w, h);
      const ImVec2 corner(at.x + (tile - w * fit) / 2, at.y + (tile - h * fit) / 2);
      list.AddImage(
          reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(sample.thumbnail.id())), corner,
          {corner.x + w * fit, corner.y + h * fit});
    }
    ImGui::TextUnformatted(sample.title.c_str());
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + tile);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", sample.text.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    ImGui::EndGroup();
    ImGui::PopID();
  }
  if (!preferences.recent.empty()) {
    ImGui::Dummy({0, 10 * s});
    ImGui::TextUnformatted("Recent");
    for (size_t i = 0; i < std::min<size_t>(preferences.recent.size(), 6); ++i)
      if (text_row(static_cast<int>(i), preferences.recent[i].string(), false,
                   {std::min(display.x - 100 * s, 640 * s), 0}))
        answer.open = preferences.recent[i];
  }
  ImGui::End();
  ImGui::PopStyleVar();
  return answer;
}

}  // namespace holomorph
