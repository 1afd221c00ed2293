// Imports into the open document: pictures (as new layers or replacements), cages and outlines.
#pragma once

#include "app/dialogs/file_chooser.h"
#include "app/dialogs/jobs.h"

namespace holomorph {

class Imports {
 public:
  /// `reach` returns which files scenes may read. `chosen` is called with each file that the user
  /// has chosen and that could be read. `remember` is called with each file that was added as a
  /// layer. `first` is called after the first layer was added to an empty document.
  Imports(Workspace& workspace, Jobs& jobs, FileChooser& chooser, std::function<Reach()> reach,
          std::function<void(const Path&)> remember, std::function<void(const Path&)> chosen,
          std::function<void()> first)
      : workspace_(workspace),
        jobs_(jobs),
        chooser_(chooser),
        reach_(std::move(reach)),
        remember_(std::move(remember)),
        chosen_(std::move(chosen)),
        first_(std::move(first)) {}

  /// Handles an action's request if it is an import.
  void answer(Request request);

  /// These functions return an error message, or "".
  std::string add_layer(const Path& path);
  std::string replace_picture(const Path& path);
  std::string svg(const Path& path, bool pose);
  std::string outline(const Path& path);

 private:
  double open_pixels() const;
  std::string replace_picture(ImageReference reference, const std::string& label);
  std::string play_numbered();
  std::string add_new_layers();
  void show_timeline_of_films();
  bool add_layers_of(const LoadedScene& added, const std::string& label);
  Scene in_the_middle(Scene scene, const Image& picture) const;
  void paste_picture();
  void ask_find_picture();
  std::string find_picture(const Path& path, const std::string& asked);
  void ask_svg(bool pose);
  void take_cage(Cage cage, bool pose);

  Workspace& workspace_;
  Jobs& jobs_;
  FileChooser& chooser_;
  std::function<Reach()> reach_;
  std::function<void(const Path&)> remember_, chosen_;
  std::function<void()> first_;
};

}  // namespace holomorph
