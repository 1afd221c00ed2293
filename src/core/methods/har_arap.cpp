// Method `har_arap`: minimizes the energy of `arap` over the smooth maps f = Phi + conj(Psi), with
// Phi and Psi in a Cauchy basis (the har-ARAP of Levi, Weber 2016).
//
// There are a few hundred unknowns. The energy is a sum over samples instead of triangles. Here f_z
// = Phi' and f_zbar = conj(Psi').
#include "core/cauchy/boundary_basis.h"
#include "core/error.h"
#include "core/mesh/area_samples.h"
#include "core/methods/handles.h"
#include "core/methods/linear.h"
#include "core/methods/rows.h"
#include "core/solvers/real_form.h"

namespace holomorph {
namespace {

constexpr int kSamplesEach = 3;
constexpr size_t kAreaSamples = 400;
constexpr int kMostSteps = 400, kFewSteps = 30;
constexpr double kStill = 1e-9;
constexpr double kHandlePull = 1e3;  ///< weight of a handle, relative to the mean energy
constexpr double kRigidPart = 1e-3;  ///< weight of rigidity in the otherwise conformal start
constexpr double kDefinite = 1e-9;   ///< fixes a constant that can move between Phi and Psi

class HarArapDeformer final : public Deformer {
 public:
  explicit HarArapDeformer(const Rest& rest)
      : rest_(rest),
        handles_(rest_),
        basis_(rest.cage, BoundaryBasis::usual_size(rest.cage.size()),
               kSamplesEach * BoundaryBasis::usual_size(rest.cage.size())) {
    size_ = box_of(rest.mesh->vertices).diagonal();
    set_up_energy();
    set_up_handles();
    const Cage polygon = polygon_cage(basis_.polygon());
    values_ = planar_coordinates<double>(polygon, rest_.samples, 0);
    slopes_ = planar_coordinates<double>(
        polygon, rest_.derivative_samples.empty() ? rest_.samples : rest_.derivative_samples, 1);
  }

  using Deformer::deform;
  SampledMap deform(const Pose& pose, EvalOptions options, const Solution* from) override {
    const Points targets = handles_.targets(pose);
    SampledMap out;
    out.note = handles_.note();
    if (const auto rigid = handles_.rigid(targets))
      return moved_rigidly(*rigid, std::move(out), options);
    const VectorXd handles = handle_right(targets);
    const auto* before = dynamic_cast<const Found*>(from);
    const bool continues = options.draft && before && before->phi.size() == basis_.size();
    const auto found =
        std::make_shared<Found>(continues ? *before : unknowns(conformal_.solve(handles)));
    const int most = options.draft ? kFewSteps : kMostSteps;
    out.iterations = minimize(handles, most, options.stop, *found);
    if (out.iterations == most) out.status = SampledMap::Status::iterating;
    out.solution = found;
    out.f = product(values_, found->phi) + product(values_, found->psi).conjugate();
    if (!options.derivatives) return out;
    out.fz = product(slopes_, found->phi);
    out.fzbar = product(slopes_, found->psi).conjugate();
    return out;
  }

 private:
  struct Found : Solution {
    VectorXc phi, psi;
  };

  /// Takes some of the mesh's vertices as samples, weighted by the area of their triangles.
  void set_up_energy() {
    Points points;
    std::vector<double> weights;
    double total = 0;
    for (const AreaSample& sample : area_samples(*rest_.mesh, kAreaSamples)) {
      points.push_back(rest_.mesh->vertices[static_cast<size_t>(sample.vertex)]);
      weights.push_back(sample.area);
      total += sample.area;
    }
    for (double& weight : weights) weight = std::sqrt(weight / total);
    gradient_ = basis_.values(points, 1);
    for (size_t i = 0; i < points.size(); ++i) gradient_.row(static_cast<Index>(i)) *= weights[i];
    weights_ = Eigen::Map<const VectorXd>(weights.data(), static_cast<Index>(weights.size()));
  }

