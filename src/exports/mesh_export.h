// Exports of moving meshes: glTF, vertex caches, Godot, Spine and sequences of OBJ files.
#pragma once

#include "exports/export_formats.h"
#include "raster/moving_meshes.h"
#include "system/file.h"

namespace holomorph {

/// What is exported, in a format for which ExportFormat::meshes is set, and at which times.
struct MeshExport {
  std::string format;  ///< its id
  Path out;
  /// Of each layer. Not set: in formats with all layers, the fewest with which no difference is
  /// visible; in others, all of them.
  std::optional<size_t> vertices = {};
  std::optional<double> time = {};  ///< a single moment in seconds
  /// The first and the last frame. If neither this nor the time is set: all frames or, if nothing
  /// moves, the scene's own pose.
  std::optional<std::pair<int, int>> frames = {};
  /// Frames per second; by default the fewest that do not differ visibly, if the format has all
  /// layers, and otherwise those of the scene.
  std::optional<double> rate = {};
  bool keys = false;       ///< only at keyframes
  bool full_mesh = false;  ///< all vertices of each layer's own mesh

  bool operator==(const MeshExport&) const = default;
};

/// The first frame must not come after the last one. Throws Error if there are too many times, or
/// if a rate or keys are asked for at a single moment.
MovingMeshOptions mesh_options_of(const Scene& scene, const MeshExport& wanted);

/// The files of an export and what they contain. What the first one refers to comes after it.
using MeshFiles = std::vector<std::pair<Path, std::string>>;
MeshFiles mesh_files_of(const MovingMeshes& moving, const MeshExport& wanted);
/// The names of these files, known before there are meshes.
std::vector<Path> mesh_file_names(const Scene& scene, const Pictures& pictures,
                                  const MeshExport& wanted);

/// The error up to which a motion does not visibly differ, in pixels.
inline constexpr double kVisibleError = 0.25;
/// Advice about a visible error, or about programs that do not load so many frames; empty if there
/// is none.
std::string mesh_advice(const MovingMeshes& moving, const MeshExport& wanted);
/// Such as "3 meshes, 1200 vertices, 49 frames".
std::string mesh_counts(const MovingMeshes& moving);
/// Such as ", at most 0.2 px off at the frames"; empty if they are exact.
std::string mesh_error_text(const MovingMeshes& moving);

/// What the formats for engines cannot express, such as "Hat: its clipping is not kept".
std::vector<std::string> mesh_losses_of(const Scene& scene);

}  // namespace holomorph
