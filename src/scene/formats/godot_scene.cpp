// The text formats of scenes of Godot 3 and 4. They differ in the names of types and in how
// resources are numbered. In Godot 4, animations lie in a library.
#include <algorithm>
#include <cstdio>

#include "scene/formats/moving_mesh.h"

namespace holomorph {
namespace {

std::string short_number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", x);
  return text;
}

/// A text in quotes for a Godot scene.
std::string godot_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

/// What the versions write differently.
struct GodotDialect {
  const char *format, *texture, *points, *floats, *ints, *loop;
  bool quoted_ids, library;

  std::string id(size_t number) const {
    return quoted_ids ? godot_text(std::to_string(number)) : std::to_string(number);
  }
};

const GodotDialect& godot_dialect(GodotVersion version) {
  static const GodotDialect three{.format = "2",
                                  .texture = "Texture",
                                  .points = "PoolVector2Array",
                                  .floats = "PoolRealArray",
                                  .ints = "PoolIntArray",
                                  .loop = "loop = true",
                                  .quoted_ids = false,
                                  .library = false};
  static const GodotDialect four{.format = "3",
                                 .texture = "Texture2D",
                                 .points = "PackedVector2Array",
                                 .floats = "PackedFloat32Array",
                                 .ints = "PackedInt32Array",
                                 .loop = "loop_mode = 1",
                                 .quoted_ids = true,
                                 .library = true};
  return version == GodotVersion::three ? three : four;
}

/// Positions with y downward.
std::string godot_points(const GodotDialect& dialect, const Points& points) {
  std::string list = dialect.points + std::string("(");
  for (size_t i = 0; i < points.size(); ++i)
    list += (i > 0 ? ", " : "") + short_number(points[i].real()) + ", " +
            short_number(-points[i].imag());
  return list + ")";
}

/// The track that moves the polygon of a mesh.
std::string godot_track(const GodotDialect& dialect, const MovingMesh& mesh,
                        const std::string& name, const std::vector<double>& at, int number) {
  std::string times, transitions, values;
  for (size_t k = 0; k < at.size(); ++k) {
    const std::string comma = k > 0 ? ", " : "";
    times += comma + short_number(at[k] - at[0]);
    transitions += comma + "1";
    values += comma + godot_points(dialect, mesh.frames[k]);
  }
  const std::string head = "tracks/" + std::to_string(number) + "/", floats = dialect.floats;
  return head + "type = \"value\"\n" + head + "path = NodePath(" + godot_text(name + ":polygon") +
         ")\n" + head + "interp = 1\n" + head + "loop_wrap = false\n" + head +
         "imported = false\n" + head + "enabled = true\n" + head +
         "keys = {\n\"times\": " + floats + "(" + times + "),\n\"transitions\": " + floats + "(" +
         transitions + "),\n\"update\": 0,\n\"values\": [" + values + "]\n}\n";
}

}  // namespace

std::string godot_of(const MovingMeshes& moving, const std::vector<std::string>& textures,
                     GodotVersion version) {
  const GodotDialect& dialect = godot_dialect(version);
  const std::vector<std::string> names = unique_names(moving);
  const bool animated =
      std::ranges::any_of(moving.meshes, [](const MovingMesh& mesh) { return moves(mesh); });
  const auto textured =
      std::ranges::count_if(textures, [](const std::string& texture) { return !texture.empty(); });
  const auto resources = textured + (animated ? 1 + dialect.library : 0);
  std::string text = "[gd_scene load_steps=" + std::to_string(resources + 1) +
                     " format=" + dialect.format + "]\n\n";
  for (size_t i = 0; i < textures.size(); ++i)
    if (!textures[i].empty())
      text += "[ext_resource path=" + godot_text(textures[i]) + " type=\"" + dialect.texture +
              "\" id=" + dialect.id(i + 1) + "]\n";
  if (animated) {
    text += "\n[sub_resource type=\"Animation\" id=" + dialect.id(1) +
            "]\nresource_name = \"motion\"\nlength = " +
            short_number(moving.times.back() - moving.times[0]) + "\n" + dialect.loop + "\n";
    int track = 0;
    for (size_t i = 0; i < moving.meshes.size(); ++i)
      if (moves(moving.meshes[i]))
        text += godot_track(dialect, moving.meshes[i], names[i], moving.times, track++);
    if (dialect.library)
      text += "\n[sub_resource type=\"AnimationLibrary\" id=" + dialect.id(2) +
              "]\n_data = {\n\"motion\": SubResource(" + dialect.id(1) + ")\n}\n";
  }
  text += "\n[node name=\"Holomorph\" type=\"Node2D\"]\n";
  for (size_t i = 0; i < moving.meshes.size(); ++i) {
    const MovingMesh& mesh = moving.meshes[i];
    Points coordinates;
    for (const Complex& z : mesh.rest)
      coordinates.push_back(
          z - Complex(mesh.texture.left, mesh.texture.bottom + std::max(1, mesh.texture.height)));
    text += "\n[node name=" + godot_text(names[i]) + " type=\"Polygon2D\" parent=\".\"]\n";
    if (!textures[i].empty()) text += "texture = ExtResource(" + dialect.id(i + 1) + ")\n";
    if (mesh.opacity < 1) text += "color = Color(1, 1, 1, " + short_number(mesh.opacity) + ")\n";
    text += "polygon = " + godot_points(dialect, mesh.frames[0]) +
            "\nuv = " + godot_points(dialect, coordinates) + "\npolygons = [";
    for (size_t k = 0; k < mesh.triangles.size(); ++k) {
      const Triangle& t = mesh.triangles[k];
      text += std::string(k > 0 ? ", " : "") + dialect.ints + "(" + std::to_string(t[0]) + ", " +
              std::to_string(t[1]) + ", " + std::to_string(t[2]) + ")";
    }
    text += "]\n";
  }
  if (animated)
    text += "\n[node name=\"AnimationPlayer\" type=\"AnimationPlayer\" parent=\".\"]\n" +
            (dialect.library ? "libraries = {\n\"\": SubResource(" + dialect.id(2) + ")\n}\n"
                             : "anims/motion = SubResource(" + dialect.id(1) + ")\n") +
            "autoplay = \"motion\"\n";
  return text;
}

}  // namespace holomorph
