// Method `har_arap`: minimizes the energy of `arap` over the smooth maps f = Phi + conj(Psi), with
// Phi and Psi in a Cauchy basis (the har-ARAP of Levi, Weber 2016).
//
// There are a few hundred unknowns. The energy is a sum over samples instead of triangles. Here f_z
// = Phi' and f_zbar = conj(Psi').
#include "core/cauchy/boundary_basis.h"
#include "core/error.h"
#include "core/methods/handles.h"
#include "core/methods/linear.h"
#include "core/methods/rows.h"

namespace holomorph {
namespace {

constexpr int kSamplesPerVertex = 3;
constexpr size_t kInnerSamples = 400;
constexpr int kMostIterations = 400, kDraftIterations = 30;
constexpr double kSettled = 1e-9;
constexpr double kHandleWeight = 1e3;  ///< weight of a handle, relative to the mean energy
constexpr double kRigidPart = 1e-3;    ///< weight of rigidity in the otherwise conformal start
constexpr double kDefinite = 1e-9;     ///< fixes a constant that can move between Phi and Psi

class HarArapDeformer final : public Deformer {
 public:
  explicit HarArapDeformer(const Rest& rest)
      : rest_(rest),
        handles_(rest_),
        basis_(rest.cage, BoundaryBasis::usual_size(rest.cage.size()),
               kSamplesPerVertex * BoundaryBasis::usual_size(rest.cage.size())) {
    size_ = box_of(rest.mesh->vertices).diagonal();
    set_up_energy();
    set_up_handles();
    const Cage polygon = polygon_cage(basis_.polygon());
    values_ = planar_coordinates<double>(polygon, rest_.samples, 0);
    slopes_ = planar_coordinates<double>(
        polygon, rest_.derivative_samples.empty() ? rest_.samples : rest_.derivative_samples, 1);
  }

  SampledMap deform(const Pose& pose, EvalOptions options) override {
    const Points targets = handles_.targets(pose);
    SampledMap out;
    out.note = handles_.note();
    if (const auto rigid = handles_.rigid(targets))
      return moved_rigidly(*rigid, std::move(out), options);
    out.iterations = minimize(targets, options.draft);
    if (out.iterations == (options.draft ? kDraftIterations : kMostIterations))
      out.status = SampledMap::Status::iterating;
    out.f = product(values_, phi_) + product(values_, psi_).conjugate();
    if (!options.derivatives) return out;
    out.fz = product(slopes_, phi_);
    out.fzbar = product(slopes_, psi_).conjugate();
    return out;
  }

 private:
  /// Takes some of the mesh's vertices as samples, weighted by the area of their triangles.
  void set_up_energy() {
    const Mesh& mesh = *rest_.mesh;
    std::vector<double> areas(mesh.vertices.size(), 0);
    double total = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const double area =
          cross(mesh.vertices[static_cast<size_t>(b)] - mesh.vertices[static_cast<size_t>(a)],
                mesh.vertices[static_cast<size_t>(c)] - mesh.vertices[static_cast<size_t>(a)]);
      for (const int v : {a, b, c}) areas[static_cast<size_t>(v)] += area;
      total += 3 * area;
    }
    // The weight of skipped vertices is added to the next sample.
    const size_t step = std::max<size_t>(1, mesh.vertices.size() / kInnerSamples);
    Points points;
    std::vector<double> weights;
    double weight = 0;
    for (size_t v = 0; v < mesh.vertices.size(); ++v) {
      weight += areas[v] / total;
      if (v % step != step - 1 && v + 1 < mesh.vertices.size()) continue;
      points.push_back(mesh.vertices[v]);
      weights.push_back(std::sqrt(weight));
      weight = 0;
    }
    gradient_ = basis_.values(points, 1);
    for (size_t i = 0; i < points.size(); ++i) gradient_.row(static_cast<Index>(i)) *= weights[i];
    weights_ = Eigen::Map<const VectorXd>(weights.data(), static_cast<Index>(weights.size()));
  }

  /// Sets up the normal matrices for the unknowns (Re Phi, Im Phi, Re Psi, Im Psi). At the handles,
  /// f = C Phi + conj(C Psi).
  void set_up_handles() {
    held_ = basis_.values(handles_.rest());
    const Index n = basis_.size(), h = held_.rows();
    handle_weight_ = kHandleWeight / (static_cast<double>(std::max<Index>(h, 1)) * size_ * size_);
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

  void set_unknowns(const VectorXd& x) {
    const Index n = basis_.size();
    phi_.resize(n);
    psi_.resize(n);
    phi_.real() = x.segment(0, n);
    phi_.imag() = x.segment(n, n);
    psi_.real() = x.segment(2 * n, n);
    psi_.imag() = x.segment(3 * n, n);
  }

  int minimize(const Points& targets, bool draft) {
    const VectorXd handles = handle_right(targets);
    if (!draft || phi_.size() == 0) set_unknowns(conformal_.solve(handles));
    const Index n = basis_.size();
    const int most = draft ? kDraftIterations : kMostIterations;
    int iteration = 0;
    for (double moved = 1; iteration < most && moved > kSettled; ++iteration) {
      VectorXc turn = gradient_ * phi_;  // `gradient_` includes the weights
      for (Index i = 0; i < turn.size(); ++i) {
        const double size = std::abs(turn[i]);
        turn[i] = size > 0 ? weights_[i] * turn[i] / size : Complex(weights_[i]);
      }
      const VectorXc pull = gradient_.adjoint() * turn;
      VectorXd right = handles;
      right.segment(0, n) += pull.real();
      right.segment(n, n) += pull.imag();
      const VectorXc before = phi_;
      set_unknowns(rigid_.solve(right));
      moved = (phi_ - before).cwiseAbs().maxCoeff() / size_;
    }
    return iteration;
  }

  SampledMap moved_rigidly(const Similarity& rigid, SampledMap out, EvalOptions options) {
    const Index count = static_cast<Index>(rest_.samples.size());
    out.f = Eigen::Map<const VectorXc>(rest_.samples.data(), count);
    if (rigid.factor != Complex(1) || rigid.from != rigid.to)
      for (Complex& z : out.f) z = rigid(z);
    phi_.resize(0);
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
  VectorXc phi_, psi_;
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
      .similar = false,
      .needs_mesh = true,
      .make = make_har_arap,
  };
}

}  // namespace holomorph
