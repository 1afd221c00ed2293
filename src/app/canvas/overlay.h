// Cage, pins and gestures drawn over the canvas.
#pragma once

#include "app/theme.h"
#include "edit/tools/tool.h"

namespace holomorph {

struct OverlayStyle {
  CanvasColors colors;
  double scale = 1;  ///< of the display
};

/// Where a place of the plane is in the window.
ImVec2 px(const Workspace& workspace, Complex z);

/// Draws the shown mode's cage and pins and the tool's gesture into ImGui's background.
void draw_overlay(const Workspace& workspace, const ToolOverlay& gesture,
                  const OverlayStyle& style);

/// Marks a place that a message is about.
void draw_marker(const Workspace& workspace, Complex where, const OverlayStyle& style);

/// The colour bar of a heat map, and a marker at its worst place.
void draw_legend(const Workspace& workspace, const HeatScale& scale, const Eigen::VectorXd& values,
                 const OverlayStyle& style);

}  // namespace holomorph
