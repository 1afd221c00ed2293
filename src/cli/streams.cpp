// Standard input can be read only once, so only one input can come from there.
#include "cli/streams.h"

#include <iostream>
#include <sstream>

#include "core/error.h"
#include "scene/formats/export.h"
#include "scene/formats/file_kinds.h"
#include "system/new_file.h"
#include "system/text.h"

namespace holomorph {

bool is_standard(const Path& path) {
  return path == "-";
}

std::string shown_name(const Path& input) {
  return is_standard(input) ? "standard input" : input.string();
}

std::string shown_output(const Path& out) {
  return is_standard(out) ? "standard output" : out.string();
}

std::string read_input(const Path& input) {
  return is_standard(input) ? read_standard_input() : read_stream(input);
}

void print_warning(const std::string& message) {
  std::istringstream lines(message);
  for (std::string line; std::getline(lines, line);)
    std::cerr << "holomorph: " << printable(line) << "\n";
}

LoadedScene read_scene(const SceneCommand& command) {
  const Path& input = command.scene;
  const LoadOptions options{false, {command.outside}};
  const bool regular = is_file(input);
  if (regular && !is_named_as(input, FileContent::scene) && !read_file(input).starts_with("{"))
    throw Error(ErrorKind::bad_input, input.string() +
                                          ": this is not a scene; make one from a picture with "
                                          "'holomorph new PICTURE --out SCENE'");
  const bool streamed = !regular && path_exists(input);
  LoadedScene loaded = is_standard(input) || streamed
                           ? scene_of_text(read_input(input), shown_name(input), options)
                           : load_scene(input, options);
  print_warning(loaded.message());
  return loaded;
}

void require_cage(const Scene& scene, const Path& input) {
  if (!scene.deformation().has_cage())
    throw Error(ErrorKind::bad_input, shown_name(input) +
                                          ": /cage/rest: the scene has no cage yet; draw one in "
                                          "the editor or make one with 'holomorph new'");
}

SceneAndPoints read_scene_and_points(const SceneCommand& command, const Path& points,
                                     bool takes_nan) {
  if (is_standard(points) && is_standard(command.scene))
    throw Error(ErrorKind::bad_input,
                "standard input can be the scene or the points, not both; name a file for one of "
                "them");
  SceneAndPoints read{read_scene(command).scene, {}};
  require_cage(read.scene, command.scene);
  read.points = points_of_csv(read_input(points), shown_name(points), takes_nan);
  return read;
}

void check_out(const Path& out, bool force, const std::vector<Path>& inputs) {
  if (is_standard(out)) return;
  std::error_code ignored;
  for (const Path& input : inputs)
    if (is_file(out) && std::filesystem::equivalent(out, input, ignored))
      throw Error(
          ErrorKind::bad_input,
          out.string() + ": this file is also an input of the command; choose another name");
  if (!force && is_read_only(out))
    throw Error(ErrorKind::failed,
                out.string() + ": the file is read-only; use --force to replace it");
}

void check_out(const Path& out, bool force, const Path& scene, const LoadedScene& loaded) {
  if (is_standard(out)) return;
  if (path_exists(out)) check_not_a_source(out, sources_of(loaded.scene, scene));
  check_out(out, force, {});
}

void ResultWriter::flush() {
  if (is_standard(out_)) {
    write_standard_output(buffer_);
  } else {
    if (!file_) {
      if (!is_stream(out_)) tidy_.emplace();
      file_ = std::make_unique<NewFile>(out_);
    }
    file_->write(buffer_);
  }
  buffer_.clear();
}

void ResultWriter::write(std::string_view bytes) {
  constexpr size_t kMaxBuffered = 16 << 20;  // bytes
  buffer_ += bytes;
  if (buffer_.size() > kMaxBuffered) flush();
}

void ResultWriter::finish() {
  flush();
  if (file_) file_->put_in_place();
  file_.reset();
  tidy_.reset();
}

void write_result(const Path& out, const std::string& bytes) {
  ResultWriter result(out);
  result.write(bytes);
  result.finish();
}

}  // namespace holomorph
