// What the canvas shows of the edited layer, why it may differ from what is saved, and what an edit
// of it starts from.
#pragma once

#include <optional>

#include "edit/timeline.h"
#include "scene/document.h"
#include "scene/motion.h"

namespace holomorph {

/// Where an edit starts: from what is shown, which may be the pose at a time, or from the
/// document's own deformation, which is then entered as it is.
enum class EditBase { shown, document };

/// The shown deformation is one of three: the document's, the same at a time of its keyframes, or a
/// drag's preview.
class Shown {
 public:
  enum class Source { document, timed, preview };

  explicit Shown(const Document& document) : document_(&document) {}

  std::optional<Deformation> preview;  ///< of a drag that is not committed yet
  Timeline timeline;

  Source source() const {
    return preview ? Source::preview : timed_ && timeline.active ? Source::timed : Source::document;
  }
  const Deformation& deformation() const { return preview ? *preview : base(); }
  /// The same without a preview: what edits start from.
  const Deformation& base() const { return timed_ && timeline.active ? *timed_ : own(); }
  /// The document's own deformation.
  const Deformation& own() const { return document_->scene().deformation(); }

  /// The time whose map is shown; none where the map is of a deformation's own pose.
  std::optional<double> time() const {
    return preview || own().keyframes.empty() ? std::nullopt : time_of_layers();
  }
  /// The same for all layers: those without keyframes have their own pose at any time.
  std::optional<double> time_of_layers() const {
    return timeline.active && has_keyframes(document_->scene()) ? std::optional(timeline.time)
                                                                : std::nullopt;
  }
  Moment moment() const { return {time(), document_->scene().animation.linear_blend}; }
  Moment moment_of_layers() const {
    return {time_of_layers(), document_->scene().animation.linear_blend};
  }

  /// Whether base() is what is shown: not while the map of another time is being prepared.
  bool knows_pose() const { return !time() || timed_ || playing_keys(own()).empty(); }
  /// Whether the document's own pose is in none of its keyframes.
  bool leaves_a_pose() const;

  /// Goes to a time and shows it.
  void go_to_time(double seconds);
  /// The handles at the shown time, as the map of that time has them; none: they are not known.
  void set_timed(std::optional<Deformation> timed) { timed_ = std::move(timed); }
  /// The handles at the shown time, given a pose of the document's structure.
  void set_timed_pose(const Pose& pose) { timed_ = posed_as(own(), pose); }
  bool is_timed() const { return timed_.has_value(); }

  /// What an edit means for the poses of the document, which has one of its own and keyframes.
  struct Entry {
    bool moves = false;     ///< the edit changes the shown pose
    bool sets_key = false;  ///< and that becomes a key at the shown time (auto-key)
    Pose shown;             ///< what is shown after the edit
    Deformation deformation;
  };
  /// Where a time is shown, an edit of the pose from there is a key with auto-key, and else becomes
  /// the document's own pose and leaves the time; an edit of the structure makes what is shown the
  /// own pose; other edits leave that.
  Entry entry_of(Deformation edited, EditBase base) const;
  /// After an entry is in the document. `same_layer`: the document's edited layer is the same.
  void follow(const Entry& entry, bool same_layer);

 private:
  const Document* document_;
  std::optional<Deformation> timed_;  ///< the document's, with its handles at the shown time
};

}  // namespace holomorph
