// Texts that describe keys and mouse gestures.
#pragma once

#include "edit/actions/actions.h"

namespace holomorph {

/// The keys of an action, such as "Ctrl+Shift+Z, Ctrl+Y". A punctuation key that is bound both with
/// and without Shift is listed once.
std::string keys_text(const Action& action);

/// A mouse gesture: what the user does, and what happens.
struct Gesture {
  const char *what, *does;
};
const std::vector<Gesture>& gestures();

/// All keys and gestures as a Markdown table.
std::string keys_markdown(const ActionTable& actions);

}  // namespace holomorph
