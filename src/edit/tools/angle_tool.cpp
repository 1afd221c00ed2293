// Key A. A ring turns corners of the posed cage, two arms open and close them, and dragging an edge
// changes its tension.
#include <algorithm>
#include <set>
#include <utility>

#include "edit/actions/actions.h"
#include "edit/edits/corner_edits.h"
#include "edit/edits/method_edits.h"
#include "edit/tools/tool.h"

namespace holomorph {
namespace {

constexpr double kTensionPx = 150;  ///< length of a drag that changes the tension by 1

class AngleTool final : public Tool {
 public:
  ToolId id() const override { return ToolId::angle; }

  void input(const Input& input, Workspace& workspace) override {
    if (dragging_) return follow(input, workspace);
    if (marquee_) return follow_marquee(input, workspace);
    mark_.reset();
    edge_.reset();
    hover_.reset();
    const Deformation& deformation = workspace.shown.deformation();
    if (!deformation.has_cage() || workspace.mode == EditMode::rest) return;
    if (const auto shown = shown_corner(workspace)) {
      mark_ = corner_mark(workspace, *shown);
      if (input.inside) mark_->hovered = region_at(*mark_, input.px, workspace.display.handle_px);
    }
    if (!input.inside) return;
    const bool on_mark = mark_ && mark_->hovered != CornerMark::Region::none;
    if (const auto vertex = posed_vertex_at(workspace, input.px); vertex && !on_mark)
      hover_ = vertex;
    else if (!on_mark)
      edge_ = posed_segment_at(workspace, input.px);
    if (!input.pressed) return;
    if (on_mark)
      start(input, workspace);
    else if (hover_)
      pick(input, workspace);
    else if (edge_)
      start(input, workspace);
    else
      marquee_ = {input.px, input.px};
  }

  void cancel(Workspace& workspace) override {
    if (dragging_) workspace.shown.preview.reset();
    if (recording_.active()) recording_.cancel(workspace);
    if (std::exchange(renumbers_, false)) select({}, workspace);
    dragging_ = false;
    marquee_.reset();
    shown_.reset();
  }
  bool busy() const override { return dragging_ || marquee_; }
  bool selects() const override { return true; }
  bool key(Key key, Workspace& workspace) override {
    if (key == Key::escape) {
      if (!busy()) picked_ = {};
      return escape(workspace);
    }
    if (key != Key::del || workspace.mode == EditMode::rest || !shown_corner(workspace))
      return false;
    remove(corners_of(workspace), workspace);
    return true;
  }

  ToolOverlay overlay() const override {
    ToolOverlay overlay;
    overlay.corner = shown_ ? shown_ : mark_;
    overlay.edge = edge_;
    if (hover_) overlay.hover = Handle{Handle::Kind::cage, *hover_, 0};
    if (marquee_ && std::abs(marquee_->second - marquee_->first) >= kDragThresholdPx) {
      overlay.marquee.emplace();
      overlay.marquee->include(marquee_->first);
      overlay.marquee->include(marquee_->second);
    }
    return overlay;
  }

  std::string hint(const Workspace& workspace) const override {
    const Deformation& deformation = workspace.shown.deformation();
    if (!deformation.has_cage()) return needs_a_cage(workspace, "Turning corners needs a cage");
    if (workspace.mode == EditMode::rest)
      return workspace.actions.key_of("cage.rest") + " returns to the pose, where corners turn";
    if (dragging_ && edge_)
      return "Tension " +
             text_of_number(corner_at(deformation, corner_before(deformation, *edge_)).tension) +
             ": drag down to let the edge bend, up to straighten it";
    if (dragging_) {
      const PoseCorner pose = corner_at(deformation, mark_->vertex);
      const double turn = (pose.before + pose.after) / 2,
                   opening = corner_opening(deformation, mark_->vertex);
      return "Turned by " + text_of_number(turn * 180 / kPi) + ", opened by " +
             text_of_number(opening * 180 / kPi) + " degrees; hold Shift for steps of 15";
    }
    if (mark_ && mark_->hovered == CornerMark::Region::ring)
      return "Drag the ring to turn the corner, as many times around as you like; Ctrl-drag to "
             "record motion";
    if (mark_ && mark_->hovered != CornerMark::Region::none)
      return "Drag the arm to open or close the corner; Ctrl-drag to record motion";
    if (hover_)
      return is_corner(deformation, *hover_)
                 ? "Click to select the corner; Shift-click to select more; Alt-click to make it a "
                   "plain point"
                 : "Click to make this point a corner";
    if (edge_)
      return "Drag down to let the edge bend, up to straighten it; Ctrl-drag to record motion";
    return "Click a corner or drag a box to select corners; drag an edge to change its tension";
  }

 private:
  static std::string text_of_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
  }

