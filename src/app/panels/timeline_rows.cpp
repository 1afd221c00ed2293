// All keyframes lie on one item, which finds by itself what is under the pointer.
#include "app/panels/timeline_rows.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "app/look/controls.h"
#include "app/look/surfaces.h"
#include "app/panels/panels.h"
#include "edit/actions/icons.h"
#include "scene/clips.h"
#include "scene/layers.h"

namespace holomorph {
namespace {

constexpr size_t kMostTimelineRows = 5;  ///< more rows scroll
constexpr double kRow = 36, kRuler = 28, kNames = 224, kMargin = 16;

/// The parts of a pose that have rows of their own.
struct Part {
  const char* name;
  bool (*differs)(const Pose& a, const Pose& b);
};
constexpr Part kParts[] = {
    {"Cage", [](const Pose& a, const Pose& b) { return a.cage != b.cage; }},
    {"Pins", [](const Pose& a, const Pose& b) { return a.pins != b.pins; }},
    {"Strokes", [](const Pose& a, const Pose& b) { return a.strokes != b.strokes; }},
    {"Angles", [](const Pose& a, const Pose& b) { return a.corners != b.corners; }}};

/// The times of the keyframes between which a part of the pose moves.
std::vector<double> times_of(const Deformation& deformation, const Part& part) {
  std::vector<double> times;
  const std::vector<Keyframe>& keys = deformation.keyframes;
  for (size_t i = 0; i < keys.size(); ++i)
    if ((i > 0 && part.differs(keys[i - 1].pose, keys[i].pose)) ||
        (i + 1 < keys.size() && part.differs(keys[i].pose, keys[i + 1].pose)))
      times.push_back(keys[i].time);
  return times;
}

/// Draws a keyframe: a circle for smooth easing, a diamond for linear, a square for hold. If the
/// keyframe does not play, the mark is hollow.
void draw_key(ImDrawList& list, ImVec2 at, float r, ImU32 color, Ease ease, bool plays) {
  if (ease == Ease::smooth)
    return plays ? list.AddCircleFilled(at, r, color) : list.AddCircle(at, r, color, 0, px(1.5));
  const float s = 0.85f * r, d = 1.15f * r;
  const bool square = ease == Ease::hold;
  const ImVec2 corners[] = {square ? at + ImVec2(-s, -s) : at + ImVec2(-d, 0),
                            square ? at + ImVec2(s, -s) : at + ImVec2(0, -d),
                            square ? at + ImVec2(s, s) : at + ImVec2(d, 0),
                            square ? at + ImVec2(-s, s) : at + ImVec2(0, d)};
  if (plays)
    list.AddConvexPolyFilled(corners, 4, color);
  else
    list.AddPolyline(corners, 4, color, ImDrawFlags_Closed, px(1.5));
}

const Deformation& deformation_of(const Workspace& workspace, size_t layer) {
  return workspace.document.scene().layers[layer]->deformation;
}

bool is_open_layer(const Workspace& workspace, size_t layer) {
  const Layer& it = *workspace.document.scene().layers[layer];
  return it.visible && !it.locked;
}

/// What a tooltip says about a keyframe.
std::string text_of(const Workspace& workspace, const KeyId& id) {
  const Scene& scene = workspace.document.scene();
  const Deformation& deformation = deformation_of(workspace, layer_index(scene, id.layer));
  const bool plays = fits(deformation, deformation.keyframes[key_at(deformation, id.time)].pose);
  char text[120];
  std::snprintf(text, sizeof text, "%.2f s, frame %d%s", id.time, frame_at(scene, id.time),
                plays ? "" : ". Cannot be played, because its points differ from the scene's.");
  return text;
}

/// Snaps a time to a frame, unless Alt is held.
double snapped(const Scene& scene, double time) {
  if (ImGui::GetIO().KeyAlt) return std::clamp(time, 0.0, kMaxTime);
  return time_of_frame(scene, std::max(0, frame_at(scene, time)));
}

}  // namespace

float TimelineRows::height(const Workspace& workspace) const {
  const size_t rows = std::clamp<size_t>(rows_of(workspace).size(), 1, kMostTimelineRows);
  return px(kRuler) + px(kRow) * static_cast<float>(rows);
}

std::vector<TimelineRows::Row> TimelineRows::rows_of(const Workspace& workspace) const {
  std::vector<Row> rows;
  const Scene& scene = workspace.document.scene();
  for (size_t i = scene.layers.size(); i-- > 0;) {
    const Deformation& deformation = scene.layers[i]->deformation;
    rows.push_back({i});
    for (const Keyframe& key : deformation.keyframes) rows.back().times.push_back(key.time);
    if (!open_.contains(scene.layers[i]->id)) continue;
    for (const Part& part : kParts)
      if (std::vector<double> times = times_of(deformation, part); !times.empty())
        rows.push_back({i, part.name, std::move(times)});
  }
  return rows;
}

void TimelineRows::draw_ruler(Workspace& workspace, float names) {
  const ThemeColors& c = theme_colors();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = px(kRuler);
  const size_t chosen = workspace.shown.timeline.keys.size();
  if (chosen > 0)
    draw_text(
        list, Type::caption, at + ImVec2(px(14), px(5)), c.muted,
        std::to_string(chosen) + (chosen == 1 ? " keyframe selected" : " keyframes selected"));
  list.AddRectFilled(at + ImVec2(names, 0), at + ImVec2(width, height), faded(c.field));
  list.PushClipRect(at + ImVec2(names, 0), at + ImVec2(width, height), true);
  ruler_.draw(list, workspace, at.y, at.y + height);
  list.PopClipRect();
  ImGui::SetCursorScreenPos(at + ImVec2(names, 0));
  ImGui::InvisibleButton("ruler", {std::max(1.0f, width - names), height});
  name_item("ruler");
  hovered_ = over_ruler_ = ImGui::IsItemHovered();
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) ruler_.fit();
  if (ImGui::IsItemHovered() && ImGui::GetIO().MouseWheel != 0) {
    const auto wheel = static_cast<double>(ImGui::GetIO().MouseWheel);
    if (ImGui::GetIO().KeyShift)
      ruler_.pan(-wheel * 0.1 * (ruler_.time(ruler_.right()) - ruler_.time(ruler_.left())));
    else
      ruler_.zoom(std::pow(1.15, wheel), ruler_.time(pointer.x));
  }
  if (ImGui::IsItemActivated()) {
    workspace.shown.timeline.playing = false;
    held_ = Held::time;
  }
  if (ImGui::IsItemActive() && held_ == Held::time) {
    grows_ = ruler_.grow_to(pointer.x);
    const double time = snapped(workspace.document.scene(), ruler_.time(pointer.x));
    if (time != workspace.shown.timeline.time) workspace.go_to_time(time);
  } else if (held_ == Held::time) {
    held_ = Held::nothing;
  }
  ImGui::SetCursorScreenPos(at + ImVec2(0, height));
}

