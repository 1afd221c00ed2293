// Draws a textured surface in space.
#pragma once

#include "core/maps/heat.h"
#include "core/mesh/surface.h"
#include "render/program.h"

namespace holomorph {

/// The camera and the colors of one frame. Matrices multiply homogeneous points from the left.
struct SurfaceFrame {
  int width = 1, height = 1;  ///< size of the render target in pixels
  Eigen::Matrix4d to_view;    ///< rigid motion into view space; the camera looks along -z
  Eigen::Matrix4d to_clip;    ///< from view space to clip space
  unsigned texture = 0;       ///< OpenGL texture with mipmaps, premultiplied; if 0, only clay
  Color background, clay;     ///< behind the surface, and on it where the texture is transparent
};

/// Owns the OpenGL objects of one surface. Needs a current OpenGL context.
class SurfaceRenderer {
 public:
  SurfaceRenderer();
  ~SurfaceRenderer();
  SurfaceRenderer(const SurfaceRenderer&) = delete;
  SurfaceRenderer& operator=(const SurfaceRenderer&) = delete;

  void set_surface(const Surface& surface);
  /// Sets the texture coordinates of the vertices: 0 to 1 in both directions, v up.
  void set_coordinates(const Points& coordinates);
  /// Clears the bound framebuffer and draws both sides of the surface, with a light that moves with
  /// the camera.
  void draw(const SurfaceFrame& frame);

 private:
  Program program_ = surface_program();
  unsigned array_ = 0, positions_ = 0, normals_ = 0, coordinates_ = 0, triangles_ = 0;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();  ///< vertices are stored relative to it
  int vertex_count_ = 0, index_count_ = 0;
};

}  // namespace holomorph
