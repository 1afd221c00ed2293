// A way from rest to where the handles of a sheet go.
#pragma once

#include "core/mesh/inbetween.h"
#include "core/sheet/sheet_program.h"

namespace holomorph {

/// Finds the map that is as conformal as possible, among those that take rows of a sheet to their
/// targets, and the way to it from rest: rotations and sizes are blended. Pins that are to form an
/// arc thus curl the picture, where straight ways would crush it.
class ConformalPaths {
 public:
  /// Cost: two sparse factorizations.
  ConformalPaths(std::shared_ptr<const Mesh> mesh, std::vector<SheetRow> rows);
  ~ConformalPaths();

  struct Path {
    Inbetween::Shape end;  ///< the conformal map, which may fold
    Location still;        ///< the point that moves least
  };
  /// Cost: a sparse solve.
  Path path(const VectorXc& displacements) const;
  /// A path that winds the picture up: sizes stay, and rotations are these at one or more places,
  /// in radians, and smooth in between. Cost: a sparse factorization.
  Path wound(std::span<const Location> places, std::span<const double> rotations) const;
  /// The same path with more whole turns.
  static Path turned(Path path, int turns) {
    path.end.logarithm.array() += Complex(0, 2 * kPi * turns);
    return path;
  }
  /// The rotation at the end of a path in a triangle, in radians. Rotations are continuous along
  /// the mesh, and small on average.
  static double rotation(const Path& path, int triangle) {
    return path.end.logarithm[triangle].imag();
  }
  /// The map at a part of the path, from 0 to 1. Cost: a sparse solve.
  VectorXc at(const Path& path, double part) const;

 private:
  struct Factor;
  std::shared_ptr<const Mesh> mesh_;
  std::vector<SheetRow> rows_;
  Inbetween between_;
  Inbetween::Shape rest_;
  std::unique_ptr<Factor> factor_;
};

}  // namespace holomorph
