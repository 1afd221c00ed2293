// Drawing programs put namespaces into entities, which pugixml does not replace.
#include "scene/formats/svg_document.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/gzip.h"
#include "scene/formats/svg_styles.h"
#include "system/text.h"

namespace holomorph {
namespace {

/// Throws Error if groups are nested deeper than the budget allows.
void check_levels(pugi::xml_document& document, const std::string& name) {
  struct Deepest : pugi::xml_tree_walker {  // does not recurse
    bool for_each(pugi::xml_node&) override {
      levels = std::max(levels, depth());
      return true;
    }
    int levels = 0;
  } deepest;
  document.traverse(deepest);
  check_budget(&Budget::groups, deepest.levels, name + ": its groups have");
}

/// The text with entities that its document type declares replaced by their values. Values may not
/// contain other entities, so the text cannot explode.
std::string with_entities(const std::string& text, const std::string& name) {
  constexpr size_t kLongest = size_t{256} << 20;
  const size_t type = text.find("<!DOCTYPE");
  if (type == std::string::npos) return text;
  const size_t open = text.find_first_of("[>", type);
  if (open == std::string::npos || text[open] == '>') return text;
  const size_t close = std::min(text.find("]", open), text.size());
  std::map<std::string, std::string, std::less<>> entities;
  const std::string declared = text.substr(open, close - open);
  for (size_t at = 0; (at = declared.find("<!ENTITY", at)) != std::string::npos;) {
    at += 8;
    const size_t from = declared.find_first_not_of(" \t\r\n", at);
    const size_t to = declared.find_first_of(" \t\r\n", from);
    const size_t quote = declared.find_first_of("\"'>", to);
    if (quote == std::string::npos) break;
    if (declared[quote] == '>') continue;
    const size_t end = declared.find(declared[quote], quote + 1);
    if (end == std::string::npos) break;
    const std::string value = declared.substr(quote + 1, end - quote - 1);
    if (value.find_first_of("&<") == std::string::npos)
      entities.emplace(declared.substr(from, to - from), value);
    at = end;
  }
  std::string result = text.substr(0, type);
  size_t at = text.find('>', close);
  at = at == std::string::npos ? text.size() : at + 1;
  while (at < text.size()) {
    const size_t next = std::min(text.find('&', at), text.size());
    result.append(text, at, next - at);
    at = next;
    if (at == text.size()) break;
    constexpr size_t kLongestName = 64;
    const std::string_view name_on = std::string_view(text).substr(at + 1, kLongestName);
    const size_t end = name_on.find(';');
    const auto entity =
        end == std::string_view::npos ? entities.end() : entities.find(name_on.substr(0, end));
    result += entity == entities.end() ? "&" : entity->second;
    at += entity == entities.end() ? 1 : end + 2;
    if (result.size() > kLongest)
      throw Error(ErrorKind::bad_input, name + ": its entities make it too long");
  }
  return result;
}

void include_extent(Box& box, const pugi::xml_node& node, const Affine& map,
                    const Viewport& viewport) {
  static const std::set<std::string> kUnseen{"defs",    "clipPath", "mask",         "marker",
                                             "pattern", "symbol",   "foreignObject"};
  if (kUnseen.contains(local_name(node))) return;
  if (is_shape(node)) include(box, path_of_shape(node, viewport), map);
  if (local_name(node) == "image") {
    const auto length = [&](const char* name, double whole) {
      return length_of(node.attribute(name).as_string(), whole).value_or(0);
    };
    const Complex corner(length("x", viewport.width), length("y", viewport.height)),
        size(length("width", viewport.width), length("height", viewport.height));
    for (const Complex by : {Complex(0), Complex(size.real(), 0), size, Complex(0, size.imag())})
      box.include(map(corner + by));
  }
  for (const pugi::xml_node& child : node.children())
    include_extent(box, child, composed(map, transform_of(child)), viewport);
}

/// Includes the lines of a text. `pen` is where the next letter is drawn.
void include_text(Box& box, const pugi::xml_node& node, Complex& pen, const Viewport& viewport) {
  const auto first = [&](const char* name, double whole, double otherwise) {
    const std::string all = node.attribute(name).as_string();
    return length_of(all.substr(0, all.find_first_of(" ,")), whole).value_or(otherwise);
  };
  pen = {first("x", viewport.width, pen.real()), first("y", viewport.height, pen.imag())};
  const double usual = 16, size = length_of(inherited_property(node, "font-size")).value_or(usual);
  const std::string anchor = inherited_property(node, "text-anchor");
  const double before = anchor == "middle" ? 0.5 : anchor == "end" ? 1 : 0;
  for (const pugi::xml_node& child : node.children()) {
    if (child.type() == pugi::node_element) include_text(box, child, pen, viewport);
    if (child.type() != pugi::node_pcdata) continue;
    const std::string_view letters = child.value();
    const auto count = std::ranges::count_if(
        letters, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });  // UTF-8
    const double width = 0.5 * size * static_cast<double>(count);
    const Complex start = pen - before * width;
    box.include(start + Complex(0, 0.2 * size));
    box.include(start + Complex(width, -0.8 * size));
    pen += (1 - before) * width;
  }
}

void set_attribute(pugi::xml_node node, const char* name, const std::string& value) {
  node.remove_attribute(name);
  node.append_attribute(name).set_value(value.c_str());
}

void set_viewbox(pugi::xml_node root, const Box& box) {
  std::string text;
  for (const double x : {box.left, box.bottom, box.width(), box.height()})
    text += (text.empty() ? "" : " ") + number_text(x);
  set_attribute(root, "viewBox", text);
}

/// The drawing's own size: that of its attributes, or else of its viewBox or its content.
/// Afterwards, the drawing has a viewBox.
Viewport own_size(pugi::xml_node root) {
  const auto width = length_of(root.attribute("width").as_string()),
             height = length_of(root.attribute("height").as_string());
  if (!viewbox_of(root)) {
    if (width && height)
      set_viewbox(root, {0, 0, *width, *height});
    else
      set_viewbox(root, extent_of(root, {}));
  }
  const auto box = viewbox_of(root);
  if (width && height) return {*width, *height};
  if (!box) return {0, 0};
  if (width) return {*width, *width * box->height() / box->width()};
  if (height) return {*height * box->width() / box->height(), *height};
  return {box->width(), box->height()};
}

}  // namespace

