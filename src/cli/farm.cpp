// The command farm: writes a script for a queue of jobs, and submits it.
//
// The script has two parts, and its first argument says which one runs: `plan`, the usual one,
// finds the chunks with missing frames, submits itself as an array of jobs that `draw` them, and as
// another `plan` after these. When nothing is missing, `plan` makes the film. A drawn frame appears
// as a whole or not at all, so whatever ends a job, its frames are either there or missing. `plan`
// also finds the rectangle of the whole motion, because that needs the maps at all keyframes. If it
// cannot, the jobs that draw say why.
#include <cstdio>
#include <map>

#include "cli/commands.h"
#include "cli/streams.h"
#include "core/error.h"
#include "exports/export_formats.h"
#include "film/film_writer.h"
#include "raster/st_map.h"
#include "scene/formats/export.h"
#include "scene/formats/image.h"
#include "system/new_file.h"
#include "system/process.h"
#include "system/program.h"

namespace holomorph {
namespace {

/// A word for the shell.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string quoted(const Path& path) {
  return quoted(absolute_path(path).string());
}

/// The options that each frame is drawn with.
std::string drawing_options(const FarmCommand& command) {
  std::string options = " --scale " + csv_line("%.17g", command.scale);
  if (command.crop) options += " --crop";
  if (command.depth) options += " --depth " + std::to_string(*command.depth);
  if (command.outside) options += " --allow-outside";
  if (const auto& box = command.rectangle)
    options += csv_line(" --rect %.10g,%.10g,%.10g,%.10g", box->left - kRectangleRounding,
                        box->bottom - kRectangleRounding, box->width() + 2 * kRectangleRounding,
                        box->height() + 2 * kRectangleRounding);
  return options;
}

Path script_path(const FarmCommand& command) {
  Path path = absolute_path(command.out);
  return path.replace_extension(".sbatch");
}

/// The script. Words between at signs stand for the options.
constexpr char kScript[] = R"sh(#!/bin/bash
# Written by 'holomorph farm'. To draw the frames with Slurm, or what is missing of them: sbatch FILE
#SBATCH --job-name=holomorph
#SBATCH --output="@log@"
#SBATCH --open-mode=append
#SBATCH --requeue
set -euo pipefail

holomorph=@program@
scene=@scene@
frames=@frames@
script=@script@
first=@first@ last=@last@ chunk=@chunk@ rounds=@rounds@

# The chunks with frames that are missing, as a list for --array.
missing_chunks() {
  for ((i = first; i <= last; ++i)); do
    [ -e "${frames%.*}-$(printf %04d "$i").${frames##*.}" ] || echo $(((i - first) / chunk))
  done | uniq | paste -sd,
}

if [ "${1:-plan}" = draw ]; then
  from=$((first + SLURM_ARRAY_TASK_ID * chunk)) to=$((from + chunk - 1))
  exec "$holomorph" render "$scene" --out "$frames" --missing@drawing@ \
    --frames "$from..$((to < last ? to : last))" ${2:+--rect "$2"}
fi

round=${2:-1}
missing=$(missing_chunks)
if [ -z "$missing" ]; then
  @film@
  echo "holomorph: all frames from $first to $last are drawn"
elif [ "$round" -gt "$rounds" ]; then
  echo "holomorph: after $rounds rounds, frames are still missing in chunks $missing" >&2
  exit 1
else
  rect=@rect@
  drawing=$(sbatch --parsable --array="$missing" "$script" draw $rect)
  sbatch --parsable --dependency="afterany:${drawing%%;*}" "$script" plan $((round + 1))
fi
)sh";

/// The command that makes the film in the end.
std::string film_command(const FarmCommand& command) {
  if (!command.film) return ":  # no film was asked for";
  return "\"$holomorph\" export \"$scene\" --format " +
         film_format_of(*command.film).extension.substr(1) +
         (command.outside ? " --allow-outside" : "") +
         " --drawn \"$frames\" --frames \"$first..$last\" --out " + quoted(*command.film);
}

