// The card with the first three steps, for new users.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

class FirstSteps {
 public:
  /// Updates the step from the document. It never goes back. `exported` says whether a picture or
  /// film was exported in this session.
  void follow(const Workspace& workspace, bool exported);
  /// Whether all steps are done, so that the card should not be shown again.
  bool done() const { return step_ >= 3; }
  /// Draws the card at a free place beside the picture. Returns false if there is no such place.
  /// Sets `closed` if the user closes the card.
  bool draw(const Workspace& workspace, bool& closed) const;
  /// Draws the card at the lower end of the inspector, and returns its height in px.
  float draw_docked(const Workspace& workspace, float inspector, float bottom, bool& closed) const;

 private:
  bool draw_contents(const Workspace& workspace) const;

  size_t step_ = 0;  ///< the number of steps that are done
};

}  // namespace holomorph
