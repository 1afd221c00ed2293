// Pictures with layers: OpenRaster (Krita, GIMP, MyPaint), PSD (Photoshop and most others), and SVG
// drawings, which are only written.
#pragma once

#include "scene/formats/image.h"
#include "scene/formats/import_report.h"
#include "scene/scene.h"

namespace holomorph {

/// A layer of a file, without its pixels.
struct FileLayer {
  std::string name;   ///< with the names of its groups: "group/name"
  std::string entry;  ///< what identifies the layer in its file
  bool visible = true;
  double opacity = 1;  ///< of the layer and its groups
  Blending blending = Blending::normal;
  bool clipped = false;
  std::string lost = {};  ///< what cannot be kept, such as "its effects"; empty if nothing
};

/// The layers of a file from bottom to top, as a flat list without groups; empty if the file has
/// none.
struct FileLayers {
  std::vector<FileLayer> layers;
  ImportReport report;
  int width = 0, height = 0;  ///< of the canvas
};

/// Whether files with this name may have layers.
bool may_have_layers(const Path& file);
/// Throws Error{bad_input} if the file is damaged.
FileLayers layers_of_file(const std::string& bytes, const std::string& name);
/// Decodes one layer: the smallest picture that shows all of it, also what lies outside the canvas.
/// The canvas's lower left corner is the origin. A layer without content is one transparent pixel.
/// Throws Error{bad_input}, also if there is no layer with this entry.
Image decode_layer(const std::string& bytes, const std::string& entry, const std::string& name,
                   PixelBudget& pixels);

/// What a layer is like whose canvas has its lower left corner at the origin. The hash is the
/// SHA-256 of the size and the pixels of what is not transparent, in hexadecimal.
LayerMark mark_of(const Image& image, const std::string& name);

/// A layer that is written to a file.
struct DrawnLayer {
  std::string name;
  Image image;
  /// Instead of an image: the element <g> of an SVG file, in pixels of the canvas.
  std::string drawing = {};
  int left = 0, top = 0;  ///< of the image, in pixels from the upper left corner of the canvas
  bool visible = true;
  double opacity = 1;
  Blending blending = Blending::normal;
  bool clipped = false;
};
/// A picture with layers, from bottom to top. `merged` shows all of them together, and has the size
/// of the canvas.
struct LayeredPicture {
  std::vector<DrawnLayer> layers;
  Image merged;
  /// A color below the layers. Their blending modes do not mix with it, nor with the originals:
  /// where this matters, files have the layers in a group.
  std::optional<std::array<std::uint8_t, 3>> background = {};
  /// The pictures before bending, which lie below the layers; all of them are shown as they are.
  std::vector<DrawnLayer> originals = {};
  /// The size of a pixel in files that have a size, in units of 1/96 inch.
  double pixel_size = 1;
  /// What is not as in the scene, such as "Hat: its animation is left out".
  std::vector<std::string> losses = {};
};
/// The layer of the background's color.
DrawnLayer background_layer(const LayeredPicture& picture);
/// Whether the layers must be in a group so that they do not mix with what lies below them.
bool needs_group(const LayeredPicture& picture);

/// A name with spaces for what XML does not allow: control characters, U+FFFE and U+FFFF.
std::string name_for_xml(const std::string& name);

/// A file format with layers.
struct LayeredFormat {
  std::string id, label, extension;
  std::string (*encode)(const LayeredPicture& picture);
  bool keeps_drawings = false;  ///< layers may be drawings
};
/// PSD; OpenRaster, which has no clipping: clipped layers are cut to the shape of their base; and
/// SVG.
const std::vector<LayeredFormat>& layered_formats();
/// The format with this extension, or with this id; null if there is none.
const LayeredFormat* layered_format_of(const Path& file);
const LayeredFormat* layered_format_named(const std::string& id);

}  // namespace holomorph
