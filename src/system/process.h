// Starts other programs, and optionally waits for them to end.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace holomorph {

struct ProcessResult {
  int status = 0;      ///< exit status; 1 if a signal ended the program
  std::string output;  ///< the bytes that the program wrote to standard output
};

/// Whether a program with this name is on the PATH.
bool has_program(const std::string& name);

/// A started program, and the caller's end of the socket used as the program's standard input and
/// output. The caller must close the socket and wait for the program.
struct Child {
  int pid = 0, socket = -1;
};
/// Starts a program found on the PATH. Its standard error goes to the descriptor `messages`, or is
/// discarded. The descriptor `passed` is open in the program as kPassedDescriptor. Returns none and
/// sets errno if the program cannot be started.
std::optional<Child> start_program(const std::vector<std::string>& words, int messages = -1,
                                   int passed = -1);
inline constexpr int kPassedDescriptor = 3;

/// Runs a program found on the PATH, writes `input` to its standard input and waits until it ends.
/// `keep_running` is called every few hundredths of a second. The program is terminated if
/// `keep_running` returns false, or if the output exceeds `limit` bytes. Returns none in both
/// cases, and also if the program cannot be started.
std::optional<ProcessResult> run_program(
    const std::vector<std::string>& words, const std::string& input = "",
    const std::function<bool()>& keep_running = [] { return true; }, size_t limit = 512u << 20);

}  // namespace holomorph
