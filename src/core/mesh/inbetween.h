// Maps between maps that keep shapes: turns and sizes are blended, never places.
//
// A map of a mesh has f_z and f_zbar in each triangle; L = ln f_z and nu = conj(f_zbar) / f_z are
// blended and integrated again, in the sense of least squares. Between conformal maps this blends
// angles and logarithms of sizes (Weber, Gotsman 2010, sec. 6); between harmonic ones L and nu stay
// holomorphic, so that |nu| stays below the larger one and the least stretch above the smaller one.
// The largest stretch may exceed both by (1 + k / 2) / sqrt(1 + k), k the larger |nu|.
#pragma once

#include <Eigen/SparseCholesky>
#include <memory>
#include <optional>
#include <span>

#include "core/mesh/mesh.h"

namespace holomorph {

/// How much of a whole turn a part of the picture makes from one map to the next: of the triangle
/// around a place at rest, or on average.
struct ExpectedTurn {
  std::optional<Complex> at;
  double radians = 0;
};

class Inbetween {
 public:
  /// Cost: a sparse factorisation, 60 ms for 10,000 vertices.
  explicit Inbetween(std::shared_ptr<const Mesh> mesh);

  /// A map at the mesh's vertices, taken apart.
  struct Shape {
    VectorXc f;
    VectorXc logarithm;  ///< of f_z in each triangle, continuous
    VectorXc nu;
    int turns = 0;  ///< whole ones, beyond the angle from -pi to pi of the first triangle
  };
  /// `before`, when given, decides about whole turns: the average is the nearest one to what is
  /// expected, and to that map's otherwise. Triangles of no size count as very small ones.
  Shape shape_of(const VectorXc& f, const Shape* before = nullptr,
                 const ExpectedTurn& expected = {}) const;
  /// The same with whole turns that are known already.
  Shape shape_of(const VectorXc& f, int turns) const;

  /// By how much each quantity of a shape changes with time at a key between its neighbors, which
  /// lie `to_before` and `to_after` away: monotone cubics (Fritsch, Carlson 1980); 0 at ends.
  VectorXc slopes(const Shape* before, const Shape& here, const Shape* after, double to_before,
                  double to_after) const;

  /// One interval between two keys.
  struct Interval {
    const Shape &from, &to;
    double duration = 1;
    const VectorXc *slopes_from = nullptr, *slopes_to = nullptr;  ///< both or none: straight
  };
  /// The map at u from 0 to 1 of an interval; exact at both ends. The place that moves least
  /// between the two maps goes straight. Cost: 4 ms for 10,000 vertices.
  void blend(const Interval& interval, double u, VectorXc& f) const;

  const Mesh& mesh() const { return *mesh_; }

 private:
  Complex opposite(const Triangle& t, int corner) const {
    return mesh_->vertices[static_cast<size_t>(t[(corner + 2) % 3])] -
           mesh_->vertices[static_cast<size_t>(t[(corner + 1) % 3])];
  }

  Location stillest(const VectorXc& a, const VectorXc& b) const;

  std::shared_ptr<const Mesh> mesh_;
  /// Triangles in an order in which each one but the first has an earlier neighbor.
  struct Visit {
    int triangle, from;
  };
  std::vector<Visit> order_;
  VectorXd areas_;
  std::shared_ptr<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>> laplacian_;
};

}  // namespace holomorph
