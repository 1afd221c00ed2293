// Layers whose pictures are SVG drawings, as bent drawings.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/similarity.h"
#include "scene/formats/image.h"
#include "scene/scene.h"

namespace holomorph {

/// An SVG drawing and the picture that stands for it.
struct SourceDrawing {
  std::string text, name;  ///< the name of its file, for messages
  const Image& image;
};

/// The size of a pixel of a drawing's picture, in units of 1/96 inch: 1 if the picture has the
/// drawing's own size. Throws Error.
double pixel_size_of(const SourceDrawing& drawing);

/// Where a drawing goes.
struct DrawingPlace {
  Similarity to_canvas;  ///< from the layer's plane to pixels of the canvas, y up
  double height = 0;     ///< of the canvas, in pixels
  std::string prefix;    ///< of all ids
};

/// The element <g> of a layer's drawing, bent by the layer's map at a time, within 0.05 pixels of
/// the canvas. Without a time, it is bent by the map of the layer's own pose. Solid parts of the
/// picture outside the cage stay where they are; all else is clipped by the posed cage. Where the
/// bent drawing overlaps itself, shapes keep their order. Appends messages about what is lost.
/// Calls `keep_going` on this thread from time to time; an exception from it ends the work and is
/// rethrown. Throws Error.
std::string layer_drawing(const SourceDrawing& drawing, const Deformation& deformation,
                          bool linear_blend, const std::optional<double>& time,
                          const DrawingPlace& place, std::vector<std::string>& losses,
                          const std::function<void()>& keep_going);

/// The same for a drawing that is not bent.
std::string placed_drawing(const SourceDrawing& drawing, const DrawingPlace& place,
                           std::vector<std::string>& losses);

}  // namespace holomorph
