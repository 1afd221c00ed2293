// Keyframes are marks on a ruler. A line marks the current time.
#include "app/panels/timeline_panel.h"

#include <array>
#include <cmath>
#include <utility>

#include "app/look/controls.h"
#include "app/panels/panels.h"
#include "edit/actions/icons.h"

namespace holomorph {
namespace {

constexpr double kRateSeconds = 1.5;  ///< over which the rate of playback is measured

/// Converts between seconds on the ruler and window px.
struct Ruler {
  float left = 0, width = 1, top = 0, bottom = 0;
  double length = 1;

  float x(double time) const { return left + static_cast<float>(time / length) * width; }
  double time(float x) const { return static_cast<double>((x - left) / width) * length; }
};

/// The smallest step of at least `least` seconds that is 1, 2 or 5 times a power of ten.
double tick_of(double least) {
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * decade >= least) return step * decade;
  return 10 * decade;
}

void tool_button(const char* id, Workspace& workspace, float size) {
  const Action& action = workspace.actions.named(id);
  const bool on = action.checked && action.checked(workspace), enabled = action.enabled(workspace);
  const bool playing = std::string_view(id) == "time.play" && on;
  ImGui::BeginDisabled(!enabled);
  if (icon_button(id, playing ? icon_named("pause") : action.icon, "", on && !playing, size))
    run(action, workspace);
  tooltip_of(workspace.actions.named(id));
  ImGui::EndDisabled();
  ImGui::SameLine(0, px(4));
}

/// Shows the last drawn item's tooltip and continues on the same line. A gesture that starts on the
/// item becomes a separate undo step.
void finish_item(Workspace& workspace, const char* hint) {
  if (ImGui::IsItemActivated()) workspace.end_mergeable_step();
  tooltip(hint);
  ImGui::SameLine();
}

void draw_time(Workspace& workspace, float s) {
  double time = workspace.shown.timeline.time;
  ImGui::SetNextItemWidth(76 * s);
  if (ImGui::DragScalar("##time", ImGuiDataType_Double, &time, 0.01f, nullptr, nullptr, "%.2f s") &&
      std::isfinite(time))
    workspace.go_to_time(time);
  finish_item(workspace, "Current time");
}

void draw_blend(Workspace& workspace, float s) {
  AnimationSettings settings = workspace.document.scene().animation;
  static constexpr const char* kLabels[] = {"Shapes", "Positions"};
  const size_t blend = settings.linear_blend ? 1 : 0;
  if (begin_dropdown("##blend", kLabels[blend], 104 * s)) {
    for (size_t i = 0; i < 2; ++i)
      if (dropdown_row(kLabels[i], i == blend)) {
        settings.linear_blend = i == 1;
        workspace.commit_layers("Blending", with_animation(workspace.document.scene(), settings));
      }
    end_dropdown();
  }
  finish_item(workspace,
              "What to blend between keyframes: shapes (rotations and sizes) or, for comparison, "
              "positions");
}

/// Draws the easing and the whole turns of the keyframe at the current time.
void draw_key_numbers(Workspace& workspace, float s) {
  Deformation deformation = workspace.shown.own();
  const size_t key = key_at(deformation, workspace.shown.timeline.time);
  if (key >= deformation.keyframes.size()) return;
  if (ImGui::GetContentRegionAvail().x < 240 * s)
    return;  // the keyframe's context menu also has these fields
  ImGui::Dummy({8 * s, 0});
  ImGui::SameLine();
  static constexpr const char* kEases[] = {"Smooth", "Linear", "Hold"};
  const auto ease = static_cast<size_t>(deformation.keyframes[key].ease);
  if (begin_dropdown("##ease", kEases[ease], 104 * s)) {
    for (size_t i = 0; i < 3; ++i)
      if (dropdown_row(kEases[i], i == ease))
        workspace.commit("Easing", with_ease(deformation, key, static_cast<Ease>(i)),
                         EditBase::document);
    end_dropdown();
  }
  finish_item(workspace, "Easing from this keyframe to the next one");
  if (key == 0) return;
  int& turns = deformation.keyframes[key].turns;
  ImGui::SetNextItemWidth(96 * s);
  if (ImGui::InputInt("##turns", &turns, 1, 1)) {
    turns = std::clamp(turns, -kMaxTurns, kMaxTurns);
    workspace.commit_or_amend("Whole turns", deformation, EditBase::document);
  }
  finish_item(workspace, "Extra whole turns between the previous keyframe and this one");
}

/// Draws a keyframe: a circle for smooth easing, a diamond for linear, a square for hold. If the
/// keyframe does not play, the mark is hollow.
void draw_key(ImDrawList& list, ImVec2 at, float r, ImU32 color, Ease ease, bool plays) {
  if (ease == Ease::smooth) {
    r *= 0.85f;
    return plays ? list.AddCircleFilled(at, r, color) : list.AddCircle(at, r, color, 0, 1.5f);
  }
  const float s = 0.75f * r;
  const std::array<ImVec2, 4> corners =
      ease == Ease::hold ? std::array{ImVec2(at.x - s, at.y - s), ImVec2(at.x + s, at.y - s),
                                      ImVec2(at.x + s, at.y + s), ImVec2(at.x - s, at.y + s)}
                         : std::array{ImVec2(at.x - r, at.y), ImVec2(at.x, at.y - r),
                                      ImVec2(at.x + r, at.y), ImVec2(at.x, at.y + r)};
  if (plays)
    list.AddConvexPolyFilled(corners.data(), 4, color);
  else
    list.AddPolyline(corners.data(), 4, color, ImDrawFlags_Closed, 1.5f);
}

/// Snaps a time to a frame, unless Alt is held.
double snapped(const Scene& scene, double time) {
  if (ImGui::GetIO().KeyAlt) return std::clamp(time, 0.0, kMaxTime);
  return time_of_frame(scene, std::max(0, frame_at(scene, time)));
}

std::optional<size_t> key_under_pointer(const Deformation& deformation, const Ruler& ruler,
                                        float s) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (mouse.y <= ruler.bottom - 24 * s) return {};
  std::optional<size_t> under;
  for (size_t i = 0; i < deformation.keyframes.size(); ++i)
    if (std::abs(ruler.x(deformation.keyframes[i].time) - mouse.x) < 8 * s) under = i;
  return under;
}

