// Text and NumPy writers. Numbers in text have 17 significant digits, which preserves them exactly.
#include "scene/formats/export.h"

#include <cstring>
#include <sstream>

#include "core/error.h"

namespace holomorph {
namespace {

std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

std::string npy_header(const char* type, std::initializer_list<size_t> shape) {
  std::string header = std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': (";
  for (const size_t size : shape) header += std::to_string(size) + ", ";
  header += "), }";
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 255);
  bytes += static_cast<char>(header.size() >> 8);
  return bytes + header;
}

template <class Number>
void append(std::string& bytes, Number x) {
  char raw[sizeof x];
  std::memcpy(raw, &x, sizeof x);
  bytes.append(raw, sizeof x);
}

}  // namespace

std::string npy_of(const MatrixXc& matrix) {
  std::string bytes =
      npy_header("<c16", {static_cast<size_t>(matrix.rows()), static_cast<size_t>(matrix.cols())});
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j < matrix.cols(); ++j) {
      append(bytes, matrix(i, j).real());
      append(bytes, matrix(i, j).imag());
    }
  return bytes;
}

std::string npy_of(std::span<const Complex> positions) {
  std::string bytes = npy_header("<f8", {positions.size(), 2});
  for (const Complex& z : positions) {
    append(bytes, z.real());
    append(bytes, z.imag());
  }
  return bytes;
}

std::string npy_of(const std::vector<float>& numbers, size_t rows, size_t columns, size_t depth) {
  std::string bytes = npy_header("<f4", {rows, columns, depth});
  for (const float x : numbers) append(bytes, x);
  return bytes;
}

std::string obj_of(const Mesh& mesh, std::span<const Complex> positions, int image_width,
                   int image_height) {
  std::string out = "# The warped mesh: positions in image pixels, y up.\n";
  for (const Complex& z : positions)
    out += "v " + number(z.real()) + " " + number(z.imag()) + " 0\n";
  const double w = std::max(image_width, 1), h = std::max(image_height, 1);
  for (const Complex& z : mesh.vertices)
    out += "vt " + number(z.real() / w) + " " + number(z.imag() / h) + "\n";
  for (const Triangle& t : mesh.triangles) {
    out += "f";
    for (const int v : t) out += " " + std::to_string(v + 1) + "/" + std::to_string(v + 1);
    out += "\n";
  }
  return out;
}

Points points_of_csv(const std::string& text, const std::string& name, bool takes_nan) {
  Points points;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    for (char& c : line)
      if (c == ',' || c == ';' || c == '\t' || c == '\r') c = ' ';
    if (line.find_first_not_of(' ') == std::string::npos || line[0] == '#') continue;
    const char* at = line.c_str();
    char* end = nullptr;
    double pair[2];
    bool good = true;
    for (double& x : pair) {
      x = std::strtod(at, &end);
      good = good && end != at && (std::isfinite(x) || (takes_nan && std::isnan(x)));
      at = end;
    }
    good = good &&
           line.find_first_not_of(' ', static_cast<size_t>(at - line.c_str())) == std::string::npos;
    char* first_end = nullptr;
    std::strtod(line.c_str(), &first_end);
    if (number == 1 && first_end == line.c_str()) continue;  // a heading
    if (!good)
      throw Error(ErrorKind::bad_input,
                  name + ": line " + std::to_string(number) + ": expected two finite numbers x,y");
    points.push_back({pair[0], pair[1]});
  }
  return points;
}

}  // namespace holomorph
