// Tools turn pointer input into edits: previews during a gesture, and one commit at its end.
#pragma once

#include <memory>

#include "core/maps/method.h"
#include "edit/input.h"
#include "edit/picking.h"
#include "edit/tools/posed_corners.h"
#include "edit/tools/recording.h"
#include "edit/tools/snapping.h"
#include "edit/tools/transform_box.h"

namespace holomorph {

/// Something that a layer can be attached to: a pin or a place as one point, or a stroke.
struct TargetMark {
  Points line;  ///< in window px
  bool is_pin = false, hovered = false;
};

/// What a tool draws in addition to the deformation.
struct ToolOverlay {
  Points line;                      ///< the line being drawn, as a polyline in the plane
  Points line_points;               ///< the points that the user set
  std::optional<Complex> line_end;  ///< the position of the line's next point
  bool in_cage = false;             ///< the line is drawn in the cage, which stays visible
  bool closes = false;              ///< the next click closes the line
  std::optional<Box> marquee;       ///< in window px
  std::optional<Handle> hover;
  std::optional<Complex> insertion;  ///< where a click inserts a point
  std::optional<Index> ring;         ///< the pin that has the rotation ring
  bool ring_hovered = false;
  std::optional<CornerMark> corner;  ///< ring and arms of a corner
  std::optional<Index> edge;         ///< the cage segment whose tension a drag changes
  std::optional<BoxMark> box;        ///< the box around the selection
  std::vector<Guide> guides;         ///< guide lines for snapping
  bool shows_dabs = false;  ///< draw stiffness: `dabs` if set, otherwise that of the deformation
  std::optional<std::vector<BrushDab>> dabs;
  std::optional<Complex> brush;  ///< the position of the brush
  std::vector<TargetMark> targets;
  Points coming_pins;  ///< in window px: where pins will be set when the map is known
};

inline constexpr double kDragThresholdPx = 3;

/// A tool determines what the pointer does on the canvas. Tools live as long as the editor. The
/// only state that they keep is an unfinished gesture.
class Tool {
 public:
  virtual ~Tool() = default;
  virtual ToolId id() const = 0;
  virtual void input(const Input& input, Workspace& workspace) = 0;
  /// Whether a press must wait until Workspace::knows_map. If so, it arrives later, and so does all
  /// input after it.
  virtual bool waits(const Input&, const Workspace&) const { return false; }
  /// Handles a key that the tool itself uses (Enter, Backspace, Escape). Returns false for all
  /// other keys, so that actions can use them.
  virtual bool key(Key key, Workspace& workspace) {
    return key == Key::escape && escape(workspace);
  }
  /// Cancels an unfinished gesture. If there is none, a tool that selects clears the selection.
  /// Returns whether the tool used the Escape key.
  bool escape(Workspace& workspace);
  /// Whether the tool selects handles.
  virtual bool selects() const { return false; }
  /// Cancels an unfinished gesture.
  virtual void cancel(Workspace& workspace) = 0;
  /// Whether a gesture is unfinished.
  virtual bool busy() const = 0;
  /// Handles the wheel at the pointer's position. Returns false if the wheel should zoom.
  virtual bool scroll(const Input&, Workspace&) { return false; }
  virtual ToolOverlay overlay() const = 0;
  /// The status bar's text: what the pointer would do at its current position.
  virtual std::string hint(const Workspace& workspace) const = 0;
};

/// The message "Switched to Elastic.", with the label of the usual method for a use.
std::string switched_to(MethodUse use);

/// The message "Pins need a cage. Draw one with P, or use Make from picture.", where `what` is the
/// first sentence without its period.
std::string needs_a_cage(const Workspace& workspace, const std::string& what);

std::unique_ptr<Tool> select_tool();
std::unique_ptr<Tool> pen_tool();
std::unique_ptr<Tool> pin_tool();
std::unique_ptr<Tool> stroke_tool();
std::unique_ptr<Tool> outline_tool();
std::unique_ptr<Tool> angle_tool();
std::unique_ptr<Tool> brush_tool();
std::unique_ptr<Tool> attach_tool();

/// A drag of handles with the pointer: threshold, axis constraint, preview and one commit. With
/// Ctrl, a drag in pose mode is recorded as motion, and a click toggles a vertex between smooth and
/// corner. Shared by the tools that drag handles.
class HandleDrag {
 public:
  /// Starts a drag that amends the last step, which added the dragged handle.
  void start_amending(const Input& input, const Selection& what, const Deformation& deformation) {
    start(input, *what.begin(), what, deformation);
    amends_ = true;
  }
  /// Starts a drag of `what`. `pressed` is the handle under the pointer.
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
  /// The guide lines to the pressed handle from the points that it lines up with.
  const std::vector<Guide>& guides() const { return guides_; }
  /// Follows the pointer and commits on release. Returns true when the drag has ended.
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

/// Sets the outline in one step and plays the iterations of the method. If the outline is the
/// boundary of a surface, displays the surface too. If the outline is invalid, shows a toast
/// instead. Returns whether the outline was set.
bool set_outline(Workspace& workspace, const std::string& label, Points outline,
                 std::optional<SurfaceReference> surface = {});

/// Makes the selected vertices smooth, or corners if all of them are smooth, in one step.
void toggle_corners(Workspace& workspace);

/// Deletes the handle under the pointer if Alt is held and the handle is a vertex, pin or stroke.
/// Returns whether both conditions hold.
bool erase_with_alt(const Input& input, Handle handle, Workspace& workspace);

/// The ring around a single selected pin. A drag of the ring rotates the picture around the pin;
/// the wheel on the ring scales it. A drag with Ctrl around the pin is recorded as motion. A drag
/// with Ctrl toward the pin or away from it, or of the edge of the held disk, changes the radius of
/// this disk.
class PinRing {
 public:
  /// Determines which pin has the ring and whether the pointer is on it.
  void hover(const Input& input, const Workspace& workspace);
  bool hovered() const { return hovered_; }
  bool active() const { return active_; }
  /// What a drag of the hovered or active ring does, for the status bar.
  std::string hint(const Workspace& workspace) const;
  std::optional<Index> pin() const { return pin_; }
  void start(const Input& input, const Workspace& workspace);
  /// Follows the pointer and commits on release.
  void follow(const Input& input, Workspace& workspace);
  /// Scales the picture around the pin if the pointer is on the ring. Consecutive scrolls are one
  /// step of the history. Returns whether the ring used the wheel.
  bool scroll(const Input& input, Workspace& workspace);
  void cancel(Workspace& workspace);

 private:
  enum class Gesture { rotate, resize, record, undecided };
  void decide(const Input& input, Workspace& workspace);
  double angle_to(const Input& input, const Workspace& workspace) const;
  double distance_to(const Input& input, const Workspace& workspace) const;
  Deformation rotated(const Input& input, const Workspace& workspace) const;
  Deformation resized(const Input& input, const Workspace& workspace) const;

  std::optional<Index> pin_;
  bool hovered_ = false, active_ = false;
  bool on_disk_ = false;  ///< the pointer is on the edge of the disk, but not on the ring
  Gesture gesture_ = Gesture::rotate;
  Recording recording_;
  double turned_ = 0;  ///< since the start, unwrapped
  Complex start_px_;
  double start_angle_ = 0, start_distance_ = 0;
  double start_rotation_ = 0;  ///< of the pin, in radians
  Deformation start_deformation_;
};

}  // namespace holomorph
