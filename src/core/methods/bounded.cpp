// Method `bounded`: the nearest map that folds nowhere and stretches no more than allowed, to the
// map of another method (Levi, Weber 2016, the space L_nu).
//
// Reference at the boundary's samples -> continuous ln f_z -> cone program -> proof -> integration
// along the mesh.
#include <cstdio>

#include "core/antiderivative.h"
#include "core/argument.h"
#include "core/bounded_space.h"
#include "core/error.h"
#include "core/methods/bounded_points.h"
#include "core/methods/rows.h"
#include "core/similarity.h"

namespace holomorph {
namespace {

constexpr int kBasis = 50, kMostBasis = 150, kSamplesPerVertex = 6;
constexpr size_t kInnerSamples = 300;
/// The references' derivatives are rough on the boundary; they are looked at this far inside, in
/// samples' distances.
constexpr double kInset = 1.0;
/// The distance is measured at every so many samples; the bounds hold at all of them.
constexpr size_t kFitStride = 2;

Bounds bounds_of(const Method& method, const Parameters& values) {
  return {parameter(method, values, "k"), parameter(method, values, "sigma"),
          parameter(method, values, "Sigma")};
}

class BoundedDeformer final : public Deformer {
 public:
  explicit BoundedDeformer(const Rest& rest)
      : rest_(rest),
        method_(method_named("bounded")),
        bounds_(bounds_of(method_, rest.parameters)) {
    check(rest.mesh != nullptr, "method bounded: a rest with a mesh");
    bounds_.check_usable();
    const int basis = std::clamp(2 * static_cast<int>(rest.cage.size()), kBasis, kMostBasis);
    basis_ = std::make_shared<const BoundaryBasis>(rest.cage, basis, kSamplesPerVertex * basis);
    tree_ = std::make_unique<MeshTree>(*rest.mesh);
    take_inner_samples();
    const Points inset = basis_->inset(kInset);
    for (size_t i = 0; i < inset.size(); i += kFitStride) points_.boundary.push_back(inset[i]);
    space_ = std::make_unique<BoundedSpace>(basis_, points_, BoundedSettings{bounds_});
    prepare_reference();
    values_ = planar_coordinates<double>(polygon_cage(basis_->polygon()), rest.mesh->vertices, 0);
    slopes_ = planar_coordinates<double>(polygon_cage(basis_->polygon()), rest.mesh->vertices, 1);
    for (const RestPin& pin : rest.pins)
      pins_.push_back(locate(*rest.mesh, rest.mesh->vertices, pin.position));
  }

  void deform(const Pose& pose, SampledMap& out, Wanted wanted) override {
    SampledMap reference;
    Pose followed = pose;
    if (!reference_method_->uses_pins) followed.pins.clear();
    reference_->deform(followed, reference, {true, wanted.draft});
    if (is_identity(reference)) return take_identity(out, wanted);
    if (!reference.f.allFinite())
      throw Error(ErrorKind::failed, "the reference map is not finite; move its handles apart");
    const BoundedReference target = target_of(reference, out.zeros);
    solution_ = space_->nearest(target, wanted.draft && solved_ ? &solution_ : nullptr);
    solved_ = true;
    integrate(pose, reference);
    answer(out, wanted);
    turned_ = turned_triangles();
    out.status = solution_.certificate.holds && turned_ == 0 ? SampledMap::Status::certified
                                                             : SampledMap::Status::infeasible;
    out.iterations = solution_.solution.iterations;
    out.note = note(pose);
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    if (posed_ != pose || !solved_) {
      BoundedDeformer copy(rest_);
      SampledMap map;
      copy.deform(pose, map, {});
      return copy.current();
    }
    return current();
  }

 private:
  std::unique_ptr<PointMap> current() const {
    return std::make_unique<BoundedPointMap>(basis_, rest_.mesh, solution_.map, f_);
  }

