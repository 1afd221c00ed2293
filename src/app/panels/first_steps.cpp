// The card never lies over the picture. It is placed in the first corner of the canvas that is
// free.
#include "app/panels/first_steps.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <optional>

#include "app/look/controls.h"
#include "app/look/surfaces.h"
#include "edit/content.h"

namespace holomorph {
namespace {

constexpr double kCardWide = 280, kCardTall = 116;

/// The upper left corner of a card of this size that lies in the canvas, but not over the picture.
std::optional<ImVec2> place_beside_picture(const Workspace& workspace, ImVec2 size) {
  const Viewport& view = workspace.display.viewport;
  const Box box = content_box(workspace);
  const float margin = px(12);
  const ImRect canvas(static_cast<float>(view.left), static_cast<float>(view.top),
                      static_cast<float>(view.left + view.width),
                      static_cast<float>(view.top + view.height));
  if (box.empty()) return canvas.Min + ImVec2(margin, margin);
  const Complex a = view.px_at_plane({box.left, box.top}),
                b = view.px_at_plane({box.right, box.bottom});
  const ImRect picture(static_cast<float>(a.real()) - margin, static_cast<float>(a.imag()) - margin,
                       static_cast<float>(b.real()) + margin,
                       static_cast<float>(b.imag()) + margin);
  const float x0 = canvas.Min.x + margin, x1 = canvas.Max.x - margin - size.x,
              y0 = canvas.Min.y + margin, y1 = canvas.Max.y - margin - size.y;
  for (const ImVec2& at : {ImVec2(x0, y0), {x1, y0}, {x0, y1}, {x1, y1}}) {
    const ImRect card(at, at + size);
    if (canvas.Contains(card) && !card.Overlaps(picture)) return at;
  }
  return {};
}

}  // namespace

void FirstSteps::follow(const Workspace& workspace, bool exported) {
  const Deformation& deformation = workspace.shown.own();
  const bool posed = deformation.has_cage() &&
                     whole_pose_of(deformation) != whole_pose_of(at_rest(deformation)),
             bent = posed && workspace.document.history().can_undo(),
             held = deformation.has_cage() &&
                    (deformation.pins.size() >= 2 || posed || deformation.pins.empty());
  const size_t now = exported ? 3 : bent ? 2 : held ? 1 : 0;
  step_ = std::max(step_, now);
}

bool FirstSteps::draw_contents(const Workspace& workspace) const {
  const ActionTable& actions = workspace.actions;
  struct Step {
    const char* what;
    std::string how;
  };
  const Deformation& deformation = workspace.shown.own();
  const bool by_cage = deformation.has_cage() && deformation.pins.empty();
  const Step steps[] = {
      {"Hold it", "Click two parts that should stay in place. Each click sets a pin."},
      {"Bend it", by_cage ? "Drag a cage point, or press " + actions.key_of("tool.pin") +
                                " and drag a part of the picture."
                          : "Press another part and drag it."},
      {"Keep it",
       "Press Export for a picture, or " + actions.key_of("file.save") + " to save the scene."}};
  const Step& step = steps[std::min<size_t>(step_, 2)];
  const ImVec2 at = ImGui::GetCursorPos();
  {
    const ScopedFont strong(Type::strong);
    ImGui::TextUnformatted(step.what);
    name_item(step.what);
  }
  const ImVec2 below = ImGui::GetCursorPos();
  const std::string number = std::to_string(std::min<size_t>(step_, 2) + 1) + " of 3";
  ImGui::SetCursorPos(
      {at.x + ImGui::GetContentRegionAvail().x - text_size(Type::body, number).x, at.y});
  muted_text(number);
  ImGui::SetCursorPos(below);
  caption(step.how);
  return small_button("Hide", ButtonKind::flat);
}

bool FirstSteps::draw(const Workspace& workspace, bool& closed) const {
  const ImVec2 size(px(kCardWide), px(kCardTall));
  const auto at = place_beside_picture(workspace, size);
  if (!at) return false;
  ImGui::SetNextWindowSize({size.x, 0});
  begin_card("First steps", *at, {0, 0});
  closed = draw_contents(workspace);
  end_card();
  return true;
}

float FirstSteps::draw_docked(const Workspace& workspace, float inspector, float bottom,
                              bool& closed) const {
  const float width = ImGui::GetIO().DisplaySize.x, height = px(kCardTall);
  begin_panel("First steps", {width - inspector, bottom - height}, {width, bottom},
              theme_colors().panel, {16, 12});
  ImGui::GetWindowDrawList()->AddLine({width - inspector, bottom - height},
                                      {width, bottom - height}, faded(theme_colors().line));
  closed = draw_contents(workspace);
  end_panel();
  return height;
}

}  // namespace holomorph
