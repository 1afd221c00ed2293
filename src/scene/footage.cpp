// The thread decodes the frames that viewers wait for, and then a few frames after each of them.
// Each frame is tried once for each request, so that frames that do not fit are not decoded again
// and again.
#include "scene/footage.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace holomorph {
namespace {

constexpr size_t kMostBytes = size_t{256} << 20;
constexpr size_t kFewestKept = 2;
constexpr int kAhead = 6;  ///< frames that are decoded before they are asked for

std::atomic<size_t> open_films = 0;  ///< they share kMostBytes

}  // namespace

Footage::Footage(std::unique_ptr<FrameReader> reader)
    : reader_(std::move(reader)), info_(reader_->info()) {
  ++open_films;
}

Footage::~Footage() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  reader_->cancel();
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
  --open_films;
}

size_t Footage::capacity() const {
  return std::max(kFewestKept,
                  kMostBytes / std::max<size_t>(1, open_films * std::max<size_t>(1, frame_bytes_)));
}

Footage::Frame Footage::kept(int number) {
  const std::lock_guard lock(mutex_);
  const auto found = kept_.find(number);
  if (found == kept_.end()) return nullptr;
  found->second.used = ++clock_;
  return found->second.image;
}

void Footage::keep(int number, const Frame& image) {
  std::function<void()> wake;
  {
    const std::lock_guard lock(mutex_);
    frame_bytes_ = image->pixels.size() + sizeof(float) * image->fine.size();
    kept_[number] = {image, ++clock_};
    while (kept_.size() > capacity())
      kept_.erase(
          std::ranges::min_element(kept_, {}, [](const auto& entry) { return entry.second.used; }));
    const bool is_awaited = std::ranges::any_of(
        requests_, [&](const auto& entry) { return entry.second.number == number; });
    if (is_awaited) wake = wake_;
  }
  if (wake) wake();
}

Footage::Frame Footage::frame(int number) {
  number = std::clamp(number, 0, last());
  if (Frame found = kept(number)) return found;
  const std::lock_guard reading(reading_);
  if (Frame found = kept(number)) return found;  // another thread has just decoded it
  Frame image = std::make_shared<const Image>(reader_->read(number));
  keep(number, image);
  return image;
}

Footage::Frame Footage::frame_now(int viewer, int number, const std::function<void()>& wake) {
  number = std::clamp(number, 0, last());
  const std::lock_guard lock(mutex_);
  wake_ = wake;
  Request& request = requests_.try_emplace(viewer, Request{-1}).first->second;
  const bool is_new = request.number != number,
             was_evicted = request.next > number && !kept_.contains(number);
  if (is_new || (was_evicted && !failed_.contains(number))) {
    const int ahead = std::min(kAhead, static_cast<int>(capacity() / 2));
    request = {number, number, std::min(info_.frames, number + 1 + ahead)};
    if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
    changed_.notify_all();
  }
  const auto after = kept_.upper_bound(number);
  if (after == kept_.begin()) return nullptr;
  Kept& nearest = std::prev(after)->second;
  if (number - std::prev(after)->first > info_.frames_per_second) return nullptr;
  nearest.used = ++clock_;
  return nearest.image;
}

std::optional<Error> Footage::take_error() {
  const std::lock_guard lock(mutex_);
  return std::exchange(error_, {});
}

/// A request with frames to decode, those that are waited for first; null if there is none.
Footage::Request* Footage::next_request() {
  Request* found = nullptr;
  for (auto& [viewer, request] : requests_) {
    while (request.next < request.end &&
           (kept_.contains(request.next) || failed_.contains(request.next)))
      ++request.next;
    if (request.next == request.end) continue;
    if (request.next == request.number) return &request;
    found = &request;
  }
  return found;
}

void Footage::work() {
  std::unique_lock lock(mutex_);
  while (!ends_) {
    Request* request = next_request();
    if (!request) {
      changed_.wait(lock);
      continue;
    }
    const int number = request->next++;
    lock.unlock();
    std::optional<Error> error;
    try {
      frame(number);
    } catch (const Error& thrown) {
      error = thrown;
    } catch (const std::exception& thrown) {  // for example, out of memory
      error = Error(ErrorKind::failed, std::string("a frame cannot be decoded: ") + thrown.what());
    }
    lock.lock();
    if (!error) continue;
    failed_.insert(number);
    error_ = error;
    if (wake_) wake_();
  }
}

}  // namespace holomorph
