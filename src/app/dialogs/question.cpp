// Short answers form a row, long ones a column.
#include "app/dialogs/question.h"

#include <algorithm>
#include <utility>

#include "app/panels/panels.h"

namespace holomorph {

void Questions::draw(double scale) {
  if (!open_) return;
  constexpr const char* kId = "###question";
  constexpr size_t kShort = 12;  // the longest short answer, in characters
  const float s = static_cast<float>(scale);
  ImGui::OpenPopup(kId);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal((open_->title + kId).c_str(), nullptr,
                              ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
    return;
  ImGui::PushTextWrapPos(std::min(430 * s, display.x - 60 * s));
  ImGui::TextUnformatted(open_->text.c_str());
  ImGui::PopTextWrapPos();
  const float text_right = ImGui::GetItemRectMax().x;
  ImGui::Dummy({0, 6});
  const std::vector<Question::Answer>& answers = open_->answers;
  const bool row = std::ranges::all_of(
      answers, [](const Question::Answer& answer) { return answer.label.size() <= kShort; });
  const float width =
      std::max(330 * s, text_right - ImGui::GetWindowPos().x - ImGui::GetStyle().WindowPadding.x);
  std::optional<size_t> given;
  size_t focused = open_->default_answer;
  for (size_t i = 0; i < answers.size(); ++i) {
    if (row && i > 0) ImGui::SameLine();
    if (ImGui::Button(answers[i].label.c_str(), {row ? 130 * s : width, 0})) given = i;
    if (i == open_->default_answer) ImGui::SetItemDefaultFocus();
    if (ImGui::IsItemFocused()) focused = i;
  }
  if (escape_pressed()) given = open_->escape.value_or(answers.size() - 1);
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false)) given = focused;
  if (given) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  if (!given) return;
  const Question answered =
      *std::exchange(open_, std::nullopt);  // the answer may ask another question
  if (answered.answers[*given].act) answered.answers[*given].act();
}

}  // namespace holomorph
