// In-between maps that keep shapes: rotations and sizes are blended, never positions.
//
// A map of a mesh has constant f_z and f_zbar in each triangle. L = ln f_z and nu = conj(f_zbar) /
// f_z are blended, and the map is recovered from the result by least squares. Between conformal
// maps, this blends angles and logarithms of sizes (Weber, Gotsman 2010, sec. 6). Between harmonic
// maps, the blended L and nu are again holomorphic. Then |nu| does not exceed the larger value of
// the two maps, and the smallest stretch does not fall below the smaller value of the two. The
// largest stretch may exceed both values by a factor of (1 + t k) / (1 + k)^t with t from 0 to 1,
// where k is the larger |nu|; the factor is less than 1.0615.
#pragma once

#include <Eigen/SparseCholesky>
#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include "core/mesh/mesh.h"

namespace holomorph {

/// The expected rotation from one map to the next: the rotation of the triangle that contains a
/// given rest point or, without a point, the average rotation.
struct ExpectedTurn {
  std::optional<Complex> at;
  double radians = 0;
};

/// A point at which the maps with values a and b at the mesh's vertices agree. If there is none,
/// the vertex whose two images are closest to each other.
Location least_moving_point(const Mesh& mesh, const VectorXc& a, const VectorXc& b);

class Inbetween {
 public:
  /// Cost: a sparse factorization, 60 ms for 10,000 vertices.
  explicit Inbetween(std::shared_ptr<const Mesh> mesh);

  /// A map at the mesh's vertices, and its decomposition.
  struct Shape {
    VectorXc f;
    /// ln f_z in each triangle, continuous in each part, except next to triangles that are flipped
    VectorXc logarithm;
    VectorXc nu;
    int turns = 0;  ///< whole turns added to the first triangle's angle in [-pi, pi]
  };
  /// Decomposes a map with a known number of whole turns. Triangles of zero size are treated as
  /// very small ones.
  Shape shape_of(const VectorXc& f, int turns = 0) const;
  /// A shape with other whole turns, such that the rotation since `before` is as close as possible
  /// to the expected rotation, which is 0 by default. Triangles that are flipped do not count.
  Shape shape_after(const Shape& before, Shape shape, const ExpectedTurn& expected = {}) const;

  /// The time derivative of each triangle's logarithm at a key, for interpolation by monotone
  /// cubics (Fritsch, Carlson 1980). The times from the key to its neighbors are `to_before` and
  /// `to_after`. The derivative is 0 at the first and last key.
  VectorXc slopes(const Shape* before, const Shape& here, const Shape* after, double to_before,
                  double to_after) const;

  /// One interval between two keys.
  struct Interval {
    const Shape &from, &to;
    double duration = 1;
    const VectorXc *slopes_from = nullptr,
                   *slopes_to = nullptr;  ///< both or neither; linear if none
    /// least_moving_point of the keys, if the mesh has one part; null: not known yet
    const Location* still = nullptr;
  };
  /// The map at u in [0, 1] of an interval. It equals the two keys exactly at the ends. The point
  /// of each part that moves least between the two keys follows a straight line. Cost: 4 ms for
  /// 10,000 vertices.
  void blend(const Interval& interval, double u, VectorXc& f) const;

  /// Moves the vertices until no triangle is flipped. In each round, the triangles that are flipped
  /// or nearly so take the nearest maps that are not, and vertices follow by least squares. Returns
  /// whether it succeeded. Cost: up to 200 times that of blend().
  bool unfold(VectorXc& f) const;

  const Mesh& mesh() const { return *mesh_; }

 private:
  struct Derivatives {
    Complex fz, fzbar;
  };
  Derivatives derivatives(const VectorXc& f, Index triangle) const;
  /// Adds what the right side has if a triangle shall have these derivatives.
  void add_right_side(Index triangle, const Derivatives& wanted, VectorXc& right) const;

  std::shared_ptr<const Mesh> mesh_;
  /// Triangles, part by part, ordered such that each one except a part's first has an earlier
  /// neighbor.
  struct Visit {
    int triangle, from;
  };
  std::vector<Visit> order_around(const std::vector<char>& flipped) const;
  VectorXd areas_of_upright(const Shape& a, const Shape& b) const;

  std::vector<std::array<int, 3>> neighbors_;  ///< of each triangle, across its sides; -1: none
  std::vector<Visit> order_;
  std::vector<size_t> part_starts_;  ///< where each part starts in it
  VectorXd areas_;
  /// A vertex of each part, and the weight with which the Laplacian holds it.
  std::vector<std::pair<int, double>> anchors_;
  std::shared_ptr<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>> laplacian_;
};

}  // namespace holomorph
