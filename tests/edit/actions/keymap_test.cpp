// Keys: key names can be parsed back, and only the user's changes are stored.
#include "edit/actions/keymap.h"

#include "core/error.h"
#include "edit/key_focus.h"
#include "support/catch.h"
#include "support/desk.h"

namespace holomorph::keymap_test {

namespace {

constexpr Modifiers kCtrl{true, false, false};

}  // namespace

TEST_CASE("The name of every key in the table parses to that key") {
  const ActionTable actions;
  for (const Action& action : actions.rows())
    for (const Shortcut& key : action.keys) {
      INFO(action.id << ": " << text_of(key));
      const auto again = shortcut_named(text_of(key));
      REQUIRE(again);
      CHECK(*again == key);
    }
  CHECK(shortcut_named("Ctrl+F12") == Shortcut(Key::f12, kCtrl));
  CHECK(shortcut_named("Ctrl++") == Shortcut('+', kCtrl));
  for (const char* none : {"", "Ctrl+", "Hyper+A", "F13", "Pause", "Ctrl+Ctrl+A"})
    CHECK_FALSE(shortcut_named(none));
}

TEST_CASE("A key that is assigned to an action is removed from all others") {
  TestWorkspace desk(shapes::rectangle(100, 100));
  ActionTable& actions = desk.workspace.actions;
  desk.workspace.commit("Move", with_cage(Deformation{}, shapes::rectangle(200, 100)));
  CHECK(actions.set_keys("edit.undo", {'J'}).empty());
  CHECK(actions.for_key('J', desk.workspace)->id == "edit.undo");
  CHECK_FALSE(actions.for_key({'Z', kCtrl}, desk.workspace));
  CHECK(label_with_keys(actions.named("edit.undo")) == "Undo (J)");
  const auto unbound = actions.set_keys("view.image", {'J', '1'});
  REQUIRE(unbound.size() == 1);
  CHECK(unbound[0] == "Undo");
  CHECK(actions.for_key('J', desk.workspace)->id == "view.image");
  CHECK(actions.named("edit.undo").keys.empty());
  CHECK(actions.changed_keys() == KeyNames{{"edit.undo", {}}, {"view.image", {"J", "1"}}});
  CHECK(keys_text(actions.named("view.image")) == "J, 1");
  const KeyNames changed = actions.changed_keys();
  actions.use_keys({});
  CHECK(actions.changed_keys().empty());
  CHECK(actions.use_keys(changed).empty());
  CHECK(actions.changed_keys() == changed);
  actions.reset_keys("edit.undo");
  CHECK(actions.for_key({'Z', kCtrl}, desk.workspace)->id == "edit.undo");
  CHECK_FALSE(actions.has_own_keys(actions.named("edit.undo")));
}

TEST_CASE(
    "Key assignments survive writing and reading; unknown actions and keys are skipped and "
    "reported") {
  ActionTable actions;
  actions.set_keys("tool.pen", {'J'});
  const KeyNames keys = actions.all_keys();
  CHECK(keys_of_json(json_of_keys(keys), "keys.json") == keys);
  actions.use_keys({});
  CHECK(actions.use_keys(keys_of_json(json_of_keys(keys), "keys.json")).empty());
  CHECK(actions.changed_keys() == KeyNames{{"tool.pen", {"J"}}});
  // A built-in key moves to the action to which the file assigns it.
  actions.use_keys({{"tool.pen", {"V"}}});
  CHECK(actions.named("tool.select").keys.empty());
  CHECK(actions.use_keys({{"tool.lasso", {"L"}}, {"tool.pen", {"Hyper+P"}}}) ==
        std::vector<std::string>{"tool.lasso", "Hyper+P"});
  for (const char* text : {"", "[]", "{}", R"({"format": "holomorph-keys", "keys": {"a": 1}})"})
    CHECK_THROWS_AS(keys_of_json(text, "keys.json"), Error);
}

TEST_CASE("The list of keys contains every key") {
  const ActionTable actions;
  const std::string list = keys_markdown(actions);
  for (const Action& action : actions.rows()) {
    INFO(action.id);
    if (action.keys.empty()) continue;
    CHECK(list.find("| " + action.label + (*action.hint ? std::string(": ") + action.hint : "") +
                    " |") != std::string::npos);
    const std::string text = keys_text(action);
    if (text.find('|') == std::string::npos)
      CHECK(list.find("`" + text + "`") != std::string::npos);
  }
  for (const Gesture& gesture : gestures()) CHECK(list.find(gesture.what) != std::string::npos);
}

TEST_CASE("Only the topmost part of the window receives key presses") {
  const std::vector<std::pair<bool WindowFocus::*, KeyFocus>> from_top{
      {&WindowFocus::assigns_key, KeyFocus::assignment},
      {&WindowFocus::edits_field, KeyFocus::field},
      {&WindowFocus::palette, KeyFocus::palette},
      {&WindowFocus::dialog, KeyFocus::dialog},
      {&WindowFocus::menu, KeyFocus::menu},
      {&WindowFocus::menu_was_open, KeyFocus::menu},
      {&WindowFocus::panel, KeyFocus::panel}};
  CHECK(key_focus({}) == KeyFocus::canvas);
  // Every combination of parts that can be open.
  for (unsigned set = 1; set < 1u << from_top.size(); ++set) {
    WindowFocus window;
    std::optional<KeyFocus> top;
    for (size_t i = 0; i < from_top.size(); ++i) {
      if (!(set >> i & 1)) continue;
      window.*from_top[i].first = true;
      if (!top) top = from_top[i].second;
    }
    INFO(set);
    CHECK(key_focus(window) == top);
    const bool items = window.dialog || window.menu || window.panel;
    CHECK(navigates_items(window) == (items && !window.assigns_key && !window.palette));
  }
}

TEST_CASE("A panel keeps the keys that navigate it or type into it") {
  const ActionTable actions;
  const Action &undo = actions.named("edit.undo"), &next = actions.named("view.next_panel");
  for (const Shortcut key : {Shortcut('Z'), Shortcut(Key::left), Shortcut(Key::enter),
                             Shortcut(Key::space), Shortcut(Key::tab, kCtrl), Shortcut(Key::del)}) {
    INFO(text_of(key));
    CHECK_FALSE(acts_from_panel(key, undo));
    CHECK(acts_from_panel(key, next));
  }
  for (const Shortcut key : {Shortcut('Z', kCtrl), Shortcut(Key::f1), Shortcut(Key::f12)})
    CHECK(acts_from_panel(key, undo));
}

TEST_CASE("Only view actions run during a gesture") {
  const ActionTable actions;
  int count = 0;
  for (const Action& action : actions.rows()) {
    if (!action.during_gesture) continue;
    ++count;
    CHECK(action.id.starts_with("view."));
  }
  CHECK(count == 6);
}

}  // namespace holomorph::keymap_test
