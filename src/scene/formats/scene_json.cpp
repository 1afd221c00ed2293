// The reader keeps track of the file's name and the JSON pointer. Every error message can therefore
// include its position.
#include "scene/formats/scene_json.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "scene/attachments.h"
#include "scene/budget.h"
#include "scene/formats/deformation_json.h"
#include "scene/formats/pose_json.h"
#include "scene/layers.h"

namespace holomorph {
namespace {

/// With a list of layers, without one, and with what older programs would drop: holes in cages; and
/// frames, parts, or marks of layers.
constexpr int kLayeredVersion = 2, kPlainVersion = 1, kHoleVersion = 3, kNewestVersion = 4;
constexpr int kDeepest = 200;  ///< limit on nesting, including unknown keys

constexpr const char* kHold = "hold";
constexpr const char* kLoop = "loop";

Clip read_clip(const Reader& reader) {
  reader.object();
  Clip clip;
  if (reader.has("frames_per_second"))
    clip.frames_per_second = reader["frames_per_second"].within(kMinFrameRate, kMaxFrameRate);
  if (reader.has("frames")) clip.frames = reader["frames"].whole(1, kMaxFilmFrames);
  if (reader.has("first")) clip.first = reader["first"].whole(0, kMaxFilmFrames);
  if (reader.has("last")) clip.last = reader["last"].whole(clip.first, kMaxFilmFrames);
  if (reader.has("start")) clip.start = reader["start"].within(-kMaxTime, kMaxTime);
  if (reader.has("after")) {
    const std::string after = reader["after"].text();
    if (after != kHold && after != kLoop)
      reader["after"].fail("'" + after + "' is not known; choose hold or loop");
    clip.loops = after == kLoop;
  }
  clip.extra = reader.others({"frames_per_second", "frames", "first", "last", "start", "after"});
  return clip;
}

constexpr int kFarthestPixel = 1 << 22;

PixelPosition read_pixel(const Reader& reader) {
  reader.array();
  if (reader.size() != 2) reader.fail("expected [x, y]");
  return {reader[size_t{0}].whole(-kFarthestPixel, kFarthestPixel),
          reader[1].whole(-kFarthestPixel, kFarthestPixel)};
}

Json pixel_json(const PixelPosition& position) {
  return Json::array({position.x, position.y});
}

void read_mark(const Reader& reader, ImageReference& image) {
  if (reader.has("corner")) image.corner = read_pixel(reader["corner"]);
  if (reader.has("moved")) image.moved = read_pixel(reader["moved"]);
  if (!reader.has("hash")) return;
  LayerMark mark;
  mark.hash = reader["hash"].text();
  if (reader.has("name")) mark.name = reader["name"].text();
  if (reader.has("offset")) mark.offset = read_pixel(reader["offset"]);
  image.mark = std::move(mark);
}

void write_mark(const ImageReference& image, Json& item) {
  if (image.corner != PixelPosition{}) item["corner"] = pixel_json(image.corner);
  if (image.moved != PixelPosition{}) item["moved"] = pixel_json(image.moved);
  if (!image.mark) return;
  item["name"] = image.mark->name;
  item["offset"] = pixel_json(image.mark->offset);
  item["hash"] = image.mark->hash;
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
  if (reader.has("clip")) image.clip = read_clip(reader["clip"]);
  if (image.entry.empty()) {
    image.extra = reader.others({"file", "entry", "size", "sha256", "clip"});
    return image;
  }
  read_mark(reader, image);
  image.extra = reader.others(
      {"file", "entry", "size", "sha256", "clip", "corner", "hash", "moved", "name", "offset"});
  return image;
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
    "image", "cage",        "pins",    "strokes", "corners", "stiffness",
    "frame", "held_beyond", "outline", "surface", "method",  "keyframes"};

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

Blending read_blending(const Reader& reader) {
  const std::string name = reader.text();
  std::string known;
  for (size_t i = 0; i < kBlendingNames.size(); ++i) {
    if (name == kBlendingNames[i]) return static_cast<Blending>(i);
    known += std::string(i > 0 ? ", " : "") + kBlendingNames[i];
  }
  reader.fail("'" + name + "' is not a blending mode; choose one of: " + known);
}

Attachment read_attachment(const Reader& reader) {
  reader.object();
  Attachment attachment;
  attachment.layer = reader["layer"].whole(1, kMaxId);
  if (reader.has("pin")) {
    attachment.to = Attachment::To::pin;
    attachment.handle = reader["pin"].whole(1, kMaxId);
  } else if (reader.has("stroke")) {
    attachment.to = Attachment::To::stroke;
    attachment.handle = reader["stroke"].whole(1, kMaxId);
  } else {
    attachment.place = reader["place"].point();
  }
  attachment.extra = reader.others({"layer", "pin", "stroke", "place"});
  return attachment;
}

Similarity read_placement(const Reader& reader) {
  reader.object();
  const Similarity placement{reader["factor"].point(), 0, reader["shift"].point()};
  const double scale = std::abs(placement.factor);
  if (!(scale >= kMinPlacementScale && scale <= kMaxPlacementScale))
    reader["factor"].fail("its absolute value must be from 1e-6 to 1e6");
  return placement;
}

/// The ids of the layers: those in the file, and numbers that are still free for the others.
void set_ids(const Reader& list, std::vector<Layer>& layers) {
  std::set<int> used;
  for (size_t i = 0; i < layers.size(); ++i) {
    if (!list[i].has("id")) continue;
    layers[i].id = list[i]["id"].whole(1, kMaxId);
    if (!used.insert(layers[i].id).second) list[i]["id"].fail("another layer has the same id");
  }
  for (size_t i = 0; i < layers.size(); ++i)
    if (layers[i].attachment && !used.contains(layers[i].attachment->layer))
      list[i]["attachment"]["layer"].fail("no layer has this id");
  for (size_t i = 0; i < layers.size(); ++i) {
    if (list[i].has("id")) continue;
    layers[i].id = static_cast<int>(i) + 1;
    while (!used.insert(layers[i].id).second) ++layers[i].id;
  }
  reserve_layer_ids(*used.rbegin());
}

void read_layers(const Reader& reader, Scene& scene) {
  scene.extra = reader.others({"format", "version", "layers", "edited", "animation", "background"});
  const Reader list = reader["layers"].array();
  if (list.size() < 1 || list.size() > kMaxLayers)
    list.fail("expected 1 to " + std::to_string(kMaxLayers) + " layers");
  std::vector<Layer> layers;
  for (size_t i = 0; i < list.size(); ++i) {
    const Reader item = list[i].object();
    Layer layer = read_layer(item);
    if (item.has("name")) layer.name = item["name"].text();
    if (item.has("visible")) layer.visible = item["visible"].truth();
    if (item.has("locked")) layer.locked = item["locked"].truth();
    if (item.has("opacity")) {
      layer.opacity = item["opacity"].number();
      if (!(layer.opacity >= 0 && layer.opacity <= 1))
        item["opacity"].fail("expected a number from 0 to 1");
    }
    if (item.has("blending")) layer.blending = read_blending(item["blending"]);
    if (item.has("clipped")) layer.clipped = item["clipped"].truth();
    if (item.has("attachment")) layer.attachment = read_attachment(item["attachment"]);
    if (item.has("placement")) layer.placement = read_placement(item["placement"]);
    layer.extra = item.others({"name", "visible", "locked", "opacity", "blending", "clipped", "id",
                               "attachment", "placement"},
                              kLayerKeys);
    layers.push_back(std::move(layer));
  }
  set_ids(list, layers);
  scene.layers = shared(std::move(layers));
  try {
    check_attachments(scene);
  } catch (const Error& error) {
    list.fail(error.what());
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
    constexpr std::string_view kOverflow = "number overflow parsing ";
    if (const size_t number = what.find(kOverflow); number != std::string::npos)
      throw Error(ErrorKind::bad_input, name + ": not a scene: the number " +
                                            what.substr(number + kOverflow.size()) +
                                            " is too large");
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
  if (version > kNewestVersion)
    reader["version"].fail("the scene has version " + std::to_string(version) +
                           ", written by a newer program; this one reads versions up to " +
                           std::to_string(kNewestVersion));
  Scene scene;
  read_shared(reader, scene);
  if (reader.has("layers"))
    read_layers(reader, scene);
  else
    read_single(reader, scene);
  return scene;
}

namespace {

Json clip_json(const Clip& clip) {
  Json item;
  item["frames_per_second"] = clip.frames_per_second;
  if (clip.frames > 0) item["frames"] = clip.frames;
  if (clip.first > 0) item["first"] = clip.first;
  if (clip.last) item["last"] = *clip.last;
  if (clip.start != 0) item["start"] = clip.start;
  if (clip.loops) item["after"] = kLoop;
  add_extra(item, clip.extra);
  return item;
}

void write_image(const ImageReference& reference, Json& document) {
  Json image;
  image["file"] = reference.file;
  if (!reference.entry.empty()) image["entry"] = reference.entry;
  if (reference.width > 0) image["size"] = Json::array({reference.width, reference.height});
  if (!reference.sha256.empty()) image["sha256"] = reference.sha256;
  if (reference.clip) image["clip"] = clip_json(*reference.clip);
  write_mark(reference, image);
  add_extra(image, reference.extra);
  document["image"] = std::move(image);
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

Json attachment_json(const Attachment& attachment) {
  Json item;
  item["layer"] = attachment.layer;
  if (attachment.to == Attachment::To::pin)
    item["pin"] = attachment.handle;
  else if (attachment.to == Attachment::To::stroke)
    item["stroke"] = attachment.handle;
  else
    item["place"] = point_json(attachment.place);
  add_extra(item, attachment.extra);
  return item;
}

bool is_parent(const Scene& scene, const Layer& layer) {
  return std::ranges::any_of(scene.layers, [&](const SharedLayer& other) {
    return other->attachment && other->attachment->layer == layer.id;
  });
}

Json layers_json(const Scene& scene) {
  Json layers = Json::array();
  for (const SharedLayer& shared : scene.layers) {
    const Layer& layer = *shared;
    Json item = Json::object();
    if (!layer.name.empty()) item["name"] = layer.name;
    if (!layer.visible) item["visible"] = false;
    if (layer.locked) item["locked"] = true;
    if (layer.opacity < 1) item["opacity"] = layer.opacity;
    if (layer.blending != Blending::normal)
      item["blending"] = kBlendingNames[static_cast<size_t>(layer.blending)];
    if (layer.clipped) item["clipped"] = true;
    if (is_parent(scene, layer)) item["id"] = layer.id;
    if (layer.attachment) item["attachment"] = attachment_json(*layer.attachment);
    if (!is_identity(layer.placement)) {
      item["placement"]["factor"] = point_json(layer.placement.factor);
      item["placement"]["shift"] = point_json(layer.placement(0));
    }
    write_layer(layer, item);
    add_extra(item, layer.extra);
    layers.push_back(std::move(item));
  }
  return layers;
}

/// The oldest version that has all that is in the scene.
int version_of(const Scene& scene) {
  const auto any = [&](const auto& has) {
    return std::ranges::any_of(scene.layers,
                               [&](const SharedLayer& layer) { return has(layer->deformation); });
  };
  if (any([](const Deformation& d) {
        return d.frame != Frame::free || d.held_beyond || !d.rest.parts.empty();
      }))
    return kNewestVersion;
  if (std::ranges::any_of(scene.layers, [](const SharedLayer& layer) {
        return layer->image && (layer->image->mark || layer->image->corner != PixelPosition{} ||
                                layer->image->moved != PixelPosition{});
      }))
    return kNewestVersion;
  if (any([](const Deformation& d) { return !d.rest.starts.empty(); })) return kHoleVersion;
  return has_layers(scene) ? kLayeredVersion : kPlainVersion;
}

Error not_utf8() {
  return {ErrorKind::bad_input,
          "a file name is not UTF-8 and cannot be written to a scene; rename the file"};
}

}  // namespace

void check_texts(const Layer& layer) {
  std::vector<std::string> texts{layer.name};
  if (layer.image) texts.insert(texts.end(), {layer.image->file, layer.image->entry});
  if (layer.image && layer.image->mark) texts.push_back(layer.image->mark->name);
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
  document["version"] = version_of(scene);
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
