// Method `har_arap`: minimizes the energy of `arap` over the smooth maps f = Phi + conj(Psi), with
// Phi and Psi in a Cauchy basis (the har-ARAP of Levi, Weber 2016).
//
// There are a few hundred unknowns. The energy is a sum over samples instead of triangles. Here f_z
// = Phi' and f_zbar = conj(Psi'). The first rotations are those of the map of `arap`.
//
// In a domain with holes, Phi + conj(Psi) is not every harmonic map. Each hole adds c ln|z - a|,
// where a lies in the hole. This contributes c / (2 (z - a)) to Phi' and conj(c) / (2 (z - a)) to
// Psi'.
#include "core/cauchy/boundary_basis.h"
#include "core/error.h"
#include "core/geometry/deepest_point.h"
#include "core/mesh/area_samples.h"
#include "core/methods/handles.h"
#include "core/methods/linear.h"
#include "core/methods/rows.h"
#include "core/solvers/real_form.h"

namespace holomorph {
namespace {

constexpr int kSamplesEach = 3;
constexpr size_t kAreaSamples = 4000;  ///< with 400, maps of tight cages went wild between samples
constexpr int kMostSteps = 100, kFewSteps = 12;
constexpr double kStill = 1e-6;
constexpr double kHandlePull = 1e3;  ///< weight of a handle, relative to the mean energy
constexpr double kDefinite = 1e-9;   ///< fixes a constant that can move between Phi and Psi

/// f = Phi + conj(Psi) + the sum of c ln|z - a| over all holes.
class HarmonicPoints final : public PointMap {
 public:
  SumMap sum;
  Points holes;
  VectorXc logs;
  double size = 1;

  Value at(Complex z) const override {
    Value value = sum.at(z);
    for (size_t h = 0; h < holes.size(); ++h) {
      const Complex c = logs[static_cast<Index>(h)], slope = 0.5 / (z - holes[h]);
      value.f += c * std::log(std::abs(z - holes[h]) / size);
      value.fz += c * slope;
      value.fzbar += c * std::conj(slope);
    }
    return value;
  }
};

class HarArapDeformer final : public Deformer {
 public:
  explicit HarArapDeformer(const Rest& rest)
      : rest_(rest),
        handles_(rest_),
        basis_(rest.cage, BoundaryBasis::usual_size(rest.cage.size()),
               kSamplesEach * BoundaryBasis::usual_size(rest.cage.size())) {
    size_ = box_of(rest.mesh->vertices).diagonal();
    const Points edge = basis_.polygon().points;
    const Loops loops = PolygonView(basis_.polygon()).loops();
    for (Index l = 1; l < loops.count(); ++l)
      holes_.push_back(deepest_point(
          Polyline({edge.begin() + loops.first(l), edge.begin() + loops.end(l)}, true)));
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
    const auto found = std::make_shared<Found>(
        continues ? *before : step(handles, rotations_of_arap(pose, options)));
    const int most = options.draft ? kFewSteps : kMostSteps;
    out.iterations = minimize(handles, most, options.stop, *found);
    if (out.iterations == most) out.status = SampledMap::Status::iterating;
    out.solution = found;
    out.f = product(values_, found->phi) + product(values_, found->psi).conjugate();
    if (!holes_.empty()) out.f += logarithms(rest_.samples) * found->logs;
    if (!options.derivatives) return out;
    out.fz = product(slopes_, found->phi);
    out.fzbar = product(slopes_, found->psi).conjugate();
    if (!holes_.empty()) {
      const MatrixXc slopes = logarithm_slopes(derivative_points());
      out.fz += slopes * found->logs;
      out.fzbar += slopes.conjugate() * found->logs;
    }
    return out;
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    HarArapDeformer copy(rest_);
    const SampledMap map = copy.deform(pose, {});
    auto points = std::make_unique<HarmonicPoints>();
    if (const auto* found = dynamic_cast<const Found*>(map.solution.get())) {
      const Cage polygon = polygon_cage(basis_.polygon());
      const VectorXc rest = controls_of(polygon);
      // A SumMap adds the identity, whose controls are the polygon's points.
      points->sum.terms.emplace_back(polygon, found->phi - rest);
      points->sum.conjugates.emplace_back(polygon, found->psi);
      points->holes = holes_;
      points->logs = found->logs;
      points->size = size_;
    } else {  // a rigid motion
      const Similarity rigid = *handles_.rigid(handles_.targets(pose));
      points->sum.slope = rigid.factor - 1.0;
      points->sum.center = rigid.from;
      points->sum.constant = rigid.to - rigid.from;
    }
    return points;
  }

 private:
  struct Found : Solution {
    VectorXc phi, psi, logs;
  };

