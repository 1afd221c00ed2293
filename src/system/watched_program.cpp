// Standard error goes to an unnamed file, so that the program never waits for a reader.
#include "system/watched_program.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "core/error.h"

namespace holomorph {

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

int WatchedProgram::end() {
  if (child_.socket >= 0) ::close(std::exchange(child_.socket, -1));
  if (child_.pid <= 0) return status_;
  int status = 0;
  while (::waitpid(child_.pid, &status, 0) < 0 && errno == EINTR) {
  }
  child_.pid = 0;
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
