// The commands new and bench, and the error for names that are neither commands nor files.
#include "cli/commands.h"

#include <unistd.h>

#include <iostream>
#include <optional>

#include "bench/report.h"
#include "cli/progress.h"
#include "cli/streams.h"
#include "core/error.h"
#include "core/mesh/flatten.h"
#include "scene/auto_cage.h"
#include "scene/content_parts.h"
#include "scene/flattened_surface.h"
#include "scene/formats/file_kinds.h"
#include "scene/formats/outline_import.h"
#include "scene/formats/scene_json.h"
#include "scene/formats/surface_file.h"
#include "scene/formats/svg_path.h"
#include "system/new_file.h"

namespace holomorph {
namespace {

/// Reads a cage from a path in an SVG file or from the boundary of a surface's texture coordinates.
Cage cage_of_file(const Path& path, const Image& picture) {
  const std::string text = read_file(path);
  if (!is_named_as(path, FileContent::surface))
    return cage_of_svg(text, path.string(), picture.page().top, PathUse::rest);
  try {
    return polygon_cage(texture_boundary(surface_of_obj(text, path.string()), picture.page()));
  } catch (const Error& error) {
    throw about(path, error);
  }
}

/// The input files that the command was given.
std::vector<Path> inputs_of(const NewCommand& command) {
  std::vector<Path> inputs{command.image};
  for (const auto& file : {command.cage, command.pose, command.outline})
    if (file) inputs.push_back(*file);
  return inputs;
}

}  // namespace

void check_is_file(const Path& path) {
  if (path_exists(path)) return;
  const bool command = path.string().find_first_of("./") == std::string::npos;
  throw Error(ErrorKind::bad_input,
              path.string() + (command ? ": there is neither a command nor a file with this name; "
                                         "'holomorph --help' lists the commands"
                                       : ": there is no such file"));
}

void run(const NewCommand& command) {
  check_out(command.out, command.force, inputs_of(command));
  if (!command.force && !is_standard(command.out) && is_file(command.out))
    throw Error(ErrorKind::failed,
                command.out.string() + ": the file already exists; use --force to replace it");
  if (command.margin && !(*command.margin >= 0))
    throw Error(ErrorKind::bad_input, "--margin: the distance must not be negative");
  if (!(command.detail >= 0 && command.detail <= 100))
    throw Error(ErrorKind::bad_input, "--detail: give a number from 0 to 100");
  if (!(command.hole_width >= 0 && command.hole_width <= 100))
    throw Error(ErrorKind::bad_input, "--hole-width: give a percentage from 0 to 100");
  const Progress progress("new");
  const LoadedScene loaded = scene_of_image(command.image);
  print_warning(loaded.message());
  const Image& picture = *loaded.image();
  const double height = picture.page().top;
  Deformation deformation = with_cage(
      {}, command.cage
              ? cage_of_file(*command.cage, picture)
              : auto_cage(picture, {command.vertices, command.margin, command.detail,
                                    command.hole_width, command.curved,
                                    command.parts ? PartChoice::apart : PartChoice::joined}));
  check_rest_cage(deformation.rest);
  if (!deformation.rest.parts.empty()) deformation.method = usual_method(MethodUse::puppet).id;
  if (command.pose) {
    deformation.pose = cage_of_svg(read_file(*command.pose), command.pose->string(), height,
                                   PathUse::pose, &deformation.rest);
    try {
      check_same_loops(deformation.rest, deformation.pose);
    } catch (const Error& error) {
      throw Error(error.kind(), command.pose->string() + ": " + error.what());
    }
  }
  if (command.outline) {
    const Flattening flattening = flattening_named(command.flattening);
    deformation.outline =
        outline_of_file(*command.outline, height, box_of(outline_of(deformation.rest)), flattening);
    deformation.surface = surface_of_file(*command.outline, flattening);
    deformation.method = usual_method(MethodUse::outline).id;
  }
  const auto absolute = [](const Path& path) { return absolute_path(path); };
  const std::string text = json_of(
      portable(with_deformation(loaded.scene, deformation), absolute(command.out).parent_path()));
  scene_from_json(text, command.out.string());  // throws if the scene could not be read again
  write_result(command.out, text);
  std::fprintf(stderr, "%s: a cage with %zu vertices\n", shown_output(command.out).c_str(),
               static_cast<size_t>(deformation.rest.size()));
  if (const std::string left =
          command.cage ? "" : left_out_text(parts_outside(picture, deformation.rest).size());
      !left.empty())
    std::fprintf(stderr, "%s: %s\n", shown_output(command.out).c_str(), left.c_str());
}

void run(const BenchCommand& command) {
  const auto extent = command.with_long ? bench::Extent::with_long : bench::Extent::usual;
  const std::vector<bench::Row> rows = bench::chosen_rows(command.filter, extent);
  if (rows.empty())
    throw Error(ErrorKind::bad_input, "--filter: no benchmark name contains '" + command.filter +
                                          "'; holomorph bench --list shows the names");
  if (command.list) {
    for (const bench::Row& row : rows) write_standard_output(bench::line_of(row) + "\n");
    return;
  }
  bench::Medians before;
  if (!command.against.empty())
    before = bench::medians_of(read_file(command.against), command.against.string());
  // If standard error is a terminal but the table goes elsewhere, show each line there as well.
  const bool shows_progress = ::isatty(STDERR_FILENO) && !::isatty(STDOUT_FILENO);
  std::optional<LastOutput> tail;
  const auto write = [&](const std::string& text) {
    const DeferredStop whole;  // a signal does not divide the text
    write_standard_output(text);
    if (command.json && !tail) tail.emplace(bench::kJsonTail);
    if (!is_interrupted()) return;
    if (tail) tail->write();
    throw Interrupted{};
  };
  if (command.json) write(bench::json_head(bench::this_machine()));
  bool is_first = true;
  bench::measure(command.filter, extent, [&](const bench::Result& result) {
    const std::string line = bench::line_of(result) + bench::change_since(before, result) + "\n";
    write(command.json ? bench::json_row(result, is_first) : line);
    if (shows_progress) std::cerr << line;
    is_first = false;
  });
  const DeferredStop whole;
  if (tail) tail->write();
}

}  // namespace holomorph
