// Commits go through one gate, so that no unusable cage ever enters the history.
#include "edit/workspace.h"

#include <algorithm>

#include "core/geometry/polyline.h"
#include "edit/actions/actions.h"
#include "scene/formats/scene_json.h"

namespace holomorph {
namespace {

std::string left_text() {
  return "The pose has no key: it stays the scene's own, and " + key_of("edit.undo") +
         " leads back. " + key_of("time.key") + " sets a key, and with " + key_of("time.auto_key") +
         " every edit does.";
}

}  // namespace

bool advance(Playback& playback, const LiveMap& map, double now_ms) {
  if (!playback.playing || map.busy()) return false;
  const int last = static_cast<int>(map.map().energies.size()) - 1;
  if (last < 1) {
    playback = {};
    return true;
  }
  // Two seconds and a half in all, but no iteration longer than a third of a second.
  constexpr double kAll = 2500, kLongest = 330;
  if (!playback.due_ms) playback.due_ms = now_ms + std::min(kLongest, kAll / last);
  if (now_ms < *playback.due_ms) return false;
  const int next = playback.iteration.value_or(-1) + 1;
  playback.due_ms.reset();
  if (next >= last)
    playback = {};
  else
    playback.iteration = next;
  return true;
}

bool Workspace::accepts(const Scene& scene) {
  if (!scene.has_cage() || scene == document.scene()) return true;
  try {
    if (scene.rest != document.scene().rest) check_rest_cage(scene.rest);
    scene_from_json(json_of(scene), "the scene");  // what could not be opened again is not done
  } catch (const Error& error) {
    complain(Error(error.kind(), "Not done: " + std::string(error.what()), error.where()));
    return false;
  }
  return true;
}

bool Workspace::commit(const std::string& label, Scene scene, From from) {
  carried_on.reset();
  preview.reset();
  const std::optional<double> at = shown_time();
  return enter(std::move(scene), from,
               [&](Scene entered) { document.commit(label, std::move(entered), at); });
}

bool Workspace::amend(Scene scene, From from) {
  return enter(std::move(scene), from, [&](Scene entered) { document.amend(std::move(entered)); });
}

bool Workspace::require_open_layer() {
  const LayerState& layer = document.scene().layer;
  if (layer.locked || !layer.visible) {
    say(layer.locked ? "The layer is locked: " + key_of("layer.lock") + " unlocks it."
                     : "The layer is hidden: " + key_of("layer.visible") + " shows it.");
  }
  return !layer.locked && layer.visible;
}

/// Whether a scene has other contents in a layer that cannot be edited before and after.
bool Workspace::changes_closed_layer(const Scene& scene) const {
  const Scene& before = document.scene();
  if ((!before.layer.locked && before.layer.visible) || scene.layer != before.layer) return false;
  Scene with_others = scene;
  with_others.below = before.below;
  with_others.above = before.above;
  with_others.background = before.background;
  with_others.animation = before.animation;
  if (before.image && !document.image()) with_others.image = before.image;  // found again
  return with_others != before;
}

bool Workspace::enter(Scene scene, From from, const std::function<void(Scene)>& put) {
  preview.reset();
  playback = {};
  if (changes_closed_layer(scene)) return require_open_layer();
  const Pose own = whole_pose_of(document.scene()), before = whole_pose_of(unedited());
  const Pose shown = from == From::shown ? whole_pose_of(scene) : before;
  const bool moves = from == From::shown && fits(scene, before) && shown != before,
             sets_key = moves && timeline.auto_key;
  if (sets_key && !require_pose()) return false;
  if (sets_key)
    scene = keyed(std::move(scene));
  else if (from == From::shown && !moves && fits(scene, own))
    scene = posed_as(std::move(scene), own);
  if (!accepts(scene)) return false;
  if (sets_key)
    timeline.visible = timeline.shows = true;
  else if (moves)
    timeline.shows = timeline.playing = false;
  const int layer = document.scene().layer.id;
  put(std::move(scene));
  timed.reset();
  if (layer == document.scene().layer.id && shown_time() && fits(document.scene(), shown))
    timed = posed_as(document.scene(), shown);
  prune_selection();
  return true;
}

/// What belongs to the edited layer alone, when it is another one.
void Workspace::leave_layer() {
  preview.reset();
  timed.reset();
  carried_on.reset();
  selection.clear();
  playback = {};
  posture = Posture::pose;
}

bool Workspace::commit_layers(const std::string& label, Scene scene) {
  if (scene.layer.id != document.scene().layer.id) leave_layer();
  if (!commit(label, std::move(scene), From::document)) return false;
  if (!document.scene().has_cage() && tool != ToolId::pen) tool = ToolId::select;
  return true;
}

void Workspace::choose_layer(size_t number) {
  static const std::string kLabel = "Edit another layer";
  if (number == edited_layer(document.scene())) return;
  Scene chosen = with_layer_chosen(document.scene(), number);
  leave_layer();
  const History& history = document.history();
  // Looking through the layers is one step, not many.
  const bool goes_on = history.can_undo() && history.entries()[history.index()].label == kLabel &&
                       !history.can_redo();
  if (goes_on) document.undo();
  commit_layers(kLabel, std::move(chosen));
}

/// With the scene's pose as the key at the time, and the document's own pose.
Scene Workspace::keyed(Scene scene) {
  const Scene& before = document.scene();
  if (const size_t there = key_at(before, timeline.time);
      there < before.keyframes.size() && !fits(before, before.keyframes[there].pose))
    say("A key that did not play was there; undo brings it back.");
  scene = with_key(std::move(scene), timeline.time);
  if (map().posed() && map().posed()->keyframes == before.keyframes) {
    map().follow_keys();
    keep_turns(scene, before, map().motion());
  }
  const Pose own = whole_pose_of(before);
  return fits(scene, own) ? posed_as(std::move(scene), own) : scene;
}

bool Workspace::require_pose() {
  if (!knows_pose()) say("One moment, the picture at this time is being prepared.");
  return knows_pose();
}

bool Workspace::knows_pose() const {
  return !shown_time() || timed || playing_keys(document.scene()).empty();
}

void Workspace::go_to_time(double seconds) {
  preview.reset();
  if (!timeline.shows && seconds != timeline.time && leaves_a_pose()) say(left_text());
  if (seconds != timeline.time) timed.reset();
  timeline.go_to(seconds);
}

/// Whether the scene's own pose is in none of its keyframes.
bool Workspace::leaves_a_pose() const {
  const Scene& scene = document.scene();
  return document.history().can_undo() && !playing_keys(scene).empty() &&
         std::ranges::find(scene.keyframes, whole_pose_of(scene), &Keyframe::pose) ==
             scene.keyframes.end();
}

void Workspace::set_key() {
  if (!require_pose()) return;
  char label[32];
  std::snprintf(label, sizeof label, "Key at %.2f s", timeline.time);
  const Scene shown = scene();
  if (!commit(label, keyed(shown), From::document)) return;
  timeline.visible = timeline.shows = true;
  timed = posed_as(document.scene(), whole_pose_of(shown));
}

std::vector<Points> Workspace::in_keyframes(std::span<const Complex> rest) {
  const Scene& scene = document.scene();
  if (scene.keyframes.empty() || !map().has_map() || map().posed() != scene) return {};
  std::vector<Points> places;
  for (const Keyframe& key : scene.keyframes) places.push_back(map().places_at(key.time, rest));
  return places;
}

std::vector<OnionSkin> Workspace::onion_skins() const {
  if (!timeline.onion || timeline.playing || at_rest() || !map().has_map()) return {};
  std::vector<OnionSkin> skins;
  for (const bool later : {false, true})
    if (const VectorXc* f = map().motion().key_beside(timeline.time, later);
        f && f->size() == map().map().f.size())
      skins.push_back({*f, later});
  return skins;
}

bool Workspace::update_map(Wanted wanted) {
  const std::optional<double> time = shown_time();
  const bool others = maps.update_others(document.scene(), time_of_layers());
  const bool changed = map().update(preview ? *preview : document.scene(), wanted, time) || others;
  if (preview) timeline.playing = false;
  if (timeline.onion && map().has_map()) map().follow_keys();
  if (preview) return changed;  // an edit of what was shown
  // While another method is being prepared, handles stay where they were at the time.
  if (!time || (timed && !fits(document.scene(), whole_pose_of(*timed)))) timed.reset();
  if (time && map().posed() == document.scene()) timed = map().timed();
  prune_selection();  // degrees of posed segments vary with time
  return changed;
}

void Workspace::commit_or_amend(const std::string& label, Scene scene, From from) {
  const History& history = document.history();
  if (carried_on == selection && posture == Posture::pose && history.can_undo() &&
      history.entries()[history.index()].label == label)
    amend(std::move(scene), from);
  else if (commit(label, std::move(scene), from))
    carried_on = selection;
}

void Workspace::go_to(size_t entry) {
  if (entry == document.history().index()) return;
  preview.reset();
  const Scene before = document.scene();
  const size_t from = document.history().index();
  carried_on.reset();
  playback = {};
  document.go_to(entry);
  timed.reset();
  timeline.playing = false;
  // What was undone or done again last is to be seen, at its time.
  const std::optional<double> at =
      document.history().entries()[entry < from ? entry + 1 : entry].at;
  const bool other_layer = before.layer.id != document.scene().layer.id,
             poses = !other_layer && whole_pose_of(before) != whole_pose_of(document.scene());
  if (at) timeline.time = *at;
  if (at || poses) timeline.shows = at && (entry < from || !poses);
  // Numbers mean other points in another structure.
  const bool other_cage = before.rest.size() != scene().rest.size(),
             other_pins = before.pins.size() != scene().pins.size(),
             other_strokes = before.strokes.size() != scene().strokes.size();
  std::erase_if(selection, [&](const Handle& handle) {
    return other_layer                           ? true
           : handle.kind == Handle::Kind::pin    ? other_pins
           : handle.kind == Handle::Kind::stroke ? other_strokes
                                                 : other_cage;
  });
  prune_selection();
}

void Workspace::show_next_fold() {
  const Injectivity& found = map().injectivity();
  if (found.folds_at.empty()) {
    if (found.crossing) viewport.center = *found.crossing;
    return found.crossing ? toasts.push_back({"Nothing folds; two parts lie over each other here.",
                                              false, found.crossing})
                          : say("Nothing folds.");
  }
  fold_shown = folds_walked == found.folds_at ? (fold_shown + 1) % folds_walked.size() : 0;
  folds_walked = found.folds_at;
  posture = Posture::pose;
  viewport.center = folds_walked[fold_shown];
  const std::string number = folds_walked.size() == 1
                                 ? ""
                                 : " (" + std::to_string(fold_shown + 1) + " of " +
                                       std::to_string(folds_walked.size()) + ")";
  toasts.push_back({"The picture folds over itself here" + number + ".", true, viewport.center});
}

void Workspace::perform(const std::string& title, const Job::Work& work,
                        const std::function<void()>& then) {
  if (beside) return beside(title, work, then);
  Job::Progress progress;
  work(progress);
  then();
}

void Workspace::erase(const Selection& handles, Refit refit) {
  if (!require_open_layer()) return;
  const std::string what = "Delete " + kind_of(handles);
  try {
    Scene after = erased(scene(), handles, refit);
    selection.clear();
    commit(handles.size() == 1 ? what : what + "s", std::move(after));
  } catch (const Error& error) {
    complain(error);
  }
}

void Workspace::say(const std::string& text) {
  toasts.push_back({printable(text), false, {}});
}

void Workspace::complain(const Error& error) {
  toasts.push_back({printable(error.what()), true, error.where()});
}

void Workspace::complain(const std::string& problem) {
  if (!problem.empty()) toasts.push_back({printable(problem), true, {}});
}

void Workspace::prune_selection() {
  std::erase_if(selection, [&](const Handle& handle) { return !exists(scene(), handle, posture); });
}

std::optional<Complex> Workspace::rest_at(Complex z) const {
  if (!map().has_map()) return {};
  const Mesh& mesh = *map().drawn();
  const std::span<const Complex> positions =
      at_rest() ? std::span<const Complex>(mesh.vertices)
                : std::span<const Complex>(map().map().f.data(),
                                           static_cast<size_t>(map().map().f.size()));
  const auto found = locate(mesh, positions, z);
  if (!found) return {};
  return found->in(mesh, mesh.vertices);
}

Complex Workspace::posed_at(Complex rest) const {
  if (!map().has_map()) return rest;
  const Mesh& mesh = *map().drawn();
  const VectorXc& f = map().map().f;
  const auto found = locate(mesh, mesh.vertices, rest);
  return found ? found->in(mesh, {f.data(), static_cast<size_t>(f.size())}) : rest;
}

std::optional<Cage> Workspace::solved_cage() const {
  if (!map().has_map() || !map().posed()) return {};
  const std::optional<Scene>& shown = map().timed() ? map().timed() : map().posed();
  if (map().timed() && key_at(*shown, timeline.time) == shown->keyframes.size())
    return {};  // on the way between keys there is none
  return map().prepared()->deformer->solved_cage(pose_of(*shown));
}

namespace {

/// The rectangle of a layer's picture where parts of it stay in it; none when the cage takes all of
/// its corners along.
Box what_stays(const Scene& layer, const Image* image) {
  if (!image) return {};
  constexpr double kOnEdge = 1e-6;  // px
  const Points outline = outline_of(layer.rest);
  const double width = image->width, height = image->height;
  Box box;
  bool stays = false;
  for (const Complex& corner : Points{{0, 0}, {width, 0}, {width, height}, {0, height}}) {
    box.include(corner);
    stays = stays || outline.empty() ||
            (winding_number(outline, corner) == 0 &&
             nearest_on_polygon(outline, corner).distance > kOnEdge);
  }
  return stays ? box : Box{};
}

}  // namespace

Box Workspace::content_box() const {
  Box box;
  const auto include = [&](const Box& part) {
    if (part.empty()) return;
    box.include({part.left, part.bottom});
    box.include({part.right, part.top});
  };
  include(what_stays(at_rest() ? Scene{} : document.scene(), document.image()));
  for (size_t i = 0; i < layer_count(document.scene()); ++i) {
    const Scene& layer = layer_at(document.scene(), i);
    if (i == edited_layer(document.scene()) || !layer.layer.visible) continue;
    include(what_stays(layer, document.pictures().of(layer)));
    for (const Complex& z : maps.of(layer.layer.id).map().f)
      if (is_finite(z)) box.include(z);
  }
  for (const Complex& z : outline_of(cage_of(scene(), posture))) box.include(z);
  if (!at_rest())
    for (const Complex& z : scene().outline) box.include(z);
  if (method_named(scene().method).uses_strokes)
    for (size_t i = 0; i < scene().strokes.size(); ++i)
      for (const Complex& z : curve_of(scene(), static_cast<Index>(i), posture)) box.include(z);
  if (!at_rest() && map().has_map())
    for (const Complex& z : map().map().f)
      if (is_finite(z)) box.include(z);
  return box;
}

void Workspace::open(Document opened) {
  document = std::move(opened);
  maps.clear();
  preview.reset();
  selection.clear();
  carried_on.reset();
  playback = {};
  timeline = {};
  timed.reset();
  timeline.visible = timeline.shows = has_keyframes(document.scene());
  posture = Posture::pose;
  split.reset();
  view = View::image;
  tool = document.scene().has_cage() ? ToolId::select : ToolId::pen;
  // A picture that is missing is offered to be found for as long as it is.
  if (document.without_picture().empty()) complain(document.warning());
}

std::optional<CageHit> edge_at(const Workspace& workspace, Complex px) {
  constexpr double kAtVertex = 1e-3;
  const CageHit hit = nearest_on_cage(cage_of(workspace.scene(), workspace.posture),
                                      workspace.viewport.plane_at_px(px));
  if (hit.distance * workspace.viewport.zoom > workspace.handle_px || hit.t < kAtVertex ||
      hit.t > 1 - kAtVertex)
    return {};
  return hit;
}

bool insert_at(Workspace& workspace, const CageHit& hit) {
  if (!workspace.commit("Insert point", inserted(workspace.scene(), hit.segment, hit.t)))
    return false;
  workspace.selection = {{Handle::Kind::cage, hit.segment + 1, 0}};
  return true;
}

std::string kind_of(const Selection& handles) {
  const auto all = [&](Handle::Kind kind) {
    return std::ranges::all_of(handles, [&](const Handle& h) { return h.kind == kind; });
  };
  return all(Handle::Kind::pin) ? "pin" : all(Handle::Kind::stroke) ? "stroke" : "point";
}

std::optional<Handle> handle_at(const Workspace& workspace, Complex px) {
  std::optional<Handle> best;
  if (!workspace.show_cage || workspace.hide_overlays) return best;
  double distance = workspace.handle_px;
  const Scene& scene = workspace.scene();
  for (const Handle& handle : handles_of(scene, workspace.posture)) {
    if (handle.kind == Handle::Kind::stroke) continue;
    const double here = std::abs(
        workspace.viewport.px_at_plane(position_of(scene, handle, workspace.posture)) - px);
    // A pin on a cage point's spot is picked first: it lies on top.
    if (here < distance || (here == distance && handle.kind == Handle::Kind::pin)) {
      best = handle;
      distance = here;
    }
  }
  if (best) return best;
  // Points lie on top of strokes.
  for (const Handle& handle : handles_of(scene, workspace.posture)) {
    if (handle.kind != Handle::Kind::stroke) continue;
    const double here =
        workspace.viewport.zoom *
        Polyline(without_repeats(curve_of(scene, handle.index, workspace.posture)), false)
            .nearest(workspace.viewport.plane_at_px(px))
            .distance;
    if (here >= distance) continue;
    best = handle;
    distance = here;
  }
  return best;
}

}  // namespace holomorph
