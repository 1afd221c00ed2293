// Ticks are at round numbers of seconds. Between them are shorter ticks, at frames if there is
// room.
#include "app/panels/time_ruler.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "app/look/text.h"

namespace holomorph {
namespace {

constexpr double kShortest = 0.1;  ///< seconds that the ruler shows at least

/// The smallest step of at least `least` seconds that is 1, 2 or 5 times a power of ten.
double tick_of(double least) {
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * decade >= least) return step * decade;
  return 10 * decade;
}

std::string seconds_text(double time) {
  char text[24];
  std::snprintf(text, sizeof text, "%.4g s", time);
  return text;
}

}  // namespace

void TimeRuler::place(const Workspace& workspace, float left, float right, bool holds) {
  left_ = left;
  right_ = std::max(right, left + 1);
  if (zoomed_ || holds) return;
  start_ = 0;
  length_ = std::max(
      {2.0, 1.1 * length_of(workspace.document.scene()), 1.02 * workspace.shown.timeline.time});
}

void TimeRuler::zoom(double factor, double around) {
  const double wanted = std::clamp(length_ / factor, kShortest, 1.1 * kMaxTime);
  start_ = std::max(0.0, around - (around - start_) * wanted / length_);
  length_ = wanted;
  zoomed_ = true;
}

void TimeRuler::pan(double seconds) {
  start_ = std::clamp(start_ + seconds, 0.0, kMaxTime);
  zoomed_ = true;
}

bool TimeRuler::grow_to(float x) {
  constexpr double kPerSecond = 6;  // times how far the pointer is outside
  const double speed = kPerSecond * static_cast<double>(ImGui::GetIO().DeltaTime);
  const double beyond = static_cast<double>(x - right_) / static_cast<double>(right_ - left_),
               before = static_cast<double>(left_ - x) / static_cast<double>(right_ - left_);
  if (beyond > 0 && start_ + length_ < kMaxTime) {
    const double more = speed * std::min(beyond, 0.3) * length_;
    if (zoomed_)
      start_ += more;
    else
      length_ += more;
    return true;
  }
  if (before > 0 && start_ > 0) {
    start_ = std::max(0.0, start_ - speed * std::min(before, 0.3) * length_);
    return true;
  }
  return false;
}

void TimeRuler::draw(ImDrawList& list, const Workspace& workspace, float top, float bottom) const {
  const ThemeColors& c = theme_colors();
  const Scene& scene = workspace.document.scene();
  const double per_px = length_ / static_cast<double>(right_ - left_);
  const double tick = tick_of(per_px * static_cast<double>(px(112)));
  const double frame = 1 / scene.animation.frames_per_second;
  const double small = frame > per_px * static_cast<double>(px(6)) ? frame : tick / 5;
  const auto line = [&](double time, float height, ImU32 color) {
    const float at = std::round(x(time));
    if (at >= left_ - 1 && at <= right_ + 1)
      list.AddLine({at, bottom - height}, {at, bottom}, faded(color));
  };
  for (auto i = static_cast<long>(start_ / small); i * small <= start_ + length_; ++i)
    line(static_cast<double>(i) * small, px(4), c.edge);
  for (auto i = static_cast<long>(start_ / tick); i * tick <= start_ + length_; ++i) {
    const double time = static_cast<double>(i) * tick;
    line(time, px(10), c.muted);
    const float at = x(time);
    if (at < left_ - 1) continue;
    const std::string seconds = seconds_text(time), frames = std::to_string(frame_at(scene, time));
    const float middle = top + px(4);
    draw_text(list, Type::caption, {at + px(4), middle}, c.muted, seconds);
    draw_text(list, Type::caption, {at + px(12) + text_size(Type::caption, seconds).x, middle},
              c.faint, frames);
  }
}

}  // namespace holomorph
