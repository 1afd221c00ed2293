// Two ways to fail: the input is bad (Error, caught at the edges), or the program is (check).
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "core/types.h"

namespace holomorph {

enum class ErrorKind {
  bad_input,  ///< what the user gave cannot be used: exit status 2
  failed      ///< the input is good but the work could not be done (disk full): exit status 1
};

/// Bad input or failed work. The message says what, where and what to do about it.
/// `where` is the place in the plane that an editor can show, when there is one.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message, std::optional<Complex> where = {})
      : std::runtime_error(message), kind_(kind), where_(where) {}

  ErrorKind kind() const { return kind_; }
  std::optional<Complex> where() const { return where_; }

 private:
  ErrorKind kind_;
  std::optional<Complex> where_;
};

/// What went wrong, in words: also of what the standard library throws.
std::string what_of(const std::exception& error);

/// Aborts with a message when an invariant of the program itself is broken; on in every build.
void check(bool condition, const char* what);

}  // namespace holomorph
