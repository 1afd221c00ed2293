// The work has its own copies of the picture and the options, because the scene may change
// meanwhile.
#include "edit/picture_cage.h"

#include "scene/content_parts.h"

namespace holomorph {
void make_picture_cage(Workspace& workspace, std::function<bool(Cage)> then) {
  const auto cage = std::make_shared<Cage>();
  const auto others = std::make_shared<std::vector<Box>>();
  const auto image = workspace.document.pictures().shared(workspace.document.scene().layer());
  workspace.perform(
      "Making the cage",
      [=, options = workspace.tools.auto_cage](Job::Progress&) {
        *cage = auto_cage(*image, options);
        *others = smaller_parts(*image);
      },
      [=, &workspace] {
        if (then(std::move(*cage)) && !others->empty())
          workspace.messages.say(left_out_text(others->size()), others->front().center());
      });
}

}  // namespace holomorph
