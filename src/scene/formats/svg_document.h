// An SVG file as a picture: its elements, and its size in pixels.
#pragma once

#include <string>

#include <pugixml.hpp>

#include "scene/formats/image_formats.h"
#include "scene/formats/svg_shapes.h"

namespace holomorph {

struct SvgDocument {
  pugi::xml_document xml;        ///< with a viewBox, and with the picture's size
  std::string name;              ///< of the file, for messages
  Viewport viewport;             ///< of the root element, in user units
  double width = 0, height = 0;  ///< the drawing's own size, at 96 pixels per inch
  int columns = 0, rows = 0;     ///< the size of the picture, in pixels
  Affine placement;              ///< from the root's user units to the picture's pixels, y down
  bool ignores_rules = false;    ///< there are style rules that are not supported

  pugi::xml_node root() const { return xml.document_element(); }
};

/// Reads an SVG file and applies its style sheets. With DrawingSize::own, the picture has the
/// drawing's own size. Otherwise, the longer side of small drawings (less than 512 pixels) becomes
/// 1024 pixels, and that of large ones 4096. A drawing without a size has that of its content.
/// Throws Error{bad_input} if it is not an SVG file, if it is nested too deeply, or if it has no
/// size. Cost: linear, and that of the style sheets.
SvgDocument svg_document_of(const std::string& text, const std::string& name,
                            DrawingSize size = DrawingSize::fit_for_work);

/// The text of an SVG file in UTF-8, from UTF-16 or gzip. Throws Error{bad_input}.
std::string svg_text_of(const std::string& bytes, const std::string& name);

/// Parses XML, with the entities that the file declares, from svg_text_of() the bytes. Throws
/// Error{bad_input} if it is damaged, nested too deeply, or if entities make it too long.
pugi::xml_document xml_of(const std::string& text, const std::string& name);

/// The bounding box of the shapes and pictures in an element, in its own user units, y down:
/// without its transform. Texts and copies (`use`) are left out. Empty if there are none.
Box extent_of(const pugi::xml_node& node, const Viewport& viewport);
/// About where a text is drawn, in its own user units, y down: letters are taken to be half as wide
/// as they are high.
Box extent_of_text(const pugi::xml_node& text, const Viewport& viewport);

}  // namespace holomorph
