// The only executable. Runs a command without a window, or opens the editor if there is no command.
#include <CLI/CLI.hpp>
#include <csignal>
#include <iostream>

#include "app/run_editor.h"
#include "cli/commands.h"
#include "cli/formats.h"
#include "cli/progress.h"
#include "core/error.h"
#include "exports/export_formats.h"
#include "scene/budget.h"
#include "system/memory.h"
#include "system/text.h"

using namespace holomorph;

namespace {

std::string shown_number(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", number);
  return text;
}

/// The values of all options of the command line.
struct CommandLine {
  EditorOptions editor;
  MapCommand map;
  InverseCommand inverse;
  CoordinatesCommand coordinates;
  RenderScenesCommand render;
  FarmCommand farm;
  InfoCommand info;
  NewCommand new_scene;
  UpdateCommand update;
  ExportCommand exported;
  BenchCommand bench;
  FormatsCommand formats;
  Budget budget;
  bool done = false;  ///< a command has run

  void add_to(CLI::App& app);

 private:
  void add_budget(CLI::App* sub);
  template <class Command>
  CLI::App* add(CLI::App& app, const char* name, const char* what, const Command& command);
  void add_map(CLI::App& app);
  void add_inverse(CLI::App& app);
  void add_coordinates(CLI::App& app);
  void add_render(CLI::App& app);
  void add_farm(CLI::App& app);
  void add_info(CLI::App& app);
  void add_new(CLI::App& app);
  void add_update(CLI::App& app);
  void add_export(CLI::App& app);
  void add_bench(CLI::App& app);
  void add_formats(CLI::App& app);
};

void CommandLine::add_budget(CLI::App* sub) {
  for (const BudgetOption& option : budget_options())
    sub->add_option_function<double>(
           option.name,
           [this, &option](double amount) { budget.*option.limit = amount * option.per_unit; },
           std::string(option.what) + "; " + shown_number(budget.*option.limit / option.per_unit) +
               " " + option.unit + " by default")
        ->check([](const std::string& text) {
          double value = 0;
          return CLI::detail::lexical_cast(text, value) && value > 0 && std::isfinite(value)
                     ? std::string()
                     : "'" + text + "' is not a valid limit; give a number above 0";
        })
        ->group("Limits");
}

template <class Command>
CLI::App* CommandLine::add(CLI::App& app, const char* name, const char* what,
                           const Command& command) {
  CLI::App* sub = app.add_subcommand(name, what);
  add_budget(sub);
  sub->callback([this, &command] {
    install_signal_handlers();
    set_budget(budget);
    run(command);
    stop_if_interrupted();
    done = true;
  });
  return sub;
}

/// Adds the options for the times at which a command evaluates the scene.
void add_moments(CLI::App* sub, Moments& moments, const std::string& frames) {
  auto* time = sub->add_option("--time", moments.time,
                               "Time on the timeline, in seconds; after the last keyframe, its "
                               "pose stays, and scenes without keyframes and films never change")
                   ->check([](const std::string& text) {
                     double value = 0;
                     return CLI::detail::lexical_cast(text, value) && value >= 0
                                ? std::string()
                                : "'" + text + "' is not a time; give 0 or more seconds";
                   });
  sub->add_option("--frames", moments.frames,
                  "Frames of the timeline: A, A..B, A..B:STEP or all" + frames)
      ->excludes(time);
}

/// Adds the option for the part of the plane that pictures show.
void add_rectangle(CLI::App* sub, std::optional<Box>& rectangle, CLI::Option* crop) {
  sub->add_option_function<std::string>(
         "--rect",
         [&rectangle](const std::string& text) {
           double x = 0, y = 0, width = 0, height = 0;
           int end = 0;
           if (std::sscanf(text.c_str(), "%lf,%lf,%lf,%lf%n", &x, &y, &width, &height, &end) != 4 ||
               end != static_cast<int>(text.size()) || !(width > 0 && width < 1e6) ||
               !(height > 0 && height < 1e6) || !(std::abs(x) < 1e8 && std::abs(y) < 1e8))
             throw CLI::ValidationError("--rect",
                                        "'" + text + "' is not a rectangle; give X,Y,WIDTH,HEIGHT");
           constexpr double kEdge = kRectangleRounding;
           rectangle = Box{x + kEdge, y + kEdge, x + width - kEdge, y + height - kEdge};
         },
         "Show X,Y,WIDTH,HEIGHT: lower left corner and size in the picture's pixels, widened to "
         "whole pixels")
      ->excludes(crop);
}

void add_depth(CLI::App* sub, std::optional<int>& depth) {
  sub->add_option("--depth", depth,
                  "Bits per color: 8 or 16 in PNG files, 16 or 32 in OpenEXR files");
}

void add_outside(CLI::App* sub, SceneCommand& command) {
  sub->add_flag("--allow-outside", command.outside,
                "Also read pictures that are not in the scene's folder");
}

void add_scene(CLI::App* sub, SceneCommand& command) {
  sub->add_option("SCENE", command.scene)->required();
  add_outside(sub, command);
}

void add_force(CLI::App* sub, bool& force, const char* what = "Also replace read-only files") {
  sub->add_flag("--force", force, what);
}

void CommandLine::add_map(CLI::App& app) {
  auto* sub =
      add(app, "map", "Map points: rows x,y become rows u,v,fz_re,fz_im,fzbar_re,fzbar_im", map);
  add_scene(sub, map);
  sub->add_option("--points", map.points, "CSV file of points")->required();
  sub->add_option("--out", map.out, "CSV file to write; standard output by default");
  add_moments(sub, map.moments, "; rows start with the frame number");
  add_force(sub, map.force);
}

void CommandLine::add_inverse(CLI::App& app) {
  auto* sub =
      add(app, "inverse",
          "Find where posed points come from: rows x,y become rows x,y,residual,count", inverse);
  add_scene(sub, inverse);
  sub->add_option("--points", inverse.points, "CSV file of points")->required();
  sub->add_option("--out", inverse.out, "CSV file to write; standard output by default");
  add_moments(sub, inverse.moments, "; rows start with the frame number");
  add_force(sub, inverse.force);
  sub->add_flag(
      "--all", inverse.all,
      "Write every preimage where the picture overlaps itself: rows point,x,y,residual,count");
}

void CommandLine::add_coordinates(CLI::App& app) {
  auto* sub =
      add(app, "coordinates", "Write the basis matrix at points to a NumPy file", coordinates);
  add_scene(sub, coordinates);
  sub->add_option("--points", coordinates.points, "CSV file of points")->required();
  sub->add_option("--order", coordinates.order, "Order of the derivative")->capture_default_str();
  sub->add_option("--out", coordinates.out, "File to write")->required();
  add_force(sub, coordinates.force);
}

void CommandLine::add_render(CLI::App& app) {
  auto* sub = add(app, "render", "Draw posed scenes to PNG, JPEG, WebP or OpenEXR files", render);
  sub->add_option("SCENE", render.scenes, "One scene or several")->required();
  add_outside(sub, render);
  sub->add_option(
         "--out", render.out,
         "File to write; its extension selects the format. For several scenes a folder, "
         "or a name with * for the name of each scene, such as 'pictures/*.webp'. Without an "
         "extension, pictures are PNG files")
      ->required();
  sub->add_option("--scale", render.scale, "Output pixels per image pixel")->capture_default_str();
  sub->add_option("--view", render.view, "image, angle, area, stretch or checker")
      ->capture_default_str();
  auto* crop = sub->add_flag("--crop", render.crop,
                             "Crop to the picture's rectangle; by default nothing is cut off");
  add_rectangle(sub, render.rectangle, crop);
  add_moments(sub, render.moments,
              "; each becomes a numbered file, such as walk-0007.png for walk.png. All show the "
              "rectangle of the whole motion, or --rect");
  sub->add_flag("--missing", render.missing, "Draw only frames that have no file yet");
  sub->add_flag("--print-rect", render.print_rectangle,
                "Draw nothing, but print the rectangle of the whole motion, for --rect")
      ->excludes(crop);
  add_depth(sub, render.depth);
  add_force(sub, render.force);
}

void CommandLine::add_farm(CLI::App& app) {
  auto* sub = add(app, "farm", "Draw the frames of a film on many machines", farm);
  add_scene(sub, farm);
  sub->add_option("--engine", farm.engine, "What distributes the work: slurm")->required();
  sub->add_option("--out", farm.out, "Picture to write, such as walk.png for walk-0007.png")
      ->required();
  sub->add_option("--film", farm.film, "Film to make of the frames at the end");
  sub->add_option("--frames", farm.moments.frames, "Frames of the timeline, A..B; by default all");
  sub->add_option("--scale", farm.scale, "Output pixels per image pixel")->capture_default_str();
  add_rectangle(sub, farm.rectangle,
                sub->add_flag("--crop", farm.crop,
                              "Crop to the picture's rectangle; by default nothing is cut off"));
  add_depth(sub, farm.depth);
  sub->add_option("--chunk", farm.chunk, "Frames that one task draws")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  sub->add_option("--rounds", farm.rounds, "How often frames that are missing are drawn")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  sub->add_flag("--only-write", farm.only_write,
                "Write the script next to the frames, but do not submit it");
}

void CommandLine::add_info(CLI::App& app) {
  auto* sub = add(app, "info", "Measure the scene's map", info);
  add_scene(sub, info);
  sub->add_flag("--json", info.json, "Print JSON");
  add_moments(sub, info.moments, "; one report per frame");
}

void CommandLine::add_new(CLI::App& app) {
  auto* sub = add(app, "new", "Make a scene with a cage from a picture's transparency", new_scene);
  sub->add_option("IMAGE", new_scene.image)->required();
  sub->add_option("--out", new_scene.out, "Scene to write")->required();
  add_force(sub, new_scene.force, "Replace an existing scene and read-only files");
  sub->add_option("--detail", new_scene.detail,
                  "How closely the cage follows the content, 0 to 100")
      ->capture_default_str();
  sub->add_option("--hole-width", new_scene.hole_width,
                  "Empty regions inside the content that are wider than this percentage of its "
                  "size become holes; 100 fills all of them")
      ->capture_default_str();
  sub->add_option("--vertices", new_scene.vertices,
                  "Approximate number of cage vertices; by default as many as the shape needs");
  sub->add_option(
      "--margin", new_scene.margin,
      "Distance of the cage from the content in pixels; by default chosen by --detail, and reduced "
      "to keep gaps between limbs open where possible");
  sub->add_flag("--curved", new_scene.curved, "Use cubic segments instead of straight edges");
  sub->add_flag(
      "--parts", new_scene.parts,
      "Give each part of the picture an outline of its own; if there are several, choose the "
      "method sheet");
  sub->add_option("--cage", new_scene.cage,
                  "Read the cage from a file: the path \"rest\", or else the first path, of an SVG "
                  "file, or the boundary of the texture coordinates of an OBJ file");
  sub->add_option(
         "--pose", new_scene.pose,
         "Read the posed cage from an SVG file: the path \"pose\", or else the first path; needs "
         "--cage")
      ->needs("--cage");
  sub->add_option(
      "--outline", new_scene.outline,
      "Map the cage's shape onto an outline: a path of an SVG file, the transparency of another "
      "picture, or the boundary of a flattened OBJ surface");
  sub->add_option("--flattening", new_scene.flattening,
                  "How to flatten an OBJ surface: lscm (free boundary) or circle")
      ->capture_default_str();
}

void CommandLine::add_update(CLI::App& app) {
  auto* sub = add(app, "update", "Find the layers of a changed file with layers again", update);
  add_scene(sub, update);
  sub->add_option(
         "--match", update.matches,
         "BEFORE=NOW: which layer of the file a layer of the scene is now, by their names; "
         "nothing after = if it is gone. Needed only where names and pixels do not tell")
      ->take_all();
  sub->add_flag("--add", update.adds, "Also add the layers that are new in the file");
}

void CommandLine::add_export(CLI::App& app) {
  auto* sub = add(app, "export", "Write the posed scene in another format", exported);
  add_scene(sub, exported);
  sub->add_option("--format", exported.format,
                  export_format_names() + "; 'holomorph formats' says more")
      ->required();
  sub->add_option(
      "--scale", exported.scale,
      "Output pixels per image pixel, by default 1; for png, ST-maps, unwarp, textured and films");
  add_depth(sub, exported.depth);
  sub->add_option("--overscan", exported.overscan,
                  "Pixels beyond each side of the picture; for stmap and unwarp-map")
      ->check(CLI::Range(0, 8192));
  sub->add_flag(
      "--half", exported.half,
      "Write half floats instead of single ones, for OpenEXR files; precise to half a pixel "
      "in a picture 2000 pixels wide");
  auto* vertices =
      sub->add_option("--vertices", exported.vertices,
                      "Vertices of the mesh of each layer, by default the fewest that do not "
                      "visibly differ, or all of them for mdd, pc2 and obj; for meshes")
          ->check(CLI::Range(3, 1'000'000));
  sub->add_flag("--full-mesh", exported.full_mesh,
                "All vertices of the mesh of each layer; for meshes")
      ->excludes(vertices);
  auto* rate =
      sub->add_option("--rate", exported.rate,
                      "Frames per second of moving meshes, by default the fewest frames with "
                      "which the motion does not visibly differ; players interpolate between "
                      "them; for glb, Godot and Spine")
          ->check(CLI::Range(0.1, 500.0));
  sub->add_flag("--keys", exported.keys,
                "Frames of moving meshes only at keyframes; for glb, Godot and Spine")
      ->excludes(rate);
  sub->add_option("--drawn", exported.drawn,
                  "Make a film of frames that 'render --frames' has written with this --out");
  sub->add_flag("--sound", exported.sound,
                "Keep the sound of films that are pictures of layers; for mp4 and webm");
  sub->add_option("--out", exported.out, "File to write")->required();
  add_rectangle(sub, exported.rectangle,
                sub->add_flag("--crop", exported.crop,
                              "Crop to the picture's rectangle; for pictures, layers and films"));
  add_moments(sub, exported.moments,
              "; for png, ST-maps, meshes and films, of which only png can have a STEP");
  add_force(sub, exported.force);
}

void CommandLine::add_formats(CLI::App& app) {
  auto* sub = add(app, "formats", "List which files can be opened and written", formats);
  sub->add_flag("--markdown", formats.markdown, "Print the first table as Markdown");
}

void CommandLine::add_bench(CLI::App& app) {
  auto* sub = add(app, "bench", "Run the benchmarks and print their results", bench);
  sub->add_option("--filter", bench.filter, "Run only benchmarks whose name contains this text");
  sub->add_flag("--json", bench.json, "Print JSON, with the machine, its load and the commit");
  sub->add_flag("--long", bench.with_long,
                "Also run the long benchmarks, which --filter runs as well");
  sub->add_flag("--list", bench.list, "Print the names and goals of the benchmarks");
  sub->add_option("--against", bench.against,
                  "Compare with earlier results, a file that --json has written")
      ->excludes("--json");
}

void CommandLine::add_to(CLI::App& app) {
  app.set_version_flag("--version", HOLOMORPH_VERSION);
  app.add_option("FILE", editor.file, "A scene (.json) or a picture to open");
  app.add_flag("--allow-outside", editor.allow_outside,
               "Show pictures that are not in the scene's folder without asking");
  add_budget(&app);
  app.footer("For scenes, points and results, - stands for standard input or output.");
  app.require_subcommand(0, 1);
  app.fallthrough(false);
  add_map(app);
  add_inverse(app);
  add_coordinates(app);
  add_render(app);
  add_farm(app);
  add_info(app);
  add_new(app);
  add_update(app);
  add_export(app);
  add_formats(app);
  add_bench(app);
}

/// The words on the command line that the program does not recognize.
std::vector<std::string> unknown_words(const CLI::App& app) {
  std::vector<std::string> words = app.remaining();
  for (const CLI::App* sub : app.get_subcommands())
    for (const std::string& word : sub->remaining()) words.push_back(word);
  return words;
}

/// Reports an error of CLI11, naming the word that the user wrote. Returns the exit status.
int report_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> unknown = unknown_words(app);
  constexpr std::string_view kUnread = "Could not convert: ";
  std::string what = error.what();
  if (!unknown.empty())
    what = unknown[0] + ": unknown option or argument";
  else if (what.starts_with(kUnread))
    what = what.substr(kUnread.size()) + ": the option does not accept this value";
  std::cerr << "holomorph: " << what << "\n"
            << "See 'holomorph --help' or 'holomorph COMMAND --help'.\n";
  return 2;
}

