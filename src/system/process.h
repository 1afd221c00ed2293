// Starts other programs, or runs them to their end.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace holomorph {

struct ProcessResult {
  int status = 0;      ///< exit status; 1 if it was ended by a signal
  std::string output;  ///< what it wrote to standard output
};

/// Whether a program of this name is on the PATH.
bool has_program(const std::string& name);

/// A started program and this end of the socket that is its input and output. The caller closes the
/// socket and waits for the program.
struct Child {
  int pid = 0, socket = -1;
};
/// Starts a program found on the PATH. Its error messages go to the descriptor `messages`, or
/// nowhere. The descriptor `passed` is open in the program as kPassedDescriptor. None if it cannot
/// be started; errno says why.
std::optional<Child> start_program(const std::vector<std::string>& words, int messages = -1,
                                   int passed = -1);
inline constexpr int kPassedDescriptor = 3;

/// Runs a program found on the PATH, gives it `input` and waits for it. `keep_running` is called
/// every few hundredths of a second; if it returns false, the program is ended. A program that
/// writes more than `limit` bytes is also ended. None in these two cases, and if it cannot be
/// started.
std::optional<ProcessResult> run_program(
    const std::vector<std::string>& words, const std::string& input = "",
    const std::function<bool()>& keep_running = [] { return true; }, size_t limit = 512u << 20);

}  // namespace holomorph