void TimelineRows::draw_name(Workspace& workspace, const Row& row, ImVec2 at, float width,
                             Thumbnails& thumbnails) {
  const ThemeColors& c = theme_colors();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Scene& scene = workspace.document.scene();
  const Layer& layer = *scene.layers[row.layer];
  const float height = px(kRow);
  if (!row.part.empty()) {
    draw_text(list, Type::body, at + ImVec2(px(64), px(9)), c.muted, row.part);
    return;
  }
  const bool edited = row.layer == scene.edited;
  if (edited) list.AddRectFilled(at, at + ImVec2(width, height), faded(c.accent_tint));
  ImGui::SetCursorScreenPos(at + ImVec2(px(32), 0));
  if (ImGui::InvisibleButton("name", {width - px(32), height})) workspace.choose_layer(row.layer);
  name_item("Row: " + title_of_layer(scene, row.layer));
  draw_focus_ring(px(4));
  if (ImGui::IsItemHovered() && !edited)
    list.AddRectFilled(at, at + ImVec2(width, height), faded(c.hover));
  ImGui::SetCursorScreenPos(at + ImVec2(px(6), (height - px(24)) / 2));
  const bool open = open_.contains(layer.id);
  ImGui::BeginDisabled(layer.deformation.keyframes.size() < 2);
  if (icon_button("open", open ? icon_named("down") : icon_named("right"),
                  open ? "Hide the parts of the pose" : "Show which parts of the pose move", false,
                  px(24), Type::caption)) {
    if (open)
      open_.erase(layer.id);
    else
      open_.insert(layer.id);
  }
  name_item("Open: " + title_of_layer(scene, row.layer));
  ImGui::EndDisabled();
  draw_thumbnail(list, thumbnails.of_picture(workspace.document.pictures().still(layer)),
                 at + ImVec2(px(34), (height - px(24)) / 2), px(24), px(4));
  draw_text(list, Type::body, at + ImVec2(px(66), px(9)), layer.visible ? c.text : c.muted,
            shortened_text(title_of_layer(scene, row.layer), width - px(74)));
}

