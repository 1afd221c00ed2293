// The text format of scenes of Godot 3.
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

/// Positions with y downward.
std::string godot_points(const Points& points) {
  std::string list = "PoolVector2Array( ";
  for (size_t i = 0; i < points.size(); ++i)
    list += (i > 0 ? ", " : "") + short_number(points[i].real()) + ", " +
            short_number(-points[i].imag());
  return list + " )";
}

}  // namespace

std::string godot_of(const MovingMeshes& moving, const std::vector<std::string>& textures) {
  const std::vector<std::string> names = unique_names(moving);
  const bool animated =
      std::ranges::any_of(moving.meshes, [](const MovingMesh& mesh) { return moves(mesh); });
  std::string text =
      "[gd_scene load_steps=" + std::to_string(textures.size() + animated + 1) + " format=2]\n\n";
  for (size_t i = 0; i < textures.size(); ++i)
    if (!textures[i].empty())
      text += "[ext_resource path=" + godot_text(textures[i]) +
              " type=\"Texture\" id=" + std::to_string(i + 1) + "]\n";
  if (animated) {
    text += "\n[sub_resource type=\"Animation\" id=1]\nresource_name = \"motion\"\nlength = " +
            short_number(moving.times.back() - moving.times[0]) + "\nloop = true\n";
    int track = 0;
    for (size_t i = 0; i < moving.meshes.size(); ++i) {
      const MovingMesh& mesh = moving.meshes[i];
      if (!moves(mesh)) continue;
      const std::string head = "tracks/" + std::to_string(track++) + "/";
      std::string times, transitions, values;
      for (size_t k = 0; k < moving.times.size(); ++k) {
        const char* comma = k > 0 ? ", " : "";
        times += comma + short_number(moving.times[k] - moving.times[0]);
        transitions += std::string(comma) + "1";
        values += comma + godot_points(mesh.frames[k]);
      }
      text += head + "type = \"value\"\n" + head + "path = NodePath(" +
              godot_text(names[i] + ":polygon") + ")\n" + head + "interp = 1\n" + head +
              "loop_wrap = false\n" + head + "imported = false\n" + head + "enabled = true\n" +
              head + "keys = {\n\"times\": PoolRealArray( " + times +
              " ),\n\"transitions\": PoolRealArray( " + transitions +
              " ),\n\"update\": 0,\n\"values\": [ " + values + " ]\n}\n";
    }
  }
  text += "\n[node name=\"Holomorph\" type=\"Node2D\"]\n";
  for (size_t i = 0; i < moving.meshes.size(); ++i) {
    const MovingMesh& mesh = moving.meshes[i];
    Points coordinates;
    for (const Complex& z : mesh.rest)
      coordinates.push_back(
          z - Complex(mesh.texture.left, mesh.texture.bottom + std::max(1, mesh.texture.height)));
    text += "\n[node name=" + godot_text(names[i]) + " type=\"Polygon2D\" parent=\".\"]\n";
    if (!textures[i].empty()) text += "texture = ExtResource( " + std::to_string(i + 1) + " )\n";
    if (mesh.opacity < 1) text += "color = Color( 1, 1, 1, " + short_number(mesh.opacity) + " )\n";
    text += "polygon = " + godot_points(mesh.frames[0]) + "\nuv = " + godot_points(coordinates) +
            "\npolygons = [ ";
    for (size_t k = 0; k < mesh.triangles.size(); ++k) {
      const Triangle& t = mesh.triangles[k];
      text += std::string(k > 0 ? ", " : "") + "PoolIntArray( " + std::to_string(t[0]) + ", " +
              std::to_string(t[1]) + ", " + std::to_string(t[2]) + " )";
    }
    text += " ]\n";
  }
  if (animated)
    text +=
        "\n[node name=\"AnimationPlayer\" type=\"AnimationPlayer\" parent=\".\"]\n"
        "autoplay = \"motion\"\nanims/motion = SubResource( 1 )\n";
  return text;
}

}  // namespace holomorph