  /// Sets up the normal matrices for the unknowns (Re Phi, Im Phi, Re Psi, Im Psi). At the handles,
  /// f = C Phi + conj(C Psi).
  void set_up_handles() {
    held_ = basis_.values(handles_.rest());
    const Index n = basis_.size(), h = held_.rows();
    handle_weight_ = kHandlePull / (static_cast<double>(std::max<Index>(h, 1)) * size_ * size_);
    MatrixXd rows(4 * n, 2 * h);  // columns: Re f, Im f of each handle
    rows.topLeftCorner(n, h) = held_.real().transpose();
    rows.block(n, 0, n, h) = -held_.imag().transpose();
    rows.block(2 * n, 0, n, h) = held_.real().transpose();
    rows.block(3 * n, 0, n, h) = -held_.imag().transpose();
    rows.topRightCorner(n, h) = held_.imag().transpose();
    rows.block(n, h, n, h) = held_.real().transpose();
    rows.block(2 * n, h, n, h) = -held_.imag().transpose();
    rows.block(3 * n, h, n, h) = -held_.real().transpose();
    held_rows_ = rows;
    MatrixXd shared = kDefinite / (size_ * size_) * MatrixXd::Identity(4 * n, 4 * n);
    add_gram(std::sqrt(handle_weight_) * rows, 2 * h, 0, shared);
    const MatrixXc gram = gradient_.adjoint() * gradient_;
    MatrixXd real(2 * n, 2 * n);
    real << gram.real(), -gram.imag(), gram.imag(), gram.real();
    const auto factored = [&](double phi_weight, Cholesky& out) {
      MatrixXd normal = shared;
      normal.topLeftCorner(2 * n, 2 * n) += phi_weight * real;
      normal.bottomRightCorner(2 * n, 2 * n) += real;
      check(out.factor(normal), "har_arap: the energy is definite");
    };
    factored(1, rigid_);
    factored(kRigidPart, conformal_);
  }

  VectorXd handle_right(const Points& targets) const {
    const Index h = held_.rows();
    VectorXd stacked(2 * h);
    for (Index i = 0; i < h; ++i) {
      stacked[i] = targets[static_cast<size_t>(i)].real();
      stacked[h + i] = targets[static_cast<size_t>(i)].imag();
    }
    return handle_weight_ * (held_rows_ * stacked);
  }

  Found unknowns(const VectorXd& x) const {
    Found found;
    found.phi = complex_of(x.head(2 * basis_.size()));
    found.psi = complex_of(x.tail(2 * basis_.size()));
    return found;
  }

  int minimize(const VectorXd& handles, int most, const std::stop_token& stop, Found& found) const {
    const Index n = basis_.size();
    int iteration = 0;
    for (double moved = 1; iteration < most && moved > kStill; ++iteration) {
      throw_if_stopped(stop);
      VectorXc turn = gradient_ * found.phi;  // `gradient_` includes the weights
      for (Index i = 0; i < turn.size(); ++i) {
        const double size = std::abs(turn[i]);
        turn[i] = size > 0 ? weights_[i] * turn[i] / size : Complex(weights_[i]);
      }
      const VectorXc pull = gradient_.adjoint() * turn;
      VectorXd right = handles;
      right.segment(0, n) += pull.real();
      right.segment(n, n) += pull.imag();
      Found next = unknowns(rigid_.solve(right));
      moved = (next.phi - found.phi).cwiseAbs().maxCoeff() / size_;
      found = std::move(next);
    }
    return iteration;
  }

  SampledMap moved_rigidly(const Similarity& rigid, SampledMap out, EvalOptions options) const {
    const Index count = static_cast<Index>(rest_.samples.size());
    out.f = Eigen::Map<const VectorXc>(rest_.samples.data(), count);
    if (rigid.factor != Complex(1) || rigid.from != rigid.to)
      for (Complex& z : out.f) z = rigid(z);
    if (!options.derivatives) return out;
    out.fz = VectorXc::Constant(count, rigid.factor);
    out.fzbar = VectorXc::Zero(count);
    return out;
  }

  Rest rest_;
  HandlePoints handles_;
  BoundaryBasis basis_;
  double size_ = 1, handle_weight_ = 1;
  MatrixXc gradient_, held_;  ///< C' at the energy's samples, weighted; C at the handles
  MatrixXd held_rows_;
  VectorXd weights_;
  PlanarMatrix<double> values_, slopes_;
  Cholesky rigid_, conformal_;
};

std::unique_ptr<Deformer> make_har_arap(const Rest& rest, const Deformer*) {
  return std::make_unique<HarArapDeformer>(rest);
}

}  // namespace

Method har_arap_method() {
  return {
      .id = "har_arap",
      .label = "Rigid and smooth",
      .hint =
          "As rigid as a smooth map can be, without spikes at the pins. Without pins, the cage "
          "points stay where you put them.",
      .uses_pins = true,
      .pins_replace_cage = true,
      .iterates = true,
      .reproduces = Method::Motions::rigid,
      .needs_mesh = true,
      .make = make_har_arap,
  };
}

}  // namespace holomorph