  /// The selected corners. The ring and the arms act on all of them.
  std::vector<Index> corners_of(const Workspace& workspace) const {
    const Deformation& deformation = workspace.shown.deformation();
    std::vector<Index> corners;
    const auto add = [&](const Handle& handle) {
      if (handle.kind == Handle::Kind::cage && handle.control == 0 &&
          handle.index < deformation.pose.size() && is_corner(deformation, handle.index))
        corners.push_back(handle.index);
    };
    std::ranges::for_each(selection_of(workspace), add);
    return corners;
  }

  /// Corners that are picked while the method has no use for the cage's points, which cannot be
  /// selected then. They belong to this cage.
  struct Picked {
    Selection corners;
    Cage cage;
  };
  bool can_select(const Workspace& workspace) const {
    return has_cage_handles(workspace.shown.deformation(), EditMode::pose);
  }
  Selection selection_of(const Workspace& workspace) const {
    if (can_select(workspace)) return workspace.selection;
    return picked_.cage == workspace.shown.deformation().rest ? picked_.corners : Selection{};
  }
  void select(Selection corners, Workspace& workspace) {
    workspace.selection = can_select(workspace) ? corners : Selection{};
    picked_ = {std::move(corners), workspace.shown.deformation().rest};
  }
  /// The corner that has the ring and the arms: the one that was clicked last if it is selected,
  /// else the first selected one.
  std::optional<Index> shown_corner(const Workspace& workspace) const {
    const std::vector<Index> corners = corners_of(workspace);
    if (corners.empty()) return {};
    return std::ranges::find(corners, clicked_) != corners.end() ? clicked_ : corners.front();
  }

  void remove(const std::vector<Index>& corners, Workspace& workspace) {
    try {
      Deformation deformation = workspace.shown.deformation();
      for (const Index corner : corners)
        deformation = without_corner(std::move(deformation), corner);
      workspace.commit(corners.size() == 1 ? "Remove corner" : "Remove corners",
                       std::move(deformation));
      select({}, workspace);
    } catch (const Error& error) {
      workspace.messages.complain(error);
    }
  }

  void pick(const Input& input, Workspace& workspace) {
    if (input.mods.alt) return remove({*hover_}, workspace);
    if (!is_corner(workspace.shown.deformation(), *hover_))
      workspace.commit("Add corner", with_corner(workspace.shown.deformation(), *hover_));
    const Handle handle{Handle::Kind::cage, *hover_, 0};
    Selection corners = input.mods.shift ? selection_of(workspace) : Selection{};
    if (!corners.erase(handle)) corners.insert(handle);
    select(std::move(corners), workspace);
    clicked_ = *hover_;
  }

  void follow_marquee(const Input& input, Workspace& workspace) {
    marquee_->second = input.px;
    if (input.down && !input.released) return;
    Box box;
    box.include(marquee_->first);
    box.include(marquee_->second);
    marquee_.reset();
    Selection corners = input.mods.shift ? selection_of(workspace) : Selection{};
    const Viewport view = workspace.layer_view();
    for (Index v = 0; v < workspace.shown.deformation().pose.size(); ++v)
      if (box.contains(view.px_at_plane(posed_vertex(workspace, v))))
        corners.insert({Handle::Kind::cage, v, 0});
    select(std::move(corners), workspace);
  }

  void start(const Input& input, Workspace& workspace) {
    dragging_ = true;
    start_px_ = last_px_ = input.px;
    turned_ = 0;
    with_ctrl_ = input.mods.ctrl;
    deformation_ = workspace.shown.deformation();
    corners_ = corners_of(workspace);
    switches_ = !has_method_for(deformation_, MethodUse::corners);
    renumbers_ = false;
  }

  /// Switches to the method for corners, which may select them. It has a single outline: where
  /// parts of the cage are joined, the drag goes on with the nearest corners and the nearest edge.
  void switch_method(Workspace& workspace) {
    const Cage before = deformation_.rest;
    deformation_ = with_method_for(std::move(deformation_), MethodUse::corners);
    if (!before.parts.empty()) renumber(before);
    workspace.selection.clear();
    for (const Index corner : corners_) workspace.selection.insert({Handle::Kind::cage, corner, 0});
    renumbers_ = true;
  }

  void renumber(const Cage& before) {
    const auto nearest = [&](Index vertex) {
      Index best = 0;
      for (Index v = 0; v < deformation_.rest.size(); ++v)
        if (std::abs(deformation_.rest.vertex(v) - before.vertex(vertex)) <
            std::abs(deformation_.rest.vertex(best) - before.vertex(vertex)))
          best = v;
      return best;
    };
    if (edge_)
      edge_ = nearest_on_cage(deformation_.rest,
                              0.5 * (before.vertex(*edge_) + before.end_vertex(*edge_)))
                  .segment;
    if (mark_) mark_->vertex = nearest(mark_->vertex);
    clicked_ = mark_ ? mark_->vertex : -1;
    std::set<Index> corners;
    for (const Index corner : corners_) corners.insert(nearest(corner));
    corners_.assign(corners.begin(), corners.end());
  }

