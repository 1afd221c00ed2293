// The legend of a heat map: the meaning of its colors and its worst point.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/canvas/mark_list.h"
#include "app/canvas/overlay.h"

namespace holomorph {

void draw_legend(const Workspace& workspace, const HeatScale& scale, const Eigen::VectorXd& values,
                 const OverlayStyle& style) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Viewport& view = workspace.display.viewport;
  const float s = static_cast<float>(style.scale), width = 220 * s, bar = 14 * s,
              line = ImGui::GetTextLineHeight();
  const float left = static_cast<float>(view.left) + 16 * s,
              top = static_cast<float>(view.top + view.height) - 16 * s - bar - 2 * line - 12 * s;
  list.AddRectFilled({left - 10 * s, top - 8 * s},
                     {left + width + 10 * s, top + bar + 2 * line + 12 * s}, style.colors.panel,
                     6 * s);
  list.AddText({left, top}, style.colors.text, scale.label.c_str());
  const float y = top + line + 4 * s;
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    const Color c = heat_color((i + 0.5) / kSteps, scale.diverging);
    list.AddRectFilled({left + width * i / kSteps, y},
                       {left + width * (i + 1) / kSteps + 1, y + bar},
                       ImGui::ColorConvertFloat4ToU32({c[0], c[1], c[2], 1}));
  }
  for (const double t : {0.0, 0.5, 1.0}) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", scale.low + t * (scale.high - scale.low));
    const float size = ImGui::CalcTextSize(text).x;
    list.AddText({left + static_cast<float>(t) * (width - size), y + bar + 2 * s},
                 style.colors.text, text);
  }
  if (!workspace.map().has_map() || values.size() != workspace.map().map().f.size() ||
      values.size() == 0)
    return;
  Index worst = 0;
  double most = -1;
  for (Index i = 0; i < values.size(); ++i)
    if (const double here = std::abs(values[i]); here > most) most = here, worst = i;
  if (most < 1e-6) return;
  const Complex at = workspace.at_rest() ? workspace.map().prepared()->mesh->vertices[worst]
                                         : workspace.map().map().f[worst];
  const ImVec2 p = px(workspace, at);
  if (!can_draw_at(p)) return;
  char text[48];
  if (std::isfinite(values[worst]))
    std::snprintf(text, sizeof text, "Worst: %.3g", values[worst]);
  else
    std::snprintf(text, sizeof text, "Folded here");
  list.AddCircle(p, 9 * s, IM_COL32_BLACK, 0, 4 * s);
  list.AddCircle(p, 9 * s, IM_COL32_WHITE, 0, 2 * s);
  const ImVec2 size = ImGui::CalcTextSize(text);
  const ImVec2 corner(p.x + 14 * s, p.y - size.y / 2);
  list.AddRectFilled({corner.x - 5 * s, corner.y - 2 * s},
                     {corner.x + size.x + 5 * s, corner.y + size.y + 2 * s}, style.colors.panel,
                     4 * s);
  list.AddText(corner, style.colors.text, text);
}

}  // namespace holomorph
