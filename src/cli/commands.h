// The program without a window: one function per subcommand.
#pragma once

#include <optional>

#include "scene/file.h"

namespace holomorph {

struct MapCommand {
  Path scene, points;
  std::optional<Path> out;  ///< standard output when missing
};
struct CoordinatesCommand {
  Path scene, points, out;
  int order = 0;
};
struct InverseCommand {
  Path scene, points;
  std::optional<Path> out;  ///< standard output when missing
  bool all = false;
};
struct RenderCommand {
  Path scene, out;
  double scale = 1;
  std::string view = "image";
  bool crop = false;
  std::optional<double> time = {};  ///< seconds of the keyframes
  std::string frames = {};          ///< "A..B", "all", or nothing: one picture
};
struct InfoCommand {
  Path scene;
  bool json = false;
};
struct NewCommand {
  Path image, out;
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
};
struct BenchCommand {
  std::string filter;
  bool json = false;
};

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
