// Warps a picture by a mesh, on all processor cores. This code computes all exported pixels.
#pragma once

#include <optional>

#include "core/geometry/similarity.h"
#include "core/maps/heat.h"
#include "core/mesh/mesh.h"
#include "scene/formats/image.h"

namespace holomorph {

/// What to draw. The mesh's vertices move to `positions`; `source` is sampled once, at rest
/// coordinates. The picture outside the rest cage does not move.
struct RasterJob {
  const Mesh* mesh = nullptr;          ///< if null, only the source is drawn
  std::span<const Complex> positions;  ///< one per mesh vertex
  /// A mesh below the first one, for pictures only, with one position per vertex. The picture
  /// outside the rest cage is then drawn by it alone.
  const Mesh* fringe = nullptr;
  std::span<const Complex> fringe_positions;
  const Image* source = nullptr;  ///< may be null for heat maps and checkers
  /// The rectangle that the source fills; if not set, that of its pixels, each one unit wide.
  std::optional<Box> box;
  View view = View::image;
  Eigen::VectorXd heat;  ///< one value per mesh vertex, for heat views
  HeatScale scale;
  double pixels_per_unit = 1;  ///< output pixels per unit of the plane
  bool surroundings = true;    ///< also draw the source outside the rest cage
  Similarity placement = {};   ///< moves everything that is drawn
  /// What lies beyond the page is shown where it comes into this part of the plane.
  std::optional<Box> stage;
  bool crop = false;          ///< crop to the source's page; otherwise crop nothing
  std::optional<Box> region;  ///< draw exactly this part of the plane, rounded to whole pixels
  std::optional<double> top;  ///< y of the top of pixel row 0; if not set, the page's top
  bool fine = false;          ///< the result has fine pixels
  int threads = 0;            ///< if 0, one per processor core

  /// The rectangle of the source in the plane; zero without a source.
  Box source_box() const { return source ? box.value_or(source->box()) : Box{0, 0, 0, 0}; }
  /// The rectangle that the result shows even where the source is transparent.
  Box page() const { return source ? box.value_or(source->page()) : Box{0, 0, 0, 0}; }
};

/// A picture and the position of its lower left corner in the plane.
struct RasterResult {
  Image image;
  Complex corner;
};

/// Draws a job. Colors are interpolated bilinearly in premultiplied form, with up to 8 x 8 samples
/// per pixel where the map shrinks. The edges of the cage's image are antialiased by 4 x 4 coverage
/// samples. Triangles are drawn in mesh order, later ones on top. The identity map reproduces the
/// source bit for bit. Fine pixels are computed by portable code. Throws Error{bad_input} if the
/// result would be empty or have more than 16384 pixels on a side, or if fine pixels would exceed
/// the budget for pixels. Cost with AVX2: about 20 ns per
/// pixel of the cage's image on one core.
RasterResult rasterized(const RasterJob& job);

}  // namespace holomorph
