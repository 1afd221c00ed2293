// Elements are kept if their names are known, because unknown ones could do anything.
#include "scene/formats/svg_cleaning.h"

#include <functional>
#include <vector>

#include "scene/formats/svg_styles.h"
#include "system/text.h"

namespace holomorph {
namespace {

/// Calls visit(value, from) for each reference url(...) in a text; `from` is the position after the
/// parenthesis, quotes and blanks. Visit returns where to go on.
void for_each_url(std::string& value, const std::function<size_t(size_t)>& visit) {
  for (size_t at = 0; (at = value.find("url(", at)) != std::string::npos;) {
    at = value.find_first_not_of("\"' ", at + 4);
    if (at == std::string::npos) return;
    at = visit(at);
  }
}

bool is_href(const pugi::xml_attribute& attribute) {
  const std::string name = attribute.name();
  return name == "href" || name.ends_with(":href");
}

bool is_allowed_target(const pugi::xml_node& node, const std::string& target) {
  if (target.starts_with("#")) return true;
  if (local_name(node) == "a")
    return target.starts_with("https://") || target.starts_with("http://");
  return local_name(node) == "image" && target.starts_with("data:image/");
}

/// Replaces references to other files in a property by none.
void remove_other_files(std::string& value) {
  for (size_t at = 0; (at = value.find("url(", at)) != std::string::npos;) {
    const size_t target = value.find_first_not_of("\"' ", at + 4);
    const size_t end = value.find(')', at);
    if (target != std::string::npos && value[target] == '#') {
      at = target;
      continue;
    }
    value.replace(at, end == std::string::npos ? end : end + 1 - at, "none");
  }
}

/// What 100 % stands for in an attribute; none if its percentages are not those of the viewport.
std::optional<double> whole_of(const std::string& name, const Viewport& viewport) {
  static const std::set<std::string> kAcross{"x",     "x1", "x2", "cx",   "fx",
                                             "width", "dx", "rx", "refX", "markerWidth"},
      kDown{"y", "y1", "y2", "cy", "fy", "height", "dy", "ry", "refY", "markerHeight"},
      kBoth{"r", "fr"};
  if (kAcross.contains(name)) return viewport.width;
  if (kDown.contains(name)) return viewport.height;
  if (kBoth.contains(name)) return viewport.diagonal();
  return {};
}

/// A list of lengths with its percentages replaced.
std::string without_percentages(const std::string& list, double whole) {
  std::string text, word;
  const auto finish = [&] {
    const auto length = word.ends_with("%") ? length_of(word, whole) : std::nullopt;
    text += length ? number_text(*length) : word;
    word.clear();
  };
  for (const char c : list) {
    if (c == ' ' || c == ',') {
      finish();
      text += c;
    } else {
      word += c;
    }
  }
  finish();
  return text;
}

/// Whether an element's coordinates are fractions of a bounding box.
bool uses_bounding_box(const pugi::xml_node& node) {
  const std::string kind = local_name(node);
  const auto is_user_space = [&](const char* units) {
    return std::string(node.attribute(units).as_string()) == "userSpaceOnUse";
  };
  if (kind.ends_with("Gradient")) return !is_user_space("gradientUnits");
  if (kind == "pattern") return !is_user_space("patternUnits");
  if (kind == "filter") return !is_user_space("filterUnits");
  if (kind.starts_with("fe"))
    return std::string(node.parent().attribute("primitiveUnits").as_string()) ==
           "objectBoundingBox";
  return false;
}

void collect_references(const pugi::xml_node& node, std::set<std::string>& ids) {
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    std::string value = attribute.as_string();
    if (is_href(attribute) && value.starts_with("#")) ids.insert(value.substr(1));
    for_each_url(value, [&](size_t at) {
      if (value[at] == '#')
        ids.insert(value.substr(at + 1, value.find_first_of("\"' )", at) - at - 1));
      return at + 1;
    });
  }
  for (const pugi::xml_node& child : node.children()) collect_references(child, ids);
}

bool remove_unused(pugi::xml_node node, const std::set<std::string>& used) {
  bool removed = false;
  for (pugi::xml_node child = node.first_child(); child;) {
    const pugi::xml_node next = child.next_sibling();
    const std::string kind = local_name(child);
    if ((kind == "clipPath" || kind == "mask") && !used.contains(child.attribute("id").as_string()))
      removed = node.remove_child(child);
    else
      removed = remove_unused(child, used) || removed;
    child = next;
  }
  return removed;
}

}  // namespace

