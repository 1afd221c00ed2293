// The energy of As rigid as possible on a mesh, and how it is minimized.
#pragma once

#include <Eigen/SparseCholesky>
#include <memory>

#include "core/geometry/stiffness.h"
#include "core/mesh/mesh.h"

namespace holomorph {

/// The energy of a map f that is linear in each triangle: the sum over all triangles of
///     stiffness area (|f_z - R|^2 + |f_zbar|^2),  R = f_z / |f_z|,
/// plus handle_weight() |f(h) - target|^2 for each handle h (after Sorkine, Alexa 2007, eq. 3, with
/// one rotation per triangle). Maps are given by their values at the mesh's vertices.
///
/// Each published iteration makes the rotations of neighboring triangles more alike. A limb that
/// bends needs hundreds of iterations, because its rotations change slowly along many triangles. On
/// a coarser mesh there are fewer triangles between its ends. A RigidEnergy therefore owns the same
/// energy on a coarser mesh, which owns one on a mesh that is coarser still.
class RigidEnergy {
 public:
  /// `handles` are places in the mesh. Cost: sparse factorizations of the mesh and of coarser ones.
  RigidEnergy(std::shared_ptr<const Mesh> mesh, std::span<const BrushDab> stiffness,
              const std::vector<Location>& handles);

  double handle_weight() const { return handle_weight_; }
  double stiffness(size_t triangle) const { return stiffness_[triangle]; }
  /// The part of the linear system's right-hand side that handles with these targets contribute.
  VectorXc pull(const Points& targets) const;

  /// One iteration as published: finds the rotations R of f, and then the map f of least energy for
  /// these rotations.
  void iterate(const Points& targets, VectorXc& f) const;
  /// Improves f on the coarser meshes, and then iterates once; 30 times on the coarsest mesh. This
  /// is a cycle of the full approximation scheme (Brandt 1977). Near a minimum, each cycle makes
  /// the error several times smaller, however fine the mesh is. Cost: about twice that of
  /// iterate() on a mesh of thousands of vertices; on smaller ones, the 30 iterations dominate.
  void cycle(const Points& targets, VectorXc& f) const;
  /// A cycle that does not raise the energy, except by rounding. If the full step would, half of it
  /// is tried, followed by an iteration, and then an iteration alone. Cycles without this condition
  /// are faster when targets have just moved, but may alternate forever between two states of a bar
  /// that buckles. Cost: at most about twice that of cycle().
  void descend(const Points& targets, VectorXc& f) const;

 private:
  struct Coarser;
  /// A handle as a weighted sum of vertices.
  struct Weight {
    int vertex = 0;
    double weight = 0;
  };
  using Handle = std::vector<Weight>;
  RigidEnergy(std::shared_ptr<const Mesh> mesh, std::span<const BrushDab> stiffness,
              std::vector<Handle> handles, std::optional<double> handle_weight);
  double energy(const Points& targets, const VectorXc& f) const;
  static std::vector<Handle> handles_at(const Mesh& mesh, const std::vector<Location>& places);
  VectorXc rotations_of(const VectorXc& f) const;  ///< one per triangle
  /// The part of the right-hand side that triangles with these rotations contribute.
  VectorXc turned_by(const VectorXc& rotations) const;
  void improve(const VectorXc& load, VectorXc& f) const;

  std::shared_ptr<const Mesh> mesh_;
  std::vector<Handle> handles_;
  std::vector<double> stiffness_;  ///< one per triangle
  double handle_weight_ = 1;
  double rounding_ = 0;  ///< rounding error of the energy, at most
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  std::shared_ptr<const Coarser> coarser_;  ///< null for the coarsest mesh
};

}  // namespace holomorph
