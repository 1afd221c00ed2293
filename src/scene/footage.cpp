// The thread decodes the frame that was asked for last, and then the frames after it.
#include "scene/footage.h"

#include <algorithm>
#include <utility>

namespace holomorph {
namespace {

constexpr size_t kMostBytes = size_t{256} << 20;
constexpr size_t kFewestKept = 4;
constexpr int kAhead = 6;  ///< frames that are decoded before they are asked for

}  // namespace

Footage::~Footage() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

Footage::Frame Footage::kept(int number) {
  const std::lock_guard lock(mutex_);
  const auto found = kept_.find(number);
  if (found == kept_.end()) return nullptr;
  found->second.used = ++clock_;
  return found->second.image;
}

void Footage::keep(int number, const Frame& image) {
  const std::lock_guard lock(mutex_);
  kept_[number] = {image, ++clock_};
  most_ = std::max(kFewestKept, kMostBytes / std::max<size_t>(1, image->pixels.size()));
  while (kept_.size() > most_)
    kept_.erase(
        std::ranges::min_element(kept_, {}, [](const auto& entry) { return entry.second.used; }));
}

Footage::Frame Footage::frame(int number) {
  number = std::clamp(number, 0, info_.frames - 1);
  if (Frame found = kept(number)) return found;
  const std::lock_guard reading(reading_);
  if (Frame found = kept(number)) return found;  // another thread has just decoded it
  Frame image = std::make_shared<const Image>(reader_->read(number));
  keep(number, image);
  return image;
}

Footage::Frame Footage::frame_now(int number, const std::function<void()>& wake) {
  number = std::clamp(number, 0, info_.frames - 1);
  const std::lock_guard lock(mutex_);
  if (wanted_ != number && failed_ != number) {
    wanted_ = number;
    wake_ = wake;
    if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
    changed_.notify_all();
  }
  const auto after = kept_.upper_bound(number);
  if (after == kept_.begin()) return nullptr;
  const auto& [nearest, entry] = *std::prev(after);
  if (number - nearest > info_.frames_per_second) return nullptr;
  kept_[nearest].used = ++clock_;
  return entry.image;
}

std::optional<Error> Footage::take_error() {
  const std::lock_guard lock(mutex_);
  return std::exchange(error_, {});
}

void Footage::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    // The first missing frame among the wanted one and those after it.
    std::optional<int> missing;
    if (wanted_) {
      const int ahead = std::min(kAhead, static_cast<int>(most_ / 2)),
                end = std::min(info_.frames, *wanted_ + 1 + ahead);
      for (int i = *wanted_; i < end && !missing; ++i)
        if (!kept_.contains(i) && failed_ != i) missing = i;
    }
    if (ends_) return;
    if (!missing) {
      changed_.wait(lock);
      continue;
    }
    lock.unlock();
    std::optional<Error> error;
    try {
      frame(*missing);
    } catch (const Error& thrown) {
      error = thrown;
    }
    lock.lock();
    if (error) {
      failed_ = missing;
      if (missing == wanted_) error_ = error;
    }
    if (missing == wanted_ && wake_) wake_();
  }
}

}  // namespace holomorph