void TimelineRows::draw_keys(const Workspace& workspace, const Row& row, float middle) const {
  const ThemeColors& c = theme_colors();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Deformation& deformation = deformation_of(workspace, row.layer);
  const int id = workspace.document.scene().layers[row.layer]->id;
  const KeySelection& chosen = workspace.shown.timeline.keys;
  for (size_t i = 0; i + 1 < row.times.size(); ++i) {
    const bool both =
        chosen.contains({id, row.times[i]}) && chosen.contains({id, row.times[i + 1]});
    const bool held = deformation.keyframes[key_at(deformation, row.times[i])].ease == Ease::hold;
    const ImU32 color = faded(both ? c.accent : c.edge);
    const float from = ruler_.x(row.times[i]), to = ruler_.x(row.times[i + 1]),
                dash = held ? px(3) : to - from, gap = held ? px(3) : 0;
    for (float x = from; x < to; x += dash + gap)
      list.AddLine({x, middle}, {std::min(x + dash, to), middle}, color, px(1.5));
  }
  for (const double time : row.times) {
    const Keyframe& key = deformation.keyframes[key_at(deformation, time)];
    const bool is_chosen = chosen.contains({id, time});
    const ImVec2 at(ruler_.x(time), middle);
    if (is_chosen) draw_key(list, at, px(7.5), faded(c.text), key.ease, true);
    draw_key(list, at, px(6), faded(is_chosen ? c.accent : c.muted), key.ease,
             fits(deformation, key.pose));
  }
}

/// Draws the box around the selected keyframes, whose ends stretch them.
void TimelineRows::draw_selection_box(const Workspace& workspace) {
  box_ = {};
  const KeySelection& chosen = workspace.shown.timeline.keys;
  if (chosen.size() < 2) return;
  const auto [first, last] = span_of(chosen);
  float low = HUGE_VALF, high = -HUGE_VALF;
  for (size_t i = 0; i < rows_.size(); ++i) {
    const int id = workspace.document.scene().layers[rows_[i].layer]->id;
    for (const double time : rows_[i].times)
      if (chosen.contains({id, time})) {
        const float top = top_ + px(kRow) * static_cast<float>(i);
        low = std::min(low, top);
        high = std::max(high, top + px(kRow));
      }
  }
  if (low > high) return;
  const ThemeColors& c = theme_colors();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  box_ = {ruler_.x(first) - px(14), low + px(3), ruler_.x(last) + px(14), high - px(3)};
  list.AddRectFilled({box_.x, box_.y}, {box_.z, box_.w}, faded(c.accent, 0.14f), px(4));
  list.AddRect({box_.x, box_.y}, {box_.z, box_.w}, faded(c.accent, 0.7f), px(4));
  const float middle = (box_.y + box_.w) / 2;
  if (first == last) {  // nothing to stretch
    box_ = {};
    return;
  }
  for (const float x : {box_.x, box_.z})
    list.AddRectFilled({x - px(2), middle - px(12)}, {x + px(2), middle + px(12)}, faded(c.accent),
                       px(2));
}

