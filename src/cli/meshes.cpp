// Secondary files are known only after the work, so they are checked then.
#include "cli/meshes.h"

#include <cstdio>

#include "cli/progress.h"
#include "cli/streams.h"
#include "core/error.h"
#include "exports/mesh_export.h"
#include "system/text.h"

namespace holomorph {
namespace {

MeshExport wanted_by(const ExportCommand& command, const Scene& scene) {
  MeshExport wanted{command.format, command.out,  command.vertices, command.moments.time, {},
                    command.rate,   command.keys, command.full_mesh};
  if (command.moments.frames) {
    const FrameRange range = frames_named(*command.moments.frames, scene);
    wanted.frames = std::pair(range.first, range.last);
  }
  return wanted;
}

}  // namespace

void export_meshes(const LoadedScene& loaded, const ExportCommand& command) {
  const Scene& scene = loaded.scene;
  const bool is_alone =
      command.format == "glb" || command.format == "mdd" || command.format == "pc2";
  if (is_standard(command.out) && !is_alone)
    throw Error(ErrorKind::bad_input,
                command.format + " has several files; give a file name with --out");
  const bool all_layers = export_format_named(command.format).all_layers;
  if (!all_layers) require_cage(scene, command.scene);
  check_out(command.out, command.force, command.scene, loaded);
  const MeshExport wanted = wanted_by(command, scene);
  const DeferredStop tidy;
  MovingMeshes moving;
  MeshFiles files;
  {
    Progress progress("export", "frame");
    moving =
        moving_meshes_of(scene, loaded.image(), loaded.pictures, mesh_options_of(scene, wanted),
                         [&](size_t done, size_t all) { progress.step(done, all); });
    files = mesh_files_of(moving, wanted);
  }
  for (const auto& [path, bytes] : files) check_out(path, command.force, command.scene, loaded);
  // The main file comes last, so that what it refers to is there.
  for (size_t i = files.size(); i-- > 1;) write_file(files[i].first, files[i].second);
  write_result(files[0].first, files[0].second);
  if (all_layers)
    for (const std::string& loss : mesh_losses_of(scene))
      std::fprintf(stderr, "holomorph: %s\n", printable(loss).c_str());
  size_t bytes = 0;
  for (const auto& [path, content] : files) bytes += content.size();
  std::fprintf(stderr, "%s: %s, %zu bytes%s%s\n", shown_output(files[0].first).c_str(),
               mesh_counts(moving).c_str(), bytes, mesh_error_text(moving).c_str(),
               mesh_advice(moving, wanted).c_str());
}

}  // namespace holomorph
