// Method `arap`: triangles may rotate freely, and any other change of shape costs energy (after
// Sorkine, Alexa 2007, with one rotation per triangle).
//
// A map starts from the most conformal one. A draft starts from the map before it.
#include <Eigen/SparseCholesky>

#include "core/arithmetic.h"
#include "core/error.h"
#include "core/maps/mesh_point_map.h"
#include "core/methods/handles.h"
#include "core/methods/rigid_energy.h"
#include "core/methods/rows.h"

namespace holomorph {
namespace {

constexpr int kMostRounds = 120, kDraftRounds = 2;
constexpr Index kManyVertices = 30'000;  ///< drafts of meshes with more have one round
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
      const double area = area_of(t) / energy_.stiffness(i);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
          // The product of the conjugated coefficient of a in f_zbar and the coefficient of b.
          // Adding a small part of the rigid energy makes the matrix definite.
          constexpr double kRigidPart = 1e-3;
          const Complex ea = opposite(t, a), eb = opposite(t, b);
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
    found.f = continues ? before->f : start(targets);
    out.iterations = minimize(targets, options, found.f, out.status);
    return found;
  }

  Index vertices() const { return static_cast<Index>(mesh_.vertices.size()); }
  Complex opposite(const Triangle& t, int corner) const {
    return mesh_.vertices[static_cast<size_t>(t[(corner + 2) % 3])] -
           mesh_.vertices[static_cast<size_t>(t[(corner + 1) % 3])];
  }
  double area_of(const Triangle& t) const { return 0.5 * cross(opposite(t, 2), opposite(t, 0)); }

  struct Derivatives {
    Complex fz, fzbar;
  };
  Derivatives derivatives_of(const Triangle& t, const VectorXc& f) const {
    Derivatives d{0, 0};
    for (int a = 0; a < 3; ++a) {
      const Complex e = opposite(t, a), w = f[t[a]];
      d.fz += times(-kI * std::conj(e), w);
      d.fzbar += times(kI * e, w);
    }
    const double over = 1 / (4 * area_of(t));
    return {d.fz * over, d.fzbar * over};
  }

  /// The most conformal map, found by one linear solve.
  VectorXc start(const Points& targets) const { return conformal_.solve(energy_.pull(targets)); }

  int most_rounds(const EvalOptions& options) const {
    if (!options.draft) return kMostRounds;
    return vertices() > kManyVertices ? 1 : kDraftRounds;
  }

  /// Returns the number of rounds. The status is `iterating` if the last round has still moved f.
  int minimize(const Points& targets, const EvalOptions& options, VectorXc& f,
               SampledMap::Status& status) const {
    int round = 0;
    double moved = HUGE_VAL;
    for (; round < most_rounds(options) && moved > kSmallestMove * size_; ++round) {
      throw_if_stopped(options.stop);
      const VectorXc before = f;
      energy_.cycle(targets, f);
      moved = (f - before).cwiseAbs().maxCoeff();
    }
    if (moved > kSmallestMove * size_) status = SampledMap::Status::iterating;
    return round;
  }

  void answer(const Found& found, SampledMap& out, EvalOptions options) const {
    const Index count = static_cast<Index>(rest_.samples.size());
    if (rest_.samples == mesh_.vertices) {
      out.f = found.f;
      if (options.derivatives) average_derivatives(found, out);
      return;
    }
    out.f.resize(count);
    out.fz.resize(count);
    out.fzbar.resize(count);
    for (Index i = 0; i < count; ++i) {
      const Location& at = places_[static_cast<size_t>(i)];
      const Derivatives d =
          found.turn ? Derivatives{*found.turn, 0}
                     : derivatives_of(mesh_.triangles[static_cast<size_t>(at.triangle)], found.f);
      out.f[i] = at.in(mesh_, as_span(found.f));
      out.fz[i] = d.fz;
      out.fzbar[i] = d.fzbar;
    }
  }

  /// The derivatives at a vertex are the mean over its triangles, weighted by area.
  void average_derivatives(const Found& found, SampledMap& out) const {
    const Index n = found.f.size();
    if (found.turn) {
      out.fz = VectorXc::Constant(n, *found.turn);
      out.fzbar = VectorXc::Zero(n);
      return;
    }
    out.fz = VectorXc::Zero(n);
    out.fzbar = VectorXc::Zero(n);
    VectorXd areas = VectorXd::Zero(n);
    for (const Triangle& t : mesh_.triangles) {
      const Derivatives d = derivatives_of(t, found.f);
      const double area = area_of(t);
      for (const int v : t) {
        out.fz[v] += area * d.fz;
        out.fzbar[v] += area * d.fzbar;
        areas[v] += area;
      }
    }
    out.fz.array() /= areas.array();
    out.fzbar.array() /= areas.array();
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
