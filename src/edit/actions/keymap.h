// Keys and mouse gestures in words.
#pragma once

#include "edit/actions/actions.h"

namespace holomorph {

/// "Ctrl+Shift+Z, Ctrl+Y"; signs that are reached with and without Shift are named once.
std::string keys_text(const Action& action);

/// A mouse gesture in words: what to do, and what it does.
struct Gesture {
  const char *what, *does;
};
const std::vector<Gesture>& gestures();

/// All keys and gestures as a Markdown table.
std::string keys_markdown(const ActionTable& actions);

}  // namespace holomorph