  const Points& derivative_points() const {
    return rest_.derivative_samples.empty() ? rest_.samples : rest_.derivative_samples;
  }
  /// ln|z - a|, one column for each hole.
  MatrixXd logarithms(const Points& points) const {
    MatrixXd values(static_cast<Index>(points.size()), static_cast<Index>(holes_.size()));
    for (Index h = 0; h < values.cols(); ++h)
      for (Index i = 0; i < values.rows(); ++i)
        values(i, h) = std::log(
            std::abs(points[static_cast<size_t>(i)] - holes_[static_cast<size_t>(h)]) / size_);
    return values;
  }
  /// Its derivative in z.
  MatrixXc logarithm_slopes(const Points& points) const {
    MatrixXc slopes(static_cast<Index>(points.size()), static_cast<Index>(holes_.size()));
    for (Index h = 0; h < slopes.cols(); ++h)
      for (Index i = 0; i < slopes.rows(); ++i)
        slopes(i, h) = 0.5 / (points[static_cast<size_t>(i)] - holes_[static_cast<size_t>(h)]);
    return slopes;
  }

  /// Points at a small distance inside the edges of the basis, where its functions vary most.
  Points near_boundary() const {
    const PolygonView polygon = basis_.polygon();
    const Loops loops = polygon.loops();
    Points points;
    for (Index i = 0; i < polygon.size(); ++i) {
      const Complex a = polygon.points()[static_cast<size_t>(i)],
                    side = polygon.points()[static_cast<size_t>(loops.next(i))] - a;
      for (const double t : {0.25, 0.75}) points.push_back(a + side * Complex(t, 0.4));
    }
    return points;
  }

  /// Takes some of the mesh's vertices as samples, weighted by the area of their triangles.
  void set_up_energy() {
    Points points;
    std::vector<double> weights;
    double total = 0;
    for (const AreaSample& sample : area_samples(*rest_.mesh, kAreaSamples, near_boundary())) {
      vertices_.push_back(sample.vertex);
      points.push_back(rest_.mesh->vertices[static_cast<size_t>(sample.vertex)]);
      weights.push_back(sample.area);
      total += sample.area;
    }
    for (double& weight : weights) weight = std::sqrt(weight / total);
    gradient_.resize(static_cast<Index>(points.size()), basis_.size() + holes());
    gradient_ << basis_.values(points, 1), logarithm_slopes(points);
    for (size_t i = 0; i < points.size(); ++i) gradient_.row(static_cast<Index>(i)) *= weights[i];
    weights_ = Eigen::Map<const VectorXd>(weights.data(), static_cast<Index>(weights.size()));
  }

  Index holes() const { return static_cast<Index>(holes_.size()); }

  /// Sets up the normal matrix for the unknowns (Re Phi, Im Phi, Re Psi, Im Psi, Re c, Im c). At
  /// the handles, f = C Phi + conj(C Psi) + ln|z - a| c.
  void set_up_handles() {
    held_ = basis_.values(handles_.rest());
    const Index n = basis_.size(), h = held_.rows(), all = 4 * n + 2 * holes();
    handle_weight_ = kHandlePull / (static_cast<double>(std::max<Index>(h, 1)) * size_ * size_);
    MatrixXd rows = MatrixXd::Zero(all, 2 * h);  // columns: Re f, Im f of each handle
    rows.topLeftCorner(n, h) = held_.real().transpose();
    rows.block(n, 0, n, h) = -held_.imag().transpose();
    rows.block(2 * n, 0, n, h) = held_.real().transpose();
    rows.block(3 * n, 0, n, h) = -held_.imag().transpose();
    rows.topRightCorner(n, h) = held_.imag().transpose();
    rows.block(n, h, n, h) = held_.real().transpose();
    rows.block(2 * n, h, n, h) = -held_.imag().transpose();
    rows.block(3 * n, h, n, h) = -held_.real().transpose();
    const MatrixXd logs = logarithms(handles_.rest());
    rows.block(4 * n, 0, holes(), h) = logs.transpose();
    rows.block(4 * n + holes(), h, holes(), h) = logs.transpose();
    held_rows_ = rows;
    MatrixXd normal = kDefinite / (size_ * size_) * MatrixXd::Identity(all, all);
    add_gram(std::sqrt(handle_weight_) * rows, 2 * h, 0, normal);
    const MatrixXc gram = gradient_.adjoint() * gradient_;
    const Index e = gram.rows();
    MatrixXd real(2 * e, 2 * e);
    real << gram.real(), -gram.imag(), gram.imag(), gram.real();
    // The positions of the real unknowns of (Phi, c), or of (Psi, conj(c)), among all unknowns.
    const auto position = [&](Index i, Index first) {
      const Index part = i / e, k = i % e;
      return k < n ? first + part * n + k : 4 * n + part * holes() + k - n;
    };
    for (Index i = 0; i < 2 * e; ++i)
      for (Index j = 0; j < 2 * e; ++j) {
        normal(position(i, 0), position(j, 0)) += real(i, j);
        const bool flips = (i >= e + n) != (j >= e + n);  // Im c changes its sign
        normal(position(i, 2 * n), position(j, 2 * n)) += flips ? -real(i, j) : real(i, j);
      }
    check(normal_.factor(normal), "har_arap: the energy is definite");
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
    const Index n = basis_.size();
    found.phi = complex_of(x.head(2 * n));
    found.psi = complex_of(x.segment(2 * n, 2 * n));
    found.logs = complex_of(x.tail(2 * holes()));
    return found;
  }

