// The formats of the command export, and the command formats, which lists what files can be.
#pragma once

#include <string>
#include <vector>

namespace holomorph {

/// A format of `export` and the options that it accepts.
struct ExportFormat {
  std::string id;
  std::vector<std::string> extensions;  ///< with the dot
  std::string writes;                   ///< what is written, such as "a film"
  bool scale = false, crop = false, time = false, frames = false, st_map = false, film = false;
  bool meshes = false;      ///< --vertices sets how many vertices a layer has
  bool all_layers = false;  ///< meshes of all layers, for --rate and --keys
};
/// All formats, films last.
const std::vector<ExportFormat>& export_formats();
/// Throws Error with a list of all formats if there is none with this name.
const ExportFormat& export_format_named(const std::string& id);
/// The names of all formats, separated by commas.
std::string export_format_names();

struct FormatsCommand {
  bool markdown = false;
};
/// Prints which files can be opened and written.
void run(const FormatsCommand& command);

}  // namespace holomorph
