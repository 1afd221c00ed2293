// Shows the progress of commands, and handles their interruption by Ctrl-C.
#pragma once

#include <atomic>
#include <string>
#include <thread>

namespace holomorph {

/// Thrown when the user stops a command; the exit status is 130.
struct Interrupted {};

/// After this call, SIGINT and SIGTERM end the program immediately with status 130. While a
/// DeferredStop exists, they make stop_if_interrupted() throw instead.
void install_signal_handlers();

/// While an object of this class exists, a signal ends the program only at the next call of
/// stop_if_interrupted(). This prevents half-written results.
class DeferredStop {
 public:
  DeferredStop();
  ~DeferredStop();
  DeferredStop(const DeferredStop&) = delete;
  DeferredStop& operator=(const DeferredStop&) = delete;
};

/// While an object of this class exists, a signal that ends the program first writes `text` to
/// standard output. Makes what a command has written until then complete. At most one such object
/// exists, and its text outlives it.
class LastOutput {
 public:
  explicit LastOutput(const char* text);
  ~LastOutput();
  LastOutput(const LastOutput&) = delete;
  LastOutput& operator=(const LastOutput&) = delete;
  /// Writes the text now. Throws Error if it cannot be written.
  void write();
};

bool is_interrupted();
/// Throws Interrupted if a signal has arrived.
void stop_if_interrupted();

/// Shows on a terminal what a command is doing and how long it has run, such as "render: frame 3 of
/// 24, 2 s". Appears after one second.
class Progress {
 public:
  /// `unit` is the name of a step, such as "frame".
  explicit Progress(const std::string& what, const std::string& unit = "step");
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Reports that `done` of `all` steps are done. Throws Interrupted if a signal has arrived.
  void step(size_t done, size_t all);

 private:
  void show(const std::stop_token& stop) const;

  std::string what_, unit_;
  std::atomic<size_t> done_ = 0, all_ = 0;
  std::jthread display_;  ///< declared last, because its thread must end first
};

}  // namespace holomorph
