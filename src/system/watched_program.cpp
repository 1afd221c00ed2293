// Standard error goes to an unnamed file, so that the program never waits for a reader.
#include "system/watched_program.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include "core/clock.h"
#include "core/error.h"

namespace holomorph {
namespace {

/// How long a program has used no processor time.
class Patience {
 public:
  Patience(int pid, double most_ms) : pid_(pid), most_ms_(most_ms) {}
  bool is_over() {
    if (const double used = seconds_used_by(pid_); used != used_) {
      used_ = used;
      since_ms_ = now_ms();
    }
    return now_ms() - since_ms_ > most_ms_;
  }

 private:
  int pid_;
  double most_ms_, used_ = 0, since_ms_ = now_ms();
};

}  // namespace

WatchedProgram::WatchedProgram(const std::vector<std::string>& words, const std::string& if_missing,
                               int passed) {
  if (!log_) throw Error(ErrorKind::failed, "cannot create a temporary file for " + words[0]);
  if (const auto child = start_program(words, ::fileno(log_.get()), passed)) {
    child_ = *child;
    return;
  }
  if (errno == ENOENT) throw Error(ErrorKind::failed, if_missing);
  throw Error(ErrorKind::failed, "cannot start " + words[0] + ": " + std::strerror(errno));
}

WatchedProgram::~WatchedProgram() {
  if (child_.pid > 0) ::kill(child_.pid, SIGKILL);
  end();
}

bool WatchedProgram::accepts(double patience_ms) {
  constexpr int kStepMs = 50;
  Patience patience(child_.pid, patience_ms);
  pollfd waiting{child_.socket, POLLOUT, 0};
  while (::poll(&waiting, 1, kStepMs) <= 0)
    if (patience.is_over()) {
      was_stuck_ = true;
      ::kill(child_.pid, SIGKILL);
      return false;
    }
  return true;
}

int WatchedProgram::end(double patience_ms) {
  if (child_.socket >= 0) ::close(std::exchange(child_.socket, -1));
  if (child_.pid <= 0) return status_;
  int status = 0;
  Patience patience(child_.pid, patience_ms);
  for (int waits = 0; ::waitpid(child_.pid, &status, WNOHANG) == 0; ++waits) {
    if (patience.is_over()) {
      was_stuck_ = true;
      ::kill(child_.pid, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(std::min(waits, 20)));
  }
  child_.pid = 0;
  out_of_time_ = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU;
  return status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

std::string WatchedProgram::complaint() const {
  std::rewind(log_.get());
  std::array<char, 400> line{};
  const std::string all =
      std::fgets(line.data(), static_cast<int>(line.size()), log_.get()) ? line.data() : "";
  return all.substr(0, all.find('\n'));
}

}  // namespace holomorph