int run_program(int argc, char** argv) {
  CLI::App app{
      "Holomorph bends pictures with conformal maps. Without a command it opens the editor."};
  CommandLine line;
  line.add_to(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // help, version
      app.exit(error);
      if (!std::cout.flush()) throw Error(ErrorKind::failed, "standard output: cannot be written");
      return 0;
    }
    // A mistyped command is parsed as the name of a file to open.
    const bool extras = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
    if (extras && !line.editor.file.empty()) check_is_file(line.editor.file);
    return report_parse_error(app, error);
  }
  if (line.done) return 0;
  set_budget(line.budget);
  if (!line.editor.file.empty()) check_is_file(line.editor.file);
  return run_editor(line.editor);
}

int fail(const std::string& what, int status) {
  std::cerr << "holomorph: " << printable(what) << "\n";
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  std::signal(SIGPIPE, SIG_IGN);  // makes writing to a pipe without a reader an ordinary error
  try {
    return run_program(argc, argv);
  } catch (const Interrupted&) {
    return fail("interrupted", 130);
  } catch (const std::exception& error) {
    if (is_interrupted()) return fail("interrupted", 130);
    const auto* known = dynamic_cast<const Error*>(&error);
    return fail(what_of(error), known && known->kind() == ErrorKind::bad_input ? 2 : 1);
  }
}
