// Uses POSIX calls and never runs a shell.
#include "system/process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <sstream>
#include <thread>

extern char** environ;

namespace holomorph {

std::optional<Child> start_program(const std::vector<std::string>& words, int messages,
                                   int passed) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return {};
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  if (messages >= 0)
    ::posix_spawn_file_actions_adddup2(&actions, messages, STDERR_FILENO);
  else
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  // This action must be last, because a later action could overwrite the descriptor.
  if (passed >= 0) ::posix_spawn_file_actions_adddup2(&actions, passed, kPassedDescriptor);
  Child child;
  const int wrong =
      ::posix_spawnp(&child.pid, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  child.socket = ends[0];
  if (wrong == 0) return child;
  ::close(child.socket);
  errno = wrong;
  return {};
}

bool has_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((folder + "/" + name).c_str(), X_OK) == 0) return true;
  return false;
}

namespace {

/// Sets a limit that the program itself could have set: never above its hard limit.
void lower_limit(int pid, decltype(RLIMIT_CPU) resource, double amount) {
  rlimit limit{};
  if (::prlimit(pid, resource, nullptr, &limit) != 0) return;  // it has ended
  const auto most = static_cast<double>(limit.rlim_max);
  limit.rlim_cur = amount < most ? static_cast<rlim_t>(amount) : limit.rlim_max;
  ::prlimit(pid, resource, &limit, nullptr);
}

}  // namespace

double seconds_used_by(int pid) {
  clockid_t clock{};
  timespec used{};
  if (::clock_getcpuclockid(pid, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return 0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

void limit_program(int pid, const ProgramLimits& limits) {
  lower_limit(pid, RLIMIT_CPU, std::ceil(seconds_used_by(pid) + limits.seconds));
  lower_limit(pid, RLIMIT_DATA, limits.bytes);
}

std::optional<ProcessResult> run_program(const std::vector<std::string>& words,
                                         const std::string& input, const RunOptions& options) {
  const std::optional<Child> child = start_program(words);
  if (!child) return {};
  limit_program(child->pid, options.limits);
  ProcessResult finished;
  size_t sent = 0;
  bool good = true, told_end = false, ended = false;
  int status = 0;
  while (good) {
    if (sent == input.size() && !told_end) {
      ::shutdown(child->socket, SHUT_WR);
      told_end = true;
    }
    pollfd wait{child->socket, static_cast<short>(sent < input.size() ? POLLIN | POLLOUT : POLLIN),
                0};
    if (::poll(&wait, 1, 40) < 0 && errno != EINTR) good = false;
    if (wait.revents & POLLOUT) {
      const ssize_t count = ::send(child->socket, input.data() + sent, input.size() - sent,
                                   MSG_NOSIGNAL | MSG_DONTWAIT);
      sent = count > 0                           ? sent + static_cast<size_t>(count)
             : errno == EAGAIN || errno == EINTR ? sent
                                                 : input.size();  // the program no longer reads
    }
    if (wait.revents & (POLLIN | POLLHUP)) {
      std::array<char, 65536> part;
      const ssize_t count = ::recv(child->socket, part.data(), part.size(), MSG_DONTWAIT);
      if (count == 0) break;
      if (count > 0) finished.output.append(part.data(), static_cast<size_t>(count));
      if (count < 0 && errno != EAGAIN && errno != EINTR) break;
    } else if (!ended) {
      // Some programs, such as clipboard tools, leave a helper process behind that keeps this
      // socket open.
      ended = ::waitpid(child->pid, &status, WNOHANG) == child->pid;
    } else {
      break;
    }
    good = good && options.keep_running() && finished.output.size() <= options.most_output;
  }
  ::close(child->socket);
  // The program may still run after closing its output, or may not respond to SIGTERM.
  for (int waited = 0; !ended; waited += 10) {
    const pid_t found = ::waitpid(child->pid, &status, WNOHANG);
    ended = found == child->pid || (found < 0 && errno != EINTR);
    if (ended) break;
    if (good && !options.keep_running()) good = false, waited = 0;
    if (!good) ::kill(child->pid, waited < 1000 ? SIGTERM : SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (!good) return {};
  finished.status = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  finished.out_of_time = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU;
  return finished;
}

}  // namespace holomorph
