// All edits pass one check (`accepts`), which keeps invalid cages out of the history.
#include "edit/workspace.h"

#include <algorithm>
#include <utility>

#include "core/geometry/polyline.h"
#include "scene/check_scene.h"
#include "scene/original.h"

namespace holomorph {
namespace {

std::string left_pose_text(const ActionTable& actions) {
  return "The pose that you left has no keyframe; it remains the scene's own pose. Undo with " +
         actions.key_of("edit.undo") + ", set keyframes with " + actions.key_of("time.key") +
         ", or turn on auto-key with " + actions.key_of("time.auto_key") + ".";
}

}  // namespace

bool advance(Playback& playback, const LiveMap& map, double now_ms) {
  if (!playback.playing || map.busy()) return false;
  const int last = static_cast<int>(map.map().energies.size()) - 1;
  if (last < 1) {
    playback = {};
    return true;
  }
  // Playback takes at most 2.5 seconds, and shows no iteration for longer than a third of a second.
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

bool Workspace::shows_outline() const {
  const Deformation& deformation = shown.deformation();
  return mode == EditMode::pose && display.show_cage && !display.hide_overlays &&
         !deformation.outline.empty() && method_named(deformation.method).uses_outline;
}

bool Workspace::accepts(const Scene& scene) {
  const bool has_cage = std::ranges::any_of(
      scene.layers, [](const SharedLayer& layer) { return layer->deformation.has_cage(); });
  if (!has_cage || scene == document.scene()) return true;
  try {
    check_scene(scene);
  } catch (const Error& error) {
    messages.complain("Edit refused: " + std::string(error.what()), error.where());
    return false;
  }
  return true;
}

Deformation Workspace::with_turns(Deformation deformation) const {
  const LiveMap& live = map();
  if (!live.has_map() || !live.posed() || !same_rest(*live.posed(), deformation))
    return deformation;
  const auto& turns = live.map().turns;
  if (turns.empty()) {
    // Another method has no turns. Those of the moved pins no longer belong to their places.
    const std::vector<Pin>& before = shown.base().pins;
    for (size_t i = 0; i < deformation.pins.size(); ++i)
      if (i >= before.size() || before[i].pose != deformation.pins[i].pose)
        deformation.pins[i].turn.reset();
    return deformation;
  }
  if (turns.size() != deformation.pins.size()) return deformation;
  for (size_t i = 0; i < turns.size(); ++i)
    if (turns[i]) deformation.pins[i].turn = stored_turn(*turns[i]);
  return deformation;
}

/// Once a drag that was released has its final map, stores the turns that were found with it.
void Workspace::adopt_better_turns() {
  const LiveMap& live = map();
  if (!released_ || live.busy() || live.shows_draft() || live.posed() != released_) return;
  const Deformation before = *std::exchange(released_, std::nullopt);
  const auto& turns = live.map().better_turns;
  if (turns.empty()) return;
  Deformation after = before;
  for (size_t i = 0; i < turns.size(); ++i) after.pins[i].turn = turns[i];
  document.revise(document.scene().layer().id, before, after);
}

/// Enters a deformation. If it was dragged, its pins get the turns that the drag has led to. `put`
/// also gets the displayed time.
bool Workspace::enter_dragged(Deformation deformation, EditBase base,
                              const std::function<void(Scene, const std::optional<double>&)>& put) {
  const bool dragged = shown.preview == deformation;
  if (dragged) deformation = with_turns(std::move(deformation));
  shown.preview.reset();
  const bool entered = enter(with_deformation(document.scene(), deformation), base,
                             [&, at = shown.time()](Scene scene) { put(std::move(scene), at); });
  if (entered && dragged && shown.own() == deformation) released_ = std::move(deformation);
  return entered;
}

bool Workspace::commit(const std::string& label, Deformation deformation, EditBase base) {
  mergeable_selection_.reset();
  const auto parts = [this] { return shown.own().rest.part_count(); };
  const std::string method = shown.own().method;
  const Index before = parts();
  const bool done = enter_dragged(std::move(deformation), base, [&](Scene scene, const auto& at) {
    document.commit(label, std::move(scene), at);
  });
  if (done && parts() < before && shown.own().method != method)
    messages.say("The parts now share one outline, because " +
                 method_named(shown.own().method).label + " needs it. Undo separates them again.");
  return done;
}

bool Workspace::amend(Deformation deformation, EditBase base) {
  return enter_dragged(std::move(deformation), base,
                       [&](Scene scene, const auto&) { document.amend(std::move(scene)); });
}

bool Workspace::commit_layers(const std::string& label, Scene scene) {
  const bool leaves = scene.layer().id != document.scene().layer().id;
  if (leaves) leave_layer();
  mergeable_selection_.reset();
  shown.preview.reset();
  const std::optional<double> at = shown.time();
  if (!enter(std::move(scene), EditBase::document,
             [&](Scene entered) { document.commit(label, std::move(entered), at); }))
    return false;
  if (leaves && !shown.own().has_cage() && tools.active != ToolId::pen)
    tools.active = ToolId::select;
  return true;
}

bool Workspace::require_open_layer() {
  const Layer& layer = document.scene().layer();
  if (layer.locked || !layer.visible)
    messages.say(layer.locked
                     ? "The layer is locked. Unlock it with " + actions.key_of("layer.lock") + "."
                     : "The layer is hidden. Show it with " + actions.key_of("layer.visible") +
                           ".");
  return !layer.locked && layer.visible;
}

std::optional<Similarity> Workspace::original_placement(size_t layer) const {
  const Scene& scene = document.scene();
  const Pictures& pictures = document.pictures();
  size_t lowest = 0;
  while (lowest < layer && !pictures.of(*scene.layers[lowest])) ++lowest;
  return holomorph::original_placement(scene, layer, lowest, [&](size_t i) {
    const Layer& it = *scene.layers[i];
    const LiveMap& map = maps.of(it.id);
    const auto picture = pictures.shared(it);
    if (!picture || !map.has_map()) return std::optional(Similarity{});
    return placing_motion(it.deformation, picture->box(), *map.drawn(), as_span(map.map().f));
  });
}

bool Workspace::require_placements() {
  const Scene& scene = document.scene();
  for (size_t i = 0; i < scene.layers.size(); ++i)
    if (!maps.knows_placement(scene, i)) {
      messages.say("A layer that others follow is being prepared. Try again in a moment.");
      return false;
    }
  return true;
}

bool Workspace::require_keyframe_maps() {
  if (shown.own().keyframes.empty() || !map().has_map() || map().error() || map().follow_keys())
    return true;
  messages.say("The keyframes are being prepared. Try again in a moment.");
  return false;
}

/// Whether a scene changes the contents of the edited layer although that layer is locked or
/// hidden, and remains so.
bool Workspace::changes_closed_layer(const Scene& scene) const {
  const Layer& before = document.scene().layer();
  if (!before.locked && before.visible) return false;
  const size_t number = layer_index(scene, before.id);
  if (number == scene.layers.size()) return false;
  const Layer& after = *scene.layers[number];
  if (after.locked != before.locked || after.visible != before.visible) return false;
  // Locating a missing picture does not count as a change.
  const bool is_missing = before.image && !document.image(),
             other_image = !is_missing && after.image != before.image;
  return other_image || after.deformation != before.deformation;
}

bool Workspace::enter(Scene scene, EditBase base, const Put& put) {
  has_edits_ = true;
  shown.preview.reset();
  playback = {};
  if (changes_closed_layer(scene)) return require_open_layer();
  // A layer stays where it is displayed when what it follows is deleted.
  const auto placed = [&](int id) { return placement(layer_index(document.scene(), id)); };
  Shown::Entry entry = shown.entry_of(scene.deformation(), base);
  if (entry.sets_key && !require_pose()) return false;
  if (entry.sets_key) entry.deformation = keyed(std::move(entry.deformation));
  if (entry.deformation != scene.deformation())
    scene = with_deformation(std::move(scene), entry.deformation);
  Scene kept = without_lost_parents(scene, placed);
  if (kept != scene && !require_placements()) return false;
  scene = std::move(kept);
  if (!accepts(scene)) return false;
  if (entry.sets_key)
    shown.timeline.visible = shown.timeline.active = true;
  else if (entry.moves) {
    // A layer without keyframes is posed while the others keep the displayed time.
    shown.timeline.playing = false;
    if (!shown.own().keyframes.empty()) shown.timeline.active = false;
  }
  const int layer = document.scene().layer().id;
  put(std::move(scene));
  shown.follow(entry, layer == document.scene().layer().id);
  prune_selection();
  return true;
}

/// Resets the state that belongs only to the edited layer.
void Workspace::leave_layer() {
  shown.preview.reset();
  shown.set_timed({});
  mergeable_selection_.reset();
  selection.clear();
  playback = {};
  mode = EditMode::pose;
}

void Workspace::choose_layer(size_t number) {
  if (number == document.scene().edited) return;
  leave_layer();
  has_edits_ = true;
  document.select_layer(number);
}

/// Stores the deformation's pose as the keyframe at the current time, then sets the deformation's
/// pose to the document's own.
Deformation Workspace::keyed(Deformation deformation) {
  const Deformation& before = shown.own();
  const double time = shown.timeline.time;
  if (const size_t there = key_at(before, time);
      there < before.keyframes.size() && !fits(before, before.keyframes[there].pose))
    messages.say("A keyframe that did not fit the scene was replaced. Undo to restore it.");
  deformation = with_key(std::move(deformation), time);
  if (map().posed() && map().posed()->keyframes == before.keyframes && map().follow_keys())
    preserve_turns(deformation, before, map().motion());
  const Pose own = whole_pose_of(before);
  return fits(deformation, own) ? posed_as(std::move(deformation), own) : deformation;
}

bool Workspace::require_pose() {
  if (!shown.knows_pose())
    messages.say("The picture at this time is being prepared. Try again in a moment.");
  return shown.knows_pose();
}

void Workspace::go_to_time(double seconds) {
  shown.preview.reset();
  const Timeline& timeline = shown.timeline;
  if (!timeline.active && seconds != timeline.time && shown.leaves_a_pose())
    messages.say(left_pose_text(actions));
  shown.go_to_time(seconds);
}

void Workspace::set_key() {
  if (!require_pose()) return;
  char label[32];
  std::snprintf(label, sizeof label, "Keyframe at %.2f s", shown.timeline.time);
  const Deformation deformation = shown.deformation();
  if (!commit(label, keyed(deformation), EditBase::document)) return;
  shown.timeline.visible = shown.timeline.active = true;
  shown.set_timed_pose(whole_pose_of(deformation));
}

std::vector<Points> Workspace::keyframe_images(std::span<const Complex> rest) {
  const Deformation& deformation = shown.own();
  if (deformation.keyframes.empty() || !map().has_map() || map().posed() != deformation ||
      !map().follow_keys())
    return {};
  std::vector<Points> images;
  for (const Keyframe& key : deformation.keyframes)
    images.push_back(map().images_at(key.time, rest));
  return images;
}

std::vector<OnionSkin> Workspace::onion_skins() const {
  const Timeline& timeline = shown.timeline;
  if (!timeline.onion || timeline.playing || at_rest() || !map().has_map()) return {};
  std::vector<OnionSkin> skins;
  for (const bool later : {false, true})
    if (const VectorXc* f = map().motion().neighboring_key(timeline.time, later);
        f && f->size() == map().map().f.size())
      skins.push_back({*f, later});
  return skins;
}

/// Drops a preview that no scene may have, and says why.
void Workspace::refuse_far_preview() {
  if (!shown.preview) return;
  try {
    check_coordinates(*shown.preview);
  } catch (const Error& error) {
    shown.preview.reset();
    messages.complain("Edit refused: " + std::string(error.what()), error.where());
  }
}

bool Workspace::update_map(EvalOptions options) {
  has_edits_ = false;
  refuse_far_preview();
  const Deformation& own = shown.own();
  const std::optional<double> time = shown.time();
  if (released_ && (shown.preview || own != *released_)) released_.reset();
  options.released = released_.has_value();
  const bool others = maps.update_others(document.scene(), shown.moment_of_layers());
  const bool changed =
      map().update(shown.preview ? *shown.preview : own, options, shown.moment()) || others;
  if (shown.preview) shown.timeline.playing = false;
  if (shown.preview) return changed;  // a preview already has the handles at the displayed time
  if (!own.keyframes.empty()) map().follow_keys();  // edits and the onion skin need their maps
  // While another method is being prepared, the handles keep their positions at this time.
  if (!time || (shown.is_timed() && !fits(own, whole_pose_of(shown.base())))) shown.set_timed({});
  if (time && map().posed() == own) shown.set_timed(map().timed());
  prune_selection();  // the degrees of posed segments may vary with time
  adopt_better_turns();
  return changed;
}

bool Workspace::continues_step(const std::string& label) const {
  const History& history = document.history();
  return mergeable_selection_ == selection && history.can_undo() &&
         history.entries()[history.index()].label == label;
}

void Workspace::commit_or_amend(const std::string& label, Deformation deformation, EditBase base) {
  if (continues_step(label) && mode == EditMode::pose)
    amend(std::move(deformation), base);
  else if (commit(label, std::move(deformation), base))
    mergeable_selection_ = selection;
}

bool Workspace::amend_layers(Scene scene) {
  return enter(std::move(scene), EditBase::document,
               [&](Scene entered) { document.amend(std::move(entered)); });
}

bool Workspace::commit_or_amend_layers(const std::string& label, Scene scene) {
  if (continues_step(label)) return amend_layers(std::move(scene));
  if (!commit_layers(label, std::move(scene))) return false;
  mergeable_selection_ = selection;
  return true;
}

void Workspace::go_to(size_t entry) {
  if (entry == document.history().index()) return;
  has_edits_ = true;
  shown.preview.reset();
  const Scene before = document.scene();
  const size_t from = document.history().index();
  mergeable_selection_.reset();
  playback = {};
  document.go_to(entry);
  shown.set_timed({});
  Timeline& timeline = shown.timeline;
  timeline.playing = false;
  // Display the time at which the last undone or redone step was made.
  const std::optional<double> at =
      document.history().entries()[entry < from ? entry + 1 : entry].at;
  const Deformation &was = before.deformation(), &is = shown.own();
  const bool other_layer = before.layer().id != document.scene().layer().id,
             poses = !other_layer && whole_pose_of(was) != whole_pose_of(is);
  if (at) timeline.time = *at;
  if (at || poses) timeline.active = at && (entry < from || !poses);
  // If the number of handles of a kind differs, the same index may refer to another handle.
  const bool other_cage = was.rest.size() != is.rest.size(),
             other_pins = was.pins.size() != is.pins.size(),
             other_strokes = was.strokes.size() != is.strokes.size();
  std::erase_if(selection, [&](const Handle& handle) {
    return other_layer                           ? true
           : handle.kind == Handle::Kind::pin    ? other_pins
           : handle.kind == Handle::Kind::stroke ? other_strokes
                                                 : other_cage;
  });
  prune_selection();
}

const std::vector<Fold>& Workspace::folds() const {
  return fold_finder_.folds(map(), document.pictures().still(document.scene().layer()));
}

std::optional<Complex> Workspace::overlap() const {
  const bool has_depths =
      std::ranges::any_of(shown.deformation().pins, [](const Pin& pin) { return pin.depth != 0; });
  return has_depths || !map().has_map() ? std::nullopt : map().injectivity().crossing;
}

void Workspace::show_next_fold() {
  if (folds().empty()) {
    const std::optional<Complex> overlaps = overlap();
    if (!overlaps) return messages.say("Nothing folds.");
    center_on(*overlaps);
    return messages.say("No folds, but two parts overlap here.", overlaps);
  }
  Points all;
  for (const Fold& each : folds()) all.push_back(each.at);
  fold_ = visited_folds_ == all ? (fold_ + 1) % all.size() : 0;
  visited_folds_ = std::move(all);
  mode = EditMode::pose;
  const Complex at = visited_folds_[fold_];
  center_on(at);
  const std::string number =
      visited_folds_.size() == 1
          ? ""
          : " (" + std::to_string(fold_ + 1) + " of " + std::to_string(visited_folds_.size()) + ")";
  messages.complain("The picture folds over itself here" + number + ".", at);
}

void Workspace::perform(const std::string& title, bool quietly, const Job::Work& work,
                        const std::function<void()>& then) {
  if (run_in_background) return run_in_background(title, quietly, work, then);
  Job::Progress progress;
  work(progress);
  then();
}

void Workspace::erase(const Selection& handles, Refit refit) {
  if (!require_open_layer()) return;
  const std::string what = "Delete " + kind_of(handles);
  try {
    Deformation after = erased(shown.deformation(), handles, refit);
    selection.clear();
    commit(handles.size() == 1 ? what : what + "s", std::move(after));
  } catch (const Error& error) {
    messages.complain(error);
  }
}

void Workspace::prune_selection() {
  std::erase_if(selection,
                [&](const Handle& handle) { return !exists(shown.deformation(), handle, mode); });
  shown.timeline.keys = editable_keys(document.scene(), shown.timeline.keys);
}

void Workspace::open(Document opened) {
  document = std::move(opened);
  has_edits_ = true;
  maps.clear();
  selection.clear();
  copied_keys = {};
  mergeable_selection_.reset();
  playback = {};
  shown = Shown(document);
  shown.timeline.visible = shown.timeline.active = has_time(document.scene());
  mode = EditMode::pose;
  display.split.reset();
  display.view = View::image;
  tools.active = shown.own().has_cage() ? ToolId::select
                 : document.image()     ? ToolId::pin
                                        : ToolId::pen;
  // Missing pictures need no message, because the window offers to find them as long as they are
  // missing.
  if (document.layers_without_picture().empty()) messages.complain(document.warning());
}

}  // namespace holomorph
