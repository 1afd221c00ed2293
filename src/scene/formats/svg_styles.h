// Style sheets and style attributes of SVG documents.
#pragma once

#include <string>

#include <pugixml.hpp>

namespace holomorph {

/// Writes the declarations of all style sheets into the attribute `style` of the elements that they
/// apply to, and removes the sheets, except at-rules such as @font-face. Selectors of types,
/// classes and ids are supported, and their combination by descent. Returns whether there were
/// others, which are left out. Throws Error{bad_input} if there are too many rules. Cost: rules
/// times elements.
bool inline_style_sheets(pugi::xml_node root, const std::string& name);

/// The value of a property of an element alone: from its style or, if `name` is also an attribute,
/// from there. Empty if there is none.
std::string property_of(const pugi::xml_node& node, const std::string& name);
/// The value that the element has or inherits. Empty if there is none.
std::string inherited_property(pugi::xml_node node, const std::string& name);
/// Sets a property in the element's style. An empty value removes it everywhere.
void set_property(pugi::xml_node node, const std::string& name, const std::string& value);

/// The id in url(#id); empty if the value is something else.
std::string id_in_url(const std::string& value);
/// An element's name without its namespace.
std::string local_name(const pugi::xml_node& node);

}  // namespace holomorph
