// The functions whose sums are Hilbert coordinates: cubic Cauchy coordinates of the subdivided
// boundary, and singular functions at the vertices and holes of a cage.
//
// Sums at many points need not evaluate every function at every point. In a disk that is far from
// the place where a function is singular, values at a few points of the circle around it determine
// the function to almost full precision.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "core/geometry/cage.h"
#include "core/geometry/point_groups.h"

namespace holomorph {

class HilbertFunctions {
 public:
  static constexpr size_t kMostPowers = 6;
  struct Vertex {
    Complex at, tip;     ///< the ends of the branch cut outside the cage; `at` is the vertex
    double angle = 0;    ///< the inner angle
    bool jumps = false;  ///< whether there is a logarithm here
    std::vector<double> powers;  ///< exponents of (z - at) / (z - tip), increasing
    std::vector<int> lower;  ///< for each power, the index of the power that is less by 1, or -1
  };

  HilbertFunctions() = default;
  /// `boundary` is oriented. Each of `centers` lies in a hole, and `size` is that of the cage.
  HilbertFunctions(Cage boundary, std::vector<Vertex> vertices, Points centers, double size);

  /// The columns of all functions: first the Cauchy coordinates, then each vertex's logarithm, if
  /// it has one, and powers, and last one logarithm for each hole.
  Index count() const { return count_; }
  /// Whether a column is the logarithm of a vertex.
  bool is_logarithm(Index column) const;

  /// The values of all functions (order 0), or their derivatives (order 1): points x count().
  /// Points must be inside the cage or on its boundary.
  MatrixXc values(std::span<const Complex> points, int order) const;

  /// Receives a group of points and the sums there, points x columns, which it may change.
  using VisitGroup = std::function<void(const PointGroup& group, MatrixXc& sums)>;
  /// Calls `visit`, on all cores, for groups of points that contain each point once. The sums are
  /// values(points, order) * coefficients, except for rounding and 1e-11 of the largest values of
  /// their terms. Cost: all functions at each point if there are few points or few functions;
  /// otherwise those that are singular nearby, and a tenth of the others.
  void for_each_group(std::span<const Complex> points, const MatrixXc& coefficients, int order,
                      const VisitGroup& visit) const;

 private:
  /// ln((z - at) / (z - tip)), with its branch cut between both points, and the powers of that
  /// ratio.
  struct Singular {
    Complex log;
    std::array<Complex, kMostPowers> powers;
  };
  static Singular singular(const Vertex& vertex, Complex z);
  Index first_hole() const { return count_ - static_cast<Index>(centers_.size()); }
  /// The vertex to which a column between those of the boundary and of the holes belongs.
  size_t vertex_of(Index column) const;
  Index end_of(size_t vertex) const;
  /// The same for some groups, one after another. Their circles share one product.
  void visit_batch(std::span<const PointGroup> groups, const MatrixXc& coefficients, int order,
                   const VisitGroup& visit) const;
  /// The columns of the functions that are singular within `distance` of `center`, in order.
  std::vector<Index> singular_within(Complex center, double distance) const;
  /// The values of some functions; `columns` are in order.
  MatrixXc values_of(std::span<const Index> columns, std::span<const Complex> points,
                     int order) const;
  /// Writes the values of a vertex's functions to the columns from `column` on.
  void write_vertex(size_t vertex, std::span<const Complex> points, int order, Index column,
                    MatrixXc& out) const;
  void write_holes(std::span<const Complex> points, int order, Index column, MatrixXc& out) const;

  Cage boundary_;
  std::vector<Vertex> vertices_;
  Points centers_;
  double size_ = 1;
  std::vector<Index> columns_;  ///< of each vertex
  Index count_ = 0;
};

}  // namespace holomorph
