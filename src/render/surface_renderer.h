// A textured surface in space.
#pragma once

#include "core/maps/heat.h"
#include "core/mesh/surface.h"
#include "render/program.h"

namespace holomorph {

/// How a surface is looked at. Matrices take homogeneous points from the left.
struct SurfaceFrame {
  int width = 1, height = 1;  ///< px of what is drawn into
  Eigen::Matrix4d to_view;    ///< a motion; the camera looks along -z
  Eigen::Matrix4d to_clip;    ///< from there
  unsigned texture = 0;       ///< GL texture with mipmaps, premultiplied; 0: the clay alone
  Color background, clay;     ///< behind the surface; where nothing is on it
};

/// Owns the GL objects of one surface. Needs a current OpenGL context.
class SurfaceRenderer {
 public:
  SurfaceRenderer();
  ~SurfaceRenderer();
  SurfaceRenderer(const SurfaceRenderer&) = delete;
  SurfaceRenderer& operator=(const SurfaceRenderer&) = delete;

  void set_surface(const Surface& surface);
  /// Where each vertex is on the texture: 0 to 1 each way, v up.
  void set_coordinates(const Points& coordinates);
  /// Clears what is bound and draws, lit from the camera's side, both sides of the surface.
  void draw(const SurfaceFrame& frame);

 private:
  Program program_ = surface_program();
  unsigned array_ = 0, places_ = 0, normals_ = 0, coordinates_ = 0, triangles_ = 0;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();  ///< what is drawn is relative to it
  int vertex_count_ = 0, index_count_ = 0;
};

}  // namespace holomorph