std::string svg_text_of(const std::string& bytes, const std::string& name) {
  constexpr size_t kMost = size_t{64} << 20;
  return utf8_of_file(is_gzip(bytes) ? unpacked_gzip(bytes, name, kMost) : bytes);
}

pugi::xml_document xml_of(const std::string& text, const std::string& name) {
  pugi::xml_document document;
  const std::string replaced = with_entities(svg_text_of(text, name), name);
  const pugi::xml_parse_result result = document.load_buffer(
      replaced.data(), replaced.size(), pugi::parse_default | pugi::parse_ws_pcdata_single);
  if (!result)
    throw Error(ErrorKind::bad_input, name + ": not an SVG file: " + result.description());
  check_levels(document, name);
  return document;
}

Box extent_of(const pugi::xml_node& node, const Viewport& viewport) {
  Box box;
  include_extent(box, node, {}, viewport);
  return box;
}

Box extent_of_text(const pugi::xml_node& text, const Viewport& viewport) {
  Box box;
  Complex pen;
  include_text(box, text, pen, viewport);
  if (box.empty()) box.include(pen);
  return box;
}

SvgDocument svg_document_of(const std::string& text, const std::string& name, DrawingSize wanted) {
  constexpr double kSmall = 512, kEnlarged = 1024, kLongest = 4096;  // of the longer side
  SvgDocument document;
  document.name = name;
  document.xml = xml_of(text, name);
  pugi::xml_node root = document.root();
  if (local_name(root) != "svg") throw Error(ErrorKind::bad_input, name + ": not an SVG file");
  document.ignores_rules = inline_style_sheets(root, name);
  const Viewport size = own_size(root);
  const double longer = std::max(size.width, size.height);
  if (!(std::min(size.width, size.height) > 0) || !(longer < 1e9))
    throw Error(ErrorKind::bad_input, name + ": the drawing is empty or has no size");
  const double scale = wanted == DrawingSize::own ? 1
                       : longer < kSmall          ? kEnlarged / longer
                                                  : std::min(1.0, kLongest / longer);
  document.width = size.width;
  document.height = size.height;
  document.columns = std::max(1, static_cast<int>(std::lround(scale * size.width)));
  document.rows = std::max(1, static_cast<int>(std::lround(scale * size.height)));
  set_attribute(root, "width", std::to_string(document.columns));
  set_attribute(root, "height", std::to_string(document.rows));
  const auto box = viewbox_of(root);
  if (!box) throw Error(ErrorKind::bad_input, name + ": the drawing is empty or has no size");
  document.viewport = {box->width(), box->height()};
  document.placement = viewbox_map(root, 0, {double(document.columns), double(document.rows)});
  return document;
}

}  // namespace holomorph
