// Everything that tools and actions act on; the window draws it.
#pragma once

#include <functional>
#include <memory>

#include "core/maps/heat.h"
#include "edit/actions/actions.h"
#include "edit/edits/displacement.h"
#include "edit/messages.h"
#include "edit/shown.h"
#include "edit/viewport.h"
#include "scene/auto_cage.h"
#include "scene/layer_maps.h"
#include "system/job.h"

namespace holomorph {

/// What an action asks of the window, which alone can show dialogs.
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
  rename_layer,
  find_picture,
  show_withheld,
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

/// The iterations of a method that gives energies, watched one by one.
struct Playback {
  std::optional<int> iteration = {};  ///< shown; none: the last one
  bool playing = false;
  std::optional<double> due_ms = {};  ///< when the next one is
};
/// Shows the next iteration when it is due. Returns whether it did, or ended.
bool advance(Playback& playback, const LiveMap& map, double now_ms);

enum class ToolId { select, pen, pin, stroke, outline, angle, brush };

/// How the canvas shows the scene.
struct DisplayOptions {
  Viewport viewport;
  View view = View::image;
  bool automatic_range = false, show_mesh = false, show_cage = true, show_surface = true;
  bool hide_overlays = false, show_original = false;  ///< while a key is held
  std::optional<double> split = {};  ///< left of it, as a fraction of the canvas, is the original
  double handle_px = 10;             ///< picking distance in window px, scaled with the display
};

/// The active tool, and what tools are set to.
struct ToolSettings {
  ToolId active = ToolId::select;
  DragOptions drag;
  bool snaps = false;        ///< drags stop where handles line up
  double brush_radius = 60;  ///< plane units
  AutoCageOptions auto_cage = {};
};

/// The map at a key next to the time that is shown.
struct OnionSkin {
  const VectorXc& f;  ///< at the mesh's vertices
  bool later = false;
};

/// An editing session: a document, its maps, and everything that is not saved.
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
  std::optional<Pose> copied;  ///< a pose
  Request request = Request::none;
  /// Does work that may take long on another thread and `then` on this one; the window sets it.
  std::function<void(const std::string& title, Job::Work work, std::function<void()> then)>
      run_in_background;

  /// The edited layer's map.
  LiveMap& map() { return maps.of(document.scene().layer().id); }
  const LiveMap& map() const { return maps.of(document.scene().layer().id); }
  /// Brings the maps up to date with what is shown. Returns whether it changed.
  bool update_map(EvalOptions options);
  /// Whether the canvas shows the picture at rest.
  bool at_rest() const { return mode == EditMode::rest || display.show_original; }
  /// Whether there is an outline that the method uses, and it is drawn.
  bool shows_outline() const;
  /// Whether the surface whose boundary the outline is has its view next to the canvas.
  bool shows_surface() const {
    return display.show_surface && document.scene().deformation().surface.has_value();
  }

  /// One undo step; a rest cage that cannot be used is refused with a toast that shows where. What
  /// it does to poses and keyframes is Shown::entry_of's.
  bool commit(const std::string& label, Deformation deformation, EditBase base = EditBase::shown);
  /// The last step, carried further; refused in the same way.
  bool amend(Deformation deformation, EditBase base = EditBase::shown);
  /// For what is done in many small pieces: with the selection unchanged it carries the last step
  /// further, if that has the same label.
  void commit_or_amend(const std::string& label, Deformation deformation,
                       EditBase base = EditBase::shown);
  /// One undo step that changes layers, or what all of them share.
  bool commit_layers(const std::string& label, Scene scene);
  /// The same for layers.
  void commit_or_amend_layers(const std::string& label, Scene scene);
  /// The next commit_or_amend is a step of its own.
  void end_mergeable_step() { mergeable_selection_.reset(); }

  /// Whether the edited layer is visible and not locked; says it otherwise.
  bool require_open_layer();
  /// Whether the shown pose is known; says that it is being prepared otherwise.
  bool require_pose();
  /// Edits another layer.
  void choose_layer(size_t number);
  /// Another entry of the history; drops what is selected of a structure that it changes.
  void go_to(size_t entry);
  /// Goes to a time and shows it; says when that leaves a pose without a key.
  void go_to_time(double seconds);
  /// The shown pose as the key at the time.
  void set_key();
  /// Where each keyframe takes points at rest; none before their maps are known.
  std::vector<Points> in_keyframes(std::span<const Complex> rest);
  /// What the onion skin shows: the keys before and after the time, where it is on and there is a
  /// pose to compare with.
  std::vector<OnionSkin> onion_skins() const;
  /// Work that may take long, and then what is done with it: next to the window, or immediately
  /// where there is none. Throws Error then.
  void perform(const std::string& title, const Job::Work& work, const std::function<void()>& then);
  /// Goes to where the picture folds: the worst place first, then the others.
  void show_next_fold();
  /// Deletes handles as one step and clears the selection; a cage keeps three points, and says so.
  void erase(const Selection& handles, Refit refit = Refit::curve);
  /// Drops handles that an edit removed.
  void prune_selection();
  /// Replaces the document; selection, preview, mode and view start afresh.
  void open(Document opened);

 private:
  using Put = std::function<void(Scene)>;
  bool enter(Scene scene, EditBase base, const Put& put);
  Deformation keyed(Deformation deformation);
  bool continues_step(const std::string& label) const;
  bool changes_closed_layer(const Scene& scene) const;
  void leave_layer();
  /// Whether a scene may enter the history; says why not.
  bool accepts(const Scene& scene);

  std::optional<Selection> mergeable_selection_;  ///< whose step commit_or_amend may extend
  Points folds_;                                  ///< that show_next_fold goes through
  size_t fold_ = 0;
};

/// The rest point under a point of the shown picture; none outside it or before there is a map.
std::optional<Complex> rest_at(const Workspace& workspace, Complex z);
/// Where the map takes a rest point; the point itself outside the mesh or before there is a map.
Complex posed_at(const LiveMap& map, Complex rest);
/// The cage that alone gives the shown map, where the method knows one.
std::optional<Cage> solved_cage(const Workspace& workspace);
/// The box of picture and cage as shown.
Box content_box(const Workspace& workspace);

/// "pin", "stroke" or "point": what these are, in the words of the history.
std::string kind_of(const Selection& handles);

/// The nearest handle of the shown mode within picking distance.
std::optional<Handle> handle_at(const Workspace& workspace, Complex px);

/// The place on the shown mode's cage within picking distance, not at a vertex: where a click
/// can insert one.
std::optional<CageHit> edge_at(const Workspace& workspace, Complex px);
/// Inserts a vertex there as one step and selects it; false when that is refused.
bool insert_at(Workspace& workspace, const CageHit& hit);

}  // namespace holomorph
