// A separate thread shows the time, because some commands never report a step.
#include "cli/progress.h"

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <mutex>

#include "core/clock.h"
#include "system/new_file.h"

namespace holomorph {
namespace {

volatile std::sig_atomic_t interrupted = 0;
std::atomic<int> deferred_stops = 0;  // lock-free, because the handler reads it
std::atomic<const char*> last_output = nullptr;

void write_in_handler(int descriptor, const char* text) {
  const ssize_t ignored = ::write(descriptor, text, std::strlen(text));
  static_cast<void>(ignored);
}

void stop(int) {
  interrupted = 1;
  if (deferred_stops > 0) return;
  if (const char* text = last_output.exchange(nullptr)) write_in_handler(STDOUT_FILENO, text);
  write_in_handler(STDERR_FILENO, "\nholomorph: interrupted\n");
  ::_exit(130);
}

}  // namespace

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = stop;  // without SA_RESTART, a signal interrupts a wait for a pipe
  for (const int signal : {SIGINT, SIGTERM}) ::sigaction(signal, &action, nullptr);
}

DeferredStop::DeferredStop() {
  ++deferred_stops;
}
DeferredStop::~DeferredStop() {
  --deferred_stops;
}

LastOutput::LastOutput(const char* text) {
  last_output = text;
}
LastOutput::~LastOutput() {
  last_output = nullptr;
}

void LastOutput::write() {
  if (const char* text = last_output.exchange(nullptr)) write_standard_output(text);
}

bool is_interrupted() {
  return interrupted != 0;
}

void stop_if_interrupted() {
  if (interrupted) throw Interrupted{};
}

Progress::Progress(const std::string& what, const std::string& unit) : what_(what), unit_(unit) {
  if (::isatty(STDERR_FILENO)) display_ = std::jthread([this](std::stop_token s) { show(s); });
}

Progress::~Progress() {
  if (!display_.joinable()) return;
  display_.request_stop();
  display_.join();
}

void Progress::step(size_t done, size_t all) {
  stop_if_interrupted();
  all_ = all;
  done_ = done;
}

void Progress::show(const std::stop_token& stop) const {
  using namespace std::chrono_literals;
  const double start = now_ms();
  std::mutex mutex;
  std::condition_variable_any tick;
  std::unique_lock lock(mutex);
  bool any = false;
  for (auto pause = 1000ms; !tick.wait_for(lock, stop, pause, [] { return false; });
       pause = 200ms) {
    if (stop.stop_requested()) break;
    const size_t done = done_, all = all_;
    any = true;
    std::fprintf(stderr, "\r\033[K%s", what_.c_str());
    if (all > 1) std::fprintf(stderr, ": %s %zu of %zu", unit_.c_str(), done, all);
    std::fprintf(stderr, ", %.0f s", (now_ms() - start) / 1000);
  }
  if (any) std::fprintf(stderr, "\r\033[K");
}

}  // namespace holomorph
