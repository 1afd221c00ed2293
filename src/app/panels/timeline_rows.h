// The rows of the timeline: the keyframes of each layer, and of the parts of its pose.
#pragma once

#include <set>
#include <utility>

#include "app/panels/clip_bar.h"
#include "app/thumbnails.h"
#include "edit/tools/key_drag.h"

namespace holomorph {

class TimelineRows {
 public:
  /// The height of the ruler and of all rows, at most five, in px.
  float height(const Workspace& workspace) const;
  void draw(Workspace& workspace, Thumbnails& thumbnails);
  TimeRuler& ruler() { return ruler_; }
  /// Shows a new document: all of its time, and only the layers' own rows.
  void forget() { ruler_.fit(), open_.clear(); }
  /// Whether the ruler has grown during a drag, so that another frame is needed. Resets the answer.
  bool take_growth() { return std::exchange(grows_, false); }
  /// Whether the pointer is on the ruler or on the keyframes.
  bool hovered() const { return hovered_; }
  /// Whether the pointer is on the ruler.
  bool over_ruler() const { return over_ruler_; }
  /// Whether the pointer is on the bar of a film.
  bool over_film() const { return over_film_; }

 private:
  enum class Held { nothing, time, keys, clip, box };
  /// The keyframes of a layer, or of a part of its pose, such as "Pins".
  struct Row {
    size_t layer = 0;
    std::string part = {};  ///< empty for the layer itself
    std::vector<double> times = {};
  };
  std::vector<Row> rows_of(const Workspace& workspace) const;
  void draw_ruler(Workspace& workspace, float names);
  void draw_name(Workspace& workspace, const Row& row, ImVec2 at, float width,
                 Thumbnails& thumbnails);
  void draw_keys(const Workspace& workspace, const Row& row, float middle) const;
  void draw_selection_box(const Workspace& workspace);
  void draw_menu(Workspace& workspace);
  void draw_time(const Workspace& workspace, ImVec2 corner, float left) const;
  void handle_keys(Workspace& workspace);
  /// The row at this y; none above and below the rows.
  std::optional<size_t> row_at(float y) const;
  /// The y of a row's center.
  float middle_of(size_t row) const;
  /// The bar of a row; none if the row is not that of a film.
  std::optional<ClipBar> clip_bar(const Workspace& workspace, size_t row) const;
  std::optional<KeyId> key_under(const Workspace& workspace, ImVec2 pointer) const;
  /// The layer whose film's bar is under the pointer, and what a drag of it does. None if the layer
  /// is locked or hidden.
  struct ClipUnder {
    size_t layer = 0;
    ClipDrag::Kind kind = ClipDrag::Kind::move;
  };
  std::optional<ClipUnder> clip_under(const Workspace& workspace, ImVec2 pointer) const;
  void show_film_cursor(const Workspace& workspace, ImVec2 pointer, bool hovered);
  void press(Workspace& workspace, ImVec2 pointer);
  void follow(Workspace& workspace, ImVec2 pointer);
  void release(Workspace& workspace, ImVec2 pointer);
  void select_in_box(Workspace& workspace, ImVec2 to);

  TimeRuler ruler_;
  std::set<int> open_;  ///< ids of the layers whose parts are shown
  std::vector<Row> rows_;
  float top_ = 0;  ///< of the first row, in the window
  ImVec4 box_{};   ///< around the selected keyframes; empty if there is none
  Held held_ = Held::nothing;
  ImVec2 pressed_{};
  std::optional<KeyId> pressed_key_;
  bool moved_ = false, hovered_ = false, over_ruler_ = false, over_film_ = false, grows_ = false;
  KeySelection before_box_;
  KeyDrag drag_;
  ClipUnder pressed_clip_;
  ClipDrag clip_drag_;
};

}  // namespace holomorph
