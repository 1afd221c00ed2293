// An OpenRaster file is a ZIP archive. It contains a description of the layers and a PNG file for
// each layer. Sizes from the file are checked before memory is allocated.
#include "scene/formats/ora_image.h"

#include <zip.h>

#include <cstring>
#include <memory>

#include <pugixml.hpp>

#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/image_formats.h"
#include "system/text.h"

namespace holomorph {
namespace {

constexpr zip_uint64_t kLargestEntry = 512u << 20;
constexpr zip_uint64_t kLargestDescription = 4u << 20;
constexpr int kDeepestGroup = 50;   ///< levels of groups
constexpr int kFarthest = 1 << 20;  ///< offset of a layer from the canvas's corner

struct BlendingMode {
  const char* name;
  Blending blending;
};
constexpr BlendingMode kModes[] = {{"svg:src-over", Blending::normal},
                                   {"svg:multiply", Blending::multiply},
                                   {"svg:screen", Blending::screen},
                                   {"svg:overlay", Blending::overlay},
                                   {"svg:plus", Blending::add}};

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw Error(ErrorKind::bad_input, name + ": the OpenRaster file is damaged: " + what);
}

class Archive {
 public:
  Archive(const std::string& bytes, const std::string& name) : name_(name) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source) zip_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
    if (source && !zip_) zip_source_free(source);
    zip_error_fini(&error);
    if (!zip_) fail(name_, "it is not a ZIP archive");
  }

  Image picture(const std::string& entry, PixelBudget& pixels) const {
    const std::string bytes = read(entry), name = name_ + ", " + entry;
    if (is_png(bytes)) return decode_png(bytes, name, pixels, PixelDepth::eight_bits);
    if (is_svg(bytes)) return decode_svg(bytes, name, pixels, DrawingSize::own);
    fail(name_, entry + " is neither a PNG file nor a drawing");
  }

  std::string read(const std::string& entry, zip_uint64_t most = kLargestEntry) const {
    zip_stat_t stat;
    zip_stat_init(&stat);
    if (zip_stat(zip_.get(), entry.c_str(), 0, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE))
      fail(name_, entry + " is missing");
    if (stat.size > most) fail(name_, entry + " is too large");
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(
        zip_fopen(zip_.get(), entry.c_str(), 0), zip_fclose);
    if (!file) fail(name_, entry + " cannot be read");
    std::string bytes(stat.size, '\0');
    if (zip_fread(file.get(), bytes.data(), stat.size) != static_cast<zip_int64_t>(stat.size))
      fail(name_, entry + " ends too early");
    return bytes;
  }

 private:
  std::string name_;
  std::unique_ptr<zip_t, void (*)(zip_t*)> zip_{nullptr, zip_discard};
};

struct Placed {
  FileLayer layer;
  int x = 0, y = 0;        ///< the layer's upper left corner on the canvas
  bool has_below = false;  ///< there is something below its group
};
struct Stack {
  int width = 0, height = 0;
  std::vector<Placed> layers;  ///< from top to bottom, as in the file
  ImportReport report;
};

int offset(const pugi::xml_node& node, const char* name) {
  return std::clamp(node.attribute(name).as_int(), -kFarthest, kFarthest);
}

constexpr const char* kNormalMode = "svg:src-over";

/// Whether the layers of a group blend with each other alone.
bool is_isolated(const pugi::xml_node& group) {
  return std::string(group.attribute("isolation").as_string()) == "isolate" ||
         group.attribute("opacity").as_double(1) < 1 ||
         std::string(group.attribute("composite-op").as_string(kNormalMode)) != kNormalMode;
}

/// Whether a layer in a group, or in groups in it, has a blending mode.
bool blends_inside(const pugi::xml_node& group) {
  return group.find_node([](const pugi::xml_node& node) {
    return std::string(node.attribute("composite-op").as_string(kNormalMode)) != kNormalMode;
  });
}

bool next_element(pugi::xml_node node) {
  do node = node.next_sibling();
  while (node && node.type() != pugi::node_element);
  return !node.empty();
}

