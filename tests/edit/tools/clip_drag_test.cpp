// Drags of a film's bar on the timeline.
#include "edit/tools/clip_drag.h"

#include "edit/actions/actions.h"
#include "scene/clips.h"
#include "scene/layers.h"
#include "support/catch.h"
#include "support/desk.h"
#include "support/seeds.h"

namespace holomorph::clip_drag_test {

namespace {

/// A layer with a film.
struct Filmed {
  TestWorkspace desk{Points{}};
  Workspace& w = desk.workspace;

  Filmed(const Clip& clip, double rate) {
    Layer layer;
    layer.id = 1;
    layer.image.emplace();
    layer.image->file = "film.mp4";
    layer.image->width = layer.image->height = 10;
    layer.image->clip = clip;
    Scene scene;
    scene.layers = shared({layer});
    scene.animation.frames_per_second = rate;
    REQUIRE(w.commit_layers("Add", scene));
  }
  Clip clip() const { return *clip_of(w.document.scene().layer()); }
  void drag(ClipDrag::Kind kind, double from, const std::vector<double>& path,
            bool freely = false) {
    ClipDrag drag;
    drag.start(w, kind, from);
    for (const double time : path) drag.follow(w, time, freely);
    drag.end(w);
  }
};

Clip random_clip(std::mt19937& random) {
  const auto number = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  Clip clip;
  clip.frames_per_second = number(5, 60);
  clip.frames = number(2, 300);
  clip.first = number(0, clip.frames - 1);
  if (number(0, 2) > 0) clip.last = number(clip.first, clip.frames - 1);
  clip.loops = number(0, 1) == 1;
  clip.start = number(-20, 40) / 10.0;
  return clip;
}

}  // namespace

TEST_CASE("A dragged film shows the same frames at later times") {
  for (const unsigned seed : seeds_of("moved films", {1, 2, 3})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const Clip before = random_clip(random);
    Filmed filmed(before, 24);
    const double by = std::uniform_real_distribution<double>(-5, 5)(random);
    filmed.drag(ClipDrag::Kind::move, 1, {2, 1 + 2 * by, 1 + by}, true);
    const Clip after = filmed.clip();
    CHECK(std::abs(after.start - before.start - by) < 1e-9);
    CHECK(after.first == before.first);
    for (double time = -2.013; time < 9; time += 0.37)
      CHECK(clip_frame_at(after, time + by) == clip_frame_at(before, time));
    filmed.drag(ClipDrag::Kind::move, 0, {0.3});
    const double frame = filmed.clip().start * 24;
    CHECK(std::abs(frame - std::round(frame)) < 1e-6);
    run("edit.undo", filmed.w);
    CHECK(filmed.clip() == after);
    run("edit.undo", filmed.w);
    CHECK(filmed.clip() == before);
  }
}

TEST_CASE("A drag that trims nothing is no step") {
  Clip clip;
  clip.frames_per_second = 10;
  clip.frames = 30;
  Filmed filmed(clip, 24);
  const size_t before = filmed.w.document.history().index();
  for (const auto kind : {ClipDrag::Kind::trim_start, ClipDrag::Kind::trim_end})
    filmed.drag(kind, 3, {3.02, 3.04});
  filmed.drag(ClipDrag::Kind::trim_end, 3, {2, 5});
  CHECK(filmed.clip() == clip);
  CHECK(filmed.w.document.history().index() <= before + 1);
}

TEST_CASE("A trimmed film keeps the times of its other frames") {
  for (const unsigned seed : seeds_of("trimmed films", {1, 2, 3})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const Clip before = random_clip(random);
    for (const auto kind : {ClipDrag::Kind::trim_start, ClipDrag::Kind::trim_end}) {
      Filmed filmed(before, 24);
      const double by = std::uniform_real_distribution<double>(-8, 8)(random);
      filmed.drag(kind, 1, {1 - by, 1 + 3 * by, 1 + by});
      const Clip after = filmed.clip();
      const int first = first_played_frame(after), last = last_played_frame(after);
      CHECK(first >= 0);
      CHECK(first <= last);
      CHECK(last < before.frames);
      const bool at_start = kind == ClipDrag::Kind::trim_start;
      CHECK((at_start ? last_played_frame(before) : first_played_frame(before)) ==
            (at_start ? last : first));
      for (int k = std::max(first, first_played_frame(before));
           k <= std::min(last, last_played_frame(before)); ++k) {
        const double time =
            before.start + (k - first_played_frame(before) + 0.5) / before.frames_per_second;
        CHECK(clip_frame_at(after, time) == k);
      }
      if (after == before) continue;
      run("edit.undo", filmed.w);
      CHECK(filmed.clip() == before);
    }
  }
}

}  // namespace holomorph::clip_drag_test