/// Draws the context menu of the keyframe at the current time, if it is open.
void draw_key_menu(Workspace& workspace) {
  if (!ImGui::BeginPopup("key")) return;
  const Deformation deformation = workspace.shown.own();
  const size_t key = key_at(deformation, workspace.shown.timeline.time);
  if (key < deformation.keyframes.size()) {
    for (const auto& [label, ease] :
         {std::pair("Smooth", Ease::smooth), {"Linear", Ease::linear}, {"Hold", Ease::hold}})
      if (ImGui::MenuItem(label, "", deformation.keyframes[key].ease == ease))
        workspace.commit("Easing", with_ease(deformation, key, ease), EditBase::document);
    ImGui::Separator();
    int turns = deformation.keyframes[key].turns;
    ImGui::SetNextItemWidth(8 * ImGui::GetFontSize());
    if (key > 0 && ImGui::InputInt("Whole turns before it", &turns)) {
      Deformation after = deformation;
      after.keyframes[key].turns = std::clamp(turns, -kMaxTurns, kMaxTurns);
      workspace.commit_or_amend("Whole turns", after, EditBase::document);
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Delete keyframe", "Del")) run("time.delete_key", workspace);
  }
  ImGui::EndPopup();
}

void draw_ruler(const Workspace& workspace, const Ruler& ruler, std::optional<size_t> hovered,
                float s) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 text = ImGui::GetColorU32(ImGuiCol_TextDisabled),
              ground = ImGui::GetColorU32(ImGuiCol_FrameBg),
              line = ImGui::GetColorU32(ImGuiCol_Separator),
              accent = ImGui::GetColorU32(ImGuiCol_CheckMark);
  const float height = ruler.bottom - ruler.top, middle = ruler.bottom - 13 * s;
  list.AddRectFilled({ruler.left - 8 * s, ruler.top},
                     {ruler.left + ruler.width + 8 * s, ruler.bottom}, ground, 4 * s);
  const double tick = tick_of(ruler.length * 70 * s / ruler.width);
  for (int i = 0; i * tick <= ruler.length * (1 + 1e-9); ++i) {
    const float x = ruler.x(i * tick);
    char label[24];
    std::snprintf(label, sizeof label, "%.4g", i * tick);
    list.AddLine({x, ruler.top + 0.45f * height}, {x, ruler.bottom}, line, 1);
    list.AddText({x + 3 * s, ruler.top + 1 * s}, text, label);
  }
  const Deformation& deformation = workspace.shown.own();
  const size_t here = key_at(deformation, workspace.shown.timeline.time);
  for (size_t i = 0; i < deformation.keyframes.size(); ++i) {
    const ImVec2 at(ruler.x(deformation.keyframes[i].time), middle);
    const bool plays = fits(deformation, deformation.keyframes[i].pose);
    const ImU32 color = i == here || hovered == i ? accent : ImGui::GetColorU32(ImGuiCol_Text);
    draw_key(list, at, (hovered == i ? 8.5f : 7) * s, color, deformation.keyframes[i].ease, plays);
  }
  const float x = ruler.x(std::min(workspace.shown.timeline.time, ruler.length));
  const ImU32 head = workspace.shown.timeline.active ? accent : text;
  list.AddLine({x, ruler.top}, {x, ruler.bottom}, head, 2 * s);
  list.AddTriangleFilled({x - 6 * s, ruler.top}, {x + 6 * s, ruler.top}, {x, ruler.top + 8 * s},
                         head);
}

}  // namespace

