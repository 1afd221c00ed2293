// The choices are drawings. A click on the picture itself is the shortest way, and needs no choice.
#include "app/panels/start_card.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/look/controls.h"
#include "app/look/method_picture.h"
#include "app/look/numbers.h"
#include "app/look/surfaces.h"
#include "app/panels/panels.h"
#include "edit/actions/icons.h"
#include "edit/content.h"
#include "edit/method_choice.h"
#include "edit/picture_cage.h"

namespace holomorph {
namespace {

constexpr double kCardWidth = 400;

std::shared_ptr<const Image> picture_of(const Workspace& workspace) {
  return workspace.document.pictures().still(workspace.document.scene().layer());
}

struct Choice {
  const char *picture, *label, *text;
  void (*choose)(Workspace&);
};

/// Chooses a method that pins control, for the pins that follow.
template <MethodUse use>
void start_with_pins(Workspace& workspace) {
  const std::string& id = usual_method(use).id;
  if (workspace.shown.own().method != id) choose_method(workspace, id);
  run("tool.pin", workspace);
}

constexpr Choice kChoices[] = {
    {"sheet", "Puppet", "Pins bend it. Sizes stay.", start_with_pins<MethodUse::puppet>},
    {"pins", "Elastic", "Pins bend it. Angles stay.", start_with_pins<MethodUse::pins>},
    {"cage", "Cage", "Points around it bend it.",
     [](Workspace& workspace) { run("cage.from_picture", workspace); }},
    {"place", "Place", "Move, scale and rotate.",
     [](Workspace& workspace) { run("cage.box", workspace); }}};

/// The height of the texts of the choices on cards of a width.
float caption_height(float width) {
  const ScopedFont small(Type::caption);
  float height = 0;
  for (const Choice& choice : kChoices)
    height = std::max(height, ImGui::CalcTextSize(choice.text, nullptr, false, width - px(20)).y);
  return height;
}

bool choice_card(const Choice& choice, bool chosen, ImVec2 size) {
  const ThemeColors& c = theme_colors();
  const bool clicked = ImGui::InvisibleButton(choice.label, size);
  const bool hovered = ImGui::IsItemHovered();
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  const ImU32 surface = chosen ? c.accent_tint : hovered ? c.hover : c.field;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(from, to, faded(surface), px(8));
  list.AddRect(from, to, faded(chosen ? c.accent : c.line), px(8), 0, chosen ? px(2) : 1);
  const float words = px(35) + caption_height(size.x), tall = size.y - words;
  draw_method_picture(list, choice.picture, {(from.x + to.x) / 2, from.y + tall / 2 + px(4)},
                      std::min(1.35f, (tall - px(16)) / px(54)), chosen ? c.text : c.control,
                      surface);
  const float x = from.x + px(12), room = size.x - px(20);
  draw_text(list, Type::strong, {x, to.y - words + px(4)}, c.text, choice.label);
  draw_wrapped_text(list, Type::caption, {x, to.y - words + px(25)}, c.muted, choice.text, room);
  draw_focus_ring(px(8));
  name_item(std::string("Start: ") + choice.label);
  return clicked;
}

}  // namespace

float StartCard::width() {
  return px(kCardWidth) + px(32);
}

bool StartCard::shows(const Workspace& workspace) const {
  return workspace.document.image() && !workspace.shown.deformation().has_cage() &&
         picture_of(workspace) != closed_for_;
}

bool StartCard::has_room(const Workspace& workspace) {
  constexpr double kFull = 0.85;  // of the size that the picture has without the card
  const Viewport& view = workspace.display.viewport;
  if (workspace.document.scene().layers.size() != 1 ||
      view.width < static_cast<double>(width() + px(320)) ||
      view.height < static_cast<double>(px(460)))
    return false;
  Viewport alone = view, beside = view;
  beside.width -= static_cast<double>(width());
  const Box content = content_box(workspace);
  alone.fit(content);
  beside.fit(content);
  return beside.zoom >= kFull * alone.zoom;
}

void StartCard::draw_choices(Workspace& workspace, float width) {
  const float gap = px(8), each = std::floor((width - gap) / 2),
              tall = std::floor(std::min(px(120), each * 0.7f) + px(35) + caption_height(each));
  const std::string& method = workspace.shown.own().method;
  for (size_t i = 0; i < std::size(kChoices); ++i) {
    const Choice& choice = kChoices[i];
    if (i % 2 == 1) ImGui::SameLine(0, gap);
    const bool by_pins = workspace.tools.active == ToolId::pin;
    const bool by_default = method == usual_method(MethodUse::cage).id;  // pins make it a puppet
    const bool is_set = by_pins && (by_default ? i == 0 : method == choice.picture);
    if (choice_card(choice, is_set, {each, tall})) choice.choose(workspace);
  }
  const ScopedLabelWidth narrow(px(56));
  slider_row("Detail", workspace.tools.auto_cage.detail, {.low = 0, .high = 100, .neutral = 50.0},
             kDetailHint);
}

void StartCard::draw(Workspace& workspace, const OverlayStyle& style) {
  draw_outline(workspace, style);
  const Viewport& view = workspace.display.viewport;
  ImGui::SetNextWindowSize({px(kCardWidth), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(20), px(16)});
  begin_card("Start",
             {static_cast<float>(view.left + view.width) - px(16),
              static_cast<float>(view.top + view.height / 2)},
             {1, 0.5f});
  const ImVec2 at = ImGui::GetCursorPos();
  const float inner = px(kCardWidth) - 2 * px(20), side = px(28);
  {
    const ScopedFont title(Type::title);
    ImGui::TextUnformatted("How should it bend?");
  }
  caption("Click the picture to set a pin, or choose how it bends.");
  draw_choices(workspace, inner);
  ImGui::SetCursorPos({at.x + inner - side + px(6), at.y - px(4)});
  if (icon_button("Close", icon_named("close"), "Close this card"))
    closed_for_ = picture_of(workspace);
  end_card();
  ImGui::PopStyleVar();
}

void StartCard::draw_docked(Workspace& workspace, const OverlayStyle& style) {
  draw_outline(workspace, style);
  ImGui::Dummy({0, px(8)});
  {
    const ScopedFont title(Type::strong);
    ImGui::TextUnformatted("How should it bend?");
  }
  draw_choices(workspace, ImGui::GetContentRegionAvail().x);
}

void StartCard::update_outline(const Workspace& workspace) {
  if (result_) {
    const std::lock_guard lock(result_->mutex);
    if (result_->cage) outline_ = std::move(*std::exchange(result_->cage, std::nullopt));
  }
  if (job_ && job_->ended()) job_.reset();
  AutoCageOptions options = workspace.tools.auto_cage;
  if (method_of_first_pin(workspace).allows_parts) options.parts = PartChoice::apart;
  const Question question{picture_of(workspace), options.detail, options.curved, options.parts};
  if (job_ || asked_ == question) return;
  if (!asked_ || asked_->image != question.image) outline_.reset();
  asked_ = question;
  result_ = std::make_shared<Result>();
  job_ = std::make_unique<Job>(
      "Finding the outline",
      [image = question.image, options, result = result_](Job::Progress&) {
        Cage cage = auto_cage(*image, options);
        const std::lock_guard lock(result->mutex);
        result->cage = std::move(cage);
      },
      wake_);
}

void StartCard::draw_outline(const Workspace& workspace, const OverlayStyle& style) {
  update_outline(workspace);
  if (outline_) draw_proposed_cage(workspace, *outline_, style);
}

}  // namespace holomorph
