// Short messages that are displayed over the canvas.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "system/file.h"
#include "system/text.h"

namespace holomorph {

/// A short message. It may refer to a point of the plane.
struct Toast {
  std::string text;
  bool problem = false;
  std::optional<Complex> where = {};
};

/// Messages that wait for the window to display them.
struct Messages {
  std::vector<Toast> toasts = {};

  void say(const std::string& text, std::optional<Complex> where = {}) {
    toasts.push_back({printable(text), false, where});
  }
  void complain(const Error& error) { complain(error.what(), error.where()); }
  /// Adds a problem, unless the text is empty.
  void complain(const std::string& problem, std::optional<Complex> where = {}) {
    if (!problem.empty()) toasts.push_back({printable(problem), true, where});
  }
};

}  // namespace holomorph
