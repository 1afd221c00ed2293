// Where a point of the posed picture comes from: all preimages of a map.
//
// Lin, Chen 2024, 4.3 integrate around the boundary, to first order. Here the posed mesh tells
// where preimages are, the boundary's image how many, and Newton's method on the map itself does
// the rest.
#pragma once

#include <memory>

#include "core/maps/image_winding.h"
#include "core/mesh/mesh.h"

namespace holomorph {

/// A point z of the rest with f(z) = w, and |f(z) - w|.
struct Preimage {
  Complex z;
  double residual = 0;
  int triangle = -1;    ///< of the mesh; later ones are drawn on top
  int orientation = 1;  ///< -1 where the map turns the plane over
};

class InverseMap {
 public:
  /// `positions` are the map at the mesh's vertices. Both the mesh and the map must outlive this.
  /// Cost: linear in the triangles.
  InverseMap(const Cage& rest, const Mesh& mesh, std::span<const Complex> positions,
             const PointMap& map);
  InverseMap(const InverseMap&) = delete;  // its parts refer to each other
  InverseMap& operator=(const InverseMap&) = delete;

  /// All preimages of w inside the cage, the one drawn on top first; empty when there is none. For
  /// w off the boundary's image they are as many as it winds around w, counted with their
  /// orientation: all there are where the map is holomorphic, branch points as often as sheets meet
  /// there. Residuals are mostly a few rounding errors, at most 1e-11 of the cage's size and of
  /// |w|. Cost: about ten evaluations of the map, up to a few thousand where sheets are smaller
  /// than triangles.
  std::vector<Preimage> at(Complex w) const;

  /// How often the boundary's image winds around w; none when w is on it, as well as rounding can
  /// tell.
  std::optional<int> winding(Complex w) const;

 private:
  struct Cell {
    int first = 0, count = 0;
    bool on_boundary = false;  ///< whether the boundary's image may be between it and its chords
    bool may_fold = false;     ///< whether triangles here are turned over, or nearly flat
  };
  /// Three arcs around a part of the domain.
  using Region = std::array<Arc, 3>;

  template <class Visit>
  void for_each_cell(const Box& box, Visit visit);
  void fill_cells();
  void set_up_boundary();
  size_t cell_of(Complex w) const;
  bool improve(Complex w, Preimage& start) const;
  bool is_inside(Complex z) const;
  bool is_in_inner_triangle(const Preimage& preimage) const;
  void add(Complex w, Complex start, int triangle, std::vector<Preimage>& found) const;
  Complex pulled_inside(Complex start, int triangle) const;
  std::vector<Preimage> quickly(Complex w, std::optional<int> wanted) const;
  std::vector<Preimage> thoroughly(Complex w, int wanted) const;
  Arc side(int from, int to) const;
  std::optional<int> turns(const Region& region, Complex w) const;
  std::vector<Preimage> inside(const Region& region, Complex w) const;
  void search_region(const Region& region, int count, Complex w, int depth,
                     std::vector<Preimage>& found) const;

  Cage rest_;
  const Mesh& mesh_;
  Points positions_;
  const PointMap& map_;
  ImageWinding winding_;
  Points boundary_;                          ///< the mesh's, posed
  std::vector<ImageWinding::Piece> pieces_;  ///< of the boundary
  std::vector<int> piece_at_;                ///< that starts at a vertex, or -1
  double reach_ = 0;                         ///< the longest posed edge of the boundary
  double near_ = 0;                          ///< how near to the boundary the exact test decides
  FlatCage flat_;
  double size_ = 1;
  std::vector<char> outer_;  ///< the mesh's boundary_marks
  Box box_;
  int columns_ = 1, rows_ = 1;
  std::vector<Cell> cells_;
  std::vector<int> triangles_;  ///< cell by cell
};

}  // namespace holomorph
