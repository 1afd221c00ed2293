// The inputs and outputs of commands: files, pipes, and standard input and output ("-").
#pragma once

#include <string_view>

#include "cli/commands.h"
#include "cli/progress.h"
#include "scene/document.h"
#include "system/new_file.h"

namespace holomorph {

bool is_standard(const Path& path);
/// The name of an input or output in messages: its path, "standard input" or "standard output".
std::string shown_name(const Path& input);
std::string shown_output(const Path& out);

/// The bytes of a file, a pipe or standard input. Throws Error.
std::string read_input(const Path& input);
/// Prints each line of a message about what was read.
void print_warning(const std::string& message);
/// Reads a scene and prints its warning, if any. Throws Error.
LoadedScene read_scene(const SceneCommand& command);
/// Throws Error if the scene has no cage.
void require_cage(const Scene& scene, const Path& input);

/// A scene with a cage, and the points at which a command evaluates it.
struct SceneAndPoints {
  Scene scene;
  Points points;
};
/// With `takes_nan`, accepts rows of nan as points, because `map` writes such rows.
SceneAndPoints read_scene_and_points(const SceneCommand& command, const Path& points,
                                     bool takes_nan = false);

/// Throws Error if `out` is one of the command's inputs, or if it is read-only and `force` is not
/// set.
void check_out(const Path& out, bool force, const std::vector<Path>& inputs);
/// Throws Error if `out` is the scene or one of its pictures or surfaces, or if it is read-only and
/// `force` is not set.
void check_out(const Path& out, bool force, const Path& scene, const LoadedScene& loaded);

/// Writes the result of a command piece by piece to a file, a pipe or standard output. A file
/// appears only when finish() has written all of it.
class ResultWriter {
 public:
  explicit ResultWriter(Path out) : out_(std::move(out)) {}
  /// Both functions throw Error.
  void write(std::string_view bytes);
  void finish();

 private:
  void flush();

  Path out_;
  std::string buffer_;
  std::optional<DeferredStop> tidy_;  ///< prevents an interrupt from leaving a partial file
  std::unique_ptr<NewFile> file_;
};
void write_result(const Path& out, const std::string& bytes);

/// Formats numbers like printf, but writes "-nan" as "nan", because CSV readers expect no sign.
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
