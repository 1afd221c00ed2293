// Keys: each has a name that leads back to it, and what the user changes is all that changes.
#include "edit/actions/keymap.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "support/desk.h"

using namespace holomorph;

namespace {

/// Whatever a test does, the next one finds the table's own keys.
struct OwnKeys {
  ~OwnKeys() { use_keys({}); }
};

constexpr Modifiers kCtrl{true, false, false};

}  // namespace

TEST_CASE("Every key of the table has a name that is that key") {
  for (const Action& action : actions())
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

TEST_CASE("A key that is given to an action is its own, and no other's") {
  const OwnKeys own;
  Desk desk(shapes::rectangle(100, 100));
  desk.workspace.commit("Move", with_cage(Deformation{}, shapes::rectangle(200, 100)));
  CHECK(set_keys("edit.undo", {'J'}).empty());
  CHECK(action_for('J', desk.workspace)->id == "edit.undo");
  CHECK_FALSE(action_for({'Z', kCtrl}, desk.workspace));
  CHECK(label_with_keys(action_named("edit.undo")) == "Undo (J)");
  const auto robbed = set_keys("view.image", {'J', '1'});
  REQUIRE(robbed.size() == 1);
  CHECK(robbed[0] == "Undo");
  CHECK(action_for('J', desk.workspace)->id == "view.image");
  CHECK(action_named("edit.undo").keys.empty());
  CHECK(changed_keys() == KeyNames{{"edit.undo", {}}, {"view.image", {"J", "1"}}});
  CHECK(keys_text(action_named("view.image")) == "J, 1");
  const KeyNames changed = changed_keys();
  use_keys({});
  CHECK(changed_keys().empty());
  CHECK(use_keys(changed).empty());
  CHECK(changed_keys() == changed);
  reset_keys("edit.undo");
  CHECK(action_for({'Z', kCtrl}, desk.workspace)->id == "edit.undo");
  CHECK_FALSE(has_own_keys(action_named("edit.undo")));
}

TEST_CASE("Keys survive a file, and what is not known there is left out and said") {
  const OwnKeys own;
  set_keys("tool.pen", {'J'});
  const KeyNames keys = all_keys();
  CHECK(keys_of_json(json_of_keys(keys), "keys.json") == keys);
  use_keys({});
  CHECK(use_keys(keys_of_json(json_of_keys(keys), "keys.json")).empty());
  CHECK(changed_keys() == KeyNames{{"tool.pen", {"J"}}});
  // A key that another action has by the table goes over to the one that the file gives it.
  use_keys({{"tool.pen", {"V"}}});
  CHECK(action_named("tool.select").keys.empty());
  CHECK(use_keys({{"tool.lasso", {"L"}}, {"tool.pen", {"Hyper+P"}}}) ==
        std::vector<std::string>{"tool.lasso", "Hyper+P"});
  for (const char* text : {"", "[]", "{}", R"({"format": "holomorph-keys", "keys": {"a": 1}})"})
    CHECK_THROWS_AS(keys_of_json(text, "keys.json"), Error);
}

TEST_CASE("The list of keys names every key") {
  const std::string list = keys_markdown();
  for (const Action& action : actions()) {
    INFO(action.id);
    if (action.keys.empty()) continue;
    CHECK(list.find("| " + action.label + " |") != std::string::npos);
    const std::string text = keys_text(action);
    if (text.find('|') == std::string::npos)
      CHECK(list.find("`" + text + "`") != std::string::npos);
  }
  for (const Gesture& gesture : gestures()) CHECK(list.find(gesture.what) != std::string::npos);
}
