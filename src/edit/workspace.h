// Everything that tools and actions act on; the window draws it.
#pragma once

#include <functional>
#include <memory>

#include "core/maps/heat.h"
#include "core/mesh/mesher.h"
#include "edit/edits/displacement.h"
#include "edit/timeline.h"
#include "edit/viewport.h"
#include "scene/document.h"
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

/// A short message over the canvas; `where` can be shown.
struct Toast {
  std::string text;
  bool problem = false;
  std::optional<Complex> where;
};

/// The map at a key beside the time that is shown.
struct OnionSkin {
  const VectorXc& f;  ///< at the mesh's vertices
  bool later = false;
};

/// What an edit started from: what is shown, which may be a time's, or the document's own scene,
/// which then is taken as it is.
enum class From { shown, document };

/// The editor's state beyond the document.
struct Workspace {
  explicit Workspace(MeshOptions options = {}) : maps(options) {}

  Document document;
  LayerMaps maps;
  std::optional<Scene> preview;  ///< what a drag shows before it is committed
  Selection selection;
  Viewport viewport;
  Posture posture = Posture::pose;
  ToolId tool = ToolId::select;
  View view = View::image;
  bool automatic_range = false, show_mesh = false, show_cage = true, show_surface = true;
  bool hide_overlays = false, show_original = false;  ///< while a key is held
  Influence influence;                                ///< of drags
  Points folds_walked;                                ///< through these goes show_next_fold
  size_t fold_shown = 0;
  std::optional<double> split = {};  ///< left of it, in parts of the canvas, is the original
  bool snaps = false;                ///< drags stop where things line up
  double handle_px = 10;             ///< picking distance in window px, scaled with the display
  Playback playback;
  Timeline timeline;
  std::optional<Scene> timed;  ///< the document's scene with its handles as at the shown time
  std::optional<Pose> copied;  ///< a pose
  double brush_radius = 60;    ///< plane units
  int auto_cage_vertices = 30;
  double auto_cage_margin = -1;
  bool auto_cage_curved = false;
  std::optional<Selection> carried_on;  ///< whose step commit_or_amend may carry further
  Request request = Request::none;
  /// Does work that may take long on another thread and `then` on this one; the window sets it.
  std::function<void(const std::string& title, Job::Work work, std::function<void()> then)> beside;
  std::vector<Toast> toasts;  ///< taken over by the window

  /// The edited layer's map.
  LiveMap& map() { return maps.of(document.scene().layer.id); }
  const LiveMap& map() const { return maps.of(document.scene().layer.id); }
  /// The scene to show: the preview of a drag, the document's posed as at the shown time, or the
  /// document's.
  const Scene& scene() const { return preview ? *preview : unedited(); }
  /// The same without a preview: what edits start from.
  const Scene& unedited() const { return timed && timeline.shows ? *timed : document.scene(); }
  /// The time whose picture is wanted, where it is not the scene's own pose.
  std::optional<double> shown_time() const {
    return preview || !timeline.shows || document.scene().keyframes.empty()
               ? std::nullopt
               : std::optional(timeline.time);
  }
  /// The same for all layers: those without keyframes have their own pose at any time.
  std::optional<double> time_of_layers() const {
    return timeline.shows && has_keyframes(document.scene()) ? std::optional(timeline.time)
                                                             : std::nullopt;
  }
  /// Brings the maps up to date with what is shown. Returns whether it changed.
  bool update_map(Wanted wanted);
  /// Where each keyframe takes places at rest; none before their maps are known.
  std::vector<Points> in_keyframes(std::span<const Complex> rest);
  /// Whether unedited() is what is shown: not while the map of another time is on its way.
  bool knows_pose() const;
  /// The same; says that it is on its way otherwise.
  bool require_pose();
  /// What the onion skin shows: the keys before and after the time, where it is on and there is a
  /// pose to compare with.
  std::vector<OnionSkin> onion_skins() const;
  /// Goes to a time and shows it.
  void go_to_time(double seconds);
  /// The shown pose as the key at the time.
  void set_key();
  /// Whether the canvas shows the picture at rest.
  bool at_rest() const { return posture == Posture::rest || show_original; }

  /// Whether there is an outline that the method uses, and it is drawn.
  bool shows_outline() const {
    return posture == Posture::pose && show_cage && !hide_overlays && !scene().outline.empty() &&
           method_named(scene().method).uses_outline;
  }

  /// Whether the surface whose boundary the outline is has its view beside the canvas.
  bool shows_surface() const { return show_surface && scene().surface.has_value(); }

  /// One undo step; a rest cage that cannot be used is refused with a toast that shows where.
  /// Where a time is shown, an edit of the pose from there is a key with auto-key, and else becomes
  /// the scene's own pose and leaves the time; an edit of the structure makes what is shown the own
  /// pose; other edits leave that.
  bool commit(const std::string& label, Scene scene, From from = From::shown);
  /// The last step, carried further; refused in the same way.
  bool amend(Scene scene, From from = From::shown);
  /// Whether the edited layer is shown and not locked; says it otherwise.
  bool require_open_layer();
  /// One undo step that changes layers, or what all of them share; nothing else may change.
  bool commit_layers(const std::string& label, Scene scene);
  /// Edits another layer.
  void choose_layer(size_t number);
  /// Another entry of the history; drops what is selected of a structure that it changes.
  void go_to(size_t entry);
  /// The same for what is done in many small pieces: with the selection unchanged it carries the
  /// last step further, if that has the same label.
  void commit_or_amend(const std::string& label, Scene scene, From from = From::shown);
  /// Work that may take long, and then what is done with it: beside the window, or at once where
  /// there is none. Throws Error then.
  void perform(const std::string& title, const Job::Work& work, const std::function<void()>& then);
  /// Goes to where the picture folds: the worst place first, then the others.
  void show_next_fold();
  /// Deletes handles as one step and clears the selection; a cage keeps three points, and says so.
  void erase(const Selection& handles, Refit refit = Refit::curve);
  /// Drops handles that an edit took away.
  void prune_selection();
  void say(const std::string& text);
  void complain(const Error& error);
  /// The same for a problem in words; "" is none.
  void complain(const std::string& problem);

  /// The rest place under a place of the shown picture; none outside it or before there is a map.
  std::optional<Complex> rest_at(Complex z) const;
  /// Where the map takes a rest place; the place itself outside the mesh or before there is a map.
  Complex posed_at(Complex rest) const;
  /// The cage that alone gives the shown map, where the method knows one.
  std::optional<Cage> solved_cage() const;
  /// The box of picture and cage as shown.
  Box content_box() const;
  /// Replaces the document; selection, preview, posture and view start afresh.
  void open(Document opened);

 private:
  bool enter(Scene scene, From from, const std::function<void(Scene)>& put);
  Scene keyed(Scene scene);
  bool leaves_a_pose() const;
  bool changes_closed_layer(const Scene& scene) const;
  void leave_layer();
  /// Whether a scene may enter the history; says why not.
  bool accepts(const Scene& scene);
};

/// "pin", "stroke" or "point": what these are, in the words of the history.
std::string kind_of(const Selection& handles);

/// The nearest handle of the shown posture within picking distance.
std::optional<Handle> handle_at(const Workspace& workspace, Complex px);

/// The place on the shown posture's cage within picking distance, not at a vertex: where a click
/// can insert one.
std::optional<CageHit> edge_at(const Workspace& workspace, Complex px);
/// Inserts a vertex there as one step and selects it; false when that is refused.
bool insert_at(Workspace& workspace, const CageHit& hit);

}  // namespace holomorph
