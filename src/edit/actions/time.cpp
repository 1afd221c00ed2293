// The Time menu: playback, keyframes and poses.
#include <utility>

#include "edit/actions/groups.h"
#include "edit/actions/icons.h"
#include "scene/mirror.h"

namespace holomorph {
namespace {

bool has_keys(const Workspace& w) {
  return has_keyframes(w.document.scene());
}
bool has_frames(const Workspace& w) {
  return has_time(w.document.scene());
}
bool has_copied(const Workspace& w) {
  return w.copied && fits(w.shown.deformation(), *w.copied);
}
std::optional<size_t> key_here(const Workspace& w) {
  const size_t key = key_at(w.shown.own(), w.shown.timeline.time);
  return key < w.shown.own().keyframes.size() ? std::optional(key) : std::nullopt;
}
/// The selected keyframes, or else the one at the current time.
KeySelection chosen_keys(const Workspace& w) {
  const Scene& scene = w.document.scene();
  const KeySelection keys = editable_keys(scene, w.shown.timeline.keys);
  if (!keys.empty()) return keys;
  const std::optional<size_t> here = key_here(w);
  return here ? KeySelection{{scene.layer().id, w.shown.own().keyframes[*here].time}}
              : KeySelection{};
}
bool has_chosen_keys(const Workspace& w) {
  return !chosen_keys(w).empty();
}
std::string for_keys(const std::string& what, const KeySelection& keys) {
  return what + (keys.size() == 1 ? " keyframe" : " keyframes");
}

/// Deletes keyframes. A layer that loses its last one stays as it is displayed.
void delete_keys(Workspace& w, const KeySelection& keys) {
  const Scene& before = w.document.scene();
  Scene after = without_keys(before, keys);
  const bool timed = w.shown.time_of_layers().has_value();
  for (size_t i = 0; i < after.layers.size(); ++i) {
    const Deformation& own = before.layers[i]->deformation;
    if (!timed || own.keyframes.empty() || !after.layers[i]->deformation.keyframes.empty() ||
        playing_keys(own).empty())
      continue;
    const bool edited = i == before.edited;
    const LiveMap& map = std::as_const(w.maps).of(before.layers[i]->id);
    if (map.error()) continue;  // its keyframes have no maps, so it is not displayed at a time
    if (edited ? !w.shown.knows_pose() : map.busy() || !map.timed())
      return w.messages.say("The picture at this time is being prepared. Try again in a moment.");
    Layer layer = *after.layers[i];
    layer.deformation = posed_as(std::move(layer.deformation),
                                 whole_pose_of(edited ? w.shown.base() : *map.timed()));
    after = with_layer_at(std::move(after), i, std::move(layer));
  }
  w.commit_layers(for_keys("Delete", keys), std::move(after));
}

/// Adds copied keyframes at the current time, or after them if it is among them.
void add_copies(Workspace& w, const CopiedKeys& copies) {
  const KeySelection keys = copies.keys();
  const auto [first, last] = span_of(keys);
  const Scene& scene = w.document.scene();
  const double frame = 1 / scene.animation.frames_per_second, time = w.shown.timeline.time;
  for (const double to : {time, std::max(last, time) + frame}) {
    const auto copied = with_keys_pasted(scene, copies, {1, first, to});
    if (!copied) continue;
    if (w.commit_layers(for_keys("Copy", keys), copied->scene))
      w.shown.timeline.keys = copied->keys;
    return;
  }
  w.messages.say("There are other keyframes where the copies would be.");
}

/// Stops at the frame that is `by` frames after the nearest one.
template <int by = 0>
void stop_at_frame(Workspace& w) {
  w.shown.timeline.playing = false;
  const Scene& scene = w.document.scene();
  w.go_to_time(time_of_frame(scene, frame_at(scene, w.shown.timeline.time) + by));
}
void copy(Workspace& w) {
  w.copied_keys = copied_keys(w.document.scene(), w.shown.timeline.keys);
  if (const size_t count = w.copied_keys.keys().size(); count > 0) {
    return w.messages.say(count == 1 ? "Keyframe copied."
                                     : std::to_string(count) + " keyframes copied.");
  }
  if (!w.require_pose()) return;
  w.copied = whole_pose_of(w.shown.deformation());
  w.messages.say("Pose copied.");
}
bool can_paste(const Workspace& w) {
  return w.copied_keys.empty() ? has_copied(w)
                               : !fitting(w.document.scene(), w.copied_keys).empty();
}
void paste(Workspace& w) {
  const CopiedKeys keys = fitting(w.document.scene(), w.copied_keys);
  if (keys.empty()) {
    w.commit("Paste pose", posed_as(w.shown.deformation(), *w.copied));
    return;
  }
  add_copies(w, keys);
  if (const size_t left = w.copied_keys.layers.size() - keys.layers.size(); left > 0)
    w.messages.say(
        "The copied keyframes of " + std::to_string(left) +
        (left == 1
             ? " layer were left out: they do not fit it, or it is locked or hidden."
             : " layers were left out: they do not fit, or the layers are locked or hidden."));
}

template <bool forwards>
void step_key(Workspace& w) {
  w.shown.timeline.playing = false;
  if (const auto time = next_key(w.shown.own(), w.shown.timeline.time, forwards))
    w.go_to_time(*time);
}

}  // namespace

std::vector<Action> time_actions() {
  return {
      {
          .id = "time.play",
          .label = "Play",
          .icon = icon_named("play"),
          .keys = {Key::space},
          .needs = "Needs two keyframes, or a film",
          .enabled = plays,
          .run =
              [](Workspace& w) {
                w.shown.preview.reset();
                if (std::exchange(w.shown.timeline.playing, !w.shown.timeline.playing))
                  return stop_at_frame(w);
                w.shown.timeline.clock_ms.reset();
                if (w.shown.timeline.time >= length_of(w.document.scene()) - 1e-6)
                  w.shown.timeline.time = 0;
              },
          .checked = [](const Workspace& w) { return w.shown.timeline.playing; },
      },
      {
          .id = "time.back",
          .label = "Previous frame",
          .icon = icon_named("previous"),
          .keys = {','},
          .needs = "Needs a keyframe, or a film",
          .enabled = has_frames,
          .run = stop_at_frame<-1>,
      },
      {
          .id = "time.forward",
          .label = "Next frame",
          .icon = icon_named("next"),
          .keys = {'.'},
          .needs = "Needs a keyframe, or a film",
          .enabled = has_frames,
          .run = stop_at_frame<1>,
      },
      {
          .id = "time.previous_key",
          .label = "Previous keyframe",
          .icon = icon_named("to-start"),
          .keys = {{',', kShift}, {'<', kShift}},
          .needs = "Needs a keyframe",
          .enabled = has_keys,
          .run = step_key<false>,
      },
      {
          .id = "time.next_key",
          .label = "Next keyframe",
          .icon = icon_named("to-end"),
          .keys = {{'.', kShift}, {'>', kShift}},
          .needs = "Needs a keyframe",
          .enabled = has_keys,
          .run = step_key<true>,
      },
      {
          .id = "time.key",
          .label = "Set keyframe",
          .hint = "Store the current pose at the current time",
          .icon = icon_named("key"),
          .keys = {'I'},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = [](Workspace& w) { w.set_key(); },
      },
      {
          .id = "time.delete_key",
          .label = "Delete keyframes",
          .hint = "Delete the selected keyframes, or the one at the current time",
          .icon = icon_named("trash"),
          .needs = "Needs a selected keyframe, or one at the current time",
          .enabled = has_chosen_keys,
          .run = [](Workspace& w) { delete_keys(w, chosen_keys(w)); },
      },
      {
          .id = "time.copy_keys",
          .label = "Duplicate keyframes",
          .hint = "Copy the selected keyframes to the current time",
          .icon = icon_named("duplicate"),
          .needs = "Needs a selected keyframe, or one at the current time",
          .enabled = has_chosen_keys,
          .run =
              [](Workspace& w) { add_copies(w, copied_keys(w.document.scene(), chosen_keys(w))); },
      },
      {
          .id = "time.mirror_keys",
          .label = "Mirror keyframes",
          .hint = "Mirror the selected poses; needs a cage that is symmetric at rest",
          .icon = icon_named("symmetry"),
          .needs = "Needs a selected keyframe, or one at the current time",
          .enabled = has_chosen_keys,
          .run =
              [](Workspace& w) {
                const KeySelection keys = chosen_keys(w);
                w.commit_layers(for_keys("Mirror", keys),
                                with_keys_mirrored(w.document.scene(), keys));
              },
      },
      {
          .id = "time.select_keys",
          .label = "Select all keyframes",
          .needs = "Needs a keyframe",
          .enabled = has_keys,
          .run =
              [](Workspace& w) {
                const Scene& scene = w.document.scene();
                w.selection.clear();
                w.shown.timeline.keys = editable_keys(scene, all_keys(scene));
                w.shown.timeline.visible = true;
              },
      },
      {
          .id = "time.auto_key",
          .label = "Auto-key",
          .hint = "Every change of the pose sets a keyframe",
          .icon = icon_named("auto-key"),
          .keys = {'K'},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run =
              [](Workspace& w) {
                w.shown.timeline.auto_key = !w.shown.timeline.auto_key;
                w.shown.timeline.visible = w.shown.timeline.visible || w.shown.timeline.auto_key;
              },
          .checked = [](const Workspace& w) { return w.shown.timeline.auto_key; },
      },
      {
          .id = "time.loop",
          .label = "Loop",
          .hint = "Start again after the last keyframe or frame",
          .icon = icon_named("loop"),
          .needs = "Needs a cage, or a film",
          .enabled = [](const Workspace& w) { return has_cage(w) || has_frames(w); },
          .run = [](Workspace& w) { w.shown.timeline.loop = !w.shown.timeline.loop; },
          .checked = [](const Workspace& w) { return w.shown.timeline.loop; },
      },
      {
          .id = "time.onion",
          .label = "Onion skin",
          .hint = "Show the keyframes before and after the current time",
          .icon = icon_named("onion"),
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = [](Workspace& w) { w.shown.timeline.onion = !w.shown.timeline.onion; },
          .checked = [](const Workspace& w) { return w.shown.timeline.onion; },
      },
      {
          .id = "time.copy",
          .label = "Copy pose",
          .hint = "Copy the pose, or the keyframes that are selected",
          .keys = {{'C', kCtrl}},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = copy,
      },
      {
          .id = "time.paste",
          .label = "Paste pose",
          .hint = "Paste the pose, or put the copied keyframes at the current time",
          .keys = {{'V', kCtrl}},
          .needs = "Needs a copied pose or keyframe that fits the cage and the pins",
          .enabled = can_paste,
          .run = paste,
      },
      {
          .id = "time.paste_mirrored",
          .label = "Paste pose mirrored",
          .hint = "Needs a cage that is symmetric at rest",
          .keys = {{'V', kCtrlShift}},
          .needs = "Needs a copied pose",
          .enabled = has_copied,
          .run =
              [](Workspace& w) {
                w.commit(
                    "Paste pose mirrored",
                    posed_as(w.shown.deformation(), mirrored(w.shown.deformation(), *w.copied)));
              },
      },
  };
}

}  // namespace holomorph
