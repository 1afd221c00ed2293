// The one place that makes exported pixels: a picture warped by a mesh, on all processor cores.
#pragma once

#include <optional>

#include "core/maps/heat.h"
#include "core/mesh/mesh.h"
#include "scene/formats/image.h"

namespace holomorph {

/// What to draw. The mesh's vertices are taken to `positions`; `source` is sampled once, at rest
/// coordinates. What lies outside the rest cage stays where it is.
struct RasterJob {
  const Mesh* mesh = nullptr;          ///< null: the source alone
  std::span<const Complex> positions;  ///< per mesh vertex
  const Image* source = nullptr;       ///< may be null for heat maps and checkers
  View view = View::image;
  Eigen::VectorXd heat;  ///< per mesh vertex, for heat views
  HeatScale scale;
  double pixels_per_unit = 1;  ///< output pixels per image pixel
  bool surroundings = true;    ///< draw the source outside the rest cage, too
  bool crop = false;           ///< keep the source's rectangle; else nothing is cut off
  std::optional<Box> shows;    ///< exactly this part of the plane, in whole pixels around it
  std::optional<double> top;   ///< where rows of pixels count from; the source's height
  int threads = 0;             ///< 0: as many as the machine has cores
};

/// A picture and where its lower left corner lies in the plane.
struct RasterResult {
  Image image;
  Complex corner;
};

/// Draws. Bilinear in premultiplied colour with up to 8 x 8 samples where pixels shrink, edges of
/// the cage's image antialiased by coverage (4 x 4), triangles in mesh order, later ones on top.
/// A map that moves nothing gives the source back bit for bit.
/// Throws Error{bad_input} when the result would be larger than 16384 pixels a side, or empty.
/// Cost: about 10 ns per pixel and core.
RasterResult rasterized(const RasterJob& job);

}  // namespace holomorph
