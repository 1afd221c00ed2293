// A running program with its error output.
#pragma once

#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "system/process.h"

namespace holomorph {

/// A started program whose standard error is kept. It is killed when this object is destroyed.
class WatchedProgram {
 public:
  /// `passed` as in start_program(). Throws Error{failed} if the program cannot be started, with
  /// `if_missing` as its message if it is not installed.
  WatchedProgram(const std::vector<std::string>& words, const std::string& if_missing,
                 int passed = -1);
  ~WatchedProgram();
  WatchedProgram(const WatchedProgram&) = delete;
  WatchedProgram& operator=(const WatchedProgram&) = delete;

  /// Limits what the program may use from now on.
  void limit(const ProgramLimits& limits) const { limit_program(child_.pid, limits); }
  /// The socket that the program reads from and writes to.
  int socket() const { return child_.socket; }
  /// Waits until the program reads more of its input, or has ended. Kills it and returns false if
  /// it uses no processor time for so long.
  bool accepts(double patience_ms);
  /// Closes the socket, waits until the program ends, and returns its exit status. Kills it if it
  /// uses no processor time for so long.
  int end(double patience_ms = std::numeric_limits<double>::infinity());
  /// Whether it was killed because it used no processor time.
  bool was_stuck() const { return was_stuck_; }
  /// Whether it had ended because of ProgramLimits::seconds before end() was called.
  bool out_of_time() const { return out_of_time_; }
  /// The first line that the program wrote to its standard error; may be empty.
  std::string complaint() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> log_{std::tmpfile()};  ///< an unnamed file
  Child child_;
  int status_ = 0;
  bool out_of_time_ = false, was_stuck_ = false;
};

}  // namespace holomorph
