// The matrix of the energy is the cotangent Laplacian, weighted by stiffness, plus the handles.
#include "core/methods/rigid_energy.h"

#include <map>

#include "core/arithmetic.h"
#include "core/error.h"
#include "core/maps/distortion.h"
#include "core/mesh/coarser.h"

namespace holomorph {
namespace {

constexpr double kHandleWeight = 1e3;  ///< relative to the energy's mean diagonal
/// A coarser mesh has fewer vertices by this factor, but at least kFewest.
constexpr size_t kCoarsening = 8, kFewest = 100;
constexpr int kCoarseCycles = 2, kCoarsestIterations = 30;

}  // namespace

/// The energy on the next coarser mesh, and how values pass between the meshes.
struct RigidEnergy::Coarser {
  Coarser(std::shared_ptr<const Mesh> mesh, CoarserMesh made, const RigidEnergy& fine,
          std::span<const BrushDab> stiffness)
      : kept(std::move(made.kept)),
        locations(std::move(made.locations)),
        energy(mesh, stiffness, restricted_handles(*mesh, fine.handles_), fine.handle_weight_) {}

  /// Values at the vertices that this mesh has kept.
  VectorXc injected(const VectorXc& values) const {
    VectorXc found(static_cast<Index>(kept.size()));
    for (Index v = 0; v < found.size(); ++v) found[v] = values[kept[static_cast<size_t>(v)]];
    return found;
  }

  /// The transpose of interpolated().
  VectorXc restricted(const VectorXc& values) const {
    VectorXc sum = VectorXc::Zero(static_cast<Index>(kept.size()));
    for (size_t v = 0; v < locations.size(); ++v) {
      const Triangle& t = energy.mesh_->triangles[static_cast<size_t>(locations[v].triangle)];
      for (size_t k = 0; k < 3; ++k)
        sum[t[k]] += locations[v].weights[k] * values[static_cast<Index>(v)];
    }
    return sum;
  }

  VectorXc interpolated(const VectorXc& values) const {
    VectorXc found(static_cast<Index>(locations.size()));
    for (size_t v = 0; v < locations.size(); ++v)
      found[static_cast<Index>(v)] = locations[v].in(*energy.mesh_, as_span(values));
    return found;
  }

  std::vector<int> kept;            ///< the vertices of the finer mesh that this one has
  std::vector<Location> locations;  ///< of the finer mesh's vertices
  RigidEnergy energy;

 private:
  /// The finer mesh's handles as sums of this mesh's vertices. With any other choice of
  /// handles, cycles would not converge to the finer mesh's minimum.
  std::vector<Handle> restricted_handles(const Mesh& mesh, const std::vector<Handle>& fine) const {
    std::vector<Handle> found;
    for (const Handle& handle : fine) {
      std::map<int, double> sum;
      for (const auto& [v, weight] : handle) {
        const Location& at = locations[static_cast<size_t>(v)];
        for (size_t k = 0; k < 3; ++k)
          sum[mesh.triangles[static_cast<size_t>(at.triangle)][k]] += weight * at.weights[k];
      }
      Handle& coarse = found.emplace_back();
      for (const auto& [v, weight] : sum) coarse.push_back({v, weight});
    }
    return found;
  }
};

RigidEnergy::RigidEnergy(std::shared_ptr<const Mesh> mesh, std::span<const BrushDab> stiffness,
                         const std::vector<Location>& handles)
    : RigidEnergy(mesh, stiffness, handles_at(*mesh, handles), std::nullopt) {}

RigidEnergy::RigidEnergy(std::shared_ptr<const Mesh> shared, std::span<const BrushDab> stiffness,
                         std::vector<Handle> handles, std::optional<double> handle_weight)
    : mesh_(std::move(shared)), handles_(std::move(handles)) {
  const Mesh& mesh = *mesh_;
  const Index n = static_cast<Index>(mesh.vertices.size());
  std::vector<Eigen::Triplet<double>> entries;
  double diagonal = 0, stiffest = 1;
  for (const Triangle& t : mesh.triangles) {
    const Complex middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
    stiffness_.push_back(std::pow(10, stiffness_level(stiffness, middle)));
    stiffest = std::max(stiffest, stiffness_.back());
    const double area = area_of(mesh, t);
    rounding_ += 1e-15 * stiffness_.back() * area;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const double weight =
            dot(opposite_side(mesh, t, a), opposite_side(mesh, t, b)) / (8 * area);
        entries.push_back({t[a], t[b], weight * stiffness_.back()});
        if (a == b) diagonal += weight;
      }
  }
  handle_weight_ =
      handle_weight.value_or(kHandleWeight * stiffest * diagonal / static_cast<double>(n));
  for (const Handle& handle : handles_)
    for (const auto& [v, a] : handle)
      for (const auto& [w, b] : handle) entries.push_back({v, w, handle_weight_ * a * b});
  matrix_.resize(n, n);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(matrix_);
  check(factor_.info() == Eigen::Success, "rigid energy: the matrix is definite");