std::optional<size_t> TimelineRows::row_at(float y) const {
  const auto number = static_cast<int>(std::floor((y - top_) / px(kRow)));
  if (number < 0 || number >= static_cast<int>(rows_.size())) return {};
  return static_cast<size_t>(number);
}

float TimelineRows::middle_of(size_t row) const {
  return top_ + px(kRow) * (static_cast<float>(row) + 0.5f);
}

std::optional<ClipBar> TimelineRows::clip_bar(const Workspace& workspace, size_t row) const {
  const Clip* clip = clip_of(*workspace.document.scene().layers[rows_[row].layer]);
  if (!clip || !rows_[row].part.empty()) return {};
  return ClipBar(ruler_, *clip, middle_of(row));
}

std::optional<TimelineRows::ClipUnder> TimelineRows::clip_under(const Workspace& workspace,
                                                                ImVec2 pointer) const {
  const auto row = row_at(pointer.y);
  const auto bar = row ? clip_bar(workspace, *row) : std::nullopt;
  const auto kind = bar ? bar->part_at(pointer) : std::nullopt;
  if (!kind || !is_open_layer(workspace, rows_[*row].layer)) return {};
  return ClipUnder{rows_[*row].layer, *kind};
}

std::optional<KeyId> TimelineRows::key_under(const Workspace& workspace, ImVec2 pointer) const {
  const auto number = row_at(pointer.y);
  if (!number) return {};
  const Row& row = rows_[*number];
  // A bar is higher than keyframes, so that its ends can be dragged where there is one, too.
  if (clip_bar(workspace, *number) && std::abs(pointer.y - middle_of(*number)) > px(7)) return {};
  std::optional<KeyId> under;
  float nearest = px(9);
  for (const double time : row.times)
    if (const float here = std::abs(ruler_.x(time) - pointer.x); here < nearest) {
      nearest = here;
      under = KeyId{workspace.document.scene().layers[row.layer]->id, time};
    }
  return under;
}

void TimelineRows::press(Workspace& workspace, ImVec2 pointer) {
  Timeline& timeline = workspace.shown.timeline;
  timeline.playing = false;
  pressed_ = pointer;
  moved_ = false;
  const bool adds = ImGui::GetIO().KeyShift;
  const auto key = key_under(workspace, pointer);
  const double time = ruler_.time(pointer.x);
  pressed_key_ = key;
  if (!key && box_.z > box_.x && pointer.y >= box_.y && pointer.y <= box_.w)
    for (const auto& [x, kind] :
         {std::pair(box_.x, KeyDrag::Kind::stretch_start), {box_.z, KeyDrag::Kind::stretch_end}})
      if (std::abs(pointer.x - x) < px(7)) {
        held_ = Held::keys;
        drag_.start(workspace, kind, time);
        return;
      }
  if (const auto clip = clip_under(workspace, pointer); clip && !key && !adds) {
    held_ = Held::clip;
    pressed_clip_ = *clip;
    return;
  }
  if (!key) {
    held_ = Held::box;
    before_box_ = adds ? timeline.keys : KeySelection{};
    return;
  }
  const size_t layer = layer_index(workspace.document.scene(), key->layer);
  if (!is_open_layer(workspace, layer)) {
    workspace.messages.say("This layer is locked or hidden.");
    return;
  }
  workspace.selection.clear();  // so that Delete removes the keyframes
  if (adds) {
    if (!timeline.keys.erase(*key)) timeline.keys.insert(*key);
    return;
  }
  if (!timeline.keys.contains(*key)) timeline.keys = {*key};
  const KeySelection chosen = timeline.keys;
  workspace.choose_layer(layer);
  if (chosen.size() == 1) workspace.go_to_time(key->time);
  timeline.keys = chosen;
  held_ = Held::keys;
  drag_.start(workspace, ImGui::GetIO().KeyCtrl ? KeyDrag::Kind::copy : KeyDrag::Kind::move, time);
}

