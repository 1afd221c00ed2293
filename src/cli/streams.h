// What commands read and write: files, pipes, and "-" for standard input and output.
#pragma once

#include <string_view>

#include "cli/commands.h"
#include "cli/progress.h"
#include "scene/document.h"

namespace holomorph {

bool is_standard(const Path& path);
/// How messages call an input or output: its path, or "standard input", "standard output".
std::string shown_name(const Path& input);
std::string shown_output(const Path& out);

/// The bytes of a file, a pipe or standard input. Throws Error.
std::string read_input(const Path& input);
/// A scene; its warning is printed. Throws Error.
LoadedScene read_scene(const OfScene& command);
/// Throws Error for a scene without a cage.
void require_cage(const Scene& scene, const Path& input);

/// A scene with a cage, and the points that a command is about.
struct SceneAndPoints {
  Scene scene;
  Points points;
};
/// `takes_nan`: rows that are nan, as `map` writes them, are points, too.
SceneAndPoints read_scene_and_points(const OfScene& command, const Path& points,
                                     bool takes_nan = false);

/// Throws Error where `out` is one of a command's own inputs or, unless forced, read-only.
void check_out(const Path& out, bool force, const std::vector<Path>& inputs);
/// The same for a command that reads a scene, whose pictures and surfaces are inputs, too.
void check_out(const Path& out, bool force, const Path& scene, const LoadedScene& loaded);

/// What a command writes piece by piece into a file, a pipe or standard output; a file is there as
/// a whole when it is finished, or not at all.
class ResultWriter {
 public:
  explicit ResultWriter(Path out) : out_(std::move(out)) {}
  /// Throw Error.
  void write(std::string_view bytes);
  void finish();

 private:
  void flush();

  Path out_;
  std::string waiting_;
  std::optional<TidyStop> tidy_;  ///< an interrupt leaves nothing behind
  std::unique_ptr<NewFile> file_;
};
void write_result(const Path& out, const std::string& bytes);

void say_warning(const LoadedScene& loaded);

/// printf of numbers, NaN without the sign that some have and no reader expects.
template <class... Numbers>
std::string csv_line(const char* format, Numbers... numbers) {
  char line[200];
  std::snprintf(line, sizeof line, format, numbers...);
  std::string out;
  for (std::string_view rest = line; !rest.empty(); rest.remove_prefix(1)) {
    if (rest.starts_with("-nan")) rest.remove_prefix(1);
    out += rest[0];
  }
  return out;
}

}  // namespace holomorph
