// Tools turn input into a changed deformation: nothing, a preview, or a commit.
#pragma once

#include <memory>

#include "edit/input.h"
#include "edit/tools/posed_corners.h"
#include "edit/tools/recording.h"
#include "edit/tools/snapping.h"
#include "edit/tools/transform_box.h"

namespace holomorph {

/// What a tool wants drawn besides the deformation.
struct ToolOverlay {
  Points line;                      ///< what is being drawn, as a polyline in the plane
  Points line_points;               ///< the points that were set
  std::optional<Complex> line_end;  ///< where its next point would be
  bool closes = false;              ///< the next click closes it
  std::optional<Box> marquee;       ///< in window px
  std::optional<Handle> hover;
  std::optional<Complex> insertion;  ///< where a click inserts a point
  std::optional<Index> ring;         ///< the pin that shows its rotation ring
  bool ring_hovered = false;
  std::optional<CornerMark> corner;  ///< the cage vertex that shows its ring and arms
  std::optional<Index> edge;         ///< the cage segment whose tension a drag changes
  std::optional<BoxMark> box;        ///< around what is selected
  std::vector<Guide> guides;         ///< what is lined up with
  bool shows_dabs = false;           ///< what is painted: `dabs`, or the deformation's
  std::optional<std::vector<BrushDab>> dabs;
  std::optional<Complex> brush;  ///< where the brush is
};

inline constexpr double kDragThresholdPx = 3;
inline constexpr double kRingRadius = 2.8;  ///< of a pin's ring, in picking distances

/// One way of using the pointer. Objects live as long as the editor; state is an unfinished
/// gesture.
class Tool {
 public:
  virtual ~Tool() = default;
  virtual ToolId id() const = 0;
  virtual void input(const Input& input, Workspace& workspace) = 0;
  /// A key that the tool uses itself (Enter, Backspace, Escape); false leaves it to the actions.
  virtual bool key(Key key, Workspace& workspace) {
    return key == Key::escape && escape(workspace);
  }
  /// Drops an unfinished gesture; without one, tools that select clear the selection. Returns
  /// whether there was anything to do for Escape.
  bool escape(Workspace& workspace);
  virtual bool selects() const { return false; }
  /// Drops an unfinished gesture.
  virtual void cancel(Workspace& workspace) = 0;
  virtual bool busy() const = 0;
  /// Uses the wheel at the pointer's place; false leaves it to zooming.
  virtual bool scroll(const Input&, Workspace&) { return false; }
  virtual ToolOverlay overlay() const = 0;
  virtual std::string hint(const Workspace& workspace) const = 0;
};

/// "Pins act inside a cage: draw one with P, or make one from the picture".
std::string needs_a_cage(const Workspace& workspace, const std::string& what);

std::unique_ptr<Tool> select_tool();
std::unique_ptr<Tool> pen_tool();
std::unique_ptr<Tool> pin_tool();
std::unique_ptr<Tool> stroke_tool();
std::unique_ptr<Tool> outline_tool();
std::unique_ptr<Tool> angle_tool();
std::unique_ptr<Tool> brush_tool();

/// Moving handles with the pointer: threshold, axis constraint, preview and one commit. With Ctrl,
/// a drag of the pose is recorded as motion, and a click makes a vertex smooth or a corner. Shared
/// by the tools that drag.
class HandleDrag {
 public:
  /// A drag that carries the last step on, which set or inserted what is dragged.
  void start_amending(const Input& input, const Selection& what, const Deformation& deformation) {
    start(input, *what.begin(), what, deformation);
    amends_ = true;
  }
  /// `pressed` is the one of them that is under the pointer.
  void start(const Input& input, Handle pressed, Selection what, const Deformation& deformation) {
    amends_ = false;
    pressed_ = pressed;
    start_px_ = input.px;
    start_ = input.position;
    what_ = std::move(what);
    deformation_ = deformation;
    with_ctrl_ = input.mods.ctrl;
    active_ = true;
    moving_ = false;
  }
  bool active() const { return active_; }
  bool moving() const { return moving_; }
  /// What the drag lines up with now.
  const std::vector<Guide>& guides() const { return guides_; }
  /// Follows the pointer; on release commits. Returns true when the drag has ended.
  bool follow(const Input& input, Workspace& workspace);
  void cancel(Workspace& workspace) {
    if (active_) workspace.shown.preview.reset();
    if (recording_.active()) recording_.cancel(workspace);
    guides_.clear();
    active_ = false;
  }

 private:
  Deformation dragged(const Input& input, Workspace& workspace);
  void finish(Workspace& workspace);

  Complex start_px_, start_;
  Handle pressed_;
  Selection what_;
  Deformation deformation_;
  Recording recording_;
  std::vector<Guide> guides_;
  bool active_ = false, moving_ = false, amends_ = false, with_ctrl_ = false;
};

/// A new outline as one step, with its convergence played; refused with a toast when it is none.
/// With the surface whose boundary it is, that is shown. Returns whether it was taken.
bool take_outline(Workspace& workspace, const std::string& label, Points outline,
                  std::optional<SurfaceReference> surface = {});

/// Makes the selected vertices smooth, or corners when all of them are smooth, as one step.
void toggle_corners(Workspace& workspace);

/// Presses with Alt delete a vertex, pin or stroke instead of picking it. Returns whether it was
/// one.
bool erases(const Input& input, Handle handle, Workspace& workspace);

/// The ring around the one selected pin: dragging it turns the picture around the pin, the wheel
/// scales it there.
class PinRing {
 public:
  /// Finds the ring and whether the pointer is on it.
  void hover(const Input& input, const Workspace& workspace);
  bool hovered() const { return hovered_; }
  bool active() const { return active_; }
  std::optional<Index> pin() const { return pin_; }
  void start(const Input& input, const Workspace& workspace);
  /// Follows the pointer; on release commits.
  void follow(const Input& input, Workspace& workspace);
  /// The wheel over the ring enlarges or shrinks the picture around the pin: one step of the
  /// history as long as it goes on.
  bool scroll(const Input& input, Workspace& workspace);
  void cancel(Workspace& workspace);

 private:
  double angle_to(const Input& input, const Workspace& workspace) const;

  std::optional<Index> pin_;
  bool hovered_ = false, active_ = false;
  Complex start_px_;
  double start_angle_ = 0;
  Deformation start_deformation_;
};

}  // namespace holomorph
