// The marks of the overlay: lines, handles, pins and the box around a selection, in window px.
#pragma once

#include "app/canvas/mark_list.h"
#include "app/canvas/overlay.h"

namespace holomorph {

/// Draws a line with a dark edge.
void draw_line(MarkList& list, const std::vector<ImVec2>& line, bool closed, ImU32 color,
               const OverlayStyle& style, float width = 1.5f);
/// Draws a thin line at half strength, for what is not edited.
void draw_faint_line(MarkList& list, const std::vector<ImVec2>& line, bool closed, ImU32 color,
                     const OverlayStyle& style);
/// Draws a small text on a surface of its own.
void draw_chip(MarkList& list, ImVec2 corner, const std::string& text);
/// Draws a dashed line of at least one point. Rest shapes are dashed because not everyone can tell
/// them from poses by their color.
void draw_dashes(MarkList& list, const std::vector<ImVec2>& line, bool closed, ImU32 color,
                 const OverlayStyle& style);
/// Draws a vertex as a square and any other control point as a disk.
void draw_cage_handle(MarkList& list, ImVec2 at, bool vertex, bool selected, bool hovered,
                      ImU32 color, const OverlayStyle& style);
/// Draws the ring around a smooth vertex. Corners have none.
void draw_smooth_mark(MarkList& list, ImVec2 at, const OverlayStyle& style);
/// Draws a pin with its depth and, if it is fixed, its rotation.
void draw_pin(MarkList& list, ImVec2 at, const Pin& pin, bool selected, bool hovered,
              const OverlayStyle& style);
/// Draws the ring around the selected pin. If the pin is fixed, also its rotation.
void draw_ring(MarkList& list, ImVec2 at, float radius, const Pin& pin, bool hovered,
               const OverlayStyle& style);
/// Draws the edge of the disk that a pin with a rotation holds.
void draw_held_disk(MarkList& list, ImVec2 at, float radius, const OverlayStyle& style);
/// Draws a line from a pin's target to the point where the map takes the pin, if the gap is
/// visible.
void draw_miss(MarkList& list, ImVec2 pin, ImVec2 place, const OverlayStyle& style);
/// Marks a zero of the derivative with a diamond and a dot. Only maps that are kept from folding
/// report such zeros.
void draw_zero(MarkList& list, ImVec2 at, const OverlayStyle& style);
/// Draws the box around the selection, with its grips and its knob.
void draw_box(MarkList& list, const BoxMark& mark, const OverlayStyle& style);

}  // namespace holomorph
