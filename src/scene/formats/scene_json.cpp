// The reader carries the file's name and the JSON pointer. Therefore every error can state its
// position.
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

constexpr int kVersion = 2, kPlainVersion = 1;  ///< with layers, and without layers
constexpr int kDeepest = 200;                   ///< limit on nesting, including unknown keys

void read_cage(const Reader& reader, Deformation& deformation) {
  reader.object();
  deformation.rest = read_loop(reader["rest"]);
  deformation.pose = reader.has("pose") ? read_loop(reader["pose"]) : deformation.rest;
  deformation.cage_extra = reader.others({"rest", "pose"});
  if (deformation.pose.size() != deformation.rest.size())
    reader["pose"].fail("there are " + std::to_string(deformation.pose.size()) +
                        " posed segments and " + std::to_string(deformation.rest.size()) +
                        " at rest; they must agree");
  if (!deformation.has_cage()) return;  // no cage drawn yet
  try {
    check_rest_cage(deformation.rest);
  } catch (const Error& error) {
    reader["rest"].fail(error.what(), error.where());
  }
}

Pin read_pin(const Reader& reader) {
  reader.object();
  Pin pin;
  pin.rest = reader["rest"].point();
  pin.pose = reader.has("pose") ? reader["pose"].point() : pin.rest;
  if (reader.has("angle")) pin.angle = reader["angle"].within(-kMaxPinTurn, kMaxPinTurn);
  if (reader.has("scale")) pin.scale = reader["scale"].within(kMinPinScale, kMaxPinScale);
  if (reader.has("depth")) pin.depth = reader["depth"].whole(-kMaxDepth, kMaxDepth);
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
    if (size.size() != 2) size.fail("expected [width, height]");
    image.width = size[size_t{0}].whole(1, kMaxImageSide);
    image.height = size[1].whole(1, kMaxImageSide);
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

/// Reads a background: "original", or a color as "#rrggbb".
Background read_background(const Reader& reader) {
  const std::string text = reader.text();
  if (text == "original") return {Background::Fill::original};
  unsigned color = 0;
  int end = 0;
  if (text.size() != 7 || std::sscanf(text.c_str(), "#%6x%n", &color, &end) != 1 || end != 7)
    reader.fail("'" + text + "' is not a background; use \"original\" or a color as \"#rrggbb\"");
  return {Background::Fill::color,
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
  stroke.extra = reader.others({"rest", "pose"});
  return stroke;
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

/// Writes lists of numbers on one line and indents everything else. This keeps files short and
/// diffs readable.
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

/// Reads a brush dab, written as [x, y, radius, level].
BrushDab read_dab(const Reader& reader) {
  if (reader.array().size() != 4) reader.fail("expected [x, y, radius, level]");
  const double x = reader[size_t{0}].within(-kMaxCoordinate, kMaxCoordinate),
               y = reader[1].within(-kMaxCoordinate, kMaxCoordinate);
  return {{x, y},
          reader[2].within(kMinBrushRadius, kMaxBrushRadius),
          reader[3].within(-kMaxDabLevel, kMaxDabLevel)};
}

/// Reads the deformation of one layer, in both layouts of the file.
Deformation read_deformation(const Reader& reader) {
  Deformation deformation;
  read_cage(reader["cage"], deformation);
  if (reader.has("pins")) {
    const Reader pins = reader["pins"].array();
    if (pins.size() > kMaxPins) pins.fail("more than 2000 pins");
    for (size_t i = 0; i < pins.size(); ++i) deformation.pins.push_back(read_pin(pins[i]));
  }
  if (reader.has("strokes")) {
    const Reader strokes = reader["strokes"].array();
    if (strokes.size() > kMaxStrokes) strokes.fail("more than 200 strokes");
    for (size_t i = 0; i < strokes.size(); ++i)
      deformation.strokes.push_back(read_stroke(strokes[i]));
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
    if (dabs.size() > kMaxDabs) dabs.fail("more than 5000 brush dabs");
    for (size_t i = 0; i < dabs.size(); ++i) deformation.stiffness.push_back(read_dab(dabs[i]));
  }
  if (reader.has("outline")) deformation.outline = read_curve(reader["outline"], check_outline);
  if (reader.has("surface")) {
    deformation.surface = read_surface(reader["surface"]);
    if (deformation.outline.empty())
      reader["surface"].fail("a surface needs its flat boundary as the outline");
  }
  if (reader.has("method")) read_method(reader["method"], deformation);
  if (reader.has("keyframes")) {
    const Reader keys = reader["keyframes"].array();
    if (keys.size() > kMaxKeyframes) keys.fail("more than 2000 keyframes");
    for (size_t i = 0; i < keys.size(); ++i)
      deformation.keyframes.push_back(read_keyframe(keys[i], deformation));
  }
  return deformation;
}

/// Reads the settings that all layers share.
void read_shared(const Reader& reader, Scene& scene) {
  if (reader.has("animation")) {
    scene.animation = read_animation(reader["animation"]);
    scene.animation_extra = reader["animation"].others({"frames_per_second", "in_betweens"});
  }
  if (reader.has("background")) scene.background = read_background(reader["background"]);
}

/// The known keys of a layer in both layouts of the file.
constexpr std::initializer_list<const char*> kLayerKeys{
    "image",     "cage",    "pins",    "strokes", "corners",
    "stiffness", "outline", "surface", "method",  "keyframes"};

Layer read_layer(const Reader& reader) {
  Layer layer;
  if (reader.has("image")) layer.image = read_image(reader["image"]);
  layer.deformation = read_deformation(reader);
  return layer;
}

/// Reads a file with a single plain layer, whose keys are those of the scene.
void read_single(const Reader& reader, Scene& scene) {
  scene = with_layer(std::move(scene), read_layer(reader));
  scene.extra = reader.others({"format", "version", "animation", "background"}, kLayerKeys);
}

void read_layers(const Reader& reader, Scene& scene) {
  scene.extra = reader.others({"format", "version", "layers", "edited", "animation", "background"});
  const Reader list = reader["layers"].array();
  if (list.size() < 1 || list.size() > kMaxLayers) list.fail("expected 1 to 100 layers");
  scene.layers.clear();
  for (size_t i = 0; i < list.size(); ++i) {
    const Reader item = list[i].object();
    Layer layer = read_layer(item);
    layer.id = static_cast<int>(i) + 1;
    if (item.has("name")) layer.name = item["name"].text();
    if (item.has("visible")) layer.visible = item["visible"].truth();
    if (item.has("locked")) layer.locked = item["locked"].truth();
    layer.extra = item.others({"name", "visible", "locked"}, kLayerKeys);
    scene.layers.emplace_back(std::move(layer));
  }
  const int last = static_cast<int>(list.size()) - 1;
  scene.edited = static_cast<size_t>(reader.has("edited") ? reader["edited"].whole(0, last) : last);
}

}  // namespace

Scene scene_from_json(const std::string& text, const std::string& name) {
  check_budget(&Budget::scene, static_cast<double>(text.size()), name + ": its size is");
  std::optional<JsonTree> tree;
  try {
    tree.emplace(text, kDeepest);
  } catch (const Error& error) {
    const std::string what = error.what();  // "... at line 3, column 9: ..."
    const size_t at = what.find("line "), end = what.find(':', at);
    if (what.starts_with("brackets")) throw Error(error.kind(), name + ": not a scene: " + what);
    throw Error(ErrorKind::bad_input, name +
                                          ": not a scene: the file is damaged or ends too early" +
                                          (at != std::string::npos && end != std::string::npos
                                               ? ", at " + what.substr(at, end - at)
                                               : ""));
  }
  const Reader reader(tree->root(), name, "");
  reader.object();
  if (!reader.has("format") || reader["format"].text() != "holomorph")
    reader.fail("not a Holomorph scene: \"format\": \"holomorph\" is missing");
  const int version = reader["version"].whole(1, 1 << 30);
  if (version > kVersion)
    reader["version"].fail("the scene has version " + std::to_string(version) +
                           ", written by a newer program; this one reads versions up to " +
                           std::to_string(kVersion));
  Scene scene;
  read_shared(reader, scene);
  if (reader.has("layers"))
    read_layers(reader, scene);
  else
    read_single(reader, scene);
  return scene;
}

namespace {

void write_image(const ImageReference& reference, Json& document) {
  Json image;
  image["file"] = reference.file;
  if (!reference.entry.empty()) image["entry"] = reference.entry;
  if (reference.width > 0) image["size"] = Json::array({reference.width, reference.height});
  if (!reference.sha256.empty()) image["sha256"] = reference.sha256;
  add_extra(image, reference.extra);
  document["image"] = std::move(image);
}

void write_deformation(const Deformation& deformation, Json& document) {
  Json cage;
  cage["rest"] = loop_json(deformation.rest);
  cage["pose"] = loop_json(deformation.pose);
  add_extra(cage, deformation.cage_extra);
  document["cage"] = std::move(cage);
  if (!deformation.pins.empty()) {
    document["pins"] = Json::array();
    for (const Pin& pin : deformation.pins) {
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
  if (!deformation.strokes.empty()) {
    document["strokes"] = Json::array();
    for (const Stroke& stroke : deformation.strokes) {
      Json item;
      item["rest"] = curve_json(stroke.rest);
      item["pose"] = curve_json(stroke.pose);
      add_extra(item, stroke.extra);
      document["strokes"].push_back(std::move(item));
    }
  }
  if (!deformation.corners.empty()) {
    document["corners"] = Json::array();
    for (const Corner& corner : deformation.corners)
      document["corners"].push_back(corner_json(corner));
  }
  for (const BrushDab& dab : deformation.stiffness)
    document["stiffness"].push_back(
        Json::array({dab.at.real(), dab.at.imag(), dab.radius, dab.level}));
  if (!deformation.outline.empty()) document["outline"] = curve_json(deformation.outline);
  if (deformation.surface) {
    Json surface;
    surface["file"] = deformation.surface->file;
    surface["flattening"] = name_of(deformation.surface->flattening);
    add_extra(surface, deformation.surface->extra);
    document["surface"] = std::move(surface);
  }
  Json method;
  method["id"] = deformation.method;
  method["parameters"] = parameters_json(method_named(deformation.method), deformation.parameters);
  if (!deformation.other_parameters.empty()) {
    method["others"] = Json::object();
    for (const auto& [id, parameters] : deformation.other_parameters)
      method["others"][id] = parameters_json(method_named(id), parameters);
  }
  add_extra(method, deformation.method_extra);
  document["method"] = std::move(method);
  for (const Keyframe& key : deformation.keyframes)
    document["keyframes"].push_back(keyframe_json(key, deformation));
}

void write_layer(const Layer& layer, Json& document) {
  if (layer.image) write_image(*layer.image, document);
  write_deformation(layer.deformation, document);
}

void write_shared(const Scene& scene, Json& document) {
  if (scene.animation != AnimationSettings{} || !scene.animation_extra.empty()) {
    document["animation"] = animation_json(scene.animation);
    add_extra(document["animation"], scene.animation_extra);
  }
  if (scene.background.fill == Background::Fill::original)
    document["background"] = "original";
  else if (scene.background.fill == Background::Fill::color) {
    const auto& [red, green, blue] = scene.background.color;
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", red, green, blue);
    document["background"] = text;
  }
}

Json layers_json(const Scene& scene) {
  Json layers = Json::array();
  for (const SharedLayer& shared : scene.layers) {
    const Layer& layer = *shared;
    Json item = Json::object();
    if (!layer.name.empty()) item["name"] = layer.name;
    if (!layer.visible) item["visible"] = false;
    if (layer.locked) item["locked"] = true;
    write_layer(layer, item);
    add_extra(item, layer.extra);
    layers.push_back(std::move(item));
  }
  return layers;
}

Error not_utf8() {
  return {ErrorKind::bad_input,
          "a file name is not UTF-8 and cannot be written to a scene; rename the file"};
}

}  // namespace

void check_texts(const Layer& layer) {
  std::vector<std::string> texts{layer.name};
  if (layer.image) texts.insert(texts.end(), {layer.image->file, layer.image->entry});
  if (const auto& surface = layer.deformation.surface) texts.push_back(surface->file);
  if ((layer.image && layer.image->file.empty()) ||
      (layer.deformation.surface && layer.deformation.surface->file.empty()))
    throw Error(ErrorKind::bad_input, "a file has no name");
  try {
    for (const std::string& text : texts) Json(text).dump();
  } catch (const Json::exception&) {
    throw not_utf8();
  }
}

std::string json_of(const Scene& scene) {
  // A scene with a single plain layer is written without a list of layers.
  const bool layered = has_layers(scene);
  Json document;
  document["format"] = "holomorph";
  document["version"] = layered ? kVersion : kPlainVersion;
  if (layered) {
    document["layers"] = layers_json(scene);
    document["edited"] = scene.edited;
    write_shared(scene, document);
  } else {
    write_layer(scene.layer(), document);
    write_shared(scene, document);
  }
  add_extra(document, scene.extra);
  std::string text;
  try {
    write_value(document, 0, text);
  } catch (const Json::exception&) {
    throw not_utf8();
  }
  return text + "\n";
}

}  // namespace holomorph
