// The card that asks how a new picture should bend.
#pragma once

#include <memory>
#include <mutex>

#include "app/canvas/overlay.h"
#include "scene/auto_cage.h"
#include "system/job.h"

namespace holomorph {

/// Owns the outline that is drawn while the card is shown: the cage that the picture would get.
class StartCard {
 public:
  /// `wake` is called on another thread when the outline is ready.
  explicit StartCard(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Whether the card is shown: there is a picture without a cage, and the card was not closed.
  bool shows(const Workspace& workspace) const;
  /// The width in window px that the card needs next to the picture.
  static float width();
  /// Draws the outline, and the card at the right edge of the canvas.
  void draw(Workspace& workspace, const OverlayStyle& style);
  /// Draws the choices into the current window instead.
  void draw_docked(Workspace& workspace, const OverlayStyle& style);
  /// Whether the canvas has room for the card beside the picture. A picture that would have to be
  /// much smaller fills the canvas instead, and the inspector shows the choices.
  static bool has_room(const Workspace& workspace);

 private:
  void draw_choices(Workspace& workspace, float width);
  void draw_outline(const Workspace& workspace, const OverlayStyle& style);
  void update_outline(const Workspace& workspace);

  struct Result {
    std::mutex mutex;
    std::optional<Cage> cage;
  };
  struct Question {
    std::shared_ptr<const Image> image;
    double detail = 0;
    bool curved = false;
    PartChoice parts = PartChoice::joined;
    bool operator==(const Question&) const = default;
  };
  std::function<void()> wake_;
  std::optional<Question> asked_;
  std::shared_ptr<Result> result_;
  std::optional<Cage> outline_;
  std::unique_ptr<Job> job_;
  std::shared_ptr<const Image> closed_for_;  ///< the picture for which the user closed the card
};

}  // namespace holomorph