void TimelineRows::select_in_box(Workspace& workspace, ImVec2 to) {
  const float left = std::min(pressed_.x, to.x), right = std::max(pressed_.x, to.x),
              low = std::min(pressed_.y, to.y), high = std::max(pressed_.y, to.y);
  KeySelection keys = before_box_;
  for (size_t i = 0; i < rows_.size(); ++i) {
    if (middle_of(i) < low || middle_of(i) > high) continue;
    const int id = workspace.document.scene().layers[rows_[i].layer]->id;
    for (const double time : rows_[i].times)
      if (ruler_.x(time) >= left && ruler_.x(time) <= right) keys.insert({id, time});
  }
  workspace.shown.timeline.keys = editable_keys(workspace.document.scene(), keys);
  if (!keys.empty()) workspace.selection.clear();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({left, low}, {right, high}, faded(theme_colors().accent, 0.12f));
  list.AddRect({left, low}, {right, high}, faded(theme_colors().accent));
}

void TimelineRows::follow(Workspace& workspace, ImVec2 pointer) {
  Timeline& timeline = workspace.shown.timeline;
  const bool started =
      !moved_ && std::abs(pointer.x - pressed_.x) + std::abs(pointer.y - pressed_.y) > px(4);
  moved_ = moved_ || started;
  if (held_ == Held::box && moved_) select_in_box(workspace, pointer);
  if (held_ == Held::clip && started) {
    workspace.choose_layer(pressed_clip_.layer);
    clip_drag_.start(workspace, pressed_clip_.kind, ruler_.time(pressed_.x));
  }
  if (held_ == Held::clip && moved_) {
    grows_ = ruler_.grow_to(pointer.x);
    clip_drag_.follow(workspace, ruler_.time(pointer.x), ImGui::GetIO().KeyAlt);
  }
  if (held_ != Held::keys || !moved_) return;
  grows_ = ruler_.grow_to(pointer.x);
  drag_.follow(workspace, ruler_.time(pointer.x), ImGui::GetIO().KeyAlt);
  if (timeline.keys.size() != 1 || timeline.time == timeline.keys.begin()->time) return;
  const KeySelection keys = timeline.keys;
  workspace.go_to_time(keys.begin()->time);
}

void TimelineRows::draw_menu(Workspace& workspace) {
  if (!begin_menu_popup("keys")) return;
  const Scene& scene = workspace.document.scene();
  const KeySelection keys = workspace.shown.timeline.keys;
  const std::optional<Ease> common = common_ease(scene, keys);
  for (const auto& [label, ease] :
       {std::pair("Smooth", Ease::smooth), {"Linear", Ease::linear}, {"Hold", Ease::hold}})
    if (menu_entry(label, "", common == ease))
      workspace.commit_layers("Easing", with_keys_eased(scene, keys, ease));
  menu_separator();
  for (const char* id : {"time.copy_keys", "time.mirror_keys", "time.delete_key"}) {
    const Action& action = workspace.actions.named(id);
    if (menu_entry(action.label, "", false, action.enabled(workspace))) run(action, workspace);
  }
  end_menu_popup();
}

void TimelineRows::show_film_cursor(const Workspace& workspace, ImVec2 pointer, bool hovered) {
  std::optional<ClipUnder> clip;
  if (held_ == Held::clip)
    clip = pressed_clip_;
  else if (held_ == Held::nothing && hovered)
    clip = clip_under(workspace, pointer);
  over_film_ = clip.has_value();
  if (clip)
    ImGui::SetMouseCursor(clip->kind == ClipDrag::Kind::move ? ImGuiMouseCursor_Hand
                                                             : ImGuiMouseCursor_ResizeEW);
}

/// The item that all keyframes lie on: what the pointer does there.
void TimelineRows::handle_keys(Workspace& workspace) {
  name_item("keys");
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  hovered_ = hovered_ || hovered || active;
  const auto under = hovered ? key_under(workspace, pointer) : std::nullopt;
  if (under && ImGui::IsMouseClicked(1)) {
    if (!workspace.shown.timeline.keys.contains(*under)) workspace.shown.timeline.keys = {*under};
    workspace.prune_selection();
    if (!workspace.shown.timeline.keys.empty()) ImGui::OpenPopup("keys");
  }
  if (under && held_ == Held::nothing) tooltip(text_of(workspace, *under));
  show_film_cursor(workspace, pointer, hovered && !under);
  if (ImGui::IsItemActivated() && ImGui::IsMouseClicked(0)) press(workspace, pointer);
  if (active && held_ != Held::time)
    follow(workspace, pointer);
  else if (held_ != Held::time && held_ != Held::nothing)
    release(workspace, pointer);
}

