// Writes the path data of SVG files.
#pragma once

#include <initializer_list>
#include <string>

#include "core/geometry/affine.h"

namespace holomorph {

/// Path data, command by command. Coordinates have as many digits as are visible.
class PathWriter {
 public:
  /// `map` takes the points that are given to the units that are written. Positions are written to
  /// within `precision`, before the map.
  PathWriter(const Affine& map, double precision);

  void move(Complex to) { command('M', {to}); }
  /// Four control points, of which the first is where the path has come to. It becomes a line if
  /// that differs by less than `flat`.
  void curve(const Points& cubic, double flat);
  void close() { text_ += 'Z'; }
  std::string text() && { return std::move(text_); }

 private:
  void command(char letter, std::initializer_list<Complex> points);
  void append(double x);

  Affine map_;
  int digits_ = 0;
  std::string text_;
};

}  // namespace holomorph
