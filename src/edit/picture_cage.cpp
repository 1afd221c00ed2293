// The work has its own copies of the picture and the options, because the scene may change
// meanwhile.
#include "edit/picture_cage.h"

#include "scene/auto_cage.h"
#include "scene/content_parts.h"

namespace holomorph {

const Method& method_of_first_pin(const Workspace& workspace) {
  const Method& method = method_named(workspace.shown.own().method);
  return method.uses_pins ? method : usual_method(MethodUse::puppet);
}

void make_picture_cage(Workspace& workspace, const Method& method, bool quietly,
                       std::function<bool(Cage)> then) {
  const auto cage = std::make_shared<Cage>();
  const auto others = std::make_shared<std::vector<Box>>();
  const auto image = workspace.document.pictures().shared(workspace.document.scene().layer());
  AutoCageOptions options = workspace.tools.auto_cage;
  options.parts = method.allows_parts ? PartChoice::apart : PartChoice::joined;
  workspace.perform(
      "Making the cage", quietly,
      [=](Job::Progress&) {
        *cage = auto_cage(*image, options);
        *others = parts_outside(*image, *cage);
      },
      [=, &workspace] {
        if (then(std::move(*cage)) && !others->empty())
          workspace.messages.say(left_out_text(others->size()), others->front().center());
      });
}

}  // namespace holomorph
