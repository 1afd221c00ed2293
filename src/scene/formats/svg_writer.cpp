// A base and the layers that are clipped to it form a group. They are drawn on an opaque copy of
// the base, and the mask of the group is a white copy of it.
#include "scene/formats/svg_writer.h"

#include <algorithm>

#include "scene/formats/svg_shapes.h"

namespace holomorph {
namespace {

std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
    };
    const unsigned three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += c;
  }
  return safe;
}

/// The name of a blending mode in CSS.
std::string css_name(Blending blending) {
  return blending == Blending::add ? "plus-lighter" : kBlendingNames[static_cast<size_t>(blending)];
}

/// The attributes for how a group is composited with what is below it.
std::string ink_of(const DrawnLayer& layer) {
  std::string style;
  if (!layer.visible) style += "display:none;";
  if (layer.opacity < 1) style += "opacity:" + number_text(layer.opacity) + ";";
  if (layer.blending != Blending::normal)
    style += "mix-blend-mode:" + css_name(layer.blending) + ";";
  return style.empty() ? "" : " style=\"" + style + "\"";
}

std::string named_group(const DrawnLayer& layer) {
  return "<g inkscape:groupmode=\"layer\" inkscape:label=\"" + escaped(name_for_xml(layer.name)) +
         "\"";
}

std::string content_of(const DrawnLayer& layer) {
  if (!layer.drawing.empty()) return layer.drawing;
  if (layer.image.width == 0 || layer.image.height == 0) return "";
  return "<image x=\"" + std::to_string(layer.left) + "\" y=\"" + std::to_string(layer.top) +
         "\" width=\"" + std::to_string(layer.image.width) + "\" height=\"" +
         std::to_string(layer.image.height) + "\" xlink:href=\"data:image/png;base64," +
         base64(encode_png(layer.image)) + "\"/>";
}

/// A filter that multiplies colors and alpha by a matrix.
std::string color_filter(const std::string& name, const std::string& matrix,
                         const std::string& everywhere) {
  return "<filter id=\"" + name + "\" filterUnits=\"userSpaceOnUse\"" + everywhere +
         " color-interpolation-filters=\"sRGB\"><feColorMatrix values=\"" + matrix +
         "\"/></filter>";
}

/// The mask with which layers are clipped to the content of a base.
std::string mask_of(const std::string& base, const std::string& everywhere) {
  return "<mask id=\"mask-" + base + "\" maskUnits=\"userSpaceOnUse\"" + everywhere +
         "><use xlink:href=\"#" + base + "\" filter=\"url(#white)\"/></mask>\n";
}

/// Layers from bottom to top, each base with what is clipped to it.
std::string stack_of(const std::vector<DrawnLayer>& layers, const std::string& everywhere) {
  std::string svg;
  for (size_t i = 0; i < layers.size();) {
    size_t end = i + 1;
    while (end < layers.size() && layers[end].clipped) ++end;
    svg += named_group(layers[i]) + ink_of(layers[i]) + ">\n";
    if (end == i + 1) {
      svg += content_of(layers[i]) + "\n";
    } else {
      const std::string base = "base-" + std::to_string(i);
      const std::string mask = " mask=\"url(#mask-" + base + ")\"";
      svg += mask_of(base, everywhere) + "<g" + mask + "><g filter=\"url(#opaque)\"><g id=\"" +
             base + "\">" + content_of(layers[i]) + "</g></g>\n";
      for (size_t k = i + 1; k < end; ++k)
        svg += named_group(layers[k]) + ink_of(layers[k]) + ">" + content_of(layers[k]) + "</g>\n";
      svg += "</g>\n";
    }
    svg += "</g>\n";
    i = end;
  }
  return svg;
}

}  // namespace

std::string encode_svg(const LayeredPicture& picture) {
  const std::string width = std::to_string(picture.merged.width),
                    height = std::to_string(picture.merged.height),
                    size = " width=\"" + width + "\" height=\"" + height + "\"",
                    everywhere = " x=\"0\" y=\"0\"" + size;
  const auto own_length = [&](int pixels) { return number_text(picture.pixel_size * pixels); };
  std::string svg =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" width=\"";
  svg += own_length(picture.merged.width) + "\" height=\"" + own_length(picture.merged.height) +
         "\" viewBox=\"0 0 " + width + " " + height + "\">\n";
  const std::vector<DrawnLayer>& layers = picture.layers;
  if (std::ranges::any_of(layers, &DrawnLayer::clipped))
    svg += "<defs>" + color_filter("white", "0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0", everywhere) +
           color_filter("opaque", "1 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 0 255 0", everywhere) +
           "</defs>\n";
  if (picture.background) {
    char color[8];
    const auto& [r, g, b] = *picture.background;
    std::snprintf(color, sizeof color, "#%02x%02x%02x", r, g, b);
    svg += "<rect" + size + " fill=\"" + color + "\"/>\n";
  }
  for (const DrawnLayer& original : picture.originals)
    svg += named_group(original) + ">\n" + content_of(original) + "\n</g>\n";
  return svg + "<g style=\"isolation:isolate\">\n" + stack_of(layers, everywhere) +
         "</g>\n</svg>\n";
}

}  // namespace holomorph
