// The Time menu: playback, keyframes and poses.
#include "edit/actions/groups.h"
#include "edit/actions/icons.h"
#include "scene/mirror.h"

namespace holomorph {
namespace {

bool has_keys(const Workspace& w) {
  return has_keyframes(w.document.scene());
}
bool has_copied(const Workspace& w) {
  return w.copied && fits(w.shown.deformation(), *w.copied);
}
std::optional<size_t> key_here(const Workspace& w) {
  const size_t key = key_at(w.shown.own(), w.shown.timeline.time);
  return key < w.shown.own().keyframes.size() ? std::optional(key) : std::nullopt;
}
template <int by>
void step_frame(Workspace& w) {
  w.shown.timeline.playing = false;
  const Scene& scene = w.document.scene();
  w.go_to_time(time_of_frame(scene, frame_at(scene, w.shown.timeline.time) + by));
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
          .enabled = plays,
          .run =
              [](Workspace& w) {
                w.shown.preview.reset();
                w.shown.timeline.playing = !w.shown.timeline.playing;
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
          .enabled = has_keys,
          .run = step_frame<-1>,
      },
      {
          .id = "time.forward",
          .label = "Next frame",
          .icon = icon_named("next"),
          .keys = {'.'},
          .enabled = has_keys,
          .run = step_frame<1>,
      },
      {
          .id = "time.previous_key",
          .label = "Previous keyframe",
          .icon = icon_named("to-start"),
          .keys = {{',', kShift}, {'<', kShift}},
          .enabled = has_keys,
          .run = step_key<false>,
      },
      {
          .id = "time.next_key",
          .label = "Next keyframe",
          .icon = icon_named("to-end"),
          .keys = {{'.', kShift}, {'>', kShift}},
          .enabled = has_keys,
          .run = step_key<true>,
      },
      {
          .id = "time.key",
          .label = "Set keyframe",
          .hint = "Store the current pose at the current time",
          .icon = icon_named("key"),
          .keys = {'I'},
          .enabled = has_cage,
          .run = [](Workspace& w) { w.set_key(); },
      },
      {
          .id = "time.delete_key",
          .label = "Delete keyframe",
          .hint = "Delete the keyframe at the current time",
          .enabled = [](const Workspace& w) { return key_here(w).has_value(); },
          .run =
              [](Workspace& w) {
                w.commit("Delete keyframe", without_key(w.shown.own(), *key_here(w)),
                         EditBase::document);
              },
      },
      {
          .id = "time.auto_key",
          .label = "Auto-key",
          .hint = "Every change of the pose sets a keyframe",
          .icon = icon_named("auto-key"),
          .keys = {'K'},
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
          .hint = "Start again after the last keyframe",
          .icon = icon_named("loop"),
          .enabled = has_cage,
          .run = [](Workspace& w) { w.shown.timeline.loop = !w.shown.timeline.loop; },
          .checked = [](const Workspace& w) { return w.shown.timeline.loop; },
      },
      {
          .id = "time.onion",
          .label = "Onion skin",
          .hint = "Show the keyframes before and after the current time",
          .icon = icon_named("onion"),
          .enabled = has_cage,
          .run = [](Workspace& w) { w.shown.timeline.onion = !w.shown.timeline.onion; },
          .checked = [](const Workspace& w) { return w.shown.timeline.onion; },
      },
      {
          .id = "time.copy",
          .label = "Copy pose",
          .keys = {{'C', kCtrl}},
          .enabled = has_cage,
          .run =
              [](Workspace& w) {
                if (!w.require_pose()) return;
                w.copied = whole_pose_of(w.shown.deformation());
                w.messages.say("Pose copied.");
              },
      },
      {
          .id = "time.paste",
          .label = "Paste pose",
          .keys = {{'V', kCtrl}},
          .enabled = has_copied,
          .run =
              [](Workspace& w) {
                w.commit("Paste pose", posed_as(w.shown.deformation(), *w.copied));
              },
      },
      {
          .id = "time.paste_mirrored",
          .label = "Paste pose mirrored",
          .hint = "Needs a cage that is symmetric at rest",
          .keys = {{'V', kCtrlShift}},
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
