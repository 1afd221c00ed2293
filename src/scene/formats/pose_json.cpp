// The pose of a keyframe has the same sections as a deformation, but contains only the values that
// can change over time.
#include "scene/formats/pose_json.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/geometry/polyline.h"

namespace holomorph {
namespace {

constexpr std::array<const char*, 3> kEases{"smooth", "linear", "hold"};

PoseCorner read_corner_pose(const Reader& reader) {
  PoseCorner pose;
  if (reader.has("before")) pose.before = reader["before"].within(-kMaxCornerTurn, kMaxCornerTurn);
  if (reader.has("after")) pose.after = reader["after"].within(-kMaxCornerTurn, kMaxCornerTurn);
  if (reader.has("tension")) pose.tension = reader["tension"].within(0, 1);
  return pose;
}

Json corner_pose_json(const PoseCorner& pose) {
  Json item;
  item["before"] = pose.before;
  item["after"] = pose.after;
  if (pose.tension != 1) item["tension"] = pose.tension;
  return item;
}

PosePin read_pose_pin(const Reader& reader) {
  reader.object();
  PosePin pin;
  pin.position = reader["pose"].point();
  if (reader.has("angle")) pin.angle = reader["angle"].within(-kMaxPinTurn, kMaxPinTurn);
  if (reader.has("scale")) pin.scale = reader["scale"].within(kMinPinScale, kMaxPinScale);
  if (reader.has("turn")) pin.turn = reader["turn"].within(-kMaxPinTurn, kMaxPinTurn);
  return pin;
}

/// Reads the items of a list. Throws Error if the list is too long.
template <class Read>
auto read_list(const Reader& list, size_t most, Read read) {
  list.array();
  if (list.size() > most) list.fail("more than " + std::to_string(most) + " items");
  std::vector<decltype(read(list))> items;
  for (size_t i = 0; i < list.size(); ++i) items.push_back(read(list[i]));
  return items;
}

/// An outline and its holes; holes that are not given are those at rest.
Cage read_posed_part(const Reader& reader, const Cage& rest) {
  Cage part = read_loop(reader["cage"]);
  const size_t holes = reader.has("holes") ? reader["holes"].array().size() : rest.starts.size();
  if (holes > kMaxHoles) reader["holes"].fail("more than " + std::to_string(kMaxHoles) + " holes");
  for (size_t i = 0; i < holes; ++i)
    add_hole(part, reader.has("holes") ? read_loop(reader["holes"][i]).segments
                                       : loop_of(rest, static_cast<Index>(i) + 1).segments);
  return part;
}

Pose read_pose(const Reader& reader, const Deformation& deformation) {
  reader.object();
  Pose pose = whole_pose_of(at_rest(deformation));
  if (reader.has("cage")) {
    const Cage rest = pose.cage;
    pose.cage = read_posed_part(reader, part_of(rest, 0));
    const size_t parts = reader.has("parts") ? reader["parts"].array().size() : rest.parts.size();
    if (parts >= kMaxParts)
      reader["parts"].fail("more than " + std::to_string(kMaxParts) + " parts");
    for (size_t i = 0; i < parts; ++i) {
      const Index part = static_cast<Index>(i) + 1;
      const Cage at_rest = part < rest.part_count() ? part_of(rest, part) : Cage{};
      add_part(pose.cage, reader.has("parts")
                              ? read_posed_part(reader["parts"][i].object(), at_rest)
                              : at_rest);
    }
    if (pose.cage.segments.size() > kMaxSegments ||
        pose.cage.starts.size() - pose.cage.parts.size() > kMaxHoles)
      reader.fail("more than " + std::to_string(kMaxSegments) + " segments or " +
                  std::to_string(kMaxHoles) + " holes in all parts");
  }
  if (reader.has("pins")) pose.pins = read_list(reader["pins"], kMaxPins, read_pose_pin);
  if (reader.has("strokes"))
    pose.strokes = read_list(reader["strokes"], kMaxStrokes,
                             [](const Reader& stroke) { return read_curve(stroke, check_stroke); });
  if (reader.has("corners"))
    pose.corners = read_list(reader["corners"], kMaxSegments, [](const Reader& corner) {
      return read_corner_pose(corner.object());
    });
  return pose;
}

/// An outline and its holes. `with_holes`: writes an empty list if there are none.
Json posed_part_json(const Cage& cage, Index part, bool with_holes) {
  const auto [first, end] = loops_of_part(cage, part);
  Json json = Json::object();
  json["cage"] = loop_json(cage, first);
  if (with_holes) json["holes"] = Json::array();
  for (Index l = first + 1; l < end; ++l) json["holes"].push_back(loop_json(cage, l));
  return json;
}

/// The pose as JSON. If the deformation has handles of some kind but the pose has none, writes an
/// empty list. Without this list, the reader would place the handles at rest.
Json pose_json(const Pose& pose, const Deformation& deformation) {
  Json json = posed_part_json(pose.cage, 0, part_of(deformation.rest, 0).has_holes());
  if (!deformation.rest.parts.empty()) json["parts"] = Json::array();
  for (Index part = 1; part < pose.cage.part_count(); ++part)
    json["parts"].push_back(posed_part_json(
        pose.cage, part,
        part < deformation.rest.part_count() && part_of(deformation.rest, part).has_holes()));
  if (!deformation.pins.empty()) json["pins"] = Json::array();
  if (!deformation.strokes.empty()) json["strokes"] = Json::array();
  if (!deformation.corners.empty()) json["corners"] = Json::array();
  for (const PosePin& pin : pose.pins) {
    Json item;
    item["pose"] = point_json(pin.position);
    if (pin.angle != 0) item["angle"] = pin.angle;
    if (pin.scale != 1) item["scale"] = pin.scale;
    if (pin.turn) item["turn"] = *pin.turn;
    json["pins"].push_back(std::move(item));
  }
  for (const Points& stroke : pose.strokes) json["strokes"].push_back(curve_json(stroke));
  for (const PoseCorner& corner : pose.corners) json["corners"].push_back(corner_pose_json(corner));
  return json;
}

}  // namespace

Cage read_loop(const Reader& list) {
  list.array();
  if (list.size() > kMaxSegments)
    list.fail("more than " + std::to_string(kMaxSegments) + " segments");
  Cage cage;
  for (size_t i = 0; i < list.size(); ++i) {
    const Reader segment = list[i].array();
    if (segment.size() == 0) segment.fail("a segment needs at least its first control point");
    if (segment.size() > kHighestDegree)
      segment.fail("a segment's degree is at most " + std::to_string(kHighestDegree));
    Points controls;
    for (size_t m = 0; m < segment.size(); ++m) controls.push_back(segment[m].point());
    cage.segments.push_back(std::move(controls));
  }
  return cage;
}

Points read_curve(const Reader& reader, void (*check)(std::span<const Complex>)) {
  reader.array();
  if (reader.size() > kMaxCurvePoints) reader.fail("more than 20000 points");
  Points curve;
  for (size_t i = 0; i < reader.size(); ++i) curve.push_back(reader[i].point());
  try {
    check(curve);
  } catch (const Error& error) {
    reader.fail(error.what(), error.where());
  }
  return curve;
}

Corner read_corner(const Reader& reader, const Deformation& deformation) {
  reader.object();
  Corner corner;
  const int last = static_cast<int>(deformation.rest.size()) - 1;
  if (last < 0) reader.fail("there is no cage for this corner");
  corner.vertex = reader["vertex"].whole(0, last);
  if (!deformation.corners.empty() && deformation.corners.back().vertex >= corner.vertex)
    reader["vertex"].fail("corners must be sorted by vertex, without duplicates");
  corner.pose = read_corner_pose(reader);
  corner.extra = reader.others({"vertex", "before", "after", "tension"});
  return corner;
}

Keyframe read_keyframe(const Reader& reader, const Deformation& deformation) {
  reader.object();
  Keyframe key;
  key.time = reader["time"].within(0, kMaxTime);
  if (!deformation.keyframes.empty() && deformation.keyframes.back().time >= key.time)
    reader["time"].fail("keyframes must be sorted by time, without duplicates");
  key.pose = reader.has("pose") ? read_pose(reader["pose"], deformation)
                                : whole_pose_of(at_rest(deformation));
  if (reader.has("pose"))
    key.pose_extra =
        reader["pose"].others({"cage", "holes", "parts", "pins", "strokes", "corners"});
  if (reader.has("ease")) {
    const std::string ease = reader["ease"].text();
    const auto found = std::ranges::find(kEases, ease);
    if (found == kEases.end())
      reader["ease"].fail("'" + ease + "' is not an ease; use smooth, linear or hold");
    key.ease = static_cast<Ease>(found - kEases.begin());
  }
  if (reader.has("turns")) key.turns = reader["turns"].whole(-kMaxTurns, kMaxTurns);
  key.extra = reader.others({"time", "pose", "ease", "turns"});
  return key;
}

AnimationSettings read_animation(const Reader& reader) {
  reader.object();
  AnimationSettings settings;
  if (reader.has("frames_per_second"))
    settings.frames_per_second = reader["frames_per_second"].within(kMinFrameRate, kMaxFrameRate);
  if (reader.has("in_betweens")) {
    const std::string what = reader["in_betweens"].text();
    if (what != "shapes" && what != "places")
      reader["in_betweens"].fail("'" + what + "' cannot be blended; use shapes or places");
    settings.linear_blend = what == "places";
  }
  return settings;
}

Json point_json(Complex z) {
  return Json::array({z.real(), z.imag()});
}

Json curve_json(const Points& curve) {
  Json list = Json::array();
  for (const Complex& z : curve) list.push_back(point_json(z));
  return list;
}

Json loop_json(const Cage& cage, Index loop) {
  Json list = Json::array();
  for (const Points& controls : loop_of(cage, loop).segments) list.push_back(curve_json(controls));
  return list;
}

Json corner_json(const Corner& corner) {
  Json item;
  item["vertex"] = corner.vertex;
  item.update(corner_pose_json(corner.pose));
  add_extra(item, corner.extra);
  return item;
}

Json keyframe_json(const Keyframe& key, const Deformation& deformation) {
  Json item;
  item["time"] = key.time;
  if (key.ease != Ease::smooth) item["ease"] = kEases[static_cast<size_t>(key.ease)];
  if (key.turns != 0) item["turns"] = key.turns;
  item["pose"] = pose_json(key.pose, deformation);
  add_extra(item["pose"], key.pose_extra);
  add_extra(item, key.extra);
  return item;
}

Json animation_json(const AnimationSettings& settings) {
  Json json;
  json["frames_per_second"] = settings.frames_per_second;
  if (settings.linear_blend) json["in_betweens"] = "places";
  return json;
}

namespace {

/// Appends members without looking up their keys, which makes the conversion linear in time.
Json to_json(const JsonTree::Value& value) {
  Json json;
  if (value.kind() == JsonTree::Kind::object) {
    json = Json::object();
    auto& members = json.get_ref<Json::object_t&>();
    for (size_t i = 0; i < value.size(); ++i)
      members.emplace_back(std::string(value.key(i)), to_json(value.member(i)));
  } else if (value.kind() == JsonTree::Kind::list) {
    json = Json::array();
    for (size_t i = 0; i < value.size(); ++i) json.push_back(to_json(value.item(i)));
  } else {
    std::string text;
    value.write(text);
    json = Json::parse(text);
  }
  return json;
}

}  // namespace

void add_extra(Json& object, const Extra& extra) {
  if (extra.empty()) return;
  constexpr int kDeepest = 1000;  // deeper than any scene that can be read
  const JsonTree tree(extra, kDeepest);
  if (!object.is_object()) object = Json::object();
  auto& members = object.get_ref<Json::object_t&>();
  for (size_t i = 0; i < tree.root().size(); ++i)
    members.emplace_back(std::string(tree.root().key(i)), to_json(tree.root().member(i)));
}

}  // namespace holomorph
