// glTF 2.0 specification, Khronos Group, 2021.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "scene/formats/moving_mesh.h"

namespace holomorph {
namespace {

using GltfJson = nlohmann::ordered_json;
using Vertex = std::array<float, 3>;

enum ComponentType { kUnsignedInt = 5125, kFloat = 5126 };
enum BufferTarget { kNoTarget = 0, kArrayBuffer = 34962, kElementArrayBuffer = 34963 };
constexpr double kLayerDistance = 0.01;  ///< one pixel, in units of 100 pixels

template <class Number>
void append_number(std::string& bytes, Number x) {
  char raw[sizeof x];
  std::memcpy(raw, &x, sizeof x);
  bytes.append(raw, sizeof x);
}

/// Collects the JSON and the binary part of a file.
class GltfWriter {
 public:
  GltfWriter() {
    document_["asset"] = {{"version", "2.0"}, {"generator", "Holomorph"}};
    document_["scene"] = 0;
    document_["scenes"] = GltfJson::array({{{"nodes", {0}}}});
    document_["nodes"] = GltfJson::array({{{"name", "Holomorph"}}});
  }

  void add(const MovingMesh& mesh, const std::vector<double>& times, size_t number);
  std::string file();

 private:
  size_t push(const char* list, GltfJson item) {
    document_[list].push_back(std::move(item));
    return document_[list].size() - 1;
  }
  size_t view(const std::string& bytes, BufferTarget target = kNoTarget) {
    buffer_.resize((buffer_.size() + 3) / 4 * 4, '\0');
    GltfJson item{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}};
    if (target != kNoTarget) item["target"] = target;
    buffer_ += bytes;
    return push("bufferViews", std::move(item));
  }
  size_t scalars(const std::vector<float>& values, bool with_bounds) {
    std::string bytes;
    for (const float x : values) append_number(bytes, x);
    GltfJson item{{"bufferView", view(bytes)},
                  {"componentType", kFloat},
                  {"count", values.size()},
                  {"type", "SCALAR"}};
    if (with_bounds) {
      item["min"] = {values.front()};
      item["max"] = {values.back()};
    }
    return push("accessors", std::move(item));
  }
  size_t positions(const std::vector<Vertex>& vertices, bool is_target);
  size_t material(const MovingMesh& mesh);
  GltfJson primitive(const MovingMesh& mesh);

  GltfJson document_;
  std::string buffer_;
};

Vertex vertex_of(Complex z) {
  return {static_cast<float>(z.real() / kPixelsPerUnit),
          static_cast<float>(z.imag() / kPixelsPerUnit), 0};
}

std::string bytes_of(const std::vector<Vertex>& vertices) {
  std::string bytes;
  for (const Vertex& v : vertices)
    for (const float x : v) append_number(bytes, x);
  return bytes;
}

/// Positions, or the displacements of a morph target. Displacements that are mostly zero are stored
/// without the zeros.
size_t GltfWriter::positions(const std::vector<Vertex>& vertices, bool is_target) {
  Vertex low = vertices[0], high = vertices[0];
  std::string indices;
  std::vector<Vertex> moved;
  for (size_t i = 0; i < vertices.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], vertices[i][k]);
      high[k] = std::max(high[k], vertices[i][k]);
    }
    if (vertices[i] == Vertex{}) continue;
    moved.push_back(vertices[i]);
    append_number(indices, static_cast<std::uint32_t>(i));
  }
  GltfJson item{{"componentType", kFloat},
                {"count", vertices.size()},
                {"type", "VEC3"},
                {"min", low},
                {"max", high}};
  // A sparse value takes 16 bytes in place of 12.
  const bool is_sparse = is_target && !moved.empty() && 16 * moved.size() < 12 * vertices.size();
  if (is_sparse)
    item["sparse"] = {{"count", moved.size()},
                      {"indices", {{"bufferView", view(indices)}, {"componentType", kUnsignedInt}}},
                      {"values", {{"bufferView", view(bytes_of(moved))}}}};
  else
    item["bufferView"] = view(bytes_of(vertices), kArrayBuffer);
  return push("accessors", std::move(item));
}

size_t GltfWriter::material(const MovingMesh& mesh) {
  constexpr int kLinear = 9729, kMipmaps = 9987, kClamp = 33071;
  GltfJson surface{{"baseColorFactor", {1, 1, 1, mesh.opacity}}, {"metallicFactor", 0}};
  if (mesh.texture.width > 0) {
    if (!document_.contains("samplers"))
      push("samplers",
           {{"magFilter", kLinear}, {"minFilter", kMipmaps}, {"wrapS", kClamp}, {"wrapT", kClamp}});
    const size_t image = push("images", {{"name", mesh.name},
                                         {"mimeType", "image/png"},
                                         {"bufferView", view(encode_png(mesh.texture))}});
    surface["baseColorTexture"] = {
        {"index", push("textures", {{"sampler", 0}, {"source", image}})}};
  }
  const bool opaque = mesh.opacity == 1 && is_opaque(mesh.texture);
  return push("materials", {{"name", mesh.name},
                            {"pbrMetallicRoughness", std::move(surface)},
                            {"alphaMode", opaque ? "OPAQUE" : "BLEND"},
                            {"doubleSided", true},
                            {"extensions", {{"KHR_materials_unlit", GltfJson::object()}}}});
}

