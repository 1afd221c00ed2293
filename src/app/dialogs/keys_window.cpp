// Shows one row per action. After a click on an action's keys, waits for the user to press a key.
#include "app/dialogs/keys_window.h"

#include <imgui.h>
// Must follow imgui.h, because it does not include that header itself.
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "app/look/controls.h"
#include "app/panels/panels.h"
#include "edit/actions/icons.h"
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

void KeysWindow::draw_row(const Action& action, float s) {
  ImGui::TableNextRow();
  ImGui::PushID(action.id.c_str());
  ImGui::TableNextColumn();
  const bool waits = waiting_ == action.id;
  const std::string keys = !waits         ? action.keys.empty() ? "None" : keys_text(action)
                                   : pending_key_ ? text_of(*pending_key_) + " again to reassign it"
                                          : "Press a key (Del: none, Esc: cancel)";
  if (ImGui::Button((keys + "###keys").c_str(), {-34 * s, 0})) {
    stop_waiting();
    if (!waits) waiting_ = action.id;
    adds_key_ = ImGui::GetIO().KeyShift;
  }
  if (workspace_.actions.has_own_keys(action)) {
    ImGui::SameLine(0, 4 * s);
    if (icon_button("reset", icon_named("reset"), "Restore the default keys")) {
      stop_waiting();
      report_lost_keys(workspace_.actions.reset_keys(action.id));
    }
    tooltip("Restore the default keys");
  }
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  const Action* owner =
      waits && pending_key_ ? workspace_.actions.owner_of(*pending_key_) : nullptr;
  wrapped_text(owner ? "'" + owner->label + "' uses this key" : action.label);
  if (!owner && *action.hint) tooltip_of(action);
  ImGui::PopID();
}

bool KeysWindow::draw_keys(float s) {
  const auto is_found = [&](const Action& action) {
    return has_words(action.label + " " + action.hint + " " + keys_text(action), search_);
  };
  if (std::ranges::none_of(workspace_.actions.rows(), is_found)) return false;
  if (!ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg)) return true;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.45f);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.55f);
  for (const Action& action : workspace_.actions.rows())
    if (is_found(action)) draw_row(action, s);
  ImGui::EndTable();
  return true;
}

bool KeysWindow::draw_gestures(float s) {
  const auto is_found = [&](const Gesture& gesture) {
    return has_words(std::string(gesture.what) + " " + gesture.does, search_);
  };
  if (std::ranges::none_of(gestures(), is_found)) return false;
  ImGui::Dummy({0, 8 * s});
  ImGui::TextDisabled("Mouse");
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

void KeysWindow::draw(double scale) {
  if (!open_ || chooser_.open()) return;
  const float s = static_cast<float>(scale);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(800 * s, display.x - 20), std::min(640 * s, display.y - 40)});
  ImGui::Begin(
      "Keys and mouse", &open_,
      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoResize);
  if (std::exchange(opening_, false)) {
    ImGui::SetWindowFocus();
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::SetNextItemWidth(-340 * s);
  ImGui::InputTextWithHint("##search", "Search actions and keys", &search_);
  if (ImGui::IsItemActive()) stop_waiting();  // typed text must not be assigned as a key
  ImGui::SameLine();
  if (ImGui::Button("Export...", {100 * s, 0})) export_keys();
  ImGui::SameLine();
  if (ImGui::Button("Import...", {100 * s, 0})) import_keys();
  ImGui::SameLine();
  ImGui::BeginDisabled(workspace_.actions.changed_keys().empty());
  if (ImGui::Button("Reset all", {-1, 0})) {
    stop_waiting();
    workspace_.actions.use_keys({});
    changed_();
  }
  ImGui::EndDisabled();
  begin_part("rows");
  ImGui::TextDisabled("Click a key to change it. Shift-click to add one.");
  const bool any = draw_keys(s), more = draw_gestures(s);
  if (!any && !more) ImGui::TextDisabled("Nothing found.");
  ImGui::EndChild();
  const bool escaped = escape_pressed() && !was_waiting_;
  was_waiting_ = waits_for_key();
  if (escaped) open_ = false;
  if (!open_) stop_waiting();
  ImGui::End();
}

}  // namespace holomorph
