// OBJ files are read line by line.
#include "scene/formats/surface_file.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <map>
#include <sstream>

#include "core/error.h"
#include "system/text.h"

namespace holomorph {
namespace {

constexpr size_t kMostVertices = 1000000;
constexpr const char* kMaterial = "picture";

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  SurfaceFile read() {
    while (!rest_.empty()) {
      ++line_number_;
      const size_t end = rest_.find('\n');
      line_ = rest_.substr(0, end);
      rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
      const std::string_view whole = line_;
      if (const size_t comment = line_.find('#'); comment != std::string_view::npos)
        line_ = line_.substr(0, comment);
      const std::string_view kind = word();
      if (kind == "v") {
        const double x = number(), y = number(), z = number();
        points_.push_back({x, y, z});
      } else if (kind == "vt") {
        const double u = number(), v = number();
        textures_.push_back({u, v});
      } else if (kind == "f") {
        face();
      } else if (kind == "mtllib") {
        materials_ = trimmed(whole.substr(whole.find(kind) + kind.size()));  // names may contain #
      }
      if (points_.size() > kMostVertices) fail("more than a million vertices");
    }
    if (corners_.empty()) throw Error(ErrorKind::bad_input, name_ + ": the file has no face");
    return result();
  }

 private:
  struct FaceCorner {
    int point = 0, texture = -1;
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::bad_input,
                name_ + ": line " + std::to_string(line_number_) + ": " + what);
  }

  std::string_view word() {
    const size_t start = line_.find_first_not_of(" \t\r");
    if (start == std::string_view::npos) return {};
    const size_t end = line_.find_first_of(" \t\r", start);
    const std::string_view found = line_.substr(start, end - start);
    line_ = end == std::string_view::npos ? std::string_view() : line_.substr(end);
    return found;
  }

  double number() {
    const std::string_view text = word();
    double value = 0;
    const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || wrong != std::errc() || end != text.data() + text.size() ||
        !std::isfinite(value))
      fail("expected a number, found '" + std::string(text) + "'");
    return value;
  }

  /// Converts an OBJ index to a zero-based index. OBJ indices start at 1, and negative ones count
  /// from the end.
  int index(std::string_view text, size_t count) const {
    long value = 0;
    const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || wrong != std::errc() || end != text.data() + text.size())
      fail("expected a vertex number, found '" + std::string(text) + "'");
    if (value < 0) value += static_cast<long>(count) + 1;
    if (value < 1 || value > static_cast<long>(count)) fail("there is no such vertex");
    return static_cast<int>(value - 1);
  }

  void face() {
    std::vector<FaceCorner> face;
    for (std::string_view text = word(); !text.empty(); text = word()) {
      const size_t slash = text.find('/');
      FaceCorner corner;
      corner.point = index(text.substr(0, slash), points_.size());
      if (slash != std::string_view::npos) {
        const std::string_view rest = text.substr(slash + 1),
                               texture = rest.substr(0, rest.find('/'));
        if (!texture.empty()) corner.texture = index(texture, textures_.size());
      }
      face.push_back(corner);
    }
    if (face.size() < 3) fail("a face needs at least three vertices");
    for (size_t k = 1; k + 1 < face.size(); ++k)
      corners_.push_back({face[0], face[k], face[k + 1]});
  }

  /// The surface with only the vertices used by faces, in the order of the file.
  SurfaceFile result() const {
    std::vector<int> number(points_.size(), -1), texture(points_.size(), -1);
    bool consistent = true;
    for (const auto& triangle : corners_)
      for (const FaceCorner& corner : triangle) {
        const size_t at = static_cast<size_t>(corner.point);
        consistent =
            consistent && corner.texture >= 0 && (number[at] < 0 || texture[at] == corner.texture);
        number[at] = 0;
        texture[at] = corner.texture;
      }
    SurfaceFile file;
    file.materials = materials_;
    for (size_t i = 0; i < points_.size(); ++i) {
      if (number[i] < 0) continue;
      number[i] = static_cast<int>(file.surface.vertices.size());
      file.surface.vertices.push_back(points_[i]);
      if (consistent) file.texture.push_back(textures_[static_cast<size_t>(texture[i])]);
    }
    for (const auto& t : corners_)
      file.surface.triangles.push_back({number[static_cast<size_t>(t[0].point)],
                                        number[static_cast<size_t>(t[1].point)],
                                        number[static_cast<size_t>(t[2].point)]});
    return file;
  }

  std::string_view rest_, line_;
  const std::string& name_;
  int line_number_ = 0;
  std::vector<Eigen::Vector3d> points_;
  Points textures_;
  std::string materials_;
  std::vector<std::array<FaceCorner, 3>> corners_;
};

}  // namespace

SurfaceFile surface_of_obj(const std::string& text, const std::string& name) {
  return ObjReader(text, name).read();
}

std::string texture_of_materials(const std::string& text) {
  constexpr std::string_view kKey = "map_Kd";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::string name = trimmed(line);
    if (!name.starts_with(kKey) || name.size() == kKey.size() ||
        !std::isspace(static_cast<unsigned char>(name[kKey.size()])))
      continue;
    name = trimmed(name.substr(kKey.size()));
    // An option is a word that starts with a minus sign, followed by its values.
    while (name.starts_with("-")) {
      std::istringstream words(name);
      std::string option, next, rest;
      words >> option;
      const auto is_value = [](const std::string& word) {
        return word == "on" || word == "off" ||
               word.find_first_not_of("0123456789.+-eE") == std::string::npos;
      };
      while (words >> next && is_value(next)) {
      }
      std::getline(words, rest);
      name = trimmed(next + rest);
    }
    std::ranges::replace(name, '\\', '/');
    return name;
  }
  return "";
}

std::string obj_of(const Surface& surface, const Points& texture,
                   const std::string& material_file) {
  check(texture.size() == surface.vertices.size(), "obj: texture coordinates for each vertex");
  std::string out = "mtllib " + material_file + "\n";
  char line[120];
  for (const Eigen::Vector3d& p : surface.vertices) {
    std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", p.x(), p.y(), p.z());
    out += line;
  }
  for (const Complex& z : texture) {
    std::snprintf(line, sizeof line, "vt %.9g %.9g\n", z.real(), z.imag());
    out += line;
  }
  out += std::string("usemtl ") + kMaterial + "\n";
  for (const auto& [a, b, c] : surface.triangles) {
    std::snprintf(line, sizeof line, "f %d/%d %d/%d %d/%d\n", a + 1, a + 1, b + 1, b + 1, c + 1,
                  c + 1);
    out += line;
  }
  return out;
}

std::string material_of(const std::string& texture_file) {
  const std::string text =
      std::string("newmtl ") + kMaterial + "\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\n";
  return texture_file.empty() ? text : text + "map_Kd " + texture_file + "\n";
}

}  // namespace holomorph
