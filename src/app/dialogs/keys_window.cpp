// Shows one row per action. After a click on an action's keys, waits for the user to press a key.
#include "app/dialogs/keys_window.h"

#include <imgui.h>
// Must follow imgui.h, because it does not include that header itself.
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "app/look/controls.h"
#include "app/look/surfaces.h"
#include "edit/actions/icons.h"
#include "edit/workspace.h"
#include "system/new_file.h"
#include "system/text.h"

namespace holomorph {
namespace {

void wrapped_cell(const std::string& text) {
  ImGui::TableNextColumn();
  wrapped_text(text);
}

}  // namespace

void KeysWindow::assign(const std::vector<Shortcut>& keys) {
  report_lost_keys(workspace_.actions.set_keys(waiting_, keys));
  stop_waiting();
}

void KeysWindow::stop_waiting() {
  waiting_.clear();
  pending_key_.reset();
}

void KeysWindow::report_lost_keys(const std::vector<std::string>& labels) {
  for (const std::string& label : labels)
    workspace_.messages.say("'" + label + "' no longer has this key.");
  changed_();
}

void KeysWindow::take(const Shortcut& key) {
  if (!waits_for_key()) return;
  if (key == Shortcut(Key::escape)) return stop_waiting();
  if (key == Shortcut(Key::del) && waiting_ != "edit.delete") return assign({});
  const Action* owner = workspace_.actions.owner_of(key);
  if (owner && owner->id != waiting_ && pending_key_ != key) {
    pending_key_ = key;
    return;
  }
  std::vector<Shortcut> keys;
  if (adds_key_) keys = workspace_.actions.named(waiting_).keys;
  keys.push_back(key);
  assign(keys);
}

void KeysWindow::export_keys() {
  stop_waiting();
  chooser_.ask({FileQuestion::Mode::save,
                "Export keys",
                "Export",
                {".json", ".md"},
                Path("holomorph-keys.json"),
                false},
               [this](const Path& path, double) -> std::string {
                 try {
                   check_not_read_only(path);
                   write_file(path, lower_case(path.extension().string()) == ".md"
                                        ? keys_markdown(workspace_.actions)
                                        : json_of_keys(workspace_.actions.all_keys()));
                   workspace_.messages.say("Exported " + path.filename().string() + ".");
                 } catch (const Error& error) {
                   return error.what();
                 }
                 return "";
               });
}

void KeysWindow::import_keys() {
  stop_waiting();
  chooser_.ask_open("Import keys", "Open", {".json"}, [this](const Path& path) -> std::string {
    try {
      const auto unknown =
          workspace_.actions.use_keys(keys_of_json(read_file(path), path.filename().string()));
      if (!unknown.empty())
        workspace_.messages.say(
            "Ignored because unknown: " + unknown[0] +
            (unknown.size() > 1 ? " and " + std::to_string(unknown.size() - 1) + " more." : "."));
      changed_();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  });
}

void KeysWindow::draw_row(const Action& action) {
  ImGui::TableNextRow();
  ImGui::PushID(action.id.c_str());
  ImGui::TableNextColumn();
  const bool waits = waiting_ == action.id;
  const std::string keys = !waits         ? action.keys.empty() ? "None" : keys_text(action)
                                   : pending_key_ ? text_of(*pending_key_) + " again to reassign it"
                                          : "Press a key (Del: none, Esc: cancel)";
  if (small_button(keys + "###keys", waits ? ButtonKind::primary : ButtonKind::secondary)) {
    stop_waiting();
    if (!waits) waiting_ = action.id;
    adds_key_ = ImGui::GetIO().KeyShift;
  }
  if (workspace_.actions.has_own_keys(action)) {
    ImGui::SameLine(0, px(4));
    if (icon_button("reset", icon_named("reset"), "Restore the default keys")) {
      stop_waiting();
      report_lost_keys(workspace_.actions.reset_keys(action.id));
    }
  }
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  const Action* owner =
      waits && pending_key_ ? workspace_.actions.owner_of(*pending_key_) : nullptr;
  wrapped_text(owner ? "'" + owner->label + "' uses this key" : action.label);
  if (!owner && *action.hint) tooltip_of(action);
  ImGui::PopID();
}

bool KeysWindow::draw_keys() {
  const auto is_found = [&](const Action& action) {
    return has_words(action.label + " " + action.hint + " " + keys_text(action), search_);
  };
  if (std::ranges::none_of(workspace_.actions.rows(), is_found)) return false;
  if (!ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg)) return true;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.45f);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.55f);
  for (const Action& action : workspace_.actions.rows())
    if (is_found(action)) draw_row(action);
  ImGui::EndTable();
  return true;
}

bool KeysWindow::draw_gestures() {
  const auto is_found = [&](const Gesture& gesture) {
    return has_words(std::string(gesture.what) + " " + gesture.does, search_);
  };
  if (std::ranges::none_of(gestures(), is_found)) return false;
  ImGui::Dummy({0, px(8)});
  muted_text("Mouse");
  if (!ImGui::BeginTable("mouse", 2, ImGuiTableFlags_RowBg)) return true;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.45f);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.55f);
  for (const Gesture& gesture : gestures()) {
    if (!is_found(gesture)) continue;
    ImGui::TableNextRow();
    wrapped_cell(gesture.what);
    wrapped_cell(gesture.does);
  }
  ImGui::EndTable();
  return true;
}

void KeysWindow::draw() {
  if (!open_ || chooser_.open()) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSize(
      {std::min(px(800), display.x - px(16)), std::min(px(640), display.y - px(40))});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(24), px(20)});
  begin_floating("Keys and mouse", {display.x / 2, display.y / 2}, {0.5f, 0.5f});
  ImGui::PopStyleVar();
  const bool opens = std::exchange(opening_, false);
  if (opens) ImGui::SetWindowFocus();
  const ImVec2 at = ImGui::GetCursorPos();
  const float side = px(28), room = ImGui::GetContentRegionAvail().x;
  {
    const ScopedFont title(Type::title);
    ImGui::TextUnformatted("Keys and mouse");
  }
  const ImVec2 below = ImGui::GetCursorPos();
  ImGui::SetCursorPos({at.x + room - side, at.y - px(4)});
  if (icon_button("Close", icon_named("close"), "Close")) open_ = false;
  ImGui::SetCursorPos(below);
  if (opens) ImGui::SetKeyboardFocusHere();
  text_field("##search", search_, "Search actions and keys", room - px(320));
  if (ImGui::IsItemActive()) stop_waiting();  // typed text must not be assigned as a key
  ImGui::SameLine();
  if (small_button("Export...")) export_keys();
  ImGui::SameLine();
  if (small_button("Import...")) import_keys();
  ImGui::SameLine();
  ImGui::BeginDisabled(workspace_.actions.changed_keys().empty());
  if (small_button("Reset all", ButtonKind::flat_danger)) {
    stop_waiting();
    workspace_.actions.use_keys({});
    changed_();
  }
  ImGui::EndDisabled();
  begin_part("rows");
  muted_text("Click a key to change it. Shift-click to add one.");
  const bool any = draw_keys(), more = draw_gestures();
  if (!any && !more) muted_text("Nothing found.");
  ImGui::EndChild();
  const bool escaped = dialog_key() == DialogKey::escape && !was_waiting_;
  was_waiting_ = waits_for_key();
  if (escaped) open_ = false;
  if (!open_) stop_waiting();
  end_card();
}

}  // namespace holomorph
