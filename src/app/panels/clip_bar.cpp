// Ends can be grabbed from a little outside, because bars may be short.
#include "app/panels/clip_bar.h"

#include <algorithm>

#include "app/look/surfaces.h"
#include "scene/clips.h"

namespace holomorph {

ClipBar::ClipBar(const TimeRuler& ruler, const Clip& clip, float middle)
    : from_(ruler.x(clip.start), middle - px(11)),
      to_(ruler.x(clip.start + duration_of(clip)), middle + px(11)),
      loops_(clip.loops) {}

void ClipBar::draw(ImDrawList& list, float left, float right) const {
  const auto tint = [&](float alpha) {
    ImVec4 color = ImGui::ColorConvertU32ToFloat4(theme_colors().accent);
    color.w *= alpha * ImGui::GetStyle().Alpha;
    return ImGui::ColorConvertFloat4ToU32(color);
  };
  if (loops_) list.AddRectFilled({left, from_.y}, {right, to_.y}, tint(0.15f), px(4));
  list.AddRectFilled(from_, to_, tint(0.4f), px(4));
}

std::optional<ClipDrag::Kind> ClipBar::part_at(ImVec2 point) const {
  const float outside = px(5), inside = std::min(px(7), (to_.x - from_.x) / 4);
  if (point.y < from_.y || point.y > to_.y || point.x < from_.x - outside ||
      point.x > to_.x + outside)
    return {};
  if (point.x < from_.x + inside) return ClipDrag::Kind::trim_start;
  if (point.x > to_.x - inside) return ClipDrag::Kind::trim_end;
  return ClipDrag::Kind::move;
}

}  // namespace holomorph
