// The program without a window: one function per command.
#pragma once

#include <optional>

#include "cli/moments.h"
#include "scene/formats/image.h"
#include "system/file.h"

namespace holomorph {

// In all commands, the path "-" stands for standard input or output, and `force` allows replacing
// read-only files.
/// The options shared by all commands that read a scene.
struct SceneCommand {
  Path scene;
  bool outside = false;  ///< pictures may lie outside the scene's folder
};
struct MapCommand : SceneCommand {
  Path points;
  Path out = "-";
  bool force = false;
  Moments moments = {};
};
struct CoordinatesCommand : SceneCommand {
  Path points, out;
  int order = 0;
  bool force = false;
};
struct InverseCommand : SceneCommand {
  Path points;
  Path out = "-";
  bool force = false;
  Moments moments = {};
  bool all = false;
};
struct RenderCommand : SceneCommand {
  Path out;
  double scale = 1;
  std::string view = "image";
  bool crop = false;
  std::optional<Box> rectangle = {};
  bool force = false;
  Moments moments = {};
  bool missing = false;           ///< draw only frames that have no file yet
  bool print_rectangle = false;   ///< of the whole motion, instead of drawing
  std::optional<int> depth = {};  ///< bits per color; none: as is usual in the format
  std::vector<Path> inputs = {};  ///< more files that must not be replaced
};
/// Draws each of several scenes. `out` is a folder, or a name in which * stands for the name of the
/// scene. For a single scene, it can also be another name. What can be drawn is drawn, even if
/// other scenes fail. Throws Error at the end if any failed, and before if pictures would replace
/// each other.
struct RenderScenesCommand : RenderCommand {
  std::vector<Path> scenes;
};
/// A film whose frames many machines draw.
struct FarmCommand : RenderCommand {
  std::string engine;
  std::optional<Path> film = {};
  int chunk = 10;  ///< frames per task
  int rounds = 3;  ///< how often missing frames are drawn
  bool only_write = false;
};
struct InfoCommand : SceneCommand {
  bool json = false;
  Moments moments = {};
};
/// Finds the layers of files that have changed again, and writes the scene.
struct UpdateCommand : SceneCommand {
  std::vector<std::string> matches;  ///< such as "arm=left arm": a layer before and now
  bool adds = false;                 ///< add the layers that are new in the files
};
struct NewCommand {
  Path image, out;
  bool force = false;                 ///< also allows replacing an existing scene
  std::optional<int> vertices = {};   ///< none: as many as the shape needs
  std::optional<double> margin = {};  ///< in pixels; none: see AutoCageOptions::detail
  double detail = 50;
  double hole_width = 3;  ///< percent; see AutoCageOptions::hole_width
  bool parts = false;     ///< an outline for each part of the picture, for method sheet
  bool curved = false;
  std::optional<Path> cage;     ///< SVG file or surface with texture coordinates
  std::optional<Path> pose;     ///< SVG file
  std::optional<Path> outline;  ///< SVG file, picture or surface
  std::string flattening = "lscm";
};
/// Rectangles are made smaller by this much on each side, so that rounding adds no pixel.
inline constexpr double kRectangleRounding = 1e-6;

struct ExportCommand : SceneCommand {
  Path out;
  std::string format;
  std::optional<double> scale = {};
  std::optional<int> depth = {};  ///< as in RenderCommand
  bool crop = false;
  std::optional<int> overscan = {};     ///< of ST-maps, in their pixels
  bool half = false;                    ///< half floats in OpenEXR files
  std::optional<size_t> vertices = {};  ///< of the mesh of each layer
  bool full_mesh = false;               ///< all vertices
  std::optional<double> rate = {};      ///< frames of moving meshes per second
  bool keys = false;                    ///< frames of moving meshes only at keyframes
  bool sound = false;                   ///< of films that are pictures
  std::optional<Path> drawn = {};       ///< numbered pictures to make a film of
  std::optional<Box> rectangle = {};
  bool force = false;
  Moments moments = {};
};
struct BenchCommand {
  std::string filter;
  Path against;  ///< earlier results; empty: none
  bool json = false;
  bool with_long = false;
  bool list = false;  ///< print the names and goals only
};

/// The bits per color of a picture. Throws Error if the format does not have what is wanted.
int checked_depth(const PictureFormat& format, const std::optional<int>& wanted);

/// Throws Error if the file does not exist. If the path looks like a mistyped command, the message
/// refers to --help.
void check_is_file(const Path& path);

/// Each function runs a command. Throws Error if it fails, Interrupted if the user stops it.
void run(const MapCommand& command);
void run(const InverseCommand& command);
void run(const CoordinatesCommand& command);
void run(const RenderCommand& command);
void run(const RenderScenesCommand& command);
void run(const FarmCommand& command);
void run(const InfoCommand& command);
void run(const NewCommand& command);
void run(const UpdateCommand& command);
void run(const ExportCommand& command);
void run(const BenchCommand& command);

}  // namespace holomorph
