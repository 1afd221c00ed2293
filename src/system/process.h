// Other programs: started, or run to their end.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace holomorph {

struct Finished {
  int status = 0;      ///< of the exit; 1 when it was ended by a signal
  std::string output;  ///< what it wrote to its standard output
};

/// Whether a program of this name is on the PATH.
bool has_program(const std::string& name);

/// A started program, and this end of the socket that is its input and output. Its owner closes the
/// socket and waits for the program.
struct Child {
  int pid = 0, socket = -1;
};
/// Starts a program found on the PATH; what it says of errors goes to the descriptor `messages`, or
/// nowhere. It finds the descriptor `passed` open as kPassedDescriptor. None when it cannot be
/// started; errno says why.
std::optional<Child> start_program(const std::vector<std::string>& words, int messages = -1,
                                   int passed = -1);
inline constexpr int kPassedDescriptor = 3;

/// Runs a program found on the PATH, gives it `input` and waits. None when it cannot be started, or
/// when `go_on`, which is asked every few hundredths of a second, has said no: then it is ended.
/// At most `limit` bytes are read; a program that writes more is ended, too, and none returned.
std::optional<Finished> run_program(
    const std::vector<std::string>& words, const std::string& input = "",
    const std::function<bool()>& go_on = [] { return true; }, size_t limit = 512u << 20);

}  // namespace holomorph
