// A running program with its error output.
#pragma once

#include <cstdio>
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

  /// The socket that the program reads from and writes to.
  int socket() const { return child_.socket; }
  /// Closes the socket, waits until the program ends, and returns its exit status.
  int end();
  /// The first line that the program wrote to its standard error; may be empty.
  std::string complaint() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> log_{std::tmpfile()};  ///< an unnamed file
  Child child_;
  int status_ = 0;
};

}  // namespace holomorph
