// The command render for several scenes, whose pictures are named after them.
#include <cstdio>
#include <map>

#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/streams.h"
#include "core/error.h"
#include "scene/loading.h"
#include "system/text.h"

namespace holomorph {
namespace {

/// Where the picture of a scene goes if `out` is a folder, or a name in which * stands for the name
/// of the scene. Without an extension, it is a PNG.
Path picture_path(const Path& out, const Path& scene) {
  std::error_code ignored;
  if (is_standard(out)) return out;
  const Path pattern = std::filesystem::is_directory(out, ignored) ? out / "*" : out;
  std::string name = pattern.filename().string();
  const size_t star = name.find('*');
  if (star == std::string::npos) return out;
  if (is_standard(scene))
    throw Error(ErrorKind::bad_input,
                "standard input has no name after which its picture could be named; give a file "
                "name with --out");
  if (!pattern.has_extension()) name += ".png";
  return Path(pattern).replace_filename(name.replace(star, 1, scene.stem().string()));
}

/// Throws Error if pictures would replace each other.
void check_names(const RenderScenesCommand& command) {
  std::map<Path, Path> scenes;  // by picture
  for (const Path& scene : command.scenes) {
    const auto [other, is_new] = scenes.emplace(picture_path(command.out, scene), scene);
    if (is_new) continue;
    if (other->first == command.out)
      throw Error(ErrorKind::bad_input,
                  "--out: several scenes need a folder that exists, or a name with * in place of "
                  "the name of each scene, such as 'pictures/*.png'");
    throw Error(ErrorKind::bad_input, other->second.string() + " and " + scene.string() +
                                          " would both be drawn to " + other->first.string());
  }
}

/// The files of all scenes, none of which may be replaced by the picture of another one.
std::vector<Path> inputs_of(const std::vector<Path>& scenes) {
  std::vector<Path> inputs;
  for (const Path& scene : scenes) {
    if (!is_file(scene)) continue;
    try {
      const Sources sources = sources_in(scene);
      inputs.push_back(scene);
      inputs.insert(inputs.end(), sources.images.begin(), sources.images.end());
      inputs.insert(inputs.end(), sources.surfaces.begin(), sources.surfaces.end());
    } catch (const Error&) {
      // It is reported when the scene is to be drawn.
    }
  }
  return inputs;
}

}  // namespace

void run(const RenderScenesCommand& command) {
  check_names(command);
  RenderCommand each = command;
  const bool is_alone = command.scenes.size() == 1;
  if (command.print_rectangle && !is_alone)
    throw Error(ErrorKind::bad_input, "--print-rect is for a single scene");
  if (!is_alone) each.inputs = inputs_of(command.scenes);
  size_t failures = 0;
  ErrorKind kind = ErrorKind::bad_input;
  const auto report = [&](const Path& scene, const Error& error) {
    ++failures;
    if (error.kind() != ErrorKind::bad_input) kind = error.kind();
    std::fprintf(stderr, "holomorph: %s\n", printable(about(scene, error).what()).c_str());
  };
  for (const Path& scene : command.scenes) {
    each.scene = scene;
    each.out = picture_path(command.out, scene);
    try {
      run(each);
    } catch (const Error& error) {
      if (is_alone || is_interrupted()) throw;
      report(scene, error);
    } catch (const std::exception& error) {
      if (is_alone || is_interrupted()) throw;
      report(scene, Error(ErrorKind::failed, what_of(error)));
    }
    stop_if_interrupted();
  }
  if (failures > 0)
    throw Error(kind, std::to_string(failures) + " of " + std::to_string(command.scenes.size()) +
                          " scenes were not drawn");
}

}  // namespace holomorph
