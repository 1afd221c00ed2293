// The one executable: subcommands without a window, the editor otherwise.
#include <CLI/CLI.hpp>
#include <iostream>

#include "app/editor.h"
#include "cli/commands.h"
#include "core/error.h"

using namespace holomorph;

namespace {

template <class Command>
void on_run(CLI::App* app, const Command& command, bool& done) {
  app->callback([&command, &done] {
    run(command);
    done = true;
  });
}

/// The times that a command is about.
void add_moments(CLI::App* sub, Moments& moments, const std::string& frames) {
  auto* time = sub->add_option("--time", moments.time,
                               "A time of the keyframes, in seconds; behind the last one as there")
                   ->check([](const std::string& text) {
                     double value = 0;
                     return CLI::detail::lexical_cast(text, value) && value >= 0
                                ? std::string()
                                : "'" + text + "' is not a time; times are 0 or more seconds";
                   });
  sub->add_option("--frames", moments.frames, "Frames of the keyframes, A..B or all" + frames)
      ->excludes(time);
}

void add_force(CLI::App* sub, bool& force, const char* what = "Replace read-only files, too") {
  sub->add_flag("--force", force, what);
}

int run_program(int argc, char** argv) {
  CLI::App app{
      "Holomorph bends pictures by conformal maps. Without a subcommand it opens the editor."};
  app.set_version_flag("--version", HOLOMORPH_VERSION);
  EditorOptions editor;
  app.add_option("FILE", editor.file, "A scene (.json) or a picture to open");
  app.add_option("--state", editor.state_file,
                 "Write what the editor shows to this file whenever it changes (for scripts)");
  app.footer("For scenes, points and results - stands for standard input and output.");
  app.require_subcommand(0, 1);
  app.fallthrough(false);
  bool done = false;

  MapCommand map;
  auto* sub =
      app.add_subcommand("map", "Map points: rows x,y to u,v,fz_re,fz_im,fzbar_re,fzbar_im");
  sub->add_option("SCENE", map.scene)->required();
  sub->add_option("--points", map.points, "CSV file of points")->required();
  sub->add_option("--out", map.out, "CSV file to write; standard output when missing");
  add_moments(sub, map.moments, ": rows start with the frame's number");
  add_force(sub, map.force);
  on_run(sub, map, done);

  InverseCommand inverse;
  sub =
      app.add_subcommand("inverse", "Where posed points come from: rows x,y to x,y,residual,count");
  sub->add_option("SCENE", inverse.scene)->required();
  sub->add_option("--points", inverse.points, "CSV file of points")->required();
  sub->add_option("--out", inverse.out, "CSV file to write; standard output when missing");
  add_moments(sub, inverse.moments, ": rows start with the frame's number");
  add_force(sub, inverse.force);
  sub->add_flag("--all", inverse.all,
                "Every preimage where the picture lies over itself: rows point,x,y,residual,count");
  on_run(sub, inverse, done);

  CoordinatesCommand coordinates;
  sub = app.add_subcommand("coordinates", "The basis matrix at points as a NumPy file");
  sub->add_option("SCENE", coordinates.scene)->required();
  sub->add_option("--points", coordinates.points, "CSV file of points")->required();
  sub->add_option("--order", coordinates.order, "Order of the derivative")->capture_default_str();
  sub->add_option("--out", coordinates.out, "File to write")->required();
  add_force(sub, coordinates.force);
  on_run(sub, coordinates, done);

  RenderCommand render;
  sub = app.add_subcommand("render", "Draw the posed scene to a PNG, JPEG or WebP file");
  sub->add_option("SCENE", render.scene)->required();
  sub->add_option("--out", render.out, "File to write; its extension says the format")->required();
  sub->add_option("--scale", render.scale, "Output pixels per image pixel")->capture_default_str();
  sub->add_option("--view", render.view, "image, angle, area, stretch or checker")
      ->capture_default_str();
  sub->add_flag("--crop", render.crop,
                "Keep the picture's rectangle; otherwise nothing is cut off");
  add_moments(sub, render.moments, ", each to a file with its number: walk.png to walk-0007.png");
  add_force(sub, render.force);
  on_run(sub, render, done);

  InfoCommand info;
  sub = app.add_subcommand("info", "Measure the scene's map");
  sub->add_option("SCENE", info.scene)->required();
  sub->add_flag("--json", info.json, "Print JSON");
  add_moments(sub, info.moments, ": one report for each");
  on_run(sub, info, done);

  NewCommand fresh;
  sub = app.add_subcommand("new", "Make a scene with a cage from a picture's alpha");
  sub->add_option("IMAGE", fresh.image)->required();
  sub->add_option("--out", fresh.out, "Scene to write")->required();
  add_force(sub, fresh.force, "Replace a scene that is there, and read-only files");
  sub->add_option("--vertices", fresh.vertices, "Wanted number of cage vertices")
      ->capture_default_str();
  sub->add_option("--margin", fresh.margin,
                  "Distance from the content in pixels; default 2 % of the longer side");
  sub->add_flag("--curved", fresh.curved, "Cubic segments instead of straight edges");
  sub->add_option(
      "--cage", fresh.cage,
      "An SVG file whose path \"rest\", else the first, is the cage, in place of alpha; or an OBJ "
      "file: the boundary of its texture coordinates");
  sub->add_option(
         "--pose", fresh.pose,
         "An SVG file whose path \"pose\", else the first, is the posed cage; needs --cage")
      ->needs("--cage");
  sub->add_option(
      "--outline", fresh.outline,
      "What the cage's shape goes onto: an SVG file's path, another picture's alpha, or "
      "the boundary of an OBJ surface when it is flattened");
  sub->add_option("--flattening", fresh.flattening,
                  "Of an OBJ surface: lscm (free boundary) or circle")
      ->capture_default_str();
  on_run(sub, fresh, done);

  ExportCommand out;
  sub = app.add_subcommand("export", "Write the posed scene in another format");
  sub->add_option("SCENE", out.scene)->required();
  sub->add_option(
         "--format", out.format,
         "obj, svg, npy, png, stmap, unwarp or textured; of keyframes webp, gif, apng, mp4 or webm")
      ->required();
  sub->add_option("--scale", out.scale,
                  "Output pixels per image pixel, for png, stmap, unwarp and films")
      ->capture_default_str();
  sub->add_option("--out", out.out, "File to write")->required();
  sub->add_flag("--crop", out.crop, "Keep the picture's rectangle, for png and films");
  add_moments(sub, out.moments, ": those of a film");
  add_force(sub, out.force);
  on_run(sub, out, done);

  BenchCommand bench;
  sub = app.add_subcommand("bench", "Run the benchmarks and print their table");
  sub->add_option("--filter", bench.filter, "Only benchmarks whose name contains this");
  sub->add_flag("--json", bench.json, "Print JSON");
  on_run(sub, bench, done);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError& error) {
    // The first word was taken for a file to open.
    if (!editor.file.empty()) check_is_file(editor.file);
    return app.exit(error), 2;
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : 2;
  }
  if (done) return 0;
  if (!editor.file.empty()) check_is_file(editor.file);
  return run_editor(editor);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const Interrupted&) {
    std::cerr << "holomorph: interrupted\n";
    return 130;
  } catch (const Error& error) {
    std::cerr << "holomorph: " << error.what() << "\n";
    return error.kind() == ErrorKind::bad_input ? 2 : 1;
  } catch (const std::exception& error) {
    std::cerr << "holomorph: " << error.what() << "\n";
    return 1;
  }
}
