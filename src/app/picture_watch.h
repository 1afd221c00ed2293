// Reloads open pictures when another program changes their files.
#pragma once

#include <functional>
#include <map>

#include "edit/workspace.h"

namespace holomorph {

/// The layers of a file that has changed, as far as they were found again, and the pictures of
/// those that an unclear layer may be now.
struct FoundLayers {
  LayerUpdate update;
  std::vector<std::pair<ImageReference, Picture>> pictures;
  std::map<std::string, std::shared_ptr<const Image>> candidates;  ///< by entry
};

/// Reads changed pictures on another thread once their files are no longer being written. If a
/// changed file cannot be read, the old picture is kept until the file changes again. Pictures that
/// could not be read at all are also tried again when their files change. The layers of a file with
/// layers are found again; `ask` is called if some of them are not clear.
class PictureWatch {
 public:
  PictureWatch(Workspace& workspace, std::function<void(FoundLayers)> ask)
      : workspace_(workspace), ask_(std::move(ask)) {}

  /// Checks the files and puts pictures that were read into the document. Call this regularly.
  void look();
  /// Finds the layers of a file once more, with the user's choices.
  void find_layers(const std::string& file, const LayerChoices& choices);
  /// Call this when the workspace has switched to another document.
  void forget();

 private:
  using Time = std::filesystem::file_time_type;
  using Changed = std::vector<std::pair<ImageReference, Time>>;
  Changed changed();
  void start(const Changed& changed);
  void read(std::vector<ImageReference> pictures, std::vector<std::string> layered,
            const LayerChoices& choices);
  void take_over();
  std::string take_over_pictures();
  std::string take_over_layers(FoundLayers& found);

  struct Read {
    std::vector<std::pair<ImageReference, Picture>> pictures;
    std::vector<FoundLayers> layered;
    bool chosen = false;  ///< the user has said which layer is which
  };

  Workspace& workspace_;
  std::function<void(FoundLayers)> ask_;
  std::optional<std::pair<std::string, LayerChoices>> waiting_;  ///< for what is being read
  Changed changing_;  ///< changed at the last check; other programs may still be writing them
  std::map<std::string, Time> tried_;  ///< modification times of the files when last tried
  std::shared_ptr<Read> read_;
  std::unique_ptr<Job> reading_;
};

}  // namespace holomorph