  /// The angle of the drag around the mark's center, counter-clockwise and unwrapped. With Shift,
  /// in steps of 15 degrees.
  double turned(const Input& input) {
    const Complex before = last_px_ - mark_->center, now = input.px - mark_->center;
    if (std::abs(now) > 1 && std::abs(before) > 1) {
      turned_ -= std::arg(now / before);
      last_px_ = input.px;
    }
    constexpr double kSnap = kPi / 12;
    return input.mods.shift ? std::round(turned_ / kSnap) * kSnap : turned_;
  }

  bool drags_tension() const { return !mark_ || mark_->hovered == CornerMark::Region::none; }

  /// How far the gesture has come: the change of the tension, or an angle.
  double amount(const Input& input) {
    return drags_tension() ? (start_px_ - input.px).imag() / kTensionPx : turned(input);
  }

  /// The edit of the gesture. Corners take the angles that they had at the start, plus the amount.
  RecordedEdit edit() const {
    if (drags_tension()) {
      const Index corner = corner_before(deformation_, *edge_);
      const auto set = [corner](Deformation deformation, const Deformation& start, Complex up) {
        return with_tension(std::move(deformation), corner,
                            corner_at(start, corner).tension + up.real());
      };
      return {[set](Deformation deformation) { return set(deformation, deformation, 0); }, set};
    }
    const bool turns = mark_->hovered == CornerMark::Region::ring;
    // The inside of a counter-clockwise cage is to the left of its edges. Turning the edge that
    // starts at the corner clockwise therefore opens the corner.
    const bool opens_clockwise = (mark_->hovered == CornerMark::Region::after) ==
                                 (signed_area(outline_of(deformation_.rest)) > 0);
    const auto set = [corners = corners_, turns, opens_clockwise](
                         Deformation deformation, const Deformation& start, Complex amount) {
      const double by = amount.real();
      for (const Index corner : corners) {
        const PoseCorner before = corner_at(start, corner);
        deformation = with_corner_pose(std::move(deformation), corner, before);
        deformation =
            turns ? corner_turned(std::move(deformation), corner, by)
                  : corner_opened(std::move(deformation), corner, opens_clockwise ? -by : by);
      }
      return deformation;
    };
    return {[set](Deformation deformation) { return set(deformation, deformation, 0); }, set};
  }

  void follow(const Input& input, Workspace& workspace) {
    const bool moves =
        workspace.shown.preview || std::abs(input.px - start_px_) >= kDragThresholdPx;
    if (moves && !has_method_for(deformation_, MethodUse::corners)) switch_method(workspace);
    if (moves && with_ctrl_ && !recording_.active() &&
        !recording_.start(workspace, edit(), input.now_ms))
      return cancel(workspace);
    if (recording_.active())
      workspace.shown.preview = recording_.follow(workspace, amount(input), input.now_ms);
    else if (moves)
      workspace.shown.preview = edit().set(deformation_, deformation_, amount(input));
    if (input.down && !input.released) {
      if (mark_) {  // drawn at the corner's current position
        const CornerMark::Region hovered = mark_->hovered;
        const Complex center = mark_->center;
        shown_ = corner_mark(workspace, mark_->vertex);
        shown_->hovered = hovered;
        mark_->center = center;
      }
      return;
    }
    dragging_ = renumbers_ = false;
    shown_.reset();
    if (recording_.active()) return recording_.finish(workspace);
    if (!workspace.shown.preview) return;
    workspace.commit(drags_tension()                              ? "Tension"
                     : mark_->hovered == CornerMark::Region::ring ? "Turn corner"
                                                                  : "Open corner",
                     *workspace.shown.preview);
    if (switches_) workspace.messages.say(switched_to(MethodUse::corners));
  }

  std::optional<CornerMark> mark_, shown_;
  std::optional<Index> edge_, hover_;
  Index clicked_ = -1;
  std::vector<Index> corners_;  ///< the corners that the drag changes
  std::optional<std::pair<Complex, Complex>> marquee_;
  bool dragging_ = false, switches_ = false, with_ctrl_ = false;
  bool renumbers_ = false;  ///< the drag has switched the method, and maybe joined parts
  Picked picked_;
  Recording recording_;
  Complex start_px_, last_px_;
  double turned_ = 0;
  Deformation deformation_;
};

}  // namespace

std::unique_ptr<Tool> angle_tool() {
  return std::make_unique<AngleTool>();
}

}  // namespace holomorph
