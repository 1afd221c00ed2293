// The two kinds of failure: bad input (Error, caught at the edges of the program) and bugs (check).
// Also the end of work that is no longer wanted (Stopped).
#pragma once

#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>

#include "core/types.h"

namespace holomorph {

enum class ErrorKind {
  bad_input,  ///< the user's input cannot be used: exit status 2
  failed      ///< the input is valid, but the work failed (disk full): exit status 1
};

/// Bad input or failed work. The message says what is wrong, where it is and what to do about it.
/// `where`, if set, is a position in the plane that an editor can show.
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

/// Thrown by a computation that was asked to stop.
struct Stopped : std::exception {
  const char* what() const noexcept override { return "stopped"; }
};
inline void throw_if_stopped(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Stopped();
}

/// The message of an exception as readable text. Also handles exceptions from the standard library.
std::string what_of(const std::exception& error);

/// Aborts with a message when an invariant of the program itself is broken. Active in every build.
void check(bool condition, const char* what);

}  // namespace holomorph
