// All preimages of a point under a map: where a point of the posed picture comes from.
//
// Lin and Chen (2024, section 4.3) integrate around the boundary by a first-order rule. Here the
// posed mesh locates the preimages, the winding number of the boundary's image counts them, and
// Newton's method on the map itself refines them.
#pragma once

#include <memory>

#include "core/cauchy/inside.h"
#include "core/geometry/box_grid.h"
#include "core/maps/deformer.h"
#include "core/maps/image_winding.h"
#include "core/mesh/mesh.h"

namespace holomorph {

/// A point z of the rest with f(z) = w, and the residual |f(z) - w|.
struct Preimage {
  Complex z;
  double residual = 0;
  int triangle = -1;    ///< in or near which it is; later triangles of the mesh are drawn on top
  int orientation = 1;  ///< -1 where the map reverses orientation
};

class InverseMap {
 public:
  /// `positions` are the values of the map at the mesh's vertices. The triangles are in the order
  /// in which they are drawn. The mesh and the map must outlive this object. Cost: linear in the
  /// number of triangles.
  InverseMap(const Cage& rest, const Mesh& mesh, std::span<const Complex> positions,
             const PointMap& map);
  InverseMap(const InverseMap&) = delete;  // its members refer to each other
  InverseMap& operator=(const InverseMap&) = delete;

  /// All preimages of w inside the cage, the topmost first. If w is not on the boundary's image,
  /// their orientations add up to the winding number of that image around w. For a holomorphic map,
  /// this means that no preimage is missing; a branch point is listed once for each sheet that
  /// meets there. Residuals are usually a few rounding errors and never exceed 1e-11 times the sum
  /// of the cage's size and |w|. Cost: about ten evaluations of the map, or up to a few thousand if
  /// sheets are smaller than triangles.
  std::vector<Preimage> at(Complex w) const;

  /// The winding number of the boundary's image around w; empty when w lies on that image to within
  /// rounding error.
  std::optional<int> winding(Complex w) const;

 private:
  struct Cell {
    int first = 0, count = 0;
    bool on_boundary = false;  ///< whether the boundary's image or its chords may pass through
    bool may_fold = false;     ///< whether nearby triangles are flipped or strongly sheared
  };
  /// Three arcs that enclose a part of the domain.
  using Region = std::array<Arc, 3>;

  template <class Visit>
  void for_each_cell(const Box& box, Visit visit) {
    grid_.for_each_cell(box, [&](size_t cell) { visit(cells_[cell]); });
  }
  void fill_cells();
  void set_up_boundary();
  bool improve(Complex w, Preimage& start) const;
  bool is_inside(Complex z) const;
  bool is_in_inner_triangle(const Preimage& preimage) const;
  void add(Complex w, Complex start, int triangle, std::vector<Preimage>& found) const;
  Complex pulled_inside(Complex start, int triangle) const;
  std::vector<Preimage> find(Complex w) const;
  std::vector<Preimage> newton_from_grid(Complex w, std::optional<int> wanted) const;
  std::vector<Preimage> search_triangles(Complex w, int wanted) const;
  Arc side(int from, int to) const;
  std::optional<int> turns(const Region& region, Complex w) const;
  std::vector<Preimage> inside(const Region& region, Complex w) const;
  void search_region(const Region& region, int count, Complex w, int depth,
                     std::vector<Preimage>& found) const;

  Cage rest_;
  Inside inside_;  ///< of the rest
  const Mesh& mesh_;
  Points positions_;
  const PointMap& map_;
  ImageWinding winding_;
  Points boundary_;                          ///< the mesh's boundary, posed
  std::vector<ImageWinding::Piece> pieces_;  ///< of the boundary
  std::vector<int> piece_at_;                ///< by vertex: the piece that starts there, or -1
  double reach_ = 0;                         ///< the longest posed edge of the boundary
  double near_ = 0;  ///< distance from the boundary below which the exact test is used
  FlatCage flat_;
  double size_ = 1;
  std::vector<char> outer_;  ///< the mesh's boundary_marks
  BoxGrid grid_;
  std::vector<Cell> cells_;
  std::vector<int> triangles_;  ///< triangle indices, cell by cell
};

}  // namespace holomorph
