// Short answers form a row at the right, long ones a column.
#include "app/dialogs/question.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/look/controls.h"
#include "app/look/surfaces.h"

namespace holomorph {

void Questions::draw() {
  if (!open_) return;
  constexpr size_t kShort = 12;  // the longest short answer, in characters
  if (!begin_dialog(open_->title, "###question", 440)) return;
  wrapped_text(open_->text);
  const std::vector<Question::Answer>& answers = open_->answers;
  const bool row = std::ranges::all_of(
      answers, [](const Question::Answer& answer) { return answer.label.size() <= kShort; });
  std::optional<size_t> given;
  size_t focused = open_->default_answer;
  const auto answer_button = [&](size_t i, float width) {
    const bool is_default = i == open_->default_answer;
    const ButtonKind kind = is_default            ? ButtonKind::primary
                            : answers[i].destroys ? ButtonKind::flat_danger
                                                  : ButtonKind::secondary;
    if (button(answers[i].label, kind, width)) given = i;
    if (is_default) ImGui::SetItemDefaultFocus();
    if (ImGui::IsItemFocused()) focused = i;
  };
  if (row) {
    // The default is at the right, and the answer that Escape gives next to it.
    const float gap = px(8);
    std::vector<float> widths;
    float all = -gap;
    for (const Question::Answer& answer : answers) {
      widths.push_back(std::max(px(88), text_size(Type::strong, answer.label).x + px(32)));
      all += widths.back() + gap;
    }
    begin_dialog_buttons(all);
    std::vector<size_t> order;
    for (size_t i = answers.size(); i-- > 0;)
      if (i != open_->default_answer) order.push_back(i);
    std::stable_partition(order.begin(), order.end(),
                          [&](size_t i) { return answers[i].destroys; });
    order.push_back(open_->default_answer);
    for (size_t k = 0; k < order.size(); ++k) {
      if (k > 0) ImGui::SameLine(0, gap);
      answer_button(order[k], widths[order[k]]);
    }
  } else {
    ImGui::Dummy({0, px(4)});
    for (size_t i = 0; i < answers.size(); ++i) answer_button(i, -1);
  }
  if (dialog_key() == DialogKey::escape) given = open_->escape.value_or(answers.size() - 1);
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false)) given = focused;
  if (given) ImGui::CloseCurrentPopup();
  end_dialog();
  if (!given) return;
  const Question answered =
      *std::exchange(open_, std::nullopt);  // the answer may ask another question
  if (answered.answers[*given].act) answered.answers[*given].act();
}

}  // namespace holomorph
