// The table of everything that a scene can be exported as, besides pictures in other formats than
// PNG.
#pragma once

#include <string>
#include <vector>

namespace holomorph {

/// A format of exports and the options that it accepts.
struct ExportFormat {
  std::string id;
  std::string label = {};               ///< its name in the export dialog; empty: not listed
  std::vector<std::string> extensions;  ///< with the dot
  std::string writes;                   ///< what is written, such as "a film"
  bool scale = false, crop = false, time = false, frames = false, st_map = false, film = false;
  bool sound = false;       ///< films can have the sound of films that are pictures
  bool meshes = false;      ///< the number of vertices can be chosen
  bool all_layers = false;  ///< meshes of all layers, at any rate of frames
  bool sequence = false;    ///< meshes have a file for each frame
  bool textures = false;    ///< meshes have a picture file for each layer
};
/// All formats, films last.
const std::vector<ExportFormat>& export_formats();
/// Throws Error with a list of all formats if there is none with this name.
const ExportFormat& export_format_named(const std::string& id);
/// The names of all formats, separated by commas.
std::string export_format_names();

}  // namespace holomorph
