// What a drawing may contain when it is written again.
#pragma once

#include <set>
#include <string>

#include <pugixml.hpp>

#include "scene/formats/svg_shapes.h"

namespace holomorph {

/// Whether an element draws something, or is needed for drawing or for reading: no script, no
/// animation, and nothing of another language than SVG. Otherwise appends what is lost, if that
/// can be seen.
bool is_kept(const pugi::xml_node& node, std::set<std::string>& losses);

/// Removes everything else from an element and its descendants; see is_kept(). Also removes
/// attributes that run scripts, and references to anything but elements of the drawing itself,
/// embedded pictures and, for the element `a`, web pages.
void clean(pugi::xml_node node, std::set<std::string>& losses);
/// The same for the attributes of one element.
void clean_attributes(pugi::xml_node node, std::set<std::string>& losses);

/// The target of the attribute `href`; empty if there is none.
std::string href_of(const pugi::xml_node& node);

/// Replaces the percentages of a viewport in an element's own attributes by lengths.
void resolve_percentages(pugi::xml_node node, const Viewport& viewport);

/// Puts a prefix before all ids of an element and its descendants, and in all references to them.
void prefix_ids(pugi::xml_node node, const std::string& prefix);
/// Removes clipping paths and masks that nothing refers to.
void remove_unused_clipping(pugi::xml_node root);

}  // namespace holomorph