  if (mesh.vertices.size() < 2 * kFewest) return;
  CoarserMesh coarser = coarser_mesh(mesh, std::max(kFewest, mesh.vertices.size() / kCoarsening));
  if (2 * coarser.kept.size() > mesh.vertices.size()) return;
  const auto fewer = std::make_shared<const Mesh>(std::move(coarser.mesh));
  coarser_ = std::make_shared<const Coarser>(fewer, std::move(coarser), *this, stiffness);
}

std::vector<RigidEnergy::Handle> RigidEnergy::handles_at(const Mesh& mesh,
                                                         const std::vector<Location>& locations) {
  std::vector<Handle> handles;
  for (const Location& at : locations) {
    Handle& handle = handles.emplace_back();
    for (size_t k = 0; k < 3; ++k)
      handle.push_back({mesh.triangles[static_cast<size_t>(at.triangle)][k], at.weights[k]});
  }
  return handles;
}

VectorXc RigidEnergy::pull(const Points& targets) const {
  VectorXc sum = VectorXc::Zero(matrix_.rows());
  for (size_t h = 0; h < targets.size(); ++h)
    for (const auto& [v, weight] : handles_[h]) sum[v] += handle_weight_ * weight * targets[h];
  return sum;
}

VectorXc RigidEnergy::rotations_of(const VectorXc& f) const {
  VectorXc rotations(static_cast<Index>(mesh_->triangles.size()));
  for (Index i = 0; i < rotations.size(); ++i) {
    const Triangle& t = mesh_->triangles[static_cast<size_t>(i)];
    Complex fz = 0;  // times a positive factor
    for (int a = 0; a < 3; ++a) fz += times(-kI * std::conj(opposite_side(*mesh_, t, a)), f[t[a]]);
    const double size = std::sqrt(std::norm(fz));
    rotations[i] = size > 0 ? fz / size : Complex(1);
  }
  return rotations;
}

VectorXc RigidEnergy::turned_by(const VectorXc& rotations) const {
  VectorXc sum = VectorXc::Zero(matrix_.rows());
  for (size_t i = 0; i < mesh_->triangles.size(); ++i) {
    const Triangle& t = mesh_->triangles[i];
    const Complex turn = 0.25 * stiffness_[i] * rotations[static_cast<Index>(i)];
    for (int a = 0; a < 3; ++a) sum[t[a]] += times(kI * opposite_side(*mesh_, t, a), turn);
  }
  return sum;
}

void RigidEnergy::iterate(const Points& targets, VectorXc& f) const {
  f = factor_.solve(turned_by(rotations_of(f)) + pull(targets));
}

void RigidEnergy::cycle(const Points& targets, VectorXc& f) const {
  improve(pull(targets), f);
}

void RigidEnergy::descend(const Points& targets, VectorXc& f) const {
  const VectorXc start = f;
  const double before = energy(targets, start), most = before + 1e-10 * before + rounding_;
  cycle(targets, f);
  if (energy(targets, f) <= most) return;
  f = 0.5 * (start + f);
  iterate(targets, f);
  if (energy(targets, f) <= most) return;
  f = start;
  iterate(targets, f);
}

double RigidEnergy::energy(const Points& targets, const VectorXc& f) const {
  double sum = 0;
  for (size_t i = 0; i < mesh_->triangles.size(); ++i) {
    const Triangle& t = mesh_->triangles[i];
    const auto [fz, fzbar] = derivatives_in(*mesh_, t, f);
    sum += stiffness_[i] * area_of(*mesh_, t) * (std::pow(std::abs(fz) - 1, 2) + std::norm(fzbar));
  }
  for (size_t h = 0; h < targets.size(); ++h) {
    Complex image = 0;
    for (const auto& [v, weight] : handles_[h]) image += weight * f[v];
    sum += handle_weight_ * std::norm(image - targets[h]);
  }
  return sum;
}

/// Makes the energy for targets 0, minus twice the real part of the inner product of `load` and f,
/// smaller. On the coarser mesh, the load is such that a map there in the same state has the
/// gradient of the finer map. A correction that raises the energy is kept, too: refusing it left
/// large drags with more energy a few frames later. descend() refuses it.
void RigidEnergy::improve(const VectorXc& load, VectorXc& f) const {
  const auto iterate = [&] { f = factor_.solve(turned_by(rotations_of(f)) + load); };
  if (!coarser_) {
    for (int i = 0; i < kCoarsestIterations; ++i) iterate();
    return;
  }
  const RigidEnergy& coarse = coarser_->energy;
  const VectorXc forces = turned_by(rotations_of(f)) + load - matrix_ * f,
                 start = coarser_->injected(f),
                 coarse_load = coarser_->restricted(forces) + coarse.matrix_ * start -
                               coarse.turned_by(coarse.rotations_of(start));
  VectorXc g = start;
  for (int i = 0; i < kCoarseCycles; ++i) coarse.improve(coarse_load, g);
  f += coarser_->interpolated(g - start);
  iterate();
}

}  // namespace holomorph