void TimelinePanel::draw_rate(Workspace& workspace, float s) {
  AnimationSettings settings = workspace.document.scene().animation;
  double rate = rate_.value_or(settings.frames_per_second);
  ImGui::SetNextItemWidth(76 * s);
  if (ImGui::InputDouble("##rate", &rate, 0, 0, "%.5g fps")) rate_ = rate;
  const bool typed = ImGui::IsItemDeactivatedAfterEdit();
  finish_item(workspace, "Frames per second, for stepping and export");
  if (!typed || !rate_) return;
  rate = *std::exchange(rate_, std::nullopt);
  if (!std::isfinite(rate)) return;
  settings.frames_per_second = std::clamp(rate, kMinFrameRate, kMaxFrameRate);
  workspace.commit_layers("Frame rate", with_animation(workspace.document.scene(), settings));
}

/// While the animation plays slower than its frame rate, says how fast it plays.
void TimelinePanel::draw_real_rate(const Workspace& workspace) {
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
  ImGui::AlignTextToFramePadding();
  colored_text(rate < 0.9 * wanted ? theme_colors().warning : theme_colors().muted, text);
  name_item("real rate");
  ImGui::SameLine();
}

void TimelinePanel::draw_track(Workspace& workspace, float s) {
  const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  // A function rather than a reference, because commits replace the deformation.
  const auto own = [&]() -> const Deformation& { return workspace.shown.own(); };
  if (held_ == Held::nothing)
    length_ = std::max(
        {2.0, 1.1 * length_of(workspace.document.scene()), 1.02 * workspace.shown.timeline.time});
  const Ruler ruler{corner.x + 10 * s, std::max(1.0f, room.x - 20 * s), corner.y,
                    corner.y + std::max(1.0f, room.y), length_};
  ImGui::InvisibleButton("track", {std::max(1.0f, room.x), std::max(1.0f, room.y)});
  name_item("track");
  std::optional<size_t> hovered;
  if (ImGui::IsItemHovered()) hovered = key_under_pointer(own(), ruler, s);
  if (ImGui::IsItemActivated()) {
    workspace.shown.timeline.playing = false;
    workspace.end_mergeable_step();
    held_ = hovered ? Held::key : Held::time;
    key_ = hovered.value_or(0);
    if (hovered) {
      workspace.go_to_time(own().keyframes[*hovered].time);
      workspace.shown.timeline.chosen = true;
      workspace.selection.clear();  // so that Delete removes the keyframe
    }
  }
  if (ImGui::IsItemActive()) {
    drag(workspace, snapped(workspace.document.scene(), ruler.time(ImGui::GetIO().MousePos.x)), s);
    hovered = held_ == Held::key ? std::optional(key_) : std::nullopt;
  } else {
    held_ = Held::nothing;
  }
  if (hovered && ImGui::IsMouseClicked(1)) {
    workspace.go_to_time(own().keyframes[*hovered].time);
    ImGui::OpenPopup("key");
  }
  if (hovered && held_ == Held::nothing)
    ImGui::SetTooltip("%.2f s%s", own().keyframes[*hovered].time,
                      fits(own(), own().keyframes[*hovered].pose)
                          ? ". Drag to move; right-click for more."
                          : ". Cannot be played, because its points differ from the scene's.");
  draw_ruler(workspace, ruler, hovered, s);
  draw_key_menu(workspace);
}

