// One reader object carries the file's name and the JSON pointer, so that every error can say
// where.
#include "scene/formats/scene_json.h"

#include "core/error.h"
#include "core/geometry/polyline.h"
#include "core/mesh/flatten.h"
#include "core/outline/outline_match.h"
#include "scene/budget.h"
#include "scene/formats/pose_json.h"
#include "scene/layers.h"

namespace holomorph {
namespace {

constexpr int kVersion = 2, kPlainVersion = 1;  ///< with layers, and without
constexpr int kDeepest = 200;                   ///< nesting, unknown keys included

void read_cage(const Reader& reader, Scene& scene) {
  reader.object();
  scene.rest = read_loop(reader["rest"]);
  scene.pose = reader.has("pose") ? read_loop(reader["pose"]) : scene.rest;
  scene.cage_extra = reader.others({"rest", "pose"});
  if (scene.pose.size() != scene.rest.size())
    reader["pose"].fail("there are " + std::to_string(scene.pose.size()) + " posed segments and " +
                        std::to_string(scene.rest.size()) + " at rest; they must agree");
  if (!scene.has_cage()) return;  // not drawn yet
  try {
    check_rest_cage(scene.rest);
  } catch (const Error& error) {
    reader["rest"].fail(error.what(), error.where());
  }
}

Pin read_pin(const Reader& reader) {
  reader.object();
  Pin pin;
  pin.rest = reader["rest"].point();
  pin.pose = reader.has("pose") ? reader["pose"].point() : pin.rest;
  if (reader.has("angle")) pin.angle = reader["angle"].within(-kMostPinTurn, kMostPinTurn);
  if (reader.has("scale")) pin.scale = reader["scale"].within(kLeastPinScale, kMostPinScale);
  if (reader.has("depth")) pin.depth = reader["depth"].whole(-kMostDepth, kMostDepth);
  pin.extra = reader.others({"rest", "pose", "angle", "scale", "depth"});
  return pin;
}

ImageReference read_image(const Reader& reader) {
  reader.object();
  ImageReference image;
  image.file = reader["file"].text();
  if (image.file.empty()) reader["file"].fail("the path is empty");
  if (reader.has("entry")) image.entry = reader["entry"].text();
  if (reader.has("size")) {
    const Reader size = reader["size"].array();
    if (size.size() != 2) size.fail("[width, height] is wanted here");
    image.width = size[size_t{0}].whole(1, 1 << 20);
    image.height = size[1].whole(1, 1 << 20);
  }
  if (reader.has("sha256")) image.sha256 = reader["sha256"].text();
  image.extra = reader.others({"file", "entry", "size", "sha256"});
  return image;
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

/// "original", or a colour as "#rrggbb".
Background read_background(const Reader& reader) {
  const std::string text = reader.text();
  if (text == "original") return {Background::Kind::original};
  unsigned color = 0;
  int end = 0;
  if (text.size() != 7 || std::sscanf(text.c_str(), "#%6x%n", &color, &end) != 1 || end != 7)
    reader.fail("'" + text + "' is no background: \"original\", or a colour as \"#rrggbb\"");
  return {Background::Kind::color,
          {static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8),
           static_cast<std::uint8_t>(color)}};
}

Parameters read_parameters(const Reader& values, const Method& method) {
  values.object();
  Parameters parameters;
  for (const auto& [key, reader] : values.members()) {
    const auto spec = std::ranges::find(method.parameters, key, &ParameterSpec::key);
    if (spec == method.parameters.end())
      values.fail("method '" + method.id + "' has no parameter '" + key + "'");
    if (spec->kind == ParameterSpec::Kind::choice) {
      const std::string id = reader.text();
      const auto option = std::ranges::find(spec->options, id, &ParameterSpec::Option::id);
      if (option == spec->options.end()) reader.fail("'" + id + "' is no choice here");
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

void read_method(const Reader& reader, Scene& scene) {
  reader.object();
  scene.method = reader["id"].text();
  const Method& method = read_id(reader["id"], scene.method);
  if (reader.has("parameters")) scene.parameters = read_parameters(reader["parameters"], method);
  if (reader.has("others")) {
    for (const auto& [id, parameters] : reader["others"].object().members())
      scene.other_parameters[id] = read_parameters(parameters, read_id(parameters, id));
  }
  scene.method_extra = reader.others({"id", "parameters", "others"});
}

Stroke read_stroke(const Reader& reader) {
  reader.object();
  Stroke stroke;
  stroke.rest = read_curve(reader["rest"], check_stroke);
  stroke.pose = reader.has("pose") ? read_curve(reader["pose"], check_stroke) : stroke.rest;
  stroke.extra = reader.others({"rest", "pose"});
  return stroke;
}

Json parameters_json(const Method& method, const Parameters& parameters) {
  Json values = Json::object();
  for (const ParameterSpec& spec : method.parameters) {
    const auto found = parameters.find(spec.key);
    if (found == parameters.end()) continue;
    if (spec.kind == ParameterSpec::Kind::toggle)
      values[spec.key] = found->second != 0;
    else if (spec.kind == ParameterSpec::Kind::choice)
      values[spec.key] = spec.options[static_cast<size_t>(found->second)].id;
    else
      values[spec.key] = found->second;
  }
  return values;
}

/// Lists of numbers on one line, everything else indented: short files that read well in a diff.
void write_value(const Json& value, int depth, std::string& out) {
  const std::string indent(2 * (depth + 1), ' ');
  const auto flat = [](const Json& list) {
    return std::none_of(list.begin(), list.end(), [](const Json& v) {
      return v.is_object() || (v.is_array() && !v.empty() && v[0].is_array());
    });
  };
  if (value.is_object() && !value.empty()) {
    out += "{\n";
    bool first = true;
    for (const auto& [key, member] : value.items()) {
      if (!first) out += ",\n";
      first = false;
      out += indent + Json(key).dump() + ": ";
      write_value(member, depth + 1, out);
    }
    out += "\n" + std::string(2 * depth, ' ') + "}";
  } else if (value.is_array() && !value.empty() && !flat(value)) {
    out += "[\n";
    for (size_t i = 0; i < value.size(); ++i) {
      out += indent;
      write_value(value[i], depth + 1, out);
      out += i + 1 < value.size() ? ",\n" : "\n";
    }
    out += std::string(2 * depth, ' ') + "]";
  } else {
    out += value.dump();
  }
}

/// [x, y, radius, level].
Dab read_dab(const Reader& reader) {
  if (reader.array().size() != 4) reader.fail("[x, y, radius, level] is wanted here");
  const double x = reader[size_t{0}].within(-kLargestCoordinate, kLargestCoordinate),
               y = reader[1].within(-kLargestCoordinate, kLargestCoordinate);
  return {{x, y}, reader[2].within(kLeastBrush, kMostBrush), reader[3].within(-10, 10)};
}

/// What belongs to one layer; `scene` has the animation's settings.
void read_layer(const Reader& reader, Scene& scene) {
  if (reader.has("image")) scene.image = read_image(reader["image"]);
  read_cage(reader["cage"], scene);
  if (reader.has("pins")) {
    const Reader pins = reader["pins"].array();
    if (pins.size() > 2000) pins.fail("more than 2000 pins");
    for (size_t i = 0; i < pins.size(); ++i) scene.pins.push_back(read_pin(pins[i]));
  }
  if (reader.has("strokes")) {
    const Reader strokes = reader["strokes"].array();
    if (strokes.size() > 200) strokes.fail("more than 200 strokes");
    for (size_t i = 0; i < strokes.size(); ++i) scene.strokes.push_back(read_stroke(strokes[i]));
  }
  if (reader.has("corners")) {
    const Reader corners = reader["corners"].array();
    for (size_t i = 0; i < corners.size(); ++i)
      scene.corners.push_back(read_corner(corners[i], scene));
    if (!scene.corners.empty() && scene.corners.size() < 3)
      corners.fail("there must be three corners at least, or none: all vertices");
  }
  if (reader.has("stiffness")) {
    const Reader dabs = reader["stiffness"].array();
    if (dabs.size() > kMostDabs) dabs.fail("more than 5000 touches of the brush");
    for (size_t i = 0; i < dabs.size(); ++i) scene.stiffness.push_back(read_dab(dabs[i]));
  }
  if (reader.has("outline")) scene.outline = read_curve(reader["outline"], check_outline);
  if (reader.has("surface")) {
    scene.surface = read_surface(reader["surface"]);
    if (scene.outline.empty()) reader["surface"].fail("it needs its flat boundary as the outline");
  }
  if (reader.has("method")) read_method(reader["method"], scene);
  if (reader.has("keyframes")) {
    const Reader keys = reader["keyframes"].array();
    if (keys.size() > kMostKeyframes) keys.fail("more than 2000 keyframes");
    for (size_t i = 0; i < keys.size(); ++i)
      scene.keyframes.push_back(read_keyframe(keys[i], scene));
  }
}

/// What all layers share.
void read_shared(const Reader& reader, Scene& scene) {
  if (reader.has("animation")) {
    scene.animation = read_animation(reader["animation"]);
    scene.animation_extra = reader["animation"].others({"frames_per_second", "in_betweens"});
  }
  if (reader.has("background")) scene.background = read_background(reader["background"]);
}

Scene read_single(const Reader& reader) {
  Scene scene;
  read_shared(reader, scene);
  read_layer(reader, scene);
  scene.extra = reader.others({"format", "version", "image", "cage", "pins", "strokes", "corners",
                               "stiffness", "outline", "surface", "method", "animation",
                               "keyframes", "background"});
  return scene;
}

Scene read_layers(const Reader& reader) {
  Scene shared;
  read_shared(reader, shared);
  shared.extra =
      reader.others({"format", "version", "layers", "edited", "animation", "background"});
  const Reader list = reader["layers"].array();
  if (list.size() < 1 || list.size() > kMostLayers) list.fail("1 to 100 layers are wanted here");
  std::vector<Scene> layers;
  for (size_t i = 0; i < list.size(); ++i) {
    const Reader item = list[i].object();
    Scene layer;
    layer.animation = shared.animation;
    read_layer(item, layer);
    layer.layer.id = static_cast<int>(i) + 1;
    if (item.has("name")) layer.layer.name = item["name"].text();
    if (item.has("visible")) layer.layer.visible = item["visible"].truth();
    if (item.has("locked")) layer.layer.locked = item["locked"].truth();
    layer.layer.extra =
        item.others({"name", "visible", "locked", "image", "cage", "pins", "strokes", "corners",
                     "stiffness", "outline", "surface", "method", "keyframes"});
    layers.push_back(std::move(layer));
  }
  const int last = static_cast<int>(list.size()) - 1;
  const int edited = reader.has("edited") ? reader["edited"].whole(0, last) : last;
  return scene_of_layers(std::move(layers), static_cast<size_t>(edited), shared);
}

}  // namespace

Scene scene_from_json(const std::string& text, const std::string& name) {
  check_budget(&Budget::scene, static_cast<double>(text.size()), name + ": the scene has");
  std::optional<JsonTree> tree;
  try {
    tree.emplace(text, kDeepest);
  } catch (const Error& error) {
    const std::string what = error.what();  // "... at line 3, column 9: ..."
    const size_t at = what.find("line "), end = what.find(':', at);
    if (what.starts_with("brackets"))
      throw Error(error.kind(), name + ": this is not a scene: " + what);
    throw Error(ErrorKind::bad_input, name +
                                          ": this is not a scene: it is damaged or ends too early" +
                                          (at != std::string::npos && end != std::string::npos
                                               ? ", at " + what.substr(at, end - at)
                                               : ""));
  }
  const Reader reader(tree->root(), name, "");
  reader.object();
  if (!reader.has("format") || reader["format"].text() != "holomorph")
    reader.fail("this is not a Holomorph scene: \"format\": \"holomorph\" is missing");
  const int version = reader["version"].whole(1, 1 << 30);
  if (version > kVersion)
    reader["version"].fail("the scene is of version " + std::to_string(version) +
                           ", written by a newer program; this one reads up to version " +
                           std::to_string(kVersion));
  return reader.has("layers") ? read_layers(reader) : read_single(reader);
}

namespace {

void write_layer(const Scene& scene, Json& document) {
  if (scene.image) {
    Json image;
    image["file"] = scene.image->file;
    if (!scene.image->entry.empty()) image["entry"] = scene.image->entry;
    if (scene.image->width > 0)
      image["size"] = Json::array({scene.image->width, scene.image->height});
    if (!scene.image->sha256.empty()) image["sha256"] = scene.image->sha256;
    add_extra(image, scene.image->extra);
    document["image"] = std::move(image);
  }
  Json cage;
  cage["rest"] = loop_json(scene.rest);
  cage["pose"] = loop_json(scene.pose);
  add_extra(cage, scene.cage_extra);
  document["cage"] = std::move(cage);
  if (!scene.pins.empty()) {
    document["pins"] = Json::array();
    for (const Pin& pin : scene.pins) {
      Json item;
      item["rest"] = point_json(pin.rest);
      item["pose"] = point_json(pin.pose);
      if (pin.angle) item["angle"] = *pin.angle;
      if (pin.scale != 1) item["scale"] = pin.scale;
      if (pin.depth != 0) item["depth"] = pin.depth;
      add_extra(item, pin.extra);
      document["pins"].push_back(std::move(item));
    }
  }
  if (!scene.strokes.empty()) {
    document["strokes"] = Json::array();
    for (const Stroke& stroke : scene.strokes) {
      Json item;
      item["rest"] = curve_json(stroke.rest);
      item["pose"] = curve_json(stroke.pose);
      add_extra(item, stroke.extra);
      document["strokes"].push_back(std::move(item));
    }
  }
  if (!scene.corners.empty()) {
    document["corners"] = Json::array();
    for (const Corner& corner : scene.corners) document["corners"].push_back(corner_json(corner));
  }
  for (const Dab& dab : scene.stiffness)
    document["stiffness"].push_back(
        Json::array({dab.at.real(), dab.at.imag(), dab.radius, dab.level}));
  if (!scene.outline.empty()) document["outline"] = curve_json(scene.outline);
  if (scene.surface) {
    Json surface;
    surface["file"] = scene.surface->file;
    surface["flattening"] = name_of(scene.surface->flattening);
    add_extra(surface, scene.surface->extra);
    document["surface"] = std::move(surface);
  }
  Json method;
  method["id"] = scene.method;
  method["parameters"] = parameters_json(method_named(scene.method), scene.parameters);
  if (!scene.other_parameters.empty()) {
    method["others"] = Json::object();
    for (const auto& [id, parameters] : scene.other_parameters)
      method["others"][id] = parameters_json(method_named(id), parameters);
  }
  add_extra(method, scene.method_extra);
  document["method"] = std::move(method);
  for (const Keyframe& key : scene.keyframes)
    document["keyframes"].push_back(keyframe_json(key, scene));
}

void write_shared(const Scene& scene, Json& document) {
  if (scene.animation != AnimationSettings{} || !scene.animation_extra.empty()) {
    document["animation"] = animation_json(scene.animation);
    add_extra(document["animation"], scene.animation_extra);
  }
  if (scene.background.kind == Background::Kind::original)
    document["background"] = "original";
  else if (scene.background.kind == Background::Kind::color) {
    const auto& [red, green, blue] = scene.background.color;
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", red, green, blue);
    document["background"] = text;
  }
}

Json layers_json(const Scene& scene) {
  Json layers = Json::array();
  for (size_t i = 0; i < layer_count(scene); ++i) {
    const Scene& layer = layer_at(scene, i);
    Json item = Json::object();
    if (!layer.layer.name.empty()) item["name"] = layer.layer.name;
    if (!layer.layer.visible) item["visible"] = false;
    if (layer.layer.locked) item["locked"] = true;
    write_layer(layer, item);
    add_extra(item, layer.layer.extra);
    layers.push_back(std::move(item));
  }
  return layers;
}

}  // namespace

std::string json_of(const Scene& scene) {
  // A scene of one plain layer is written as it always was.
  const bool layered = has_layers(scene);
  Json document;
  document["format"] = "holomorph";
  document["version"] = layered ? kVersion : kPlainVersion;
  if (layered) {
    document["layers"] = layers_json(scene);
    document["edited"] = edited_layer(scene);
    write_shared(scene, document);
  } else {
    write_layer(scene, document);
    write_shared(scene, document);
  }
  add_extra(document, scene.extra);
  std::string text;
  try {
    write_value(document, 0, text);
  } catch (const Json::exception&) {
    throw Error(ErrorKind::bad_input,
                "a file name is not UTF-8 and cannot be written to a scene; rename the file");
  }
  return text + "\n";
}

}  // namespace holomorph