GltfJson GltfWriter::primitive(const MovingMesh& mesh) {
  std::vector<Vertex> first;
  for (const Complex& z : mesh.frames[0]) first.push_back(vertex_of(z));
  std::string coordinates, corners;
  for (const Complex& z : mesh.rest) {
    const Complex uv = texture_coordinate(mesh, z);
    append_number(coordinates, static_cast<float>(uv.real()));
    append_number(coordinates, static_cast<float>(1 - uv.imag()));
  }
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) append_number(corners, static_cast<std::uint32_t>(v));
  GltfJson primitive;
  primitive["attributes"]["POSITION"] = positions(first, false);
  if (mesh.texture.width > 0)
    primitive["attributes"]["TEXCOORD_0"] =
        push("accessors", {{"bufferView", view(coordinates, kArrayBuffer)},
                           {"componentType", kFloat},
                           {"count", mesh.rest.size()},
                           {"type", "VEC2"}});
  primitive["indices"] = push("accessors", {{"bufferView", view(corners, kElementArrayBuffer)},
                                            {"componentType", kUnsignedInt},
                                            {"count", 3 * mesh.triangles.size()},
                                            {"type", "SCALAR"}});
  primitive["material"] = material(mesh);
  return primitive;
}

void GltfWriter::add(const MovingMesh& mesh, const std::vector<double>& times, size_t number) {
  GltfJson item{{"name", mesh.name}};
  GltfJson primitive = this->primitive(mesh);
  const bool animated = moves(mesh);
  const size_t targets = animated ? mesh.frames.size() - 1 : 0;
  constexpr size_t kMostWeights = 100'000'000;
  if (targets * times.size() > kMostWeights)
    throw Error(ErrorKind::bad_input,
                "glTF stores a number for each pair of frames, and there are " +
                    std::to_string(times.size()) + " frames; choose fewer by --frames or --rate");
  for (size_t i = 1; i <= targets; ++i) {
    std::vector<Vertex> displacements;
    for (size_t v = 0; v < mesh.rest.size(); ++v) {
      const Vertex from = vertex_of(mesh.frames[0][v]), to = vertex_of(mesh.frames[i][v]);
      displacements.push_back({to[0] - from[0], to[1] - from[1], 0});
    }
    primitive["targets"].push_back({{"POSITION", positions(displacements, true)}});
  }
  item["primitives"] = GltfJson::array({std::move(primitive)});
  if (animated) item["weights"] = std::vector<int>(targets, 0);
  const size_t node =
      push("nodes", {{"name", mesh.name},
                     {"mesh", push("meshes", std::move(item))},
                     {"translation", {0, 0, kLayerDistance * static_cast<double>(number)}}});
  document_["nodes"][0]["children"].push_back(node);
  if (!animated) return;
  std::vector<float> seconds, weights;
  for (size_t i = 0; i < times.size(); ++i) {
    seconds.push_back(static_cast<float>(times[i] - times[0]));
    for (size_t target = 1; target <= targets; ++target) weights.push_back(i == target ? 1 : 0);
  }
  if (!document_.contains("animations"))
    push("animations",
         {{"name", "motion"}, {"channels", GltfJson::array()}, {"samplers", GltfJson::array()}});
  GltfJson& animation = document_["animations"][0];
  animation["channels"].push_back({{"sampler", animation["samplers"].size()},
                                   {"target", {{"node", node}, {"path", "weights"}}}});
  const size_t input = scalars(seconds, true), output = scalars(weights, false);
  document_["animations"][0]["samplers"].push_back(
      {{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
}

std::string GltfWriter::file() {
  document_["extensionsUsed"] = {"KHR_materials_unlit"};
  buffer_.resize((buffer_.size() + 3) / 4 * 4, '\0');
  document_["buffers"] = GltfJson::array({{{"byteLength", buffer_.size()}}});
  std::string json = document_.dump(-1, ' ', false, GltfJson::error_handler_t::replace);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const size_t size = 12 + 8 + json.size() + 8 + buffer_.size();
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorKind::bad_input,
                "the file would have more than 4 GB; choose fewer vertices or frames");
  constexpr std::uint32_t kVersion = 2;
  const auto number = [](size_t value) { return static_cast<std::uint32_t>(value); };
  std::string bytes = "glTF";
  append_number(bytes, kVersion);
  append_number(bytes, number(size));
  append_number(bytes, number(json.size()));
  bytes += "JSON" + json;
  append_number(bytes, number(buffer_.size()));
  bytes += std::string("BIN\0", 4);
  return bytes + buffer_;
}

}  // namespace

std::string glb_of(const MovingMeshes& moving) {
  GltfWriter writer;
  for (size_t i = 0; i < moving.meshes.size(); ++i) writer.add(moving.meshes[i], moving.times, i);
  return writer.file();
}

}  // namespace holomorph
