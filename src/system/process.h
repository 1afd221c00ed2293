// Starts other programs, and optionally waits for them to end.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace holomorph {

struct ProcessResult {
  int status = 0;            ///< exit status; 1 if a signal ended the program
  std::string output;        ///< the bytes that the program wrote to standard output
  bool out_of_time = false;  ///< it was ended because of ProgramLimits::seconds
};

/// What a program may use.
struct ProgramLimits {
  double seconds = std::numeric_limits<double>::infinity();  ///< of processor time
  double bytes = std::numeric_limits<double>::infinity();    ///< of memory, without what it shares
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

/// Limits what a running program may use from now on. The kernel ends it with SIGXCPU when its time
/// is used up, and gives it no more memory than the limit. The limits of this process still hold.
void limit_program(int pid, const ProgramLimits& limits);

/// The processor time that a program has used, in seconds; 0 if it has ended.
double seconds_used_by(int pid);

struct RunOptions {
  /// Called every few hundredths of a second. The program is terminated if it returns false.
  std::function<bool()> keep_running = [] { return true; };
  size_t most_output = 512u << 20;  ///< bytes; the program is terminated if it writes more
  ProgramLimits limits = {};
};
/// Runs a program found on the PATH, writes `input` to its standard input and waits until it ends.
/// Returns none if the program cannot be started, or was terminated because of the options.
std::optional<ProcessResult> run_program(const std::vector<std::string>& words,
                                         const std::string& input = "",
                                         const RunOptions& options = {});

}  // namespace holomorph
