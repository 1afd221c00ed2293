// The menus contain every action once, in short groups.
#include "edit/actions/menus.h"

#include <map>
#include <string_view>

#include "edit/actions/actions.h"
#include "edit/actions/groups.h"
#include "edit/actions/icons.h"
#include "support/catch.h"

namespace holomorph::menus_test {

namespace {

void count(const std::vector<MenuItem>& items, std::map<std::string, int>& actions) {
  size_t entries = 0;
  bool separated = true;  // no separator at the start, at the end, or after another one
  for (const MenuItem& item : items) {
    if (item.name.empty()) {
      CHECK_FALSE(separated);
      separated = true;
      continue;
    }
    separated = false;
    ++entries;
    if (!item.entries.empty())
      count(item.entries, actions);
    else if (item.name[0] != '*')
      ++actions[item.name];
  }
  CHECK(entries <= 12);
  CHECK_FALSE(separated);
}

std::vector<std::string> first_entries(const MenuItem& menu, size_t most) {
  std::vector<std::string> names;
  for (const MenuItem& item : menu.entries)
    if (!item.name.empty() && names.size() < most) names.push_back(item.name);
  return names;
}

}  // namespace

TEST_CASE("Each action is in one menu, and no level has more than twelve entries") {
  const ActionTable table;
  std::map<std::string, int> actions;
  for (const MenuItem& menu : menus()) {
    INFO(menu.name);
    count(menu.entries, actions);
  }
  for (const auto& [id, times] : actions) {
    INFO(id);
    CHECK(times == 1);
    CHECK_NOTHROW(table.named(id));
  }
  for (const Action& action : table.rows()) {
    INFO(action.id);
    const bool is_key_only = action.id.starts_with("edit.nudge_") || !action.run;
    CHECK(actions.contains(action.id) == !is_key_only);
  }
}

TEST_CASE("Each action that can be disabled says what it needs") {
  const ActionTable table;
  for (const Action& action : table.rows()) {
    INFO(action.id);
    CHECK((action.enabled == always || *action.needs));
  }
}

TEST_CASE("What is used most comes first") {
  CHECK(first_entries(menus()[0], 4) ==
        std::vector<std::string>{"file.new", "file.open", "*recent", "file.save"});
  CHECK(first_entries(menus()[1], 2) == std::vector<std::string>{"edit.undo", "edit.redo"});
}

TEST_CASE("An icon is the character of its place in the sorted list") {
  for (size_t i = 1; i < std::size(kIconNames); ++i)
    CHECK(std::string_view(kIconNames[i - 1]) < std::string_view(kIconNames[i]));
  CHECK(std::string_view(icon_named("add")) == "\uE000");
  CHECK(std::string_view(icon_named("angle")) == "\uE001");
}

}  // namespace holomorph::menus_test
