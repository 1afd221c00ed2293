// All rows get the same reference; each measures its own kind of map.
#include "core/compared/comparison.h"

#include <algorithm>
#include <limits>

#include "core/clock.h"
#include "core/compared/projections.h"
#include "core/error.h"
#include "core/real_form.h"

namespace holomorph {
namespace {

constexpr int kBasis = 50, kSamples = 300;
constexpr double kInset = 1;  ///< of samples at which references are smooth, in samples' distances

/// Adds an element to the worst ones of a row.
void measure(Complex fz, Complex fzbar, ComparedMap& row) {
  const double a = std::abs(fz), b = std::abs(fzbar);
  row.max_k = std::max(row.max_k, a > 0 ? b / a : std::numeric_limits<double>::infinity());
  row.max_tau = std::max(
      row.max_tau, a > b ? std::max(a + b, 1 / (a - b)) : std::numeric_limits<double>::infinity());
}

void measure(const VectorXd& elements, ComparedMap& row) {
  for (Index i = 0; 4 * i < elements.size(); ++i)
    measure({elements[4 * i], elements[4 * i + 1]}, {elements[4 * i + 2], elements[4 * i + 3]},
            row);
}

class Comparison {
 public:
  Comparison(const Rest& rest, const Pose& pose, std::stop_token stop)
      : rest_(rest), pose_(pose), mesh_(*rest.mesh), method_(method_named("bounded")) {
    check(rest.mesh != nullptr, "comparison: a rest with a mesh");
    settings_ = {bounds_of(rest.parameters), std::move(stop)};
    settings_.bounds.check_usable();
    rest_.samples = mesh_.vertices;
    rest_.derivative_samples = derivative_samples(mesh_);
    basis_ = std::make_unique<BoundaryBasis>(rest.cage, kBasis, kSamples);
    take_reference();
  }

  void run(const std::function<void(const ComparedMap&)>& take) {
    take(reference());
    take(ours());
    const auto mesh = mesh_operator(mesh_);
    const VectorXd start = stacked(reference_), g = mesh->apply(start);
    const MapOnMesh on_mesh(*basis_, mesh_);
    const auto harmonic = harmonic_operator(*basis_, on_mesh, basis_->samples());
    using Row = std::function<ComparedMap()>;
    const Row rows[] = {
        [&] {
          return projected("Lipman 2012", "Triangles with local frames, from the identity", *mesh,
                           [&] { return by_local_frames(*mesh, g, settings_); });
        },
        [&] {
          return projected("Chen, Weber 2015", "The same for smooth harmonic maps", *harmonic,
                           [&] { return by_local_frames(*harmonic, on_boundary_, settings_); });
        },
        [&] {
          return projected("Aigerman, Lipman 2013", "Triangles kept in half-spaces, repeatedly",
                           *mesh, [&] { return by_half_spaces(*mesh, start, settings_); });
        },
        [&] {
          return projected("Kovalsky et al. 2015",
                           "Triangles projected and joined in turn, with tangent planes", *mesh,
                           [&] { return by_tangent_planes(*mesh, start, settings_); });
        }};
    for (const Row& row : rows) {
      const ComparedMap map = row();
      if (settings_.stop.stop_requested()) return;
      take(map);
    }
  }

 private:
  Bounds bounds_of(const Parameters& values) const {
    return {parameter(method_, values, "k"), parameter(method_, values, "sigma"),
            parameter(method_, values, "Sigma")};
  }

  /// The reference at the mesh's vertices, and its derivatives next to the boundary's samples.
  void take_reference() {
    const Method& followed = method_named(choice(method_, rest_.parameters, "reference"));
    Rest rest = rest_;
    rest.parameters.clear();
    rest.precision = Precision::full;
    Pose pose = pose_;
    if (!followed.uses_pins) {
      rest.pins.clear();
      pose.pins.clear();
    }
    SampledMap map;
    followed.prepare(rest, nullptr)->deform(pose, map, {});
    reference_ = map.f;
    rest.samples = basis_->inset(kInset);
    rest.derivative_samples.clear();
    followed.prepare(rest, nullptr)->deform(pose, map, {true, false});
    if (!reference_.allFinite() || !map.fz.allFinite())
      throw Error(ErrorKind::failed, "the reference map is not finite; move its handles apart");
    on_boundary_.resize(4 * map.fz.size());
    for (Index i = 0; i < map.fz.size(); ++i)
      on_boundary_.segment<4>(4 * i) << map.fz[i].real(), map.fz[i].imag(), map.fzbar[i].real(),
          map.fzbar[i].imag();
  }

  /// What every row has.
  void finish(VectorXc f, ComparedMap& row) const {
    for (const auto& [i, j, k] : mesh_.triangles) row.flips += cross(f[j] - f[i], f[k] - f[i]) <= 0;
    Points boundary;
    for (const int v : mesh_.boundary) boundary.push_back(f[v]);
    row.turning_number = turning_number(boundary);
    row.f = std::move(f);
  }

  ComparedMap reference() const {
    ComparedMap row{"The map that is followed", "As it is, without bounds"};
    measure(mesh_operator(mesh_)->apply(stacked(reference_)), row);
    finish(reference_, row);
    return row;
  }

  ComparedMap ours() const {
    ComparedMap row{"No folds (this program)", "Harmonic; certified everywhere"};
    const auto deformer = method_.prepare(rest_, nullptr);
    SampledMap map;
    const double start = now_ms();
    deformer->deform(pose_, map, {true, false});
    row.milliseconds = now_ms() - start;
    row.iterations = map.iterations;
    row.settled = map.status == SampledMap::Status::certified;
    for (Index i = 0; i < map.fz.size(); ++i) measure(map.fz[i], map.fzbar[i], row);
    finish(map.f, row);
    return row;
  }

  ComparedMap projected(const char* label, const char* hint, const DerivativeOperator& t,
                        const std::function<Projected()>& project) const {
    ComparedMap row{label, hint};
    const double start = now_ms();
    const Projected result = project();
    row.milliseconds = now_ms() - start;
    row.iterations = result.iterations;
    row.settled = result.settled;
    measure(t.apply(result.x), row);
    VectorXc f = t.map(result.x);
    f.array() += (reference_ - f).mean();  // derivatives know no place
    finish(std::move(f), row);
    return row;
  }

  Rest rest_;
  Pose pose_;
  const Mesh& mesh_;
  const Method& method_;
  ProjectionSettings settings_;
  std::unique_ptr<BoundaryBasis> basis_;
  VectorXc reference_;
  VectorXd on_boundary_;
};

}  // namespace

void compare(const Rest& rest, const Pose& pose,
             const std::function<void(const ComparedMap&)>& take, std::stop_token stop) {
  Comparison(rest, pose, std::move(stop)).run(take);
}

}  // namespace holomorph
