// Meshes that move with a scene's layers, and the files in which other programs read them. The
// formats interpolate vertices linearly, which shrinks what rotates. Meshes are therefore stored
// for each frame, and their error is measured.
#pragma once

#include "core/mesh/mesh.h"
#include "scene/formats/image.h"

namespace holomorph {

/// A textured mesh at several times.
struct MovingMesh {
  std::string name;
  Image texture;  ///< empty: none
  double opacity = 1;
  Points rest;                      ///< on the texture, in its plane
  std::vector<Triangle> triangles;  ///< each covers those before it
  std::vector<Points> frames;       ///< the positions of the vertices, at least once
};

/// Meshes from bottom to top, and the times of their frames in seconds.
struct MovingMeshes {
  std::vector<double> times;  ///< increasing
  std::vector<MovingMesh> meshes;
  /// The largest distance, in pixels, between a vertex of the scene's own mesh and these meshes, if
  /// positions are interpolated linearly inside triangles and between frames. At the frames, and at
  /// any time.
  double frame_error = 0, error = 0;
};

/// Whether any vertex is at different positions in different frames.
bool moves(const MovingMesh& mesh);
/// Texture coordinates from 0 to 1 with v upward.
Complex texture_coordinate(const MovingMesh& mesh, Complex rest);

/// Lengths in these files are in units of 100 pixels, because other programs take the units for
/// meters.
inline constexpr double kPixelsPerUnit = 100;

/// A binary glTF 2.0 file: a node with a mesh, an unlit material and a texture for each layer. The
/// first frame is the mesh itself, and each later one a morph target. An animation of their weights
/// moves from frame to frame. In units of 100 pixels, y up, layers stacked along z.
std::string glb_of(const MovingMeshes& moving);

/// A vertex cache in the format of Lightwave (MDD) or of 3ds Max (PC2), with positions in pixels.
std::string mdd_of(const MovingMesh& mesh, const std::vector<double>& times);
std::string pc2_of(const MovingMesh& mesh, const std::vector<double>& times);

enum class GodotVersion : uint8_t { three, four };
/// A text scene for Godot: a Polygon2D for each mesh, with textures from these files, and an
/// AnimationPlayer that moves their polygons. Positions in pixels, y down.
std::string godot_of(const MovingMeshes& moving, const std::vector<std::string>& textures,
                     GodotVersion version);

/// A skeleton for Spine 4.1: a slot with a mesh for each layer, and timelines that deform them,
/// with textures from these files. Positions in pixels, y up.
std::string spine_of(const MovingMeshes& moving, const std::vector<std::string>& textures);
/// Names of the meshes that differ from each other, also if case does not count, and can be file
/// names.
std::vector<std::string> unique_names(const MovingMeshes& moving);

}  // namespace holomorph
