// Gradients and patterns of SVG.
#pragma once

#include <functional>
#include <string>

#include <pugixml.hpp>

#include "core/types.h"

namespace holomorph {

/// Finds an element by its id; null if there is none.
using ElementById = std::function<pugi::xml_node(const std::string& id)>;

/// A gradient or pattern, as an element's paint refers to it.
class PaintServer {
 public:
  /// `paint` is the value of the property `fill` or `stroke`.
  PaintServer(const std::string& paint, const ElementById& find);

  bool is_gradient() const;
  bool is_pattern() const;
  /// Whether its coordinates are fractions of the shape's bounding box.
  bool uses_bounding_box() const;
  /// The paint that SVG prescribes if this one cannot be used.
  std::string fallback() const;
  /// Whether the coordinates of a pattern's content are such fractions, too.
  bool has_content_in_box() const {
    return attribute("patternContentUnits") == "objectBoundingBox";
  }

  /// Appends a copy in the user units of a shape with this bounding box. The box of a shape for
  /// gradients must not be flat.
  void append_in_user_units(pugi::xml_node definitions, const std::string& id,
                            const Box& box) const;

 private:
  std::string attribute(const char* name) const;
  double number(const char* name, const std::string& otherwise) const;
  void set_gradient(pugi::xml_node own, const Box& box) const;
  void set_pattern(pugi::xml_node own, const Box& box) const;

  std::string paint_;
  const ElementById& find_;
  pugi::xml_node node_;
};

}  // namespace holomorph