  /// Every so many inner vertices of the mesh.
  void take_inner_samples() {
    const Mesh& mesh = *rest_.mesh;
    std::vector<char> outer(mesh.vertices.size(), 0);
    for (const int v : mesh.boundary) outer[static_cast<size_t>(v)] = 1;
    std::vector<int> inner;
    for (size_t v = 0; v < mesh.vertices.size(); ++v)
      if (!outer[v]) inner.push_back(static_cast<int>(v));
    const size_t step = std::max<size_t>(1, inner.size() / kInnerSamples);
    for (size_t i = 0; i < inner.size(); i += step) {
      inner_vertices_.push_back(inner[i]);
      points_.inner.push_back(mesh.vertices[static_cast<size_t>(inner[i])]);
    }
  }

  /// The reference is sampled next to the boundary's samples, then inside.
  void prepare_reference() {
    Rest rest = rest_;
    rest.parameters.clear();
    rest.precision = Precision::full;  // the samples are few
    rest.samples = points_.boundary;
    rest.samples.insert(rest.samples.end(), points_.inner.begin(), points_.inner.end());
    rest.derivative_samples.clear();
    reference_method_ = &method_named(choice(method_, rest_.parameters, "reference"));
    if (!reference_method_->uses_pins) rest.pins.clear();
    reference_ = reference_method_->prepare(rest, nullptr);
  }

  bool is_identity(const SampledMap& reference) const {
    const size_t count = points_.boundary.size();
    for (size_t i = 0; i < count + points_.inner.size(); ++i)
      if (reference.f[static_cast<Index>(i)] !=
          (i < count ? points_.boundary[i] : points_.inner[i - count]))
        return false;
    return reference.fz == VectorXc::Ones(reference.fz.size()) && reference.fzbar.isZero(0) &&
           bounds_.sigma <= 1 && bounds_.Sigma >= 1;
  }

  void take_identity(SampledMap& out, Wanted wanted) {
    const Index count = static_cast<Index>(rest_.samples.size());
    out = SampledMap{};
    out.f = Eigen::Map<const VectorXc>(rest_.samples.data(), count);
    if (wanted.derivatives) {
      out.fz = VectorXc::Ones(count);
      out.fzbar = VectorXc::Zero(count);
    }
    out.status = SampledMap::Status::certified;
    out.note = bounds_text();
    f_ = Eigen::Map<const VectorXc>(rest_.mesh->vertices.data(),
                                    static_cast<Index>(rest_.mesh->vertices.size()));
    solution_ = BoundedMap{};
    solution_.map = {VectorXc::Zero(basis_->size()), VectorXc::Zero(basis_->size())};
    solved_ = false;
  }

  /// ln f_z along the boundary and nu everywhere (algorithm 4).
  BoundedReference target_of(const SampledMap& g, Points& zeros) const {
    const Index m = static_cast<Index>(points_.boundary.size()),
                inner = static_cast<Index>(points_.inner.size());
    const VectorXc fz = g.fz.head(m);
    // The nearest holomorphic function tells the turns and the zeros.
    const auto [unknowns, fitted] = space_->holomorphic_fit(fz);
    const VectorXc& gamma = reference_method_->harmonic ? fz : fitted;
    std::vector<Zero> found;
    zeros.clear();
    if (turns_of(gamma) != 0) {
      found = zeros_of(*rest_.mesh, product(values_, basis_->coefficients(unknowns)));
      // The loop of samples does not turn around those between it and the boundary.
      std::erase_if(found, [&](const Zero& zero) {
        return winding_number(points_.boundary, zero.place) == 0;
      });
      for (const Zero& zero : found) zeros.push_back(zero.place);
    }
    const VectorXd theta = boundary_argument(points_.boundary, gamma, found);
    BoundedReference target;
    target.log_fz.resize(m);
    const double least = 1e-6 * fz.cwiseAbs().maxCoeff();
    for (Index i = 0; i < m; ++i)
      target.log_fz[i] = {std::log(std::max(std::abs(fz[i]), least)), theta[i]};
    target.nu = (g.fzbar.head(m).conjugate().array() / fz.array()).matrix();
    target.inner_nu = (g.fzbar.tail(inner).conjugate().array() / g.fz.tail(inner).array()).matrix();
    return target;
  }

