// Method `arap`: triangles may rotate freely, and any other change of shape costs energy (after
// Sorkine, Alexa 2007, with one rotation per triangle).
//
// A map starts from the most conformal one. A draft starts from the map before it.
#include <Eigen/SparseCholesky>

#include "core/arithmetic.h"
#include "core/error.h"
#include "core/maps/distortion.h"
#include "core/maps/mesh_point_map.h"
#include "core/methods/handles.h"
#include "core/methods/rigid_energy.h"
#include "core/methods/rows.h"

namespace holomorph {
namespace {

constexpr int kMostRounds = 120, kDraftRounds = 2;
constexpr Index kManyVertices = 30'000;  ///< drafts of meshes with more have one round
constexpr int kFreeRounds = 40;          ///< with the same targets that may raise the energy
constexpr double kSmallestMove = 1e-5;   ///< largest displacement per round, relative to the size

class ArapDeformer final : public Deformer {
 public:
  explicit ArapDeformer(const Rest& rest)
      : rest_(rest),
        mesh_(*rest.mesh),
        handles_(rest_),
        energy_(rest.mesh, rest.stiffness, handles_.locations()) {
    size_ = box_of(mesh_.vertices).diagonal();
    const Index n = vertices();
    std::vector<Eigen::Triplet<Complex>> entries;
    for (size_t i = 0; i < mesh_.triangles.size(); ++i) {
      const Triangle& t = mesh_.triangles[i];
      const double area = area_of(mesh_, t) / energy_.stiffness(i);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
          // The product of the conjugated coefficient of a in f_zbar and the coefficient of b.
          // Adding a small part of the rigid energy makes the matrix definite.
          constexpr double kRigidPart = 1e-3;
          const Complex ea = opposite_side(mesh_, t, a), eb = opposite_side(mesh_, t, b);
          entries.push_back(
              {t[a], t[b],
               std::conj(ea) * eb / (16 * area) + kRigidPart * dot(ea, eb) / (8 * area)});
        }
    }
    for (const Location& at : handles_.locations())
      for (size_t a = 0; a < 3; ++a)
        for (size_t b = 0; b < 3; ++b) {
          const Triangle& t = mesh_.triangles[static_cast<size_t>(at.triangle)];
          entries.push_back({t[a], t[b], energy_.handle_weight() * at.weights[a] * at.weights[b]});
        }
    Eigen::SparseMatrix<Complex> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    conformal_.compute(matrix);
    check(conformal_.info() == Eigen::Success, "arap: the conformal energy is definite");
    if (rest_.samples == mesh_.vertices) return;
    for (const Complex& z : rest_.samples) places_.push_back(locate_near(mesh_, z));
  }

  using Deformer::deform;
  SampledMap deform(const Pose& pose, EvalOptions options, const Solution* from) override {
    SampledMap out;
    const auto found =
        std::make_shared<const Found>(solved(pose, options, dynamic_cast<const Found*>(from), out));
    answer(*found, out, options);
    out.solution = found;
    return out;
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    SampledMap ignored;
    return std::make_unique<MeshPointMap>(rest_.mesh, solved(pose, {}, nullptr, ignored).f);
  }

 private:
  struct Found : Solution {
    VectorXc f;                   ///< at the vertices
    Points targets;               ///< of the handles
    int rounds = 0;               ///< with these targets, with those of the maps it continues
    std::optional<Complex> turn;  ///< rotation of the whole picture when it moves rigidly
  };

  /// Drafts continue from `before` unless it is null. Sets the remarks in `out`.
  Found solved(const Pose& pose, const EvalOptions& options, const Found* before,
               SampledMap& out) const {
    const Points targets = handles_.targets(pose);
    out.note = handles_.note();
    Found found;
    if (const auto rigid = handles_.rigid(targets)) {
      found.turn = rigid->factor;
      found.f.resize(vertices());
      for (Index i = 0; i < found.f.size(); ++i)
        found.f[i] = rigid->factor == Complex(1) && rigid->from == rigid->to
                         ? mesh_.vertices[static_cast<size_t>(i)]
                         : (*rigid)(mesh_.vertices[static_cast<size_t>(i)]);
      return found;
    }
    const bool continues = options.draft && before && before->f.size() == vertices();
    found.targets = targets;
    if (continues && before->targets == targets) found.rounds = before->rounds;
    Minimized least =
        minimized(targets, options, continues ? before->f : start(targets), found.rounds);
    out.iterations = least.rounds;
    found.rounds += least.rounds;
    if (least.still_moves) out.status = SampledMap::Status::iterating;
    found.f = std::move(least.f);
    return found;
  }

