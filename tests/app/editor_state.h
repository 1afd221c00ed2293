// What tests may know of the editor, as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "app/editor.h"

namespace holomorph {

/// Reads the editor's parts, of which it is a friend.
class EditorState {
 public:
  explicit EditorState(const Editor& editor) : editor_(editor) {}
  /// A flat object. The plane point (x, y) is at the window position px = left + width / 2 +
  /// (x - center_x) zoom, py = top + height / 2 - (y - center_y) zoom.
  nlohmann::ordered_json json() const;

 private:
  const Editor& editor_;
};

}  // namespace holomorph
