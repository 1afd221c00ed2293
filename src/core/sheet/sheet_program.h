// Finds the map of least energy of an elastic sheet whose handles pull at it.
#pragma once

#include <functional>

#include "core/sheet/sheet_energy.h"
#include "core/sheet/spring.h"

namespace holomorph {

/// A point that a handle pulls at. Its image is a sum of the images of vertices with real weights.
struct SheetRow {
  std::vector<std::pair<int, double>> terms;  ///< vertices and their weights

  Complex image(const VectorXc& f) const {
    Complex sum = 0;
    for (const auto& [v, part] : terms) sum += part * f[v];
    return sum;
  }
};

/// What holds a sheet, whatever the pose is.
struct SheetHolds {
  std::vector<SheetRow> rows;
  /// For each vertex, whether its x and its y stay. Empty: none do.
  std::vector<std::array<bool, 2>> fixed;
};

/// A pull at a vertex.
struct VertexPull {
  int vertex = 0;
  Complex target;
  Spring spring;
};

/// Where the handles pull a sheet.
struct SheetPull {
  struct Row {
    Complex target;
    Spring spring;
  };
  std::vector<Row> rows;
  std::vector<VertexPull> vertices = {};
  VectorXc load = {};  ///< a constant force at each vertex; empty: none
};

/// Minimizes the energy plus the pull of the handles. Holds the symbolic factorization of a mesh
/// and the vertices that its rows join, so that a step only has numbers to compute.
class SheetProgram {
 public:
  /// Cost: a symbolic sparse factorization.
  SheetProgram(std::shared_ptr<const SheetEnergy> energy, SheetHolds holds);
  ~SheetProgram();

  /// The energy, with the pull. Infinite if a triangle is flipped.
  double value(const VectorXc& f, const SheetPull& pull) const;
  /// Its derivatives in x and y of each vertex, and 0 where these are fixed.
  VectorXd gradient(const VectorXc& f, const SheetPull& pull) const;

  struct Step {
    double value = 0;      ///< after the step
    double energy = 0;     ///< the same without the work of the load, which may be negative
    double decrement = 0;  ///< by how much the quadratic model expected the value to fall
    double length = 0;     ///< the part of the Newton step that was taken; 0: none lowers the value
  };
  /// A Newton step from f, which must not have a flipped triangle, and does not have one
  /// afterwards: at most 0.9 of the way to the first flip, and halved until the value falls
  /// (Armijo). With `projected`, the Hessians of triangles are made semidefinite, and those of
  /// springs are replaced by larger ones, so that no step goes too far, which is faster
  /// far from the minimum. Without it, Newton's method converges quadratically; where the matrix is
  /// not definite, the step is as with it. Cost: one to three sparse factorizations.
  Step step(const SheetPull& pull, VectorXc& f, bool projected) const;
  /// Steps until the decrement is at most `tolerance` times the energy, or at most `most` times.
  /// Calls `after`, if there is one, with the map after each step. `is_near`: the first step, too,
  /// need not be projected.
  Step minimize(const SheetPull& pull, VectorXc& f, int most,
                const std::function<void(const VectorXc&)>& after = {}, double tolerance = 1e-10,
                bool is_near = false) const;

  const SheetEnergy& energy() const { return *energy_; }

 private:
  struct Factor;
  bool factorize(const SheetPull& pull, const VectorXc& f, bool projected) const;
  bool is_fixed(Index unknown) const {
    return !holds_.fixed.empty() &&
           holds_.fixed[static_cast<size_t>(unknown / 2)][static_cast<size_t>(unknown % 2)];
  }

  std::shared_ptr<const SheetEnergy> energy_;
  SheetHolds holds_;
  Eigen::SparseMatrix<double> constant_;  ///< of bending; the lower triangle
  /// For each triangle, where the lower triangle of its 6 x 6 Hessian goes in the values of the
  /// matrix; -1 for fixed unknowns.
  std::vector<std::array<int, 21>> slots_;
  std::vector<std::vector<int>>
      row_slots_;  ///< the same for rows, with 2 x 2 blocks of their terms
  std::unique_ptr<Factor> factor_;
};

}  // namespace holomorph