bool is_kept(const pugi::xml_node& node, std::set<std::string>& losses) {
  static const std::set<std::string> kKept{
      "a",        "circle",         "clipPath",  "defs",           "desc",
      "ellipse",  "filter",         "g",         "image",          "line",
      "marker",   "linearGradient", "mask",      "radialGradient", "meshgradient",
      "meshrow",  "meshrows",       "meshpatch", "path",           "pattern",
      "polygon",  "polyline",       "rect",      "stop",           "svg",
      "switch",   "symbol",         "text",      "textPath",       "title",
      "tref",     "tspan",          "use",       "view",           "hatch",
      "hatchpath"};
  const std::string kind = local_name(node);
  if (kKept.contains(kind) || kind.starts_with("fe")) return true;
  if (kind == "foreignObject") losses.insert("its embedded pages are left out");
  if (kind.starts_with("animate") || kind == "set") losses.insert("its animation is left out");
  if (kind == "style") losses.insert("its own fonts are left out");
  return false;
}

void clean_attributes(pugi::xml_node node, std::set<std::string>& losses) {
  for (pugi::xml_attribute attribute = node.first_attribute(); attribute;) {
    const pugi::xml_attribute next = attribute.next_attribute();
    const std::string name = lower_case(attribute.name());
    std::string value = attribute.as_string();
    if (is_href(attribute) && !is_allowed_target(node, trimmed(value))) {
      if (local_name(node) == "image") losses.insert("its linked pictures are left out");
      node.remove_attribute(attribute);
    } else if (name.starts_with("on") || name == "xml:base") {
      node.remove_attribute(attribute);
    } else if (value.find("url(") != std::string::npos) {
      remove_other_files(value);
      attribute.set_value(value.c_str());
    }
    attribute = next;
  }
}

void clean(pugi::xml_node node, std::set<std::string>& losses) {
  for (pugi::xml_node child = node.first_child(); child;) {
    const pugi::xml_node next = child.next_sibling();
    if (child.type() == pugi::node_element) {
      if (is_kept(child, losses))
        clean(child, losses);
      else
        node.remove_child(child);
    }
    child = next;
  }
  clean_attributes(node, losses);
}

std::string href_of(const pugi::xml_node& node) {
  return node.attribute("href").as_string(node.attribute("xlink:href").as_string());
}

void resolve_percentages(pugi::xml_node node, const Viewport& viewport) {
  for (const char* property : {"stroke-width", "stroke-dasharray", "stroke-dashoffset"}) {
    const std::string value = property_of(node, property);
    if (value.find('%') != std::string::npos)
      set_property(node, property, without_percentages(value, viewport.diagonal()));
  }
  if (uses_bounding_box(node)) return;
  for (pugi::xml_attribute attribute : node.attributes()) {
    const std::string value = attribute.as_string();
    const auto whole = whole_of(attribute.name(), viewport);
    if (whole && value.find('%') != std::string::npos)
      attribute.set_value(without_percentages(value, *whole).c_str());
  }
}

void prefix_ids(pugi::xml_node node, const std::string& prefix) {
  for (pugi::xml_attribute attribute : node.attributes()) {
    std::string value = attribute.as_string();
    if (std::string(attribute.name()) == "id")
      value = prefix + value;
    else if (is_href(attribute) && value.starts_with("#"))
      value = "#" + prefix + value.substr(1);
    else
      for_each_url(value, [&](size_t at) {
        if (value[at] == '#') value.insert(at + 1, prefix);
        return at + 1;
      });
    if (value != attribute.as_string()) attribute.set_value(value.c_str());
  }
  for (const pugi::xml_node& child : node.children()) prefix_ids(child, prefix);
}

void remove_unused_clipping(pugi::xml_node root) {
  constexpr int kMostRounds = 4;  // what is removed may have been the only one to refer to others
  for (int round = 0; round < kMostRounds; ++round) {
    std::set<std::string> used;
    collect_references(root, used);
    if (!remove_unused(root, used)) return;
  }
}

}  // namespace holomorph
