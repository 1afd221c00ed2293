// How far a command has come, and its end by Ctrl-C.
#pragma once

#include <atomic>
#include <string>
#include <thread>

namespace holomorph {

/// What commands end with when the user stops them: exit status 130.
struct Interrupted {};

/// From here on SIGINT and SIGTERM end the program immediately with status 130, or, where a
/// TidyStop lives, make stop_if_interrupted() throw.
void install_signal_handlers();

/// For what must not be left half done.
class TidyStop {
 public:
  TidyStop();
  ~TidyStop();
  TidyStop(const TidyStop&) = delete;
  TidyStop& operator=(const TidyStop&) = delete;
};
bool is_interrupted();
/// Throws Interrupted.
void stop_if_interrupted();

/// On a terminal a line of what is being done, from the first second on: "render: frame 3 of 24, 2
/// s".
class Progress {
 public:
  /// `unit` is what steps are.
  explicit Progress(const std::string& what, const std::string& unit = "step");
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// So many steps are done of all. Throws Interrupted.
  void step(size_t done, size_t all);

 private:
  void show(const std::stop_token& stop) const;

  std::string what_, unit_;
  std::atomic<size_t> done_ = 0, all_ = 0;
  std::jthread shown_;  ///< last, so that it ends before what it shows
};

}  // namespace holomorph
