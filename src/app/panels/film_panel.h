// The inspector's section about the film that is the edited layer's picture.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

class FilmPanel {
 public:
  /// Whether the edited layer's picture is a film, or one of several numbered pictures.
  bool has_film(const Workspace& workspace);
  void draw(Workspace& workspace);

 private:
  size_t count_numbered(const Layer& layer);

  std::string counted_;  ///< the file whose neighbors were counted
  size_t count_ = 0;
};

}  // namespace holomorph
