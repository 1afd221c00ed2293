// Each layer has a list of what it may be. What is chosen for one layer is grayed for the others.
#include "app/dialogs/layer_question.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/look/controls.h"
#include "app/look/surfaces.h"
#include "app/panels/panels.h"

namespace holomorph {
namespace {

constexpr float kSide = 56;  // of a thumbnail

/// A name in which nothing looks like the mark before the hidden part of a label.
std::string plain(std::string name) {
  for (size_t at = 0; (at = name.find("##", at)) != std::string::npos;) name.replace(at, 2, "# #");
  return name;
}

}  // namespace

void LayerQuestion::ask(FoundLayers found, std::function<void(const LayerChoices&)> answered) {
  const size_t count = found.update.unclear.size();
  asked_.push_back(
      {std::move(found), std::vector<std::optional<std::string>>(count), std::move(answered)});
}

bool LayerQuestion::is_taken(const std::string& entry, size_t except) const {
  const auto& chosen = asked_.front().chosen;
  for (size_t i = 0; i < chosen.size(); ++i)
    if (i != except && chosen[i] == entry) return true;
  return false;
}

void LayerQuestion::draw_row(size_t number, Thumbnails& thumbnails) {
  FoundLayers& found = asked_.front().found;
  const UnclearLayer& unclear = found.update.unclear[number];
  std::optional<std::string>& chosen = asked_.front().chosen[number];
  const auto name_of = [&]() -> std::string {
    if (!chosen) return "Choose...";
    for (const FileLayer& candidate : unclear.candidates)
      if (candidate.entry == *chosen) return candidate.name;
    return "None of them";
  };
  ImGui::PushID(static_cast<int>(number));
  const Texture* texture =
      chosen && !chosen->empty() ? thumbnails.of_picture(found.candidates[*chosen]) : nullptr;
  draw_thumbnail(*ImGui::GetWindowDrawList(), texture, ImGui::GetCursorScreenPos(), px(kSide),
                 px(4));
  ImGui::Dummy({px(kSide), px(kSide)});
  ImGui::SameLine(0, px(12));
  ImGui::BeginGroup();
  wrapped_text(unclear.name.empty() ? "Layer without a name" : unclear.name);
  if (begin_dropdown("##layer", name_of(), ImGui::GetContentRegionAvail().x)) {
    for (const FileLayer& candidate : unclear.candidates)
      if (dropdown_row(plain(candidate.name) + "##" + candidate.entry, chosen == candidate.entry,
                       !is_taken(candidate.entry, number)))
        chosen = candidate.entry;
    if (dropdown_row("None of them", chosen == "")) chosen = "";
    end_dropdown();
  }
  ImGui::EndGroup();
  ImGui::PopID();
}

void LayerQuestion::draw(Thumbnails& thumbnails) {
  if (asked_.empty()) return;
  const auto& [found, chosen, answered] = asked_.front();
  const std::string file = found.update.report.file;
  if (!begin_dialog(kTitle, "###layers", 460)) return;
  const bool several = chosen.size() > 1;
  wrapped_text(file + " has changed. Choose what " +
               (several ? "each of these layers is now. They keep their cages, pins and keyframes."
                        : "this layer is now. It keeps its cage, pins and keyframes."));
  constexpr float kMostRows = 5;
  const float rows = std::min(static_cast<float>(chosen.size()), kMostRows);
  ImGui::BeginChild("rows", {0, rows * px(kSide + 12)});
  for (size_t i = 0; i < chosen.size(); ++i) draw_row(i, thumbnails);
  ImGui::EndChild();
  constexpr float kWidth = 96;
  begin_dialog_buttons(2 * px(kWidth) + px(8));
  const bool complete = std::ranges::all_of(
      chosen, [](const std::optional<std::string>& entry) { return entry.has_value(); });
  bool later = button("Later", ButtonKind::secondary, px(kWidth));
  ImGui::SameLine(0, px(8));
  ImGui::BeginDisabled(!complete);
  bool done = button("OK", ButtonKind::primary, px(kWidth));
  ImGui::EndDisabled();
  const DialogKey key = dialog_key();
  later = later || key == DialogKey::escape;
  done = done || (complete && key == DialogKey::enter);
  if (later || done) ImGui::CloseCurrentPopup();
  end_dialog();
  if (!later && !done) return;
  LayerChoices choices;
  for (size_t i = 0; done && i < chosen.size(); ++i)
    choices.emplace_back(found.update.unclear[i].entry, *chosen[i]);
  const auto answer = answered;
  asked_.pop_front();
  if (done) answer(choices);
}

}  // namespace holomorph
