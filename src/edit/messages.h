// Short messages over the canvas.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "system/file.h"

namespace holomorph {

/// A short message; a place of the plane that it is about can be shown.
struct Toast {
  std::string text;
  bool problem = false;
  std::optional<Complex> where = {};
};

/// Messages that the window takes over.
struct Messages {
  std::vector<Toast> toasts = {};

  void say(const std::string& text, std::optional<Complex> where = {}) {
    toasts.push_back({printable(text), false, where});
  }
  void complain(const Error& error) { complain(error.what(), error.where()); }
  /// A problem in words; "" is none.
  void complain(const std::string& problem, std::optional<Complex> where = {}) {
    if (!problem.empty()) toasts.push_back({printable(problem), true, where});
  }
};

}  // namespace holomorph