/// The command that prints the rectangle of all frames, unless the options determine it.
std::string rectangle_command(const FarmCommand& command) {
  if (command.crop || command.rectangle) return "";
  return std::string("$(\"$holomorph\" render \"$scene\" --out \"$frames\" --print-rect") +
         (command.outside ? " --allow-outside" : "") + " 2>/dev/null) || rect=";
}

std::string script_of(const FarmCommand& command, FrameRange range) {
  const Path script = script_path(command);
  const std::map<std::string, std::string> values{
      {"log", Path(script).replace_extension(".log").string()},
      {"program", quoted(program_file())},
      {"scene", quoted(command.scene)},
      {"frames", quoted(command.out)},
      {"script", quoted(script)},
      {"first", std::to_string(range.first)},
      {"last", std::to_string(range.last)},
      {"chunk", std::to_string(command.chunk)},
      {"rounds", std::to_string(command.rounds)},
      {"drawing", drawing_options(command)},
      {"rect", rectangle_command(command)},
      {"film", film_command(command)}};
  std::string text;
  const std::string_view rest = kScript;
  for (size_t from = 0; from < rest.size();) {
    const size_t start = rest.find('@', from);
    text += rest.substr(from, start - from);
    if (start == std::string_view::npos) break;
    const size_t end = rest.find('@', start + 1);
    text += values.at(std::string(rest.substr(start + 1, end - start - 1)));
    from = end + 1;
  }
  return text;
}

void check_farm(const FarmCommand& command) {
  if (command.engine != "slurm")
    throw Error(
        ErrorKind::bad_input,
        "--engine: '" + command.engine +
            "' is not known; the engine is slurm. The manual says what another queue needs");
  if (program_file().empty())
    throw Error(ErrorKind::failed, "/proc does not say where this program is; mount /proc");
  for (const Path& path : {command.scene, command.out})
    if (is_standard(path))
      throw Error(ErrorKind::bad_input, "other machines need files; name them instead of -");
  checked_depth(picture_format_of(command.out), command.depth);
  if (command.film && !export_format_named(film_format_of(*command.film).extension.substr(1)).film)
    throw Error(ErrorKind::bad_input,
                command.film->string() + ": a film of pictures needs another format, such as .mp4");
  // The log's name is in quotes in a line of the script, and Slurm replaces percent signs.
  if (script_path(command).string().find_first_of("\n%\"\\") != std::string::npos)
    throw Error(ErrorKind::bad_input,
                "--out: Slurm cannot use a name with %, a quote, a backslash or a line break");
}

}  // namespace

void run(const FarmCommand& command) {
  check_farm(command);
  const LoadedScene loaded = read_scene(command);
  require_keyframes(loaded.scene, command.scene);
  const FrameRange range = frames_named(command.moments.frames.value_or("all"), loaded.scene);
  if (const Image* picture = loaded.image()) check_map_size(command.scale, picture->page(), 0);
  const Path script = script_path(command);
  check_out(script, false, command.scene, loaded);
  if (command.film) check_out(*command.film, false, command.scene, loaded);
  write_file(script, script_of(command, range));
  if (command.only_write) {
    std::fprintf(stderr, "%s: submit it with 'sbatch %s'\n", script.c_str(), script.c_str());
    return;
  }
  if (!has_program("sbatch"))
    throw Error(ErrorKind::failed, "sbatch is not installed here; run 'sbatch " + script.string() +
                                       "' on a machine of the cluster");
  const auto submitted = run_program({"sbatch", "--parsable", script.string()});
  if (!submitted || submitted->status != 0)
    throw Error(ErrorKind::failed,
                "sbatch could not submit " + script.string() + "; run it by hand to see why");
  const std::string job = submitted->output.substr(0, submitted->output.find_first_of("\n;"));
  std::fprintf(stderr, "%s: submitted as job %s; the log is %s\n", script.c_str(), job.c_str(),
               Path(script).replace_extension(".log").c_str());
}

}  // namespace holomorph
