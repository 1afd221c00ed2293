// Keyframes are sorted by time and no two are at one time.
#include "scene/keyframes.h"

#include <algorithm>

#include "core/error.h"

namespace holomorph {
namespace {

constexpr double kSameTime = 1e-3;

}  // namespace

size_t key_at(const Scene& scene, double time) {
  const auto found = std::ranges::find_if(
      scene.keyframes, [&](const Keyframe& key) { return std::abs(key.time - time) < kSameTime; });
  return static_cast<size_t>(found - scene.keyframes.begin());
}

Scene with_key(Scene scene, double time) {
  const size_t there = key_at(scene, time);
  Pose pose = whole_pose_of(scene);
  if (there < scene.keyframes.size()) {
    scene.keyframes[there].pose = std::move(pose);
    return scene;
  }
  const auto next = std::ranges::upper_bound(scene.keyframes, time, {}, &Keyframe::time);
  scene.keyframes.insert(next, {time, std::move(pose)});
  return scene;
}

Scene without_key(Scene scene, size_t key) {
  scene.keyframes.erase(scene.keyframes.begin() + static_cast<long>(key));
  return scene;
}

std::pair<Scene, size_t> with_key_moved(Scene scene, size_t key, double time) {
  Keyframe moved = scene.keyframes[key];
  moved.time = std::clamp(time, 0.0, kLongestTime);
  scene = without_key(std::move(scene), key);
  if (const size_t there = key_at(scene, moved.time); there < scene.keyframes.size())
    scene = without_key(std::move(scene), there);
  const auto next = std::ranges::upper_bound(scene.keyframes, moved.time, {}, &Keyframe::time);
  const size_t number = static_cast<size_t>(next - scene.keyframes.begin());
  scene.keyframes.insert(next, std::move(moved));
  return {std::move(scene), number};
}

Scene with_ease(Scene scene, size_t key, Ease ease) {
  scene.keyframes[key].ease = ease;
  return scene;
}

std::vector<size_t> playing_keys(const Scene& scene) {
  std::vector<size_t> playing;
  for (size_t i = 0; i < scene.keyframes.size(); ++i)
    if (fits(scene, scene.keyframes[i].pose)) playing.push_back(i);
  return playing;
}

double length_of(const Scene& scene) {
  return scene.keyframes.empty() ? 0 : scene.keyframes.back().time;
}

int last_frame_of(const Scene& scene) {
  return static_cast<int>(std::ceil(length_of(scene) * scene.animation.frames_per_second - 1e-6));
}

Pose mirrored(const Scene& scene, const Pose& pose) {
  check(fits(scene, pose), "mirrored: the pose fits");
  const Box box = box_of(outline_of(scene.rest));
  const double axis = box.center().real(), far = 0.02 * box.diagonal();
  const auto mirror = [&](Complex z) { return Complex(2 * axis - z.real(), z.imag()); };
  const auto counterpart = [&](const Points& places, Complex z, const char* what) {
    const Complex wanted = mirror(z);
    const auto nearest =
        std::ranges::min_element(places, {}, [&](Complex w) { return std::abs(w - wanted); });
    if (std::abs(*nearest - wanted) > far)
      throw Error(ErrorKind::bad_input,
                  std::string("the pose cannot be mirrored: a ") + what +
                      " has no counterpart on the other side of the cage's middle",
                  z);
    return static_cast<size_t>(nearest - places.begin());
  };
  Pose result = pose;
  const Points vertices = vertices_of(scene.rest);
  const Index n = scene.rest.size();
  for (Index e = 0; e < n; ++e) {
    // The mirrored cage runs the other way: segment e's counterpart starts at its end's.
    const Index start =
                    static_cast<Index>(counterpart(vertices, scene.rest.vertex(e), "cage point")),
                end = static_cast<Index>(
                    counterpart(vertices, scene.rest.vertex(e + 1), "cage point"));
    if ((end + 1) % n != start)
      throw Error(ErrorKind::bad_input,
                  "the pose cannot be mirrored: the cage's two sides have different points",
                  scene.rest.vertex(e));
    Points controls = pose.cage.controls(end);
    std::ranges::reverse(controls);
    controls.pop_back();
    for (Complex& z : controls) z = mirror(z);
    result.cage.segments[static_cast<size_t>(e)] = std::move(controls);
  }
  Points pins;
  for (const Pin& pin : scene.pins) pins.push_back(pin.rest);
  for (size_t i = 0; i < pins.size(); ++i) {
    const PosePin& other = pose.pins[counterpart(pins, pins[i], "pin")];
    result.pins[i] = {mirror(other.position), -other.angle, other.scale};
  }
  Points middles;
  for (const Stroke& stroke : scene.strokes) middles.push_back(stroke.rest[stroke.rest.size() / 2]);
  for (size_t i = 0; i < middles.size(); ++i) {
    const size_t other = counterpart(middles, middles[i], "stroke");
    result.strokes[i] = pose.strokes[other];
    for (Complex& z : result.strokes[i]) z = mirror(z);
    // Drawn the other way round, its start is the other one's end.
    const Points &rest = scene.strokes[i].rest, &theirs = scene.strokes[other].rest;
    if (std::abs(mirror(theirs.back()) - rest.front()) <
        std::abs(mirror(theirs.front()) - rest.front()))
      std::ranges::reverse(result.strokes[i]);
  }
  for (size_t k = 0; k < pose.corners.size(); ++k) {
    const Index vertex = static_cast<Index>(
        counterpart(vertices, scene.rest.vertex(scene.corners[k].vertex), "cage point"));
    const auto other = std::ranges::find(scene.corners, vertex, &Corner::vertex);
    if (other == scene.corners.end())
      throw Error(ErrorKind::bad_input,
                  "the pose cannot be mirrored: a corner's counterpart is none",
                  scene.rest.vertex(vertex));
    const size_t at = static_cast<size_t>(other - scene.corners.begin()),
                 count = pose.corners.size();
    // What comes after a corner comes before its counterpart.
    result.corners[k] = {-pose.corners[at].after, -pose.corners[at].before,
                         pose.corners[(at + count - 1) % count].tension};
  }
  return result;
}

}  // namespace holomorph