  /// The map of least energy with these rotations at the energy's samples.
  Found step(const VectorXd& handles, const VectorXc& rotations) const {
    const Index n = basis_.size();
    const VectorXc pull = gradient_.adjoint() * rotations.cwiseProduct(weights_);
    VectorXd right = handles;
    right.segment(0, n) += pull.head(n).real();
    right.segment(n, n) += pull.head(n).imag();
    right.segment(4 * n, holes()) += pull.tail(holes()).real();
    right.segment(4 * n + holes(), holes()) += pull.tail(holes()).imag();
    return unknowns(normal_.solve(right));
  }

  /// The rotations of the map of `arap` at the energy's samples. Starting from
  /// another map may leave branch points, which local steps do not remove.
  VectorXc rotations_of_arap(const Pose& pose, const EvalOptions& options) {
    if (!arap_) {
      Rest rest = used_by(method_named("arap"), rest_);
      rest.samples = rest.mesh->vertices;
      rest.derivative_samples.clear();
      arap_ = method_named("arap").prepare(rest, nullptr);
    }
    const VectorXc f = arap_->deform(pose, {.draft = options.draft, .stop = options.stop}).f;
    const Mesh& mesh = *rest_.mesh;
    VectorXc sums = VectorXc::Zero(f.size());
    for (const auto& [i, j, k] : mesh.triangles) {
      const Points& z = mesh.vertices;
      const Complex z1 = z[static_cast<size_t>(j)] - z[static_cast<size_t>(i)],
                    z2 = z[static_cast<size_t>(k)] - z[static_cast<size_t>(i)];
      // Twice the signed area times f_z.
      const Complex sum =
          kI * ((f[j] - f[i]) * std::conj(z2) - (f[k] - f[i]) * std::conj(z1)) / 2.0;
      for (const int v : {i, j, k}) sums[v] += sum;
    }
    VectorXc rotations(static_cast<Index>(vertices_.size()));
    for (Index s = 0; s < rotations.size(); ++s) {
      const Complex sum = sums[vertices_[static_cast<size_t>(s)]];
      rotations[s] = std::abs(sum) > 0 ? sum / std::abs(sum) : Complex(1);
    }
    return rotations;
  }

  int minimize(const VectorXd& handles, int most, const std::stop_token& stop, Found& found) const {
    const Index n = basis_.size();
    int iteration = 0;
    for (double moved = 1; iteration < most && moved > kStill; ++iteration) {
      throw_if_stopped(stop);
      VectorXc turn = gradient_.leftCols(n) * found.phi;  // `gradient_` includes the weights
      if (!holes_.empty()) turn += gradient_.rightCols(holes()) * found.logs;
      for (Index i = 0; i < turn.size(); ++i) {
        const double size = std::abs(turn[i]);
        turn[i] = size > 0 ? turn[i] / size : Complex(1);
      }
      Found next = step(handles, turn);
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
  Points holes_;              ///< a point in each hole
  MatrixXc gradient_, held_;  ///< Phi' at the energy's samples, weighted; C at the handles
  MatrixXd held_rows_;
  VectorXd weights_;
  PlanarMatrix<double> values_, slopes_;
  std::vector<int> vertices_;  ///< of the mesh, the energy's samples
  Cholesky normal_;
  std::unique_ptr<Deformer> arap_;  ///< gives the first rotations; made when needed
};

std::unique_ptr<Deformer> make_har_arap(const Rest& rest, const Deformer*) {
  return std::make_unique<HarArapDeformer>(rest);
}

}  // namespace

Method har_arap_method() {
  return {
      .id = "har_arap",
      .label = "Rigid and smooth",
      .summary = "Keeps parts stiff, and bends smoothly between them.",
      .hint =
          "As rigid as a smooth map can be, without spikes at the pins. Without pins, the cage "
          "points stay where you put them.",
      .uses_pins = true,
      .holds_disks = true,
      .pins_replace_cage = true,
      .iterates = true,
      .reproduces = Method::Motions::rigid,
      .needs_mesh = true,
      .make = make_har_arap,
  };
}

}  // namespace holomorph
