// Menu Time: keyframes and what is shown.
#include "edit/actions/groups.h"

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

// Glyphs of Font Awesome 4.
constexpr const char *kPlay = "\uf04b", *kBack = "\uf048", *kForward = "\uf051", *kFirst = "\uf049",
                     *kLast = "\uf050", *kKey = "\uf084", *kRecord = "\uf111", *kLoop = "\uf079",
                     *kOnion = "\uf24d";

}  // namespace

std::vector<Action> time_actions() {
  return {
      {"time.play",
       "Play",
       kPlay,
       "Time",
       {Key::space},
       plays,
       [](Workspace& w) {
         w.shown.preview.reset();
         w.shown.timeline.playing = !w.shown.timeline.playing;
         w.shown.timeline.clock_ms.reset();
         if (w.shown.timeline.time >= length_of(w.document.scene()) - 1e-6)
           w.shown.timeline.time = 0;
       },
       [](const Workspace& w) { return w.shown.timeline.playing; }},
      {"time.back", "One frame back", kBack, "Time", {','}, has_keys, step_frame<-1>},
      {"time.forward", "One frame on", kForward, "Time", {'.'}, has_keys, step_frame<1>},
      {"time.previous_key",
       "Previous key",
       kFirst,
       "Time",
       {{',', kShift}, {'<', kShift}},
       has_keys,
       step_key<false>},
      {"time.next_key",
       "Next key",
       kLast,
       "Time",
       {{'.', kShift}, {'>', kShift}},
       has_keys,
       step_key<true>},
      {"time.key", "Set a key", kKey, "Time", {'I'}, has_cage, [](Workspace& w) { w.set_key(); }},
      {"time.delete_key",
       "Delete the key at this time",
       "",
       "Time",
       {},
       [](const Workspace& w) { return key_here(w).has_value(); },
       [](Workspace& w) {
         w.commit("Delete key", without_key(w.shown.own(), *key_here(w)), EditBase::document);
       }},
      {"time.auto_key",
       "Auto-key: edits of the pose set keys",
       kRecord,
       "Time",
       {'K'},
       has_cage,
       [](Workspace& w) {
         w.shown.timeline.auto_key = !w.shown.timeline.auto_key;
         w.shown.timeline.visible = w.shown.timeline.visible || w.shown.timeline.auto_key;
       },
       [](const Workspace& w) { return w.shown.timeline.auto_key; }},
      {"time.loop",
       "Loop",
       kLoop,
       "Time",
       {},
       has_cage,
       [](Workspace& w) { w.shown.timeline.loop = !w.shown.timeline.loop; },
       [](const Workspace& w) { return w.shown.timeline.loop; }},
      {"time.onion",
       "Onion skin: the keys before and after",
       kOnion,
       "Time",
       {},
       has_cage,
       [](Workspace& w) { w.shown.timeline.onion = !w.shown.timeline.onion; },
       [](const Workspace& w) { return w.shown.timeline.onion; }},
      {"time.copy",
       "Copy pose",
       "",
       "Time",
       {{'C', kCtrl}},
       has_cage,
       [](Workspace& w) {
         if (!w.require_pose()) return;
         w.copied = whole_pose_of(w.shown.deformation());
         w.messages.say("The pose is copied.");
       }},
      {"time.paste",
       "Paste pose",
       "",
       "Time",
       {{'V', kCtrl}},
       has_copied,
       [](Workspace& w) { w.commit("Paste pose", posed_as(w.shown.deformation(), *w.copied)); }},
      {"time.paste_mirrored",
       "Paste pose, mirrored",
       "",
       "Time",
       {{'V', kCtrlShift}},
       has_copied,
       [](Workspace& w) {
         w.commit("Paste mirrored pose",
                  posed_as(w.shown.deformation(), mirrored(w.shown.deformation(), *w.copied)));
       }},
  };
}

}  // namespace holomorph
