// The dialog that asks which layer of a changed file is which.
#pragma once

#include <deque>
#include <functional>

#include "app/picture_watch.h"
#include "app/thumbnails.h"

namespace holomorph {

class LayerQuestion {
 public:
  static constexpr const char* kTitle = "Which layer is it?";
  /// Opens the dialog for the unclear layers, after those that are open. `answered` gets the
  /// choices; it is not called if the user postpones them.
  void ask(FoundLayers found, std::function<void(const LayerChoices&)> answered);
  bool open() const { return !asked_.empty(); }
  void withdraw() { asked_.clear(); }
  void draw(Thumbnails& thumbnails);

 private:
  void draw_row(size_t number, Thumbnails& thumbnails);
  bool is_taken(const std::string& entry, size_t except) const;

  struct Asked {
    FoundLayers found;
    std::vector<std::optional<std::string>> chosen;  ///< an entry, or "" for none of them
    std::function<void(const LayerChoices&)> answered;
  };
  std::deque<Asked> asked_;  ///< the first one is open
};

}  // namespace holomorph
