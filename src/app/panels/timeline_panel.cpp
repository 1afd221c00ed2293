// The bar over the ruler: buttons, the current time and the frame rate.
#include "app/panels/timeline_panel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/look/controls.h"
#include "app/look/numbers.h"
#include "app/look/surfaces.h"
#include "edit/actions/icons.h"

namespace holomorph {
namespace {

constexpr double kBar = 44;
constexpr double kRateSeconds = 1.5;  ///< over which the rate of playback is measured

void tool_button(const char* id, Workspace& workspace) {
  const Action& action = workspace.actions.named(id);
  const bool on = action.checked && action.checked(workspace), enabled = action.enabled(workspace);
  const bool playing = std::string_view(id) == "time.play" && on;
  ImGui::BeginDisabled(!enabled);
  if (icon_button(id, playing ? icon_named("pause") : action.icon, "", on && !playing, px(28)))
    run(action, workspace);
  tooltip_of(workspace.actions.named(id));
  ImGui::EndDisabled();
  ImGui::SameLine(0, px(4));
}

void separator() {
  ImGui::SameLine(0, px(8));
  bar_separator(px(28));
  ImGui::SameLine(0, px(8));
}

void draw_set_key(Workspace& workspace) {
  const Action& action = workspace.actions.named("time.key");
  const float top = ImGui::GetCursorPosY();
  ImGui::BeginDisabled(!action.enabled(workspace));
  ImGui::SetCursorPosY(top - px(2));  // buttons are taller than icons
  if (button(std::string(action.icon) + " Set key", ButtonKind::flat)) run(action, workspace);
  name_item("Set key");
  tooltip_of(workspace.actions.named("time.key"));
  ImGui::EndDisabled();
  ImGui::SameLine(0, px(4));
  ImGui::SetCursorPosY(top);
}

}  // namespace

double TimelinePanel::height(const Workspace& workspace, const PanelSizes& sizes) const {
  return px(kBar) * (sizes.two_rows ? 2 : 1) + rows_.height(workspace) + 1;
}

std::string TimelinePanel::hint() const {
  if (rows_.over_ruler())
    return "Drag to go to a time; the wheel zooms, with Shift it pans; double-click shows all";
  if (rows_.over_film())
    return "Drag a film to move it, or its ends to trim it; Alt moves it between frames";
  return rows_.hovered()
             ? "Drag keys to move them, a bar to stretch; Alt puts keys between frames; "
               "Ctrl-drag copies; Shift-click selects more"
             : "";
}

void TimelinePanel::draw_numbers(Workspace& workspace, bool with_length) {
  const Scene& scene = workspace.document.scene();
  double time = workspace.shown.timeline.time;
  if (number_field("##Time", time, {0, kMaxTime, "s", 2, false, {}, 0.01}, px(84)))
    workspace.go_to_time(time);
  tooltip("Current time");
  ImGui::SameLine(0, px(6));
  // While the field is dragged, it keeps fractions of frames.
  const double shown = frame_at(scene, workspace.shown.timeline.time);
  if (!frame_ || std::lround(*frame_) != std::lround(shown)) frame_ = shown;
  if (number_field("##Frame", *frame_, {0, kMaxTime * kMaxFrameRate, "frame", 0, false, {}, 0.2},
                   px(96)))
    workspace.go_to_time(time_of_frame(scene, static_cast<int>(std::lround(*frame_))));
  if (!ImGui::IsItemActive()) frame_.reset();
  tooltip("Current frame");
  ImGui::SameLine(0, px(8));
  if (with_length) {
    char length[32];
    std::snprintf(length, sizeof length, "of %.2f s", length_of(scene));
    ImGui::AlignTextToFramePadding();
    colored_text(theme_colors().muted, length);
    ImGui::SameLine(0, px(8));
  }
  double rate = scene.animation.frames_per_second;
  const Change change = number_field(
      "##Rate", rate,
      {kMinFrameRate, kMaxFrameRate, "fps", rate == std::round(rate) ? 0 : 3, false, {}, 1},
      px(88));
  if (change.changed) {
    AnimationSettings settings = scene.animation;
    settings.frames_per_second = std::round(1000 * rate) / 1000;
    workspace.commit_or_amend_layers("Frame rate", with_animation(scene, settings));
  }
  if (change.ended) workspace.end_mergeable_step();
  tooltip("Frames per second, for stepping and export");
}

/// Says how fast the animation plays, left of `end`.
void TimelinePanel::draw_real_rate(const Workspace& workspace, float end) {
  const Timeline& timeline = workspace.shown.timeline;
  const double now = ImGui::GetTime();
  if (!timeline.playing) {
    played_.clear();
    return;
  }
  const int frame = frame_at(workspace.document.scene(), timeline.time);
  if (played_.empty() || played_.back().frame != frame) played_.push_back({frame, now});
  std::erase_if(played_, [&](const PlayedFrame& played) { return played.at < now - kRateSeconds; });
  if (played_.size() < 3) return;
  const double rate =
      static_cast<double>(played_.size() - 1) / (played_.back().at - played_.front().at);
  const double wanted = workspace.document.scene().animation.frames_per_second;
  char text[64];
  std::snprintf(text, sizeof text, "Plays at %.0f fps", std::min(rate, wanted));
  ImGui::SameLine(0, px(8));
  const float room = end - px(8) - ImGui::GetCursorScreenPos().x;
  if (room < text_size(Type::body, text).x)
    std::snprintf(text, sizeof text, "%.0f fps", std::min(rate, wanted));
  if (room < text_size(Type::body, text).x) return;
  ImGui::AlignTextToFramePadding();
  colored_text(rate < 0.9 * wanted ? theme_colors().warning : theme_colors().muted, text);
  name_item("real rate");
}

void TimelinePanel::draw_zoom(Workspace& workspace, float right, bool with_zoom) {
  const float side = px(28);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (with_zoom) {
    ImGui::SetCursorScreenPos({right - 3 * side - px(16), at.y});
    const double now = workspace.shown.timeline.time;
    if (icon_button("Zoom out", icon_named("minus"), "Show more time (wheel over the ruler)", false,
                    side))
      rows_.ruler().zoom(1 / 1.5, now);
    ImGui::SameLine(0, px(4));
    if (icon_button("Zoom in", icon_named("add"),
                    "Show less time (wheel over the ruler). Double-click the ruler to show all.",
                    false, side))
      rows_.ruler().zoom(1.5, now);
  }
  ImGui::SetCursorScreenPos({right - side - px(8), at.y});
  if (icon_button("Close timeline", icon_named("close"), "Close the timeline", false, side))
    run("view.timeline", workspace);
}

void TimelinePanel::draw(Workspace& workspace, Thumbnails& thumbnails, const PanelSizes& sizes) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const ImVec2 to(display.x - static_cast<float>(sizes.inspector),
                  display.y - static_cast<float>(sizes.status)),
      from(static_cast<float>(sizes.toolbar), to.y - static_cast<float>(sizes.timeline));
  begin_panel("Timeline", from, to, theme_colors().panel, {0, 0}, ImGuiWindowFlags_NoScrollbar);
  ImGui::GetWindowDrawList()->AddLine(from, {to.x, from.y}, faded(theme_colors().line));
  ImGui::SetCursorScreenPos({from.x + px(10), from.y + px(8)});
  for (const char* id : {"time.previous_key", "time.back", "time.play", "time.forward",
                         "time.next_key", "time.loop"})
    tool_button(id, workspace);
  if (!sizes.two_rows) {
    separator();
    draw_numbers(workspace, true);
  }
  separator();
  if (sizes.two_rows)
    tool_button("time.key", workspace);
  else
    draw_set_key(workspace);
  tool_button("time.auto_key", workspace);
  if (!sizes.two_rows) tool_button("time.onion", workspace);
  const float zoom = to.x - 3 * px(28) - px(16);
  if (!sizes.two_rows) draw_real_rate(workspace, zoom);
  ImGui::SetCursorScreenPos({from.x, from.y + px(8)});
  draw_zoom(workspace, to.x, !sizes.two_rows);
  if (sizes.two_rows) {
    ImGui::SetCursorScreenPos({from.x + px(10), from.y + px(kBar + 4)});
    draw_numbers(workspace, false);
  }
  ImGui::SetCursorScreenPos({from.x, from.y + px(kBar) * (sizes.two_rows ? 2 : 1)});
  rows_.draw(workspace, thumbnails);
  end_panel();
}

}  // namespace holomorph
