// Attributes that are missing are those of the element to which `href` refers (SVG 2, 14.1).
#include "scene/formats/svg_paint.h"

#include "scene/formats/svg_cleaning.h"
#include "scene/formats/svg_shapes.h"
#include "scene/formats/svg_styles.h"
#include "system/text.h"

namespace holomorph {

PaintServer::PaintServer(const std::string& paint, const ElementById& find)
    : paint_(paint), find_(find) {
  const std::string id = id_in_url(paint);
  if (!id.empty()) node_ = find(id);
}

bool PaintServer::is_gradient() const {
  const std::string kind = node_ ? local_name(node_) : "";
  return kind == "linearGradient" || kind == "radialGradient";
}

bool PaintServer::is_pattern() const {
  return node_ && local_name(node_) == "pattern";
}

bool PaintServer::uses_bounding_box() const {
  return attribute(is_pattern() ? "patternUnits" : "gradientUnits") != "userSpaceOnUse";
}

std::string PaintServer::fallback() const {
  const size_t end = paint_.find(')');
  const std::string rest = end == std::string::npos ? "" : trimmed(paint_.substr(end + 1));
  return rest.empty() ? "none" : rest;
}

std::string PaintServer::attribute(const char* name) const {
  constexpr int kLongestChain = 32;
  pugi::xml_node from = node_;
  for (int k = 0; k < kLongestChain && from; ++k) {
    if (from.attribute(name)) return from.attribute(name).as_string();
    const std::string next = href_of(from);
    from = next.starts_with("#") ? find_(next.substr(1)) : pugi::xml_node();
  }
  return "";
}

double PaintServer::number(const char* name, const std::string& otherwise) const {
  const std::string text = attribute(name);
  return length_of(text.empty() ? otherwise : text, 1).value_or(0);
}

void PaintServer::append_in_user_units(pugi::xml_node definitions, const std::string& id,
                                       const Box& box) const {
  pugi::xml_node own = definitions.append_child(local_name(node_).c_str());
  own.append_attribute("id").set_value(id.c_str());
  own.append_attribute("xlink:href")
      .set_value((std::string("#") + node_.attribute("id").as_string()).c_str());
  if (is_pattern())
    set_pattern(own, box);
  else
    set_gradient(own, box);
}

void PaintServer::set_gradient(pugi::xml_node own, const Box& box) const {
  own.append_attribute("gradientUnits").set_value("userSpaceOnUse");
  const Affine map =
      composed(affine_of_matrix(box.width(), 0, 0, box.height(), box.left, box.bottom),
               transform_of(attribute("gradientTransform")));
  own.append_attribute("gradientTransform").set_value(matrix_text(map).c_str());
  const auto set = [&](const char* name, const std::string& otherwise) {
    own.append_attribute(name).set_value(number_text(number(name, otherwise)).c_str());
  };
  if (local_name(node_) == "linearGradient") {
    for (const char* name : {"x1", "y1", "y2"}) set(name, "0");
    set("x2", "1");
    return;
  }
  for (const char* name : {"cx", "cy", "r"}) set(name, "0.5");
  for (const auto& [name, center] : {std::pair{"fx", "cx"}, {"fy", "cy"}})
    set(name, attribute(center).empty() ? "0.5" : attribute(center));
}

void PaintServer::set_pattern(pugi::xml_node own, const Box& box) const {
  own.append_attribute("patternUnits").set_value("userSpaceOnUse");
  const auto set = [&](const char* name, double value) {
    own.append_attribute(name).set_value(number_text(value).c_str());
  };
  set("x", box.left + number("x", "0") * box.width());
  set("y", box.bottom + number("y", "0") * box.height());
  set("width", number("width", "0") * box.width());
  set("height", number("height", "0") * box.height());
}

}  // namespace holomorph
