// The order of the actions in the menus.
#pragma once

#include <string>
#include <vector>

namespace holomorph {

/// An entry of a menu: the id of an action, or a submenu if it has entries. An empty name is a
/// separator. Names that begin with "*" are lists that the window fills in.
struct MenuItem {
  std::string name;
  std::vector<MenuItem> entries = {};
};

/// The menus of the menu bar. No level has more than twelve entries.
const std::vector<MenuItem>& menus();
/// The entries of the canvas's context menu. Those that are disabled are left out.
const std::vector<MenuItem>& context_menu();

}  // namespace holomorph
