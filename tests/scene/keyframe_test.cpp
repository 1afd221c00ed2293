// Keyframes: files keep them, edits keep them sorted, and maps at a time pass through them.
#include "scene/keyframes.h"

#include "core/error.h"
#include "core/mesh/mesher.h"
#include "scene/formats/scene_json.h"
#include "scene/live_map.h"
#include "scene/mirror.h"
#include "scene/timed_map.h"
#include "support/catch.h"
#include "support/complaint.h"

namespace holomorph::keyframe_test {

namespace {

const Points kBar{{0, 0}, {300, 0}, {300, 100}, {0, 100}};

/// A bar with a pin, at rest.
Deformation bar() {
  Deformation deformation = with_cage(Deformation{}, kBar);
  deformation.method = "pins";
  deformation.pins.push_back({{150, 50}, {150, 50}, {}, {}});
  return deformation;
}

Deformation moved(Deformation deformation, Complex by) {
  for (Points& segment : deformation.pose.segments)
    for (Complex& z : segment) z += by;
  for (Pin& pin : deformation.pins) pin.pose += by;
  return deformation;
}

/// A deformation with its pose keyed at 0, 1 and 3 seconds: moved by 0, 10 and 40.
Deformation keyed() {
  Deformation deformation = with_key(bar(), 0);
  deformation = with_key(moved(deformation, 10), 1);
  return with_key(moved(deformation, 30), 3);
}

std::string complaint(const std::string& keys) {
  Deformation deformation = bar();
  std::string text = json_of(scene_of(deformation));
  text.insert(text.rfind('}'), ", \"keyframes\": " + keys);
  return error_message_of([&] { scene_from_json(text, "s.json"); });
}

}  // namespace

TEST_CASE("Keyframes survive writing and reading, whatever their structure") {
  Deformation deformation = keyed();
  deformation.keyframes[1].ease = Ease::hold;
  deformation.keyframes[2].turns = -2;
  deformation.keyframes[2].extra = R"({"mood":"glad"})";
  deformation.keyframes[1].pose_extra = R"({"wind":3})";
  deformation.keyframes[0].pose.pins.clear();  // another structure
  Scene scene = scene_of(deformation);
  scene.animation = {30, true};
  scene.animation_extra = R"({"loop":true})";
  CHECK(scene_from_json(json_of(scene), "s.json") == scene);
  CHECK(json_of(scene_of(bar())).find("animation") == std::string::npos);
}

TEST_CASE("Another method in a file changes no key, and no position of a handle") {
  Deformation deformation = keyed();
  deformation.keyframes[1].turns = 1;
  deformation.keyframes[2].pose.pins[0].turn = 7;
  deformation.strokes.push_back({{{20, 20}, {60, 30}}, {{20, 25}, {60, 40}}, {}});
  for (Keyframe& key : deformation.keyframes) key.pose.strokes = {deformation.strokes[0].pose};
  for (const Method& method : methods()) {
    INFO(method.id);
    deformation.method = method.id;
    const Deformation read =
        scene_from_json(json_of(scene_of(deformation)), "s.json").deformation();
    CHECK(read == deformation);
    // Nor does the map at a time.
    TimedMap timed(read);
    for (const Keyframe& key : read.keyframes) {
      const TimedFrame frame = timed.frame(key.time);
      REQUIRE(frame.pose);
      CHECK(whole_pose_of(frame.deformation) == key.pose);
    }
  }
}

TEST_CASE("Missing parts of a keyframe are at rest") {
  Deformation deformation = bar();
  std::string text = json_of(scene_of(moved(deformation, 7)));
  text.insert(text.rfind('}'), R"(, "keyframes": [{"time": 0.5, "pose": {}}, {"time": 2}])");
  const Deformation read = scene_from_json(text, "s.json").deformation();
  REQUIRE(read.keyframes.size() == 2);
  for (const Keyframe& key : read.keyframes) CHECK(key.pose == whole_pose_of(deformation));
}

TEST_CASE("Errors in a keyframe name the JSON pointer") {
  CHECK_THAT(complaint(R"([{"time": 1}, {"time": 1}])"),
             Catch::Contains("/keyframes/1/time") && Catch::Contains("without duplicates"));
  CHECK_THAT(complaint(R"([{"time": -1}])"), Catch::Contains("/keyframes/0/time"));
  CHECK_THAT(complaint(R"([{"time": 0, "ease": "bouncy"}])"),
             Catch::Contains("/keyframes/0/ease") && Catch::Contains("smooth, linear or hold"));
  CHECK_THAT(complaint(R"([{"time": 0, "turns": 0.5}])"), Catch::Contains("/keyframes/0/turns"));
  CHECK_THAT(complaint(R"([{"time": 0, "pose": {"pins": [{"angle": 1}]}}])"),
             Catch::Contains("/keyframes/0/pose/pins/0"));
  CHECK_THAT(complaint(R"([{"pose": {}}])"), Catch::Contains("time"));
}

TEST_CASE("Corners must be sorted and distinct, and there must be at least three") {
  const auto with_corners = [](const std::string& corners) {
    std::string text = json_of(scene_of(bar()));
    text.insert(text.rfind('}'), ", \"corners\": " + corners);
    return text;
  };
  const auto wrong = [&](const std::string& corners) {
    try {
      scene_from_json(with_corners(corners), "s.json");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const Deformation read =
      scene_from_json(with_corners(R"([{"vertex": 0}, {"vertex": 1, "after": 0.2, "sharp": 1},
                       {"vertex": 3, "before": 7, "tension": 0.5}])"),
                      "s.json")
          .deformation();
  REQUIRE(read.corners.size() == 3);
  CHECK(read.corners[1].pose == PoseCorner{0, 0.2, 1});
  CHECK(read.corners[2].pose == PoseCorner{7, 0, 0.5});
  CHECK(scene_from_json(json_of(scene_of(read)), "again").deformation() == read);
  CHECK_THAT(wrong(R"([{"vertex": 0}, {"vertex": 1}])"), Catch::Contains("three corners"));
  CHECK_THAT(wrong(R"([{"vertex": 1}, {"vertex": 0}, {"vertex": 2}])"),
             Catch::Contains("/corners/1/vertex"));
  CHECK_THAT(wrong(R"([{"vertex": 0}, {"vertex": 1}, {"vertex": 4}])"),
             Catch::Contains("/corners/2/vertex"));
  CHECK_THAT(wrong(R"([{"vertex": 0, "tension": 2}])"), Catch::Contains("/corners/0/tension"));
}

TEST_CASE("Keys stay sorted when they are set, moved and deleted") {
  Deformation deformation = keyed();
  CHECK(deformation.keyframes.size() == 3);
  CHECK(key_at(deformation, 1.0000001) == 1);
  CHECK(key_at(deformation, 2) == 3);
  const Deformation again = with_key(moved(deformation, 5), 1);  // replaces the existing one
  CHECK(again.keyframes.size() == 3);
  CHECK(again.keyframes[1].pose != deformation.keyframes[1].pose);
  CHECK(without_key(deformation, 1).keyframes.size() == 2);
  CHECK(length_of(scene_of(deformation)) == 3);
  CHECK(last_frame_of(scene_of(deformation)) == 72);
}

TEST_CASE("A pose is mirrored about the middle of the cage") {
  Deformation deformation = bar();
  deformation.pins = {{{60, 50}, {60, 50}, 0.0, {}}, {{240, 50}, {240, 50}, {}, {}}};
  deformation.method = "angles";
  for (Index v = 0; v < 4; ++v) deformation.corners.push_back({v, {}, {}});
  Pose pose = whole_pose_of(deformation);
  pose.cage.segments[1][0] += Complex(30, 5);  // the lower right corner
  pose.pins[0] = {{50, 80}, 0.4, 1.5};
  pose.corners[1] = {0.1, 0.3, 0.5};
  const Pose mirror = mirrored(deformation, pose);
  CHECK(mirror.cage.segments[0][0] == Complex(-30, 5));
  CHECK(mirror.cage.segments[1][0] == Complex(300, 0));
  CHECK(mirror.pins[1].position == Complex(250, 80));
  CHECK(mirror.pins[1].angle == -0.4);
  CHECK(mirror.pins[1].scale == 1.5);
  CHECK(mirror.corners[0].before == -0.3);
  CHECK(mirror.corners[0].after == -0.1);
  CHECK(mirror.corners[3].tension == 0.5);  // of the edge between the corner and its neighbor
  CHECK(mirrored(deformation, mirror) == pose);
  deformation.pins.pop_back();
  CHECK_THROWS_WITH(mirrored(deformation, whole_pose_of(deformation)),
                    Catch::Contains("no counterpart"));
}

TEST_CASE("Maps at a time pass through the keyframes, and so do the handles") {
  const Deformation deformation = keyed();
  LiveMap map(MeshOptions{400});
  map.finish(deformation, {});
  const auto offset_at = [&](double time) {
    map.update(deformation, {}, {time});
    const Complex by = map.map().f[0] - map.prepared()->mesh->vertices[0];
    REQUIRE(map.timed());
    CHECK(std::abs(map.timed()->pins[0].pose - (Complex(150, 50) + by)) <= 1e-3);
    CHECK(std::abs(map.timed()->pose.vertex(2) - (Complex(300, 100) + by)) <= 1e-3);
    CHECK(std::abs(by.imag()) <= 1e-3);
    return by.real();
  };
  CHECK(offset_at(0) == Approx(0).margin(1e-3));
  CHECK(offset_at(0.5) == Approx(5).margin(1e-3));
  CHECK(offset_at(1) == Approx(10).margin(1e-3));
  CHECK(offset_at(2) == Approx(25).margin(1e-3));
  CHECK(offset_at(9) == Approx(40).margin(1e-3));
  // Without a time, the map has the deformation's own pose.
  map.update(deformation, {});
  CHECK_FALSE(map.timed());
  CHECK((map.map().f[0] - map.prepared()->mesh->vertices[0]).real() == Approx(40).margin(1e-3));
}

TEST_CASE(
    "Holds do not move, linear keys have constant speed, and keys of another structure do not "
    "play") {
  Deformation deformation = keyed();
  deformation.keyframes[0].ease = Ease::hold;
  deformation.keyframes[1].ease = Ease::linear;
  LiveMap map(MeshOptions{400});
  map.finish(deformation, {});
  const auto offset_at = [&](const Deformation& s, double time, bool linear_blend = false) {
    map.update(s, {}, {time, linear_blend});
    return (map.map().f[0] - map.prepared()->mesh->vertices[0]).real();
  };
  CHECK(offset_at(deformation, 0.9) == Approx(0).margin(1e-3));
  CHECK(offset_at(deformation, 1.5) == Approx(17.5).margin(1e-3));
  Deformation other = deformation;
  other.keyframes[1].pose.pins.clear();
  CHECK(playing_keys(other) == std::vector<size_t>{0, 2});
  CHECK(offset_at(other, 1.5) == Approx(0).margin(1e-3));
  other.keyframes[0].ease = Ease::linear;
  CHECK(offset_at(other, 1.5, true) == Approx(20).margin(1e-3));
}

TEST_CASE("Keys with equal poses keep their own turns and speeds in every frame") {
  Deformation deformation = bar();
  deformation.pins[0].angle = 0.0;
  const auto turned = [&](double angle) {
    Deformation s = deformation;
    s.pins[0].angle = angle;
    for (Points& segment : s.pose.segments)
      for (Complex& z : segment)
        z = Complex(150, 50) + std::polar(1.0, angle) * (z - Complex(150, 50));
    return whole_pose_of(s);
  };
  for (const double degrees : {0.0, 120.0, 240.0, 0.0})
    deformation.keyframes.push_back({static_cast<double>(deformation.keyframes.size()),
                                     turned(degrees * kPi / 180),
                                     Ease::linear,
                                     0,
                                     {}});
  deformation.keyframes[3].turns = 1;
  LiveMap map(MeshOptions{400});
  map.finish(deformation, {});
  map.update(deformation, {}, {2.5});
  const VectorXc first = map.map().f;
  map.update(deformation, {}, {2.4});
  map.update(deformation, {}, {2.5});
  CHECK((map.map().f - first).cwiseAbs().maxCoeff() <= 1e-9);
}

TEST_CASE("A stroke across the middle is its own mirror image") {
  Deformation deformation = bar();
  deformation.method = "strokes";
  deformation.strokes.push_back(
      {{{100, 50}, {150, 50}, {200, 50}}, {{100, 50}, {150, 50}, {200, 50}}, {}});
  CHECK(mirrored(deformation, whole_pose_of(deformation)) == whole_pose_of(deformation));
}

TEST_CASE("A pin that is turned twice also turns twice between the keys") {
  Deformation deformation = bar();
  deformation.pins[0].angle = 0.0;
  deformation = with_key(deformation, 0);
  Deformation turned = deformation;
  turned.pins[0].angle = 4 * kPi + 0.5;
  for (Points& segment : turned.pose.segments)
    for (Complex& z : segment) z = Complex(150, 50) + std::polar(1.0, 0.5) * (z - Complex(150, 50));
  deformation = with_key(turned, 1);
  deformation.keyframes[0].ease = Ease::linear;
  LiveMap map(MeshOptions{400});
  map.finish(deformation, {});
  map.update(deformation, {}, {0.25});
  const double angle = kPi + 0.125;
  for (const size_t v : {0, 50, 100}) {
    const Complex rest = map.prepared()->mesh->vertices[v] - Complex(150, 50);
    CHECK(std::abs(map.map().f[static_cast<Index>(v)] - Complex(150, 50) -
                   std::polar(1.0, angle) * rest) <= 0.5);
  }
}

}  // namespace holomorph::keyframe_test
