// Where a point of the posed picture comes from: all preimages of a map.
//
// Lin, Chen 2024, 4.3 integrate around the boundary, to first order. Here the posed mesh tells how
// many preimages there are and roughly where, and Newton's method on the map itself does the rest.
#pragma once

#include <memory>

#include "core/deformer.h"
#include "core/mesh.h"

namespace holomorph {

/// A point z of the rest with f(z) = w, and |f(z) - w|.
struct Preimage {
  Complex z;
  double residual = 0;
};

class InverseMap {
 public:
  /// `positions` are the map at the mesh's vertices. Both the mesh and the map must outlive this.
  /// Cost: linear in the triangles.
  InverseMap(const Cage& rest, const Mesh& mesh, std::span<const Complex> positions,
             const PointMap& map);

  /// All preimages of w inside the cage that the mesh resolves, the one drawn on top first; empty
  /// when there is none. A sheet of the map that lies within one triangle may be missed.
  /// Residuals are mostly a few rounding errors, at most 1e-11 of the cage's size and of |w|. Cost:
  /// about ten evaluations of the map, many more just outside its boundary.
  std::vector<Preimage> at(Complex w) const;

  /// How many preimages the winding number of the boundary's image promises for a conformal map.
  int expected(Complex w) const;

 private:
  struct Cell {
    int first = 0, count = 0;
  };
  size_t cell_of(Complex w) const;
  bool improve(Complex w, Preimage& start) const;
  bool is_inside(Complex z) const;
  void add(Complex w, Complex start, std::vector<Preimage>& found) const;

  Cage rest_;
  const Mesh& mesh_;
  Points positions_;
  const PointMap& map_;
  Points boundary_;   ///< the mesh's, posed
  double reach_ = 0;  ///< its longest edge: the map's boundary is rarely farther from it
  double near_ = 0;   ///< how near to the boundary the exact test decides
  FlatCage flat_;
  double size_ = 1;
  Box box_;
  int columns_ = 1, rows_ = 1;
  std::vector<Cell> cells_;
  std::vector<int> triangles_;  ///< cell by cell
};

}  // namespace holomorph