void collect(const pugi::xml_node& group, const Placed& inherited, int depth, Stack& stack) {
  if (depth > kDeepestGroup) {
    stack.report.add(inherited.layer.name,
                     "left out: what is in it, because groups are nested too deeply");
    return;
  }
  for (const pugi::xml_node& node : group.children()) {
    Placed here = inherited;
    here.layer.name +=
        (here.layer.name.empty() ? "" : "/") + std::string(node.attribute("name").as_string());
    here.layer.visible = inherited.layer.visible &&
                         std::string(node.attribute("visibility").as_string()) != "hidden";
    const std::string mode = node.attribute("composite-op").as_string(kNormalMode);
    const auto known = std::ranges::find(kModes, mode, &BlendingMode::name);
    const bool is_group = std::string(node.name()) == "stack";
    if (known == std::end(kModes) || (is_group && known->blending != Blending::normal))
      here.layer.lost = "its blending mode";
    else if (!is_group)
      here.layer.blending = known->blending;
    here.x = std::clamp(here.x + offset(node, "x"), -kFarthest, kFarthest);
    here.y = std::clamp(here.y + offset(node, "y"), -kFarthest, kFarthest);
    here.layer.opacity *= std::clamp(node.attribute("opacity").as_double(1), 0.0, 1.0);
    const bool has_below = inherited.has_below || next_element(node);
    if (is_group && has_below && is_isolated(node) && blends_inside(node))
      stack.report.add(here.layer.name, "left out: the blending of the group");
    here.has_below = has_below;
    if (is_group) collect(node, here, depth + 1, stack);
    if (is_group || node.type() != pugi::node_element) continue;
    here.layer.entry = node.attribute("src").as_string();
    const std::string kind = lower_case(Path(here.layer.entry).extension().string());
    if (std::string(node.name()) == "layer" && (kind == ".png" || kind == ".svg"))
      stack.layers.push_back(here);
    else
      stack.report.add(here.layer.name,
                       "left out: the whole layer, which is neither a PNG picture nor an SVG "
                       "drawing");
  }
}

Stack stack_of(const Archive& archive, const std::string& name) {
  const std::string text = archive.read("stack.xml", kLargestDescription);
  pugi::xml_document document;
  if (!document.load_buffer(text.data(), text.size())) fail(name, "stack.xml is not an XML file");
  const pugi::xml_node image = document.child("image");
  Stack stack{image.attribute("w").as_int(), image.attribute("h").as_int(), {}, {}};
  if (stack.width < 1 || stack.height < 1) fail(name, "its canvas is empty");
  PixelBudget one;
  one.take(static_cast<size_t>(stack.width), static_cast<size_t>(stack.height), name);
  collect(image.child("stack"), {}, 0, stack);
  if (stack.layers.empty()) fail(name, "it has no pixel layers");
  return stack;
}

}  // namespace

bool is_ora(const std::string& bytes) {
  // The first entry of the archive is the file's MIME type, stored without compression.
  return bytes.starts_with("PK\x03\x04") &&
         bytes.substr(0, 100).find("mimetypeimage/openraster") != std::string::npos;
}

Image decode_ora(const std::string& bytes, const std::string& name, PixelBudget& pixels) {
  return Archive(bytes, name).picture("mergedimage.png", pixels);
}

FileLayers ora_layers(const std::string& bytes, const std::string& name) {
  const Stack stack = stack_of(Archive(bytes, name), name);
  FileLayers all;
  all.report = stack.report;
  all.width = stack.width;
  all.height = stack.height;
  for (size_t i = stack.layers.size(); i-- > 0;) {
    const FileLayer& layer = stack.layers[i].layer;
    all.layers.push_back(layer);
    if (!layer.lost.empty()) all.report.add(layer.name, "left out: " + layer.lost);
  }
  return all;
}

Image decode_ora_layer(const std::string& bytes, const std::string& entry, const std::string& name,
                       PixelBudget& pixels) {
  const Archive archive(bytes, name);
  const Stack stack = stack_of(archive, name);
  const auto placed = std::ranges::find_if(
      stack.layers, [&](const Placed& each) { return each.layer.entry == entry; });
  if (placed == stack.layers.end()) fail(name, "its layer " + entry + " no longer exists");
  Image picture = archive.picture(entry, pixels);
  picture.left = placed->x;
  picture.bottom = stack.height - placed->y - picture.height;
  picture.canvas = Box{0, 0, double(stack.width), double(stack.height)};
  return picture;
}

}  // namespace holomorph
