// The parts of a deformation are read in an order that lets each part refer to earlier ones.
#include "scene/formats/deformation_json.h"

#include <array>
#include <set>

#include "core/error.h"
#include "core/geometry/polyline.h"
#include "core/mesh/flatten.h"
#include "core/outline/outline_match.h"
#include "scene/formats/pose_json.h"

namespace holomorph {
namespace {

void check_sizes(const Reader& reader, const Cage& rest, const Cage& pose) {
  if (pose.size() != rest.size())
    reader["pose"].fail("there are " + std::to_string(pose.size()) + " posed segments and " +
                        std::to_string(rest.size()) + " at rest; they must agree");
}

/// A loop of the cage, at rest and posed.
struct PosedLoop {
  Cage rest, pose;
};
PosedLoop read_posed_loop(const Reader& reader, const char* what) {
  reader.object();
  PosedLoop loop{read_loop(reader["rest"]), {}};
  loop.pose = reader.has("pose") ? read_loop(reader["pose"]) : loop.rest;
  check_sizes(reader, loop.rest, loop.pose);
  if (loop.rest.size() < 3)
    reader["rest"].fail(std::string(what) + " needs at least three segments");
  return loop;
}

/// The holes of the last part.
void read_holes(const Reader& list, Deformation& deformation) {
  if (list.array().size() > kMaxHoles)
    list.fail("more than " + std::to_string(kMaxHoles) + " holes");
  if (list.size() > 0 && !deformation.has_cage()) list.fail("there is no cage for these holes");
  const Index part = deformation.rest.part_count() - 1;
  for (size_t i = 0; i < list.size(); ++i) {
    const PosedLoop hole = read_posed_loop(list[i], "a hole");
    add_hole(deformation.rest, hole.rest.segments, part);
    add_hole(deformation.pose, hole.pose.segments, part);
    deformation.loop_extras.push_back(list[i].others({"rest", "pose"}));
  }
}

void read_parts(const Reader& list, Deformation& deformation) {
  if (list.array().size() >= kMaxParts)
    list.fail("more than " + std::to_string(kMaxParts) + " parts");
  if (list.size() > 0 && !deformation.has_cage()) list.fail("there is no first part");
  for (size_t i = 0; i < list.size(); ++i) {
    const PosedLoop part = read_posed_loop(list[i], "a part");
    add_part(deformation.rest, part.rest);
    add_part(deformation.pose, part.pose);
    deformation.loop_extras.push_back(list[i].others({"rest", "pose", "holes"}));
    if (list[i].has("holes")) read_holes(list[i]["holes"], deformation);
  }
}

void read_cage(const Reader& reader, Deformation& deformation) {
  reader.object();
  deformation.rest = read_loop(reader["rest"]);
  deformation.pose = reader.has("pose") ? read_loop(reader["pose"]) : deformation.rest;
  check_sizes(reader, deformation.rest, deformation.pose);
  if (reader.has("holes")) read_holes(reader["holes"], deformation);
  if (reader.has("parts")) read_parts(reader["parts"], deformation);
  if (deformation.rest.starts.size() - deformation.rest.parts.size() > kMaxHoles)
    reader.fail("more than " + std::to_string(kMaxHoles) + " holes in all parts");
  if (std::ranges::all_of(deformation.loop_extras, &Extra::empty)) deformation.loop_extras.clear();
  if (deformation.rest.segments.size() > kMaxSegments)
    reader.fail("more than " + std::to_string(kMaxSegments) + " segments in all loops");
  deformation.cage_extra = reader.others({"rest", "pose", "holes", "parts"});
  if (!deformation.has_cage()) return;  // no cage drawn yet
  try {
    check_rest_cage(deformation.rest);
  } catch (const Error& error) {
    (deformation.rest.starts.empty() ? reader["rest"] : reader).fail(error.what(), error.where());
  }
}

Pin read_pin(const Reader& reader) {
  reader.object();
  Pin pin;
  pin.rest = reader["rest"].point();
  pin.pose = reader.has("pose") ? reader["pose"].point() : pin.rest;
  if (reader.has("angle")) pin.angle = reader["angle"].within(-kMaxPinTurn, kMaxPinTurn);
  if (reader.has("scale")) pin.scale = reader["scale"].within(kMinPinScale, kMaxPinScale);
  if (reader.has("radius")) pin.radius = reader["radius"].within(kMinPinRadius, kMaxPinRadius);
  if (reader.has("depth")) pin.depth = reader["depth"].whole(-kMaxDepth, kMaxDepth);
  if (reader.has("turn")) pin.turn = reader["turn"].within(-kMaxPinTurn, kMaxPinTurn);
  if (reader.has("id")) pin.id = reader["id"].whole(1, kMaxId);
  pin.extra = reader.others({"rest", "pose", "angle", "scale", "radius", "depth", "turn", "id"});
  return pin;
}

SurfaceReference read_surface(const Reader& reader) {
  reader.object();
  SurfaceReference surface;
  surface.file = reader["file"].text();
  if (surface.file.empty()) reader["file"].fail("the path is empty");
  if (reader.has("flattening")) {
    const Reader flattening = reader["flattening"];
    try {
      surface.flattening = flattening_named(flattening.text());
    } catch (const Error& error) {
      flattening.fail(error.what());
    }
  }
  surface.extra = reader.others({"file", "flattening"});
  return surface;
}

Parameters read_parameters(const Reader& values, const Method& method) {
  values.object();
  Parameters parameters;
  for (const auto& [key, reader] : values.members()) {
    const auto spec = std::ranges::find(method.parameters, key, &ParameterSpec::key);
    if (spec == method.parameters.end())
      values.fail("method '" + method.id + "' has no parameter '" + key + "'");
    if (spec->type == ParameterSpec::Type::choice) {
      const std::string id = reader.text();
      const auto option = std::ranges::find(spec->options, id, &ParameterSpec::Option::id);
      if (option == spec->options.end())
        reader.fail("'" + id + "' is not an option of this parameter");
      parameters[key] = static_cast<double>(option - spec->options.begin());
      continue;
    }
    const double value = reader.value();
    if (value < spec->lowest || value > spec->highest)
      reader.fail("the value is outside [" + Json(spec->lowest).dump() + ", " +
                  Json(spec->highest).dump() + "]");
    parameters[key] = value;
  }
  return parameters;
}

const Method& read_id(const Reader& reader, const std::string& id) {
  try {
    return method_named(id);
  } catch (const Error& error) {
    reader.fail(error.what());
  }
}

void read_method(const Reader& reader, Deformation& deformation) {
  reader.object();
  deformation.method = reader["id"].text();
  const Method& method = read_id(reader["id"], deformation.method);
  if (reader.has("parameters"))
    deformation.parameters = read_parameters(reader["parameters"], method);
  if (reader.has("others")) {
    for (const auto& [id, parameters] : reader["others"].object().members())
      deformation.other_parameters[id] = read_parameters(parameters, read_id(parameters, id));
  }
  deformation.method_extra = reader.others({"id", "parameters", "others"});
}

Stroke read_stroke(const Reader& reader) {
  reader.object();
  Stroke stroke;
  stroke.rest = read_curve(reader["rest"], check_stroke);
  stroke.pose = reader.has("pose") ? read_curve(reader["pose"], check_stroke) : stroke.rest;
  if (reader.has("id")) stroke.id = reader["id"].whole(1, kMaxId);
  stroke.extra = reader.others({"rest", "pose", "id"});
  return stroke;
}

/// Reads a brush dab, written as [x, y, radius, level].
BrushDab read_dab(const Reader& reader) {
  if (reader.array().size() != 4) reader.fail("expected [x, y, radius, level]");
  const double x = reader[size_t{0}].within(-kMaxCoordinate, kMaxCoordinate),
               y = reader[1].within(-kMaxCoordinate, kMaxCoordinate);
  return {{x, y},
          reader[2].within(kMinBrushRadius, kMaxBrushRadius),
          reader[3].within(-kMaxDabLevel, kMaxDabLevel)};
}

constexpr std::array<const char*, 3> kFrameNames{"free", "slide", "fixed"};

Frame read_frame(const Reader& reader) {
  const std::string name = reader.text();
  for (size_t i = 0; i < kFrameNames.size(); ++i)
    if (name == kFrameNames[i]) return static_cast<Frame>(i);
  reader.fail("'" + name + "' is not a kind of frame; choose one of: free, slide, fixed");
}

Json parameters_json(const Method& method, const Parameters& parameters) {
  Json values = Json::object();
  for (const ParameterSpec& spec : method.parameters) {
    const auto found = parameters.find(spec.key);
    if (found == parameters.end()) continue;
    if (spec.type == ParameterSpec::Type::toggle)
      values[spec.key] = found->second != 0;
    else if (spec.type == ParameterSpec::Type::choice)
      values[spec.key] = spec.options[static_cast<size_t>(found->second)].id;
    else
      values[spec.key] = found->second;
  }
  return values;
}

Json pin_json(const Pin& pin) {
  Json item;
  item["rest"] = point_json(pin.rest);
  item["pose"] = point_json(pin.pose);
  if (pin.angle) item["angle"] = *pin.angle;
  if (pin.scale != 1) item["scale"] = pin.scale;
  if (pin.radius) item["radius"] = *pin.radius;
  if (pin.depth != 0) item["depth"] = pin.depth;
  if (pin.turn) item["turn"] = *pin.turn;
  if (pin.id > 0) item["id"] = pin.id;
  add_extra(item, pin.extra);
  return item;
}

Json stroke_json(const Stroke& stroke) {
  Json item;
  item["rest"] = curve_json(stroke.rest);
  item["pose"] = curve_json(stroke.pose);
  if (stroke.id > 0) item["id"] = stroke.id;
  add_extra(item, stroke.extra);
  return item;
}

Json surface_json(const SurfaceReference& surface) {
  Json item;
  item["file"] = surface.file;
  item["flattening"] = name_of(surface.flattening);
  add_extra(item, surface.extra);
  return item;
}

Json method_json(const Deformation& deformation) {
  Json item;
  item["id"] = deformation.method;
  item["parameters"] = parameters_json(method_named(deformation.method), deformation.parameters);
  for (const auto& [id, parameters] : deformation.other_parameters)
    item["others"][id] = parameters_json(method_named(id), parameters);
  add_extra(item, deformation.method_extra);
  return item;
}

}  // namespace

namespace {

/// Handles to which layers are attached must have different ids.
template <class Handle>
void check_ids(const Reader& list, const std::vector<Handle>& handles) {
  std::set<int> used;
  for (size_t i = 0; i < handles.size(); ++i)
    if (handles[i].id > 0 && !used.insert(handles[i].id).second)
      list[i]["id"].fail("another one has the same id");
}

}  // namespace

Deformation read_deformation(const Reader& reader) {
  Deformation deformation;
  read_cage(reader["cage"], deformation);
  if (reader.has("pins")) {
    const Reader pins = reader["pins"].array();
    if (pins.size() > kMaxPins) pins.fail("more than " + std::to_string(kMaxPins) + " pins");
    for (size_t i = 0; i < pins.size(); ++i) deformation.pins.push_back(read_pin(pins[i]));
    check_ids(pins, deformation.pins);
  }
  if (reader.has("strokes")) {
    const Reader strokes = reader["strokes"].array();
    if (strokes.size() > kMaxStrokes)
      strokes.fail("more than " + std::to_string(kMaxStrokes) + " strokes");
    for (size_t i = 0; i < strokes.size(); ++i)
      deformation.strokes.push_back(read_stroke(strokes[i]));
    check_ids(strokes, deformation.strokes);
  }
  if (reader.has("corners")) {
    const Reader corners = reader["corners"].array();
    for (size_t i = 0; i < corners.size(); ++i)
      deformation.corners.push_back(read_corner(corners[i], deformation));
    if (!deformation.corners.empty() && deformation.corners.size() < 3)
      corners.fail("there must be at least three corners, or none to use all vertices");
  }
  if (reader.has("stiffness")) {
    const Reader dabs = reader["stiffness"].array();
    if (dabs.size() > kMaxDabs) dabs.fail("more than " + std::to_string(kMaxDabs) + " brush dabs");
    for (size_t i = 0; i < dabs.size(); ++i) deformation.stiffness.push_back(read_dab(dabs[i]));
  }
  if (reader.has("frame")) deformation.frame = read_frame(reader["frame"]);
  if (reader.has("held_beyond"))
    deformation.held_beyond = reader["held_beyond"].within(kMinPinRadius, kMaxPinRadius);
  if (reader.has("outline")) deformation.outline = read_curve(reader["outline"], check_outline);
  if (reader.has("surface")) {
    deformation.surface = read_surface(reader["surface"]);
    if (deformation.outline.empty())
      reader["surface"].fail("a surface needs its flat boundary as the outline");
  }
  if (reader.has("method")) read_method(reader["method"], deformation);
  if (const Method& method = method_named(deformation.method);
      !method.allows_parts && !deformation.rest.parts.empty())
    reader["cage"]["parts"].fail("method '" + method.id + "' needs one outline around all parts");
  if (reader.has("keyframes")) {
    const Reader keys = reader["keyframes"].array();
    if (keys.size() > kMaxKeyframes)
      keys.fail("more than " + std::to_string(kMaxKeyframes) + " keyframes");
    for (size_t i = 0; i < keys.size(); ++i)
      deformation.keyframes.push_back(read_keyframe(keys[i], deformation));
  }
  return deformation;
}

namespace {

Json cage_json(const Deformation& deformation) {
  const auto posed_loop = [&](Index l) {
    Json json;
    json["rest"] = loop_json(deformation.rest, l);
    json["pose"] = loop_json(deformation.pose, l);
    if (l > 0 && deformation.loop_extras.size() == deformation.rest.starts.size())
      add_extra(json, deformation.loop_extras[static_cast<size_t>(l - 1)]);
    return json;
  };
  Json cage;
  for (Index part = 0; part < deformation.rest.part_count(); ++part) {
    const auto [first, end] = loops_of_part(deformation.rest, part);
    Json json = posed_loop(first);
    for (Index l = first + 1; l < end; ++l) json["holes"].push_back(posed_loop(l));
    if (part == 0)
      cage = std::move(json);
    else
      cage["parts"].push_back(std::move(json));
  }
  add_extra(cage, deformation.cage_extra);
  return cage;
}

}  // namespace

void write_deformation(const Deformation& deformation, Json& document) {
  document["cage"] = cage_json(deformation);
  for (const Pin& pin : deformation.pins) document["pins"].push_back(pin_json(pin));
  for (const Stroke& stroke : deformation.strokes)
    document["strokes"].push_back(stroke_json(stroke));
  for (const Corner& corner : deformation.corners)
    document["corners"].push_back(corner_json(corner));
  for (const BrushDab& dab : deformation.stiffness)
    document["stiffness"].push_back(
        Json::array({dab.at.real(), dab.at.imag(), dab.radius, dab.level}));
  if (deformation.frame != Frame::free)
    document["frame"] = kFrameNames[static_cast<size_t>(deformation.frame)];
  if (deformation.held_beyond) document["held_beyond"] = *deformation.held_beyond;
  if (!deformation.outline.empty()) document["outline"] = curve_json(deformation.outline);
  if (deformation.surface) document["surface"] = surface_json(*deformation.surface);
  document["method"] = method_json(deformation);
  for (const Keyframe& key : deformation.keyframes)
    document["keyframes"].push_back(keyframe_json(key, deformation));
}

}  // namespace holomorph
