// The data that tools and actions modify and the window draws.
#pragma once

#include <functional>

#include "core/maps/deformer.h"
#include "core/maps/heat.h"
#include "edit/actions/actions.h"
#include "edit/edits/displacement.h"
#include "edit/fold_finder.h"
#include "edit/messages.h"
#include "edit/shown.h"
#include "edit/viewport.h"
#include "scene/auto_cage.h"
#include "scene/layer_maps.h"
#include "system/job.h"

namespace holomorph {

/// A request from an action to the window. Only the window can show dialogs.
enum class Request {
  none,
  new_scene,
  open,
  save,
  save_as,
  export_picture,
  export_again,
  import_cage,
  import_pose,
  import_outline,
  export_svg,
  export_surface,
  export_film,
  add_layer,
  replace_picture,
  play_numbered,
  add_new_layers,
  rename_layer,
  find_picture,
  show_withheld,
  find_layers,
  copy_picture,
  paste_picture,
  quit,
  help,
  palette,
  menu,
  next_panel,
  context_menu,
  compare
};

/// Playback of the iterations of a method that reports an energy for each. It is not part of the
/// scene.
struct Playback {
  std::optional<int> iteration = {};  ///< the displayed iteration; none means the last one
  bool playing = false;
  std::optional<double> due_ms = {};  ///< when the next iteration is due
};
/// Advances to the next iteration when it is due. Returns whether it took a step or ended the
/// playback.
bool advance(Playback& playback, const LiveMap& map, double now_ms);

enum class ToolId { select, pen, pin, stroke, outline, angle, brush, attach };

/// How the canvas displays the scene.
struct DisplayOptions {
  Viewport viewport;
  View view = View::image;
  bool automatic_range = false, show_mesh = false, show_cage = true, show_surface = true;
  bool hide_overlays = false, show_original = false;  ///< set while a key is held
  std::optional<double> split = {};  ///< left fraction of the canvas that shows the original
  double handle_px = 10;             ///< picking distance in window px, scaled with the display
};

/// The active tool and the settings of the tools.
struct ToolSettings {
  ToolId active = ToolId::select;
  DragOptions drag;
  bool snaps = false;           ///< whether drags stop where handles line up
  double brush_radius = 60;     ///< plane units
  double brush_strength = 0.5;  ///< change of the stiffness per dab, in powers of ten
  AutoCageOptions auto_cage = {};
  bool drags_layers = true;  ///< the Select tool drags layers, or else only handles
};

/// The map at the keyframe before or after the displayed time.
struct OnionSkin {
  const VectorXc& f;  ///< at the mesh's vertices
  bool later = false;
};

/// An editing session: a document, its maps, and all state that is not saved.
struct Workspace {
  explicit Workspace(MeshOptions options = {}) : maps(options) {}
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  Document document;
  LayerMaps maps;
  Shown shown{document};
  Selection selection;
  EditMode mode = EditMode::pose;
  DisplayOptions display;
  ToolSettings tools;
  Messages messages;
  ActionTable actions;
  Playback playback;
  std::optional<Pose> copied;  ///< set by Copy pose
  CopiedKeys copied_keys;      ///< set by Copy pose if keyframes are selected; otherwise empty
  Request request = Request::none;
  /// Runs a long task on another thread, then calls `then` on this thread. Set by the window.
  /// `quietly`: without a dialog; all input waits for the task, and Escape ends it.
  std::function<void(const std::string& title, bool quietly, Job::Work work,
                     std::function<void()> then)>
      run_in_background;

  /// The edited layer's map.
  LiveMap& map() { return maps.of(document.scene().layer().id); }
  const LiveMap& map() const { return maps.of(document.scene().layer().id); }
  /// Whether the displayed map is the final one of what is edited.
  bool knows_map() const { return !has_edits_ && !map().busy(); }
  /// Brings the maps up to date with `shown`. Returns whether any of them changed.
  bool update_map(EvalOptions options);
  /// The visible folds of the edited layer's map.
  const std::vector<Fold>& folds() const;
  /// A point where parts overlap without a fold, unless pins have depths that say which is on top.
  std::optional<Complex> overlap() const;
  /// Where the plane of the layer with an index lies in the scene's plane, as displayed.
  Similarity placement(size_t layer) const { return maps.placement(document.scene(), layer); }
  /// The same for its undeformed picture, if it has one; see scene/original.h.
  std::optional<Similarity> original_placement(size_t layer) const;
  /// The canvas in the plane of the edited layer, in which tools work.
  Viewport layer_view() const { return layer_view(document.scene().edited); }
  Viewport layer_view(size_t layer) const {
    return at_rest() ? display.viewport : display.viewport.of_layer(placement(layer));
  }
  /// Centers the canvas on a point of the edited layer.
  void center_on(Complex z) {
    display.viewport.center = at_rest() ? z : placement(document.scene().edited)(z);
  }
  /// Whether the canvas shows the picture at rest.
  bool at_rest() const { return mode == EditMode::rest || display.show_original; }
  /// Whether the method uses an outline that is currently drawn.
  bool shows_outline() const;
  /// Whether a view next to the canvas displays the surface whose boundary is the outline.
  bool shows_surface() const {
    return display.show_surface && document.scene().deformation().surface.has_value();
  }

