// Text and NumPy writers. Numbers in text have 17 significant digits, which preserves them exactly.
#include "scene/formats/export.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>

#include "core/error.h"
#include "system/text.h"

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

std::string obj_of(const Mesh& mesh, std::span<const Complex> positions, const Box& page) {
  std::string out = "# The warped mesh: positions in image pixels, y up.\n";
  for (const Complex& z : positions)
    out += "v " + number(z.real()) + " " + number(z.imag()) + " 0\n";
  const double w = std::max(page.width(), 1.0), h = std::max(page.height(), 1.0);
  for (const Complex& z : mesh.vertices)
    out += "vt " + number((z.real() - page.left) / w) + " " + number((z.imag() - page.bottom) / h) +
           "\n";
  for (const Triangle& t : mesh.triangles) {
    out += "f";
    for (const int v : t) out += " " + std::to_string(v + 1) + "/" + std::to_string(v + 1);
    out += "\n";
  }
  return out;
}

namespace {

/// The fields of a line, without the quotes around them. Semicolons and tabs separate them, or else
/// commas, or else blanks.
std::vector<std::string> fields_of(const std::string& line) {
  const char separator = line.find_first_of(";\t") != std::string::npos
                             ? line[line.find_first_of(";\t")]
                         : line.find(',') != std::string::npos ? ','
                                                               : ' ';
  std::vector<std::string> fields{""};
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == separator && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  for (std::string& field : fields) field = trimmed(field);
  if (separator == ' ') std::erase(fields, "");
  return fields;
}

/// A number with a point, or with a decimal comma; none if it is not a number.
std::optional<double> number_of(std::string field) {
  if (field.find('.') == std::string::npos)
    if (const size_t comma = field.find(','); comma != std::string::npos) field[comma] = '.';
  char* end = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  if (field.empty() || *end != '\0') return {};
  return value;
}

}  // namespace

Points points_of_csv(const std::string& bytes, const std::string& name, bool takes_nan) {
  std::string text = utf8_of_file(bytes);
  for (size_t i = 0; i < text.size(); ++i)  // also line ends of old spreadsheets
    if (text[i] == '\r') text[i] = i + 1 < text.size() && text[i + 1] == '\n' ? ' ' : '\n';
  Points points;
  std::istringstream lines(text);
  bool first = true;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    line = trimmed(line);
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::optional<double>> numbers;
    for (const std::string& field : fields_of(line)) numbers.push_back(number_of(field));
    const bool is_heading =
        first && std::ranges::none_of(numbers, [](const auto& value) { return value.has_value(); });
    first = false;
    if (is_heading) continue;
    const auto is_good = [&](const std::optional<double>& value) {
      return value && (std::isfinite(*value) || (takes_nan && std::isnan(*value)));
    };
    if (numbers.size() != 2 || !std::ranges::all_of(numbers, is_good))
      throw Error(ErrorKind::bad_input,
                  name + ": line " + std::to_string(number) + ": expected two finite numbers x,y");
    points.push_back({*numbers[0], *numbers[1]});
  }
  return points;
}

}  // namespace holomorph
