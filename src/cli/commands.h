// The program without a window: one function per subcommand.
#pragma once

#include <optional>

#include "scene/file.h"

namespace holomorph {

/// Paths that are "-" stand for standard input and output.
struct Moments {
  std::optional<double> time = {};  ///< seconds of the keyframes
  std::string frames = {};          ///< "A..B", "all", or nothing: one moment
};
struct MapCommand {
  Path scene, points;
  Path out = "-";
  bool force = false;  ///< read-only files are replaced, too
  Moments moments = {};
};
struct CoordinatesCommand {
  Path scene, points, out;
  int order = 0;
  bool force = false;
};
struct InverseCommand {
  Path scene, points;
  Path out = "-";
  bool force = false;
  Moments moments = {};
  bool all = false;
};
struct RenderCommand {
  Path scene, out;
  double scale = 1;
  std::string view = "image";
  bool crop = false, force = false;
  Moments moments = {};
};
struct InfoCommand {
  Path scene;
  bool json = false;
  Moments moments = {};
};
struct NewCommand {
  Path image, out;
  bool force = false;  ///< scenes that are there, and read-only files, are replaced
  int vertices = 30;
  double margin = -1;
  bool curved = false;
  std::optional<Path> cage;     ///< SVG file, or surface with texture coordinates
  std::optional<Path> pose;     ///< SVG file
  std::optional<Path> outline;  ///< SVG file, picture or surface
  std::string flattening = "lscm";
};
struct ExportCommand {
  Path scene, out;
  std::string format;
  double scale = 1;
  bool crop = false, force = false;
  Moments moments = {};
};
struct BenchCommand {
  std::string filter;
  bool json = false;
};

/// What Ctrl-C and a polite kill end commands with that leave nothing half done.
struct Interrupted {};

/// Throws Error when there is no such file, with the names of commands when it was meant for one.
void check_is_file(const Path& path);

/// Each does its work and throws Error when it cannot.
void run(const MapCommand& command);
void run(const InverseCommand& command);
void run(const CoordinatesCommand& command);
void run(const RenderCommand& command);
void run(const InfoCommand& command);
void run(const NewCommand& command);
void run(const ExportCommand& command);
void run(const BenchCommand& command);

}  // namespace holomorph
