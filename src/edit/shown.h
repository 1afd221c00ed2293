// The edited layer as the canvas shows it, which may differ from the document. Edits start from it.
#pragma once

#include <optional>

#include "edit/timeline.h"
#include "scene/document.h"
#include "scene/motion.h"

namespace holomorph {

/// What an edit starts from: the displayed deformation, whose pose may come from keyframes, or the
/// document's own deformation. An edit of the document's own deformation is committed unchanged.
enum class EditBase { shown, document };

/// The displayed deformation. It is the document's own deformation, possibly with its handles posed
/// by the keyframes at some time, or the preview of a drag.
class Shown {
 public:
  explicit Shown(const Document& document) : document_(&document) {}

  std::optional<Deformation> preview;  ///< result of a drag that is not committed yet
  Timeline timeline;

  const Deformation& deformation() const { return preview ? *preview : base(); }
  /// The displayed deformation, ignoring any preview. Edits start from it.
  const Deformation& base() const { return timed_ && timeline.active ? *timed_ : own(); }
  /// The document's own deformation.
  const Deformation& own() const { return document_->scene().deformation(); }

  /// The time whose map is displayed; none if the map shows a deformation's own pose.
  std::optional<double> time() const {
    return preview || own().keyframes.empty() ? std::nullopt : time_of_layers();
  }
  /// The time displayed for all layers. Layers without keyframes keep their own pose at any time.
  std::optional<double> time_of_layers() const {
    return timeline.active && has_time(document_->scene()) ? std::optional(timeline.time)
                                                           : std::nullopt;
  }
  Moment moment() const { return {time(), document_->scene().animation.linear_blend}; }
  Moment moment_of_layers() const {
    return {time_of_layers(), document_->scene().animation.linear_blend};
  }

  /// Whether base() has the displayed pose. False while the map at another time is being prepared.
  bool knows_pose() const { return !time() || timed_ || playing_keys(own()).empty(); }
  /// Whether going to a time would hide a pose that has no keyframe. This is the case if keyframes
  /// play, none of them has the document's own pose, and there is a step to undo.
  bool leaves_a_pose() const;

  /// Displays the scene at a time.
  void go_to_time(double seconds);
  /// Sets the deformation with its handles posed as in the map at the displayed time. Pass none if
  /// these positions are not known yet.
  void set_timed(std::optional<Deformation> timed) { timed_ = std::move(timed); }
  /// Sets the handles at the displayed time from a pose that fits the document's structure.
  void set_timed_pose(const Pose& pose) { timed_ = posed_as(own(), pose); }
  bool is_timed() const { return timed_.has_value(); }

  /// The effect of an edit on the document's own pose and on its keyframes.
  struct Entry {
    bool moves = false;       ///< the edit changes the displayed pose
    bool sets_key = false;    ///< the pose becomes a keyframe at the current time (auto-key)
    Pose shown;               ///< the displayed pose after the edit
    Deformation deformation;  ///< the deformation to commit, before a keyframe is set
  };
  /// Classifies an edit. With EditBase::shown, there are three cases:
  /// - With auto-key, an edit of the pose becomes a keyframe. Without auto-key, it becomes the
  ///   document's own pose, and the canvas shows that pose.
  /// - An edit of the structure makes the displayed pose the document's own pose.
  /// - Any other edit keeps the document's own pose.
  Entry entry_of(Deformation edited, EditBase base) const;
  /// Updates the display after an entry has been added to the document's history. `same_layer` is
  /// whether the same layer is still being edited.
  void follow(const Entry& entry, bool same_layer);

 private:
  const Document* document_;
  std::optional<Deformation> timed_;  ///< own(), with its handles posed at the current time
};

}  // namespace holomorph
