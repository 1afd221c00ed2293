// Draws the warped picture in OpenGL 3.3: one mesh, one texture, one program per coloring. Handles
// and cages are drawn elsewhere.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/maps/heat.h"
#include "core/mesh/mesh.h"
#include "render/texture_levels.h"

namespace holomorph {

/// The driver of the current context, and whether it renders on the CPU. On a software driver,
/// multisampling and anisotropic filtering are not worth their cost, and vertex positions are
/// computed faster without a shader.
std::string driver_name();
bool is_software_driver();

/// Where the vertex positions come from.
enum class Placement { at_rest, positions, by_operator };

/// A tinted, half-transparent copy of the picture, drawn behind it.
struct Ghost {
  std::span<const Complex> positions;  ///< one per mesh vertex
  Color tint;
};

/// What to draw: the image of the picture under the map, the undeformed original, or only the
/// backdrop.
enum class Content { map, original, nothing };

/// The contents and settings of one frame of the canvas. In window pixels, x points right and y
/// points down.
struct RenderFrame {
  int window_width = 1, window_height = 1;                                      ///< framebuffer px
  double canvas_left = 0, canvas_top = 0, canvas_width = 1, canvas_height = 1;  ///< framebuffer px
  Complex center;    ///< plane point at the canvas's center
  double zoom = 1;   ///< framebuffer px per plane unit
  Complex turn = 1;  ///< rotates the plane around the center; its absolute value is 1
  View view = View::image;
  bool diverging = false;  ///< use the diverging colors for heat maps
  Placement placement = Placement::positions;
  bool wireframe = false;  ///< draw the mesh's edges over the picture
  std::vector<Ghost> ghosts = {};
  double from = 0, to = 1;  ///< draw only this part of the canvas's width, as fractions
  bool map_alone = false;   ///< draw only the mesh, opaque on a transparent canvas
  bool over = false;        ///< draw over the canvas: do not clear it, and draw no backdrop
  Content content = Content::map;
  Color background{0.2f, 0.2f, 0.2f};  ///< of the canvas
  Color backdrop{0.25f, 0.25f, 0.25f},
      other_backdrop{0.25f, 0.25f, 0.25f};  ///< of the checkerboard behind the picture
  double cell = 8;                          ///< width of its cells, framebuffer px
  double shadow = 0;       ///< standard deviation of the page's shadow, framebuffer px; 0: none
  float shadow_alpha = 0;  ///< its opacity
};

/// Owns the OpenGL objects. Needs a current OpenGL 3.3 core context during construction, calls and
/// destruction. The constructor throws Error{failed} if the context lacks a required feature;
/// `draw` and `placed_vertices` throw it if a shader does not compile on this driver.
class Renderer {
 public:
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Sets the picture: straight-alpha RGBA, rows from the top; 0 x 0 removes it. Returns the factor
  /// by which the picture was reduced for this driver, or 1 if it was not reduced.
  int set_picture(int width, int height, const std::uint8_t* pixels);
  /// Sets where the picture lies in the plane, and the rectangle that is drawn behind it. Pictures
  /// are set with their lower left corner at the origin, and with that rectangle their own.
  void place_picture(const Box& picture, const Box& page);
  /// Starts setting the picture in steps, which avoids delaying a frame. After the first call of
  /// upload_more, the picture is coarse; further calls add detail. Null removes the picture.
  void begin_picture(std::shared_ptr<const TextureLevels> levels);
  /// Uploads about this many bytes. Returns whether any are left.
  bool upload_more(size_t bytes);
  /// The largest side of a texture, in pixels.
  static int largest_side();
  /// Sets the mesh at rest; resets the positions and the operator. Null removes the mesh.
  void set_mesh(const Mesh* mesh);
  /// Changes the order in which the mesh's triangles are drawn; later triangles are drawn on top.
  void set_triangles(const std::vector<Triangle>& triangles);
  /// Sets the vertex positions for Placement::positions.
  void set_positions(std::span<const Complex> positions);
  /// Sets a mesh around the first one, which takes the place of the undeformed picture outside it.
  /// Null removes it. set_mesh removes it, too.
  void set_fringe(const Mesh* mesh);
  void set_fringe_positions(std::span<const Complex> positions);
  /// Sets the position of each vertex's value on the heat scale, in [0, 1].
  void set_heat(const Eigen::VectorXf& positions);
  /// Sets the operator for Placement::by_operator; null removes it. Returns false if it does not
  /// fit into this driver's texture buffers.
  bool set_operator(const PlanarMatrix<float>* matrix);
  void set_controls(const VectorXc& controls);

  void draw(const RenderFrame& frame);

  /// The vertex positions that the shader computes, read back.
  std::vector<Complex> placed_vertices(Placement placement);

 private:
  struct Objects;
  std::unique_ptr<Objects> gl_;
};

}  // namespace holomorph