  /// Adds an undo step. Rejects a scene that cannot be saved and opened again or that has an
  /// invalid rest cage; a toast then shows where the problem is. See Shown::entry_of for how an
  /// edit changes poses and keyframes. Returns whether the step was added.
  bool commit(const std::string& label, Deformation deformation, EditBase base = EditBase::shown);
  /// Replaces the result of the last undo step. Rejects the same scenes as commit.
  bool amend(Deformation deformation, EditBase base = EditBase::shown);
  /// A dragged deformation with the turns of the map that shows it. The file then decides which of
  /// several maps is found again. Pins that moved by a method without turns lose theirs.
  Deformation with_turns(Deformation deformation) const;
  /// Merges small edits into one step: amends the last step if it has the same label and the
  /// selection has not changed since, else adds a step.
  void commit_or_amend(const std::string& label, Deformation deformation,
                       EditBase base = EditBase::shown);
  /// Adds an undo step that changes layers, or settings that all layers share.
  bool commit_layers(const std::string& label, Scene scene);
  /// Replaces the result of the last undo step, which changed layers. Rejects the same scenes as
  /// commit_layers.
  bool amend_layers(Scene scene);
  /// Like commit_or_amend, for layers. Returns whether the scene was accepted.
  bool commit_or_amend_layers(const std::string& label, Scene scene);
  /// Makes the next commit_or_amend a separate step.
  void end_mergeable_step() { mergeable_selection_.reset(); }

  /// Whether the edited layer is visible and not locked. If not, a toast says so.
  bool require_open_layer();
  /// Whether the places of all attached layers are known. If not, a toast says that the layers
  /// that they follow are being prepared.
  bool require_placements();
  /// Whether the displayed pose is known. If not, a toast says that it is being prepared.
  bool require_pose();
  /// Whether the maps at keyframes are known, or cannot be. If not, a toast says that they are
  /// being prepared.
  bool require_keyframe_maps();
  /// Makes another layer the edited layer. This is not an undo step.
  void choose_layer(size_t number);
  /// Goes to another entry of the history. If the number of cage vertices, pins or strokes differs
  /// there, deselects all handles of that kind.
  void go_to(size_t entry);
  /// Displays the scene at a time. If no keyframe has the pose that was displayed before, a toast
  /// says so.
  void go_to_time(double seconds);
  /// Stores the displayed pose as the keyframe at the current time.
  void set_key();
  /// The images of rest points under the map of each keyframe; empty while these maps are unknown.
  std::vector<Points> keyframe_images(std::span<const Complex> rest);
  /// The maps at the keyframes before and after the current time. Empty if the onion skin is off,
  /// the timeline is playing, the picture is shown at rest or no map is available yet.
  std::vector<OnionSkin> onion_skins() const;
  /// Runs a long task, then calls `then`. The task runs in the background if the window has set
  /// run_in_background; otherwise it runs immediately, and its exceptions reach the caller.
  void perform(const std::string& title, bool quietly, const Job::Work& work,
               const std::function<void()>& then);
  /// Centers the canvas on a fold of the picture: first on the worst one, then on the others in
  /// turn.
  void show_next_fold();
  /// Deletes handles in one step and clears the selection. If fewer than three cage points would
  /// remain, deletes nothing and says so in a toast.
  void erase(const Selection& handles, Refit refit = Refit::curve);
  /// Deselects handles that no longer exist.
  void prune_selection();
  /// Replaces the document and resets selection, preview, mode, tool and view.
  void open(Document opened);

 private:
  using Put = std::function<void(Scene)>;
  bool enter(Scene scene, EditBase base, const Put& put);
  bool enter_dragged(Deformation deformation, EditBase base,
                     const std::function<void(Scene, const std::optional<double>&)>& put);
  Deformation keyed(Deformation deformation);
  bool continues_step(const std::string& label) const;
  bool changes_closed_layer(const Scene& scene) const;
  void leave_layer();
  void refuse_far_preview();
  void adopt_better_turns();
  /// Whether a scene may enter the history. If not, a toast says why.
  bool accepts(const Scene& scene);

  bool has_edits_ = false;                        ///< since the map was updated
  std::optional<Selection> mergeable_selection_;  ///< at the step that may be amended
  /// What a drag has just entered, until its final map is known.
  std::optional<Deformation> released_;
  mutable FoldFinder fold_finder_;
  Points visited_folds_;  ///< the folds that show_next_fold visits
  size_t fold_ = 0;
};

}  // namespace holomorph
