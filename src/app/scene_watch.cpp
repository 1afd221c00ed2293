#include "app/scene_watch.h"

namespace holomorph {

SceneWatch::Change SceneWatch::look(Document& document) {
  if (document.path().empty()) return Change::none;
  std::error_code gone;
  const Time found = std::filesystem::last_write_time(document.path(), gone);
  const Time now = gone ? Time::min() : found;
  if (reported_ == now || (!gone && !document.changed_on_disk())) return Change::none;
  if (seen_ != now) {
    seen_ = now;
    return Change::none;
  }
  reported_ = now;
  return gone ? Change::gone : Change::changed;
}

}  // namespace holomorph
