// An exception ends the job and is kept for error().
#include "system/job.h"

#include <chrono>

namespace holomorph {

Job::Job(std::string title, Work work, std::function<void()> wake)
    : title_(std::move(title)), thread_([this, work = std::move(work), wake = std::move(wake)] {
        const auto keep = [this](const Error& error) {
          const std::lock_guard lock(mutex_);
          error_ = error;
        };
        try {
          work(progress_);
        } catch (const Error& error) {
          keep(error);
        } catch (const std::exception& error) {
          keep(Error(ErrorKind::failed, title_ + " failed: " + what_of(error)));
        }
        ended_ = true;
        if (wake) wake();
      }) {}

Job::~Job() {
  cancel();
  thread_.join();
}

bool Job::ended_within(double milliseconds) const {
  using namespace std::chrono;
  const auto end = steady_clock::now() + duration<double, std::milli>(milliseconds);
  while (!ended_ && steady_clock::now() < end) std::this_thread::sleep_for(microseconds(500));
  return ended_;
}

std::optional<Error> Job::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

}  // namespace holomorph