void TimelineRows::release(Workspace& workspace, ImVec2 pointer) {
  if (held_ == Held::keys && !moved_ && pressed_key_) {
    workspace.shown.timeline.keys = {*pressed_key_};
    workspace.go_to_time(pressed_key_->time);
  }
  if ((held_ == Held::box || held_ == Held::clip) && !moved_) {
    workspace.shown.timeline.keys.clear();
    workspace.go_to_time(snapped(workspace.document.scene(), ruler_.time(pointer.x)));
  }
  drag_.end();
  clip_drag_.end(workspace);
  held_ = Held::nothing;
}

/// The current time, over the ruler and all rows.
void TimelineRows::draw_time(const Workspace& workspace, ImVec2 corner, float left) const {
  const float right = ruler_.right() + px(kMargin),
              x = std::round(ruler_.x(workspace.shown.timeline.time));
  if (x < left || x > right) return;
  const ThemeColors& c = theme_colors();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 color = faded(workspace.shown.timeline.active ? c.text : c.muted);
  char text[24];
  std::snprintf(text, sizeof text, "%.2f s", workspace.shown.timeline.time);
  const ImVec2 size = text_size(Type::caption, text);
  const float from = std::clamp(x - size.x / 2 - px(6), left, right - size.x - px(12)),
              bottom = corner.y + px(kRuler) + px(kRow) * static_cast<float>(rows_.size());
  list.AddLine({x, corner.y + px(20)}, {x, bottom}, color, px(1.5));
  list.AddRectFilled({from, corner.y + px(3)}, {from + size.x + px(12), corner.y + px(23)}, color,
                     px(4));
  draw_text(list, Type::caption, {from + px(6), corner.y + px(5)}, c.panel, text);
}

void TimelineRows::draw(Workspace& workspace, Thumbnails& thumbnails) {
  const float width = ImGui::GetContentRegionAvail().x, names = std::min(px(kNames), 0.35f * width),
              height = px(kRow);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ruler_.place(workspace, corner.x + names + px(kMargin), corner.x + width - px(kMargin),
               held_ != Held::nothing);
  draw_ruler(workspace, names);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  begin_part("rows");
  rows_ = rows_of(workspace);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  top_ = at.y;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (size_t i = 0; i < rows_.size(); ++i) {
    const float y = at.y + height * static_cast<float>(i);
    ImGui::PushID(static_cast<int>(i));
    draw_name(workspace, rows_[i], {at.x, y}, names, thumbnails);
    ImGui::PopID();
    list.AddLine({at.x, y + height}, {at.x + width, y + height}, faded(theme_colors().line));
  }
  list.PushClipRect({at.x + names, corner.y},
                    {at.x + width, at.y + height * static_cast<float>(rows_.size())}, true);
  for (size_t i = 0; i < rows_.size(); ++i) {
    if (const auto bar = clip_bar(workspace, i))
      bar->draw(list, ruler_.left(), ruler_.right() + px(kMargin));
    draw_keys(workspace, rows_[i], middle_of(i));
  }
  draw_selection_box(workspace);
  ImGui::SetCursorScreenPos({at.x + names, at.y});
  ImGui::InvisibleButton(
      "keys",
      {std::max(1.0f, width - names), std::max(1.0f, height * static_cast<float>(rows_.size()))},
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
  handle_keys(workspace);
  list.PopClipRect();
  draw_menu(workspace);
  ImGui::EndChild();
  ImGui::PopStyleVar(2);
  draw_time(workspace, corner, corner.x + names);
}

}  // namespace holomorph
