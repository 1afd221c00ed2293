// Lengths, transforms and basic shapes of SVG.
#pragma once

#include <optional>
#include <string>

#include <pugixml.hpp>

#include "core/geometry/affine.h"
#include "scene/formats/path_data.h"

namespace holomorph {

/// The size of the viewport to which percentages refer, in user units.
struct Viewport {
  double width = 100, height = 100;
  double diagonal() const;  ///< divided by sqrt 2
};

/// A length in user units, of 1/96 inch where it has an absolute unit. `whole` is what 100 %
/// stands for; without it, a percentage is none. None if the text is not a length.
std::optional<double> length_of(const std::string& text, std::optional<double> whole = {});

/// The map of the attribute or property `transform`; the identity if there is none, or if it is
/// damaged.
Affine transform_of(const pugi::xml_node& node);
/// The map of a list of transforms, such as "rotate(30) scale(2)".
Affine transform_of(const std::string& text);
/// A number with 9 significant digits, in any locale.
std::string number_text(double x);
/// The text matrix(...) of a map.
std::string matrix_text(const Affine& map);

/// The map from the coordinates inside an element with a viewBox to those in which it has a corner
/// and a size (SVG 2, 8.2 and 8.6).
Affine viewbox_map(const pugi::xml_node& node, Complex corner, const Viewport& size);
/// The rectangle of the attribute `viewBox`; none if it is missing or empty.
std::optional<Box> viewbox_of(const pugi::xml_node& node);

/// Whether an element is a path, a rectangle, a circle, an ellipse, a line or a polygon.
bool is_shape(const pugi::xml_node& node);
/// The outline of a shape in its own user units, y down, as far as it is not damaged.
std::vector<Subpath> path_of_shape(const pugi::xml_node& node, const Viewport& viewport);
/// Includes the points of a path, moved by a map, in a box.
void include(Box& box, const std::vector<Subpath>& path, const Affine& map = {});
/// Makes a path of a shape, without its attributes of other shapes.
void become_path(pugi::xml_node shape, const std::string& data);

}  // namespace holomorph
