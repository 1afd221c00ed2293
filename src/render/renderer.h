// The warped picture in OpenGL 3.3: one mesh, one texture, one program. Handles and cages are not
// drawn here.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/maps/heat.h"
#include "core/mesh/mesh.h"
#include "render/texture_levels.h"

namespace holomorph {

/// The current context's driver, and whether it computes on the processor: then multisampling and
/// anisotropy cost more than they give, and the CPU path places vertices faster than a shader.
std::string driver_name();
bool is_software_driver();

/// How the vertices get their places.
enum class Placement { at_rest, positions, by_operator };

/// The picture once more, elsewhere, half transparent behind the drawn one.
struct Ghost {
  std::span<const Complex> positions;  ///< of the mesh's vertices
  Color tint;
};

/// What of the picture: as the map takes it, all of it as it was, or only what is behind it.
enum class Shows { map, original, nothing };

/// One drawing of the canvas. Window px have x to the right and y down.
struct RenderFrame {
  int window_width = 1, window_height = 1;  ///< of the framebuffer
  double canvas_left = 0, canvas_top = 0, canvas_width = 1, canvas_height = 1;  ///< framebuffer px
  Complex center;   ///< plane point in the canvas' middle
  double zoom = 1;  ///< framebuffer px per plane unit
  View view = View::image;
  bool diverging = false;  ///< the heat map's colours
  Placement placement = Placement::positions;
  bool wireframe = false;  ///< the mesh's edges over it
  std::vector<Ghost> ghosts = {};
  double from = 0, to = 1;  ///< only this part of the canvas' width
  bool map_alone = false;   ///< the mesh over nothing, opaque, in place of all of the picture
  bool over = false;        ///< over what is there: nothing is cleared and there is no backdrop
  Shows shows = Shows::map;
  Color background{0.2f, 0.2f, 0.2f},
      backdrop{0.25f, 0.25f, 0.25f};  ///< canvas; behind the picture
};

/// Owns the GL objects. Needs a current OpenGL 3.3 core context during construction, calls and
/// destruction. Throws Error{failed} when the context cannot do what is needed.
class Renderer {
 public:
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// The picture: straight-alpha RGBA, rows from the top; 0 x 0 takes it away. Returns the factor
  /// by which it had to be reduced for this driver, 1 when not at all.
  int set_picture(int width, int height, const std::uint8_t* pixels);
  /// The same bit by bit, so that no frame waits: with the first call of upload_more the picture is
  /// there, coarsely, and call by call in more detail. Null takes it away.
  void begin_picture(std::shared_ptr<const TextureLevels> levels);
  /// Hands over about so many bytes. Returns whether anything is left.
  bool upload_more(size_t bytes);
  /// The largest side of a texture.
  static int largest_side();
  /// The mesh at rest; positions and operator start afresh. Null takes it away.
  void set_mesh(const Mesh* mesh);
  /// The mesh's triangles in another order: later ones are drawn on top.
  void set_triangles(const std::vector<Triangle>& triangles);
  /// Where the vertices go, by Placement::positions.
  void set_positions(std::span<const Complex> positions);
  /// Position of each vertex's value on the heat scale, in [0, 1].
  void set_heat(const Eigen::VectorXf& positions);
  /// The operator of Placement::by_operator; null takes it away. Returns false when it does not fit
  /// this driver's texture buffers.
  bool set_operator(const PlanarMatrix<float>* matrix);
  void set_controls(const VectorXc& controls);

  void draw(const RenderFrame& frame);

  /// The vertex places that the shader computes, read back.
  std::vector<Complex> placed_vertices(Placement placement);

 private:
  struct Objects;
  std::unique_ptr<Objects> gl_;
};

}  // namespace holomorph