  Index vertices() const { return static_cast<Index>(mesh_.vertices.size()); }

  /// The most conformal map, found by one linear solve.
  VectorXc start(const Points& targets) const { return conformal_.solve(energy_.pull(targets)); }

  int most_rounds(const EvalOptions& options) const {
    if (!options.draft) return kMostRounds;
    return vertices() > kManyVertices ? 1 : kDraftRounds;
  }

  struct Minimized {
    VectorXc f;
    int rounds = 0;
    bool still_moves = false;  ///< whether the last round has moved f
  };
  /// Continues from f, after `earlier` rounds with the same targets.
  Minimized minimized(const Points& targets, const EvalOptions& options, VectorXc f,
                      int earlier) const {
    int round = 0;
    double moved = HUGE_VAL;
    for (; round < most_rounds(options) && moved > kSmallestMove * size_; ++round) {
      throw_if_stopped(options.stop);
      const VectorXc before = f;
      if (earlier + round < kFreeRounds)
        energy_.cycle(targets, f);
      else
        energy_.descend(targets, f);
      moved = (f - before).cwiseAbs().maxCoeff();
    }
    return {std::move(f), round, moved > kSmallestMove * size_};
  }

  void answer(const Found& found, SampledMap& out, EvalOptions options) const {
    const Index count = static_cast<Index>(rest_.samples.size());
    if (rest_.samples == mesh_.vertices) {
      out.f = found.f;
      if (!options.derivatives) return;
      VertexDerivatives at = found.turn ? VertexDerivatives{VectorXc::Constant(count, *found.turn),
                                                            VectorXc::Zero(count)}
                                        : vertex_derivatives(mesh_, found.f);
      out.fz = std::move(at.fz);
      out.fzbar = std::move(at.fzbar);
      return;
    }
    out.f.resize(count);
    out.fz.resize(count);
    out.fzbar.resize(count);
    for (Index i = 0; i < count; ++i) {
      const Location& at = places_[static_cast<size_t>(i)];
      const LinearDerivatives d =
          found.turn
              ? LinearDerivatives{*found.turn, 0}
              : derivatives_in(mesh_, mesh_.triangles[static_cast<size_t>(at.triangle)], found.f);
      out.f[i] = at.in(mesh_, as_span(found.f));
      out.fz[i] = d.fz;
      out.fzbar[i] = d.fzbar;
    }
  }

  Rest rest_;
  const Mesh& mesh_;
  HandlePoints handles_;
  std::vector<Location> places_;  ///< of the samples, if they are not the vertices
  double size_ = 1;
  RigidEnergy energy_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complex>> conformal_;
};

std::unique_ptr<Deformer> make_arap(const Rest& rest, const Deformer*) {
  return std::make_unique<ArapDeformer>(rest);
}

}  // namespace

Method arap_method() {
  return {
      .id = "arap",
      .label = "As rigid as possible",
      .summary = "Keeps parts stiff. Pins may leave spikes.",
      .hint =
          "Pins stay where you put them, and everything else keeps its size and shape as far as "
          "possible. Paint stiffness (B) on parts that should change least. Without pins, the cage "
          "points stay where you put them.",
      .uses_pins = true,
      .uses_stiffness = true,
      .holds_disks = true,
      .pins_replace_cage = true,
      .iterates = true,
      .harmonic = false,
      .reproduces = Method::Motions::rigid,
      .needs_mesh = true,
      .make = make_arap,
  };
}

}  // namespace holomorph
