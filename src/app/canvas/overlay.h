// The overlay of the canvas: cage, pins and gestures.
#pragma once

#include "app/look/theme.h"
#include "edit/tools/tool.h"

namespace holomorph {

struct OverlayStyle {
  CanvasColors colors;
  double scale = 1;  ///< the display's scale
};

inline ImVec2 vec(Complex px) {
  return {static_cast<float>(px.real()), static_cast<float>(px.imag())};
}
/// The position in the window of a point of the edited layer.
ImVec2 px(const Workspace& workspace, Complex z);

/// Draws the cage and pins of the current mode, and the tool's gesture, into ImGui's background.
void draw_overlay(const Workspace& workspace, const ToolOverlay& gesture,
                  const OverlayStyle& style);

/// Draws the outline of a cage that is only proposed.
void draw_proposed_cage(const Workspace& workspace, const Cage& cage, const OverlayStyle& style);

/// Marks the point that a message is about.
void draw_marker(const Workspace& workspace, Complex where, const OverlayStyle& style);

/// Draws the color bar of a heat map, and a marker at its worst point.
void draw_legend(const Workspace& workspace, const HeatScale& scale, const Eigen::VectorXd& values,
                 const OverlayStyle& style);

}  // namespace holomorph
