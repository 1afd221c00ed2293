// The command `update`: finds the layers of a layered file that has changed, and writes the scene.
#include "cli/commands.h"
#include "cli/streams.h"
#include "core/error.h"
#include "scene/formats/scene_json.h"

namespace holomorph {
namespace {

LayerChoices choices_of(const std::vector<std::string>& matches) {
  LayerChoices choices;
  for (const std::string& match : matches) {
    const size_t sign = match.find('=');
    if (sign == std::string::npos || sign == 0)
      throw Error(ErrorKind::bad_input,
                  "--match: '" + match + "' is not of the form BEFORE=NOW, with names of layers");
    choices.emplace_back(match.substr(0, sign), match.substr(sign + 1));
  }
  return choices;
}

}  // namespace

void run(const UpdateCommand& command) {
  if (is_standard(command.scene))
    throw Error(ErrorKind::bad_input, "update needs a scene file, which it writes again");
  check_not_read_only(command.scene);
  LoadOptions options;
  options.reach.everywhere = command.outside;
  options.choices = choices_of(command.matches);
  options.looks_for_layers = command.adds;
  LoadedScene loaded = load_scene(command.scene, options);
  std::string text = loaded.report.text();
  size_t added = 0;
  for (const LayerUpdate& update : loaded.updates) {
    const std::string lines = update.report.text();
    if (!lines.empty()) text += (text.empty() ? "" : "\n") + lines;
    if (!command.adds) continue;
    PictureFiles files(loaded.pictures.pixels());
    loaded.scene = with_added_layers(std::move(loaded.scene), update, files, loaded.pictures);
    added += update.added.size();
  }
  if (loaded.updates.empty() && !command.adds) {
    std::fprintf(stderr, "%s: its files with layers have not changed\n",
                 command.scene.string().c_str());
    return;
  }
  print_warning(text);
  const std::string json =
      json_of(portable(loaded.scene, absolute_path(command.scene).parent_path()));
  scene_from_json(json, command.scene.string());  // throws if the scene could not be read again
  write_result(command.scene, json);
  std::fprintf(stderr, "%s: updated%s\n", command.scene.string().c_str(),
               added == 0   ? ""
               : added == 1 ? ", with 1 new layer"
                            : (", with " + std::to_string(added) + " new layers").c_str());
}

}  // namespace holomorph
