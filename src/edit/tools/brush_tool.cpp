// Key B. Paints where the picture is stiff or soft. Dabs are stored at the rest positions of the
// picture points under the pointer. They take effect when the button is released.
#include <algorithm>
#include <utility>

#include "edit/actions/actions.h"
#include "edit/edits/method_edits.h"
#include "edit/tools/tool.h"

namespace holomorph {
namespace {

constexpr double kSpacing = 0.35;  ///< distance between dabs, as a fraction of the radius

class BrushTool final : public Tool {
 public:
  ToolId id() const override { return ToolId::brush; }

  bool waits(const Input&, const Workspace& workspace) const override {
    return !workspace.knows_map();
  }

  void input(const Input& input, Workspace& workspace) override {
    position_ = input.inside ? std::optional(input.position) : std::nullopt;
    radius_ = workspace.tools.brush_radius;
    if (input.inside && input.pressed) {
      if (!workspace.shown.deformation().has_cage())
        return workspace.messages.say(needs_a_cage(workspace, "The brush needs a cage"));
      painting_ = true;
      last_.reset();
      dabs_ = workspace.shown.deformation().stiffness;
      erases_ = input.mods.shift;
      const double strength = workspace.tools.brush_strength;
      level_ = input.mods.ctrl ? -strength : strength;
    }
    if (!painting_) return;
    add_dab(input, workspace);
    if (input.down && !input.released) return;
    painting_ = false;
    finish(workspace);
  }

  void cancel(Workspace&) override { painting_ = false; }
  bool busy() const override { return painting_; }
  ToolOverlay overlay() const override {
    ToolOverlay overlay;
    overlay.shows_dabs = true;
    if (painting_) overlay.dabs = dabs_;
    overlay.brush = position_;
    return overlay;
  }
  std::string hint(const Workspace& workspace) const override {
    const bool acts = method_named(workspace.shown.deformation().method).uses_stiffness;
    return std::string(
               "Drag to stiffen, Ctrl-drag to soften, Shift-drag to erase; [ and ] set the size") +
           (acts ? "" : "; switches to As rigid as possible");
  }

 private:
  void add_dab(const Input& input, const Workspace& workspace) {
    const auto at = rest_at(workspace, input.position);
    if (!at || (last_ && std::abs(*at - *last_) < kSpacing * radius_)) return;
    last_ = at;
    if (erases_)
      std::erase_if(dabs_, [&](const BrushDab& dab) { return std::abs(dab.at - *at) < radius_; });
    else if (dabs_.size() < kMaxDabs)
      dabs_.push_back({*at, radius_, level_});
    else
      full_ = true;
  }

  void finish(Workspace& workspace) {
    if (std::exchange(full_, false))
      workspace.messages.say(
          "The limit of 5000 brush dabs is reached. Erase some with Shift-drag.");
    Deformation deformation = workspace.shown.deformation();
    if (deformation.stiffness == dabs_) return;
    deformation.stiffness = std::move(dabs_);
    const bool switches = !method_named(deformation.method).uses_stiffness;
    if (switches) deformation = with_method_for(std::move(deformation), MethodUse::stiffness);
    if (!workspace.commit(erases_      ? "Erase stiffness"
                          : level_ > 0 ? "Stiffen"
                                       : "Soften",
                          std::move(deformation)))
      return;
    if (switches) workspace.messages.say(switched_to(MethodUse::stiffness));
  }

  bool painting_ = false, erases_ = false, full_ = false;
  double level_ = 0.5, radius_ = 1;
  std::optional<Complex> position_, last_;
  std::vector<BrushDab> dabs_;
};

}  // namespace

std::unique_ptr<Tool> brush_tool() {
  return std::make_unique<BrushTool>();
}

}  // namespace holomorph