  /// Phi and Psi along the mesh, and the place from the pins or, without any, from the reference.
  void integrate(const Pose& pose, const SampledMap& reference) {
    const VectorXc l = product(values_, solution_.map.l), nu = product(values_, solution_.map.nu),
                   l1 = product(slopes_, solution_.map.l), nu1 = product(slopes_, solution_.map.nu);
    fz_ = l.array().exp();
    psi_ = nu.cwiseProduct(fz_);
    const VectorXc phi2 = l1.cwiseProduct(fz_),
                   psi2 = (nu1 + nu.cwiseProduct(l1)).cwiseProduct(fz_);
    f_ = tree_->antiderivative(fz_, phi2) + tree_->antiderivative(psi_, psi2).conjugate();
    align(pose, reference);
    posed_ = pose;
  }

  /// Turns, scales and moves the map to the pins' places or, with less than two of them, to the
  /// reference's. A turn keeps all bounds, a change of scale is proved anew.
  void align(const Pose& pose, const SampledMap& reference) {
    Points from, to;
    const std::span<const Complex> f(f_.data(), static_cast<size_t>(f_.size()));
    if (reference_method_->uses_pins)
      for (size_t i = 0; i < pins_.size(); ++i)
        if (pins_[i]) {
          from.push_back(pins_[i]->in(*rest_.mesh, f));
          to.push_back(pose.pins[i].position);
        }
    if (from.size() < 2) {
      from.clear(), to.clear();
      const Index m = static_cast<Index>(points_.boundary.size());
      for (size_t i = 0; i < points_.inner.size(); ++i) {
        from.push_back(f_[inner_vertices_[i]]);
        to.push_back(reference.f[m + static_cast<Index>(i)]);
      }
    }
    const Similarity nearest = similarity_between(from, to);
    Complex factor = nearest.factor;
    const VectorXc one = VectorXc::Ones(basis_->size());
    LogMap scaled = solution_.map;
    scaled.l += std::log(factor) * one;
    scaled.nu *= std::conj(factor) / factor;
    const Certificate certificate = space_->certify(scaled);
    if (!certificate.holds) {
      factor /= std::abs(factor);
      scaled.l = solution_.map.l + std::log(factor) * one;
    } else {
      solution_.certificate = certificate;
    }
    solution_.map = std::move(scaled);
    fz_ *= factor;
    for (Complex& w : f_) w = Similarity{factor, nearest.from, nearest.to}(w);
    psi_ *= std::conj(factor);  // conj(Psi) turns along
  }

  void answer(SampledMap& out, Wanted wanted) const {
    out.fz.resize(0);
    out.fzbar.resize(0);
    if (rest_.samples == rest_.mesh->vertices) {
      out.f = f_;
      if (!wanted.derivatives) return;
      out.fz = fz_;
      out.fzbar = psi_.conjugate();
      return;
    }
    const BoundedPointMap map(basis_, rest_.mesh, solution_.map, f_);
    const size_t count = rest_.samples.size();
    out.f.resize(static_cast<Index>(count));
    out.fz.resize(static_cast<Index>(count));
    out.fzbar.resize(static_cast<Index>(count));
    constexpr size_t kAtOnce = 256;  // the coordinates of more would fill the memory
    for (size_t first = 0; first < count; first += kAtOnce) {
      const std::span<const Complex> some =
          std::span(rest_.samples).subspan(first, std::min(kAtOnce, count - first));
      const std::vector<PointMap::Value> values = map.at(some);
      for (size_t k = 0; k < values.size(); ++k) {
        const Index i = static_cast<Index>(first + k);
        out.f[i] = values[k].f;
        out.fz[i] = values[k].fz;
        out.fzbar[i] = values[k].fzbar;
      }
    }
  }

  std::string bounds_text() const {
    char text[120];
    std::snprintf(text, sizeof text, "Locally injective: k <= %.4g, %.4g <= sigma <= %.4g",
                  bounds_.k, bounds_.sigma, bounds_.Sigma);
    return text;
  }