/// Moves the dragged item (the current time or a keyframe) to `time`.
void TimelinePanel::drag(Workspace& workspace, double time, float s) {
  const Deformation& own = workspace.shown.own();
  if (held_ == Held::time && time != workspace.shown.timeline.time) workspace.go_to_time(time);
  if (held_ != Held::key || key_ >= own.keyframes.size() || !ImGui::IsMouseDragging(0, 3 * s) ||
      time == own.keyframes[key_].time || key_at(own, time) < own.keyframes.size())
    return;
  auto [after, number] = with_key_moved(own, key_, time);
  workspace.commit_or_amend("Move keyframe", after, EditBase::document);
  if (workspace.shown.own() != after) return;
  key_ = number;
  workspace.go_to_time(time);
  workspace.shown.timeline.chosen = true;
}

void TimelinePanel::draw(Workspace& workspace, const PanelSizes& sizes) {
  const float scale = px(100) / 100;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float s = static_cast<float>(scale), height = static_cast<float>(sizes.timeline);
  ImGui::SetNextWindowPos(
      {static_cast<float>(sizes.toolbar), display.y - static_cast<float>(sizes.status) - height});
  ImGui::SetNextWindowSize(
      {display.x - static_cast<float>(sizes.toolbar + sizes.inspector), height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * s, 6 * s});
  ImGui::Begin("Timeline", nullptr, kPanel | ImGuiWindowFlags_NoScrollbar);
  const float button = px(28);
  for (const char* id : {"time.previous_key", "time.back", "time.play", "time.forward",
                         "time.next_key", "time.loop"})
    tool_button(id, workspace, button);
  ImGui::Dummy({6 * s, 0});
  ImGui::SameLine(0, 3);
  for (const char* id : {"time.key", "time.auto_key", "time.onion"})
    tool_button(id, workspace, button);
  if (sizes.two_rows) {
    ImGui::NewLine();
  } else {
    ImGui::Dummy({6 * s, 0});
    ImGui::SameLine(0, 3);
  }
  draw_time(workspace, s);
  draw_rate(workspace, s);
  draw_blend(workspace, s);
  draw_key_numbers(workspace, s);
  draw_real_rate(workspace);
  ImGui::NewLine();
  draw_track(workspace, s);
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace holomorph
