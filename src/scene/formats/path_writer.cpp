// Numbers are written without an exponent and without trailing zeros.
#include "scene/formats/path_writer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace holomorph {

PathWriter::PathWriter(const Affine& map, double precision) : map_(map) {
  const double scale = std::abs(map.linear) + std::abs(map.anti);
  digits_ = std::clamp(static_cast<int>(std::ceil(-std::log10(precision * scale))), 0, 12);
}

void PathWriter::curve(const Points& cubic, double flat) {
  const Complex side = cubic[3] - cubic[0];
  const double length = std::abs(side);
  const auto is_on_line = [&](Complex z) {
    const double along = dot(z - cubic[0], side);
    return std::abs(cross(side, z - cubic[0])) <= flat * length && along >= 0 &&
           along <= length * length;
  };
  const bool is_point = cubic[1] == cubic[0] && cubic[2] == cubic[3];
  const bool is_line = length > 0 ? is_on_line(cubic[1]) && is_on_line(cubic[2]) : is_point;
  if (is_line)
    command('L', {cubic[3]});
  else
    command('C', {cubic[1], cubic[2], cubic[3]});
}

void PathWriter::command(char letter, std::initializer_list<Complex> points) {
  text_ += letter;
  for (const Complex& z : points) {
    const Complex w = map_(z);
    for (const double x : {w.real(), w.imag()}) {
      if (text_.back() != letter) text_ += ' ';
      append(x);
    }
  }
}

void PathWriter::append(double x) {
  char number[400];
  const auto [end, wrong] =
      std::to_chars(number, number + sizeof number, x, std::chars_format::fixed, digits_);
  std::string_view digits(number, static_cast<size_t>(end - number));
  if (digits.find('.') != std::string_view::npos) {
    while (digits.back() == '0') digits.remove_suffix(1);
    if (digits.back() == '.') digits.remove_suffix(1);
  }
  text_ += digits == "-0" ? "0" : digits;
}

}  // namespace holomorph