  /// Triangles that the mesh turns over although the map does not: it is too coarse there.
  int turned_triangles() const {
    int count = 0;
    for (const auto& [i, j, k] : rest_.mesh->triangles)
      count += cross(f_[j] - f_[i], f_[k] - f_[i]) <= 0;
    return count;
  }

  /// What the proof says, and the pin that is farthest from its place.
  std::string note(const Pose& pose) const {
    static constexpr const char* kNames[] = {"angle", "smallest stretch", "largest stretch"};
    if (!solution_.certificate.holds)
      return std::string("Not proved: the bound on the ") +
             kNames[static_cast<int>(solution_.certificate.failed)] + " near " +
             point_text(solution_.certificate.where);
    std::string text = bounds_text();
    if (turned_ > 0)
      return "Proved, but too fine for the mesh: " + std::to_string(turned_) +
             " of its triangles turn over";
    if (!reference_method_->uses_pins) return text;
    const std::span<const Complex> f(f_.data(), static_cast<size_t>(f_.size()));
    double farthest = 0;
    size_t which = 0;
    for (size_t i = 0; i < pins_.size(); ++i) {
      if (!pins_[i]) continue;
      const double off = std::abs(pins_[i]->in(*rest_.mesh, f) - pose.pins[i].position);
      if (off > farthest) farthest = off, which = i;
    }
    if (farthest < 0.005 * box_of(rest_.mesh->vertices).diagonal()) return text;
    char more[120];
    std::snprintf(more, sizeof more, "; pin %d ends %.0f px from its place",
                  static_cast<int>(which) + 1, farthest);
    return text + more;
  }

  Rest rest_;
  const Method& method_;
  Bounds bounds_;
  std::shared_ptr<const BoundaryBasis> basis_;
  std::unique_ptr<BoundedSpace> space_;
  std::unique_ptr<MeshTree> tree_;
  ReferencePoints points_;
  std::vector<int> inner_vertices_;  ///< of points_.inner in the mesh
  const Method* reference_method_ = nullptr;
  std::unique_ptr<Deformer> reference_;
  PlanarMatrix<double> values_, slopes_;  ///< C and C' at the mesh's vertices
  std::vector<std::optional<Location>> pins_;

  BoundedMap solution_;
  bool solved_ = false;
  int turned_ = 0;
  Pose posed_;
  VectorXc f_, fz_, psi_;
};

std::unique_ptr<Deformer> prepare(const Rest& rest, const Deformer*) {
  check_rest_cage(rest.cage);
  return std::make_unique<BoundedDeformer>(rest);
}

}  // namespace

Method bounded_method(const std::vector<Method>& references) {
  ParameterSpec reference{"reference", "Follows", "The map that is kept within the bounds"};
  reference.kind = ParameterSpec::Kind::choice;
  for (const Method& method : references) {
    if (method.id == "pins") reference.fallback = static_cast<double>(reference.options.size());
    reference.options.push_back({method.id, method.label});
  }
  reference.highest = static_cast<double>(references.size()) - 1;
  const auto number = [](const char* key, const char* label, const char* hint, double fallback,
                         double lowest, double highest) {
    ParameterSpec spec{key, label, hint};
    spec.fallback = fallback;
    spec.lowest = lowest;
    spec.highest = highest;
    return spec;
  };
  Method method{
      "bounded",
      "No folds",
      "Nothing folds and nothing is stretched more than allowed, proved for every frame.",
      {reference,
       number("k", "Angle bound", "0 keeps all angles; towards 1 circles may turn flat", 0.7, 0,
              0.99),
       number("sigma", "Least stretch", "No length shrinks by more than this", 0.2, 0.01, 0.99),
       number("Sigma", "Largest stretch", "No length grows by more than this", 5, 1.01, 100)},
      true,
      true,
      false,
      prepare};
  method.parameters.back().logarithmic = true;
  method.presets = {{"Conformal", {{"k", 0}}},
                    {"Strict", {{"k", 0.5}, {"sigma", 0.5}, {"Sigma", 1.5}}},
                    {"Default", {}},
                    {"Loose", {{"k", 0.9}, {"sigma", 0.05}, {"Sigma", 20}}}};
  return method;
}

}  // namespace holomorph
