// All rows use the same reference. Each row measures its own kind of map.
#include "core/compared/comparison.h"

#include <algorithm>
#include <limits>

#include "core/bounded/bounded_reference.h"
#include "core/clock.h"
#include "core/compared/projections.h"
#include "core/error.h"
#include "core/maps/distortion.h"
#include "core/solvers/real_form.h"

namespace holomorph {
namespace {

/// Updates a row's largest distortion with one element.
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
      : rest_(rest), pose_(pose), mesh_(mesh_of(rest)), method_(usual_method(MethodUse::bounds)) {
    if (!rest.cage.starts.empty())
      throw Error(ErrorKind::bad_input,
                  "the other methods cannot be compared in a cage with holes; fill the holes");
    settings_ = {bounds_of(rest.parameters), std::move(stop)};
    settings_.bounds.check_usable();
    rest_.samples = mesh_.vertices;
    rest_.derivative_samples = derivative_samples(mesh_);
    const int basis = BoundaryBasis::usual_size(rest.cage.size());
    basis_ = std::make_unique<BoundaryBasis>(rest.cage, basis,
                                             ReferenceSampler::kSamplesPerVertex * basis);
    set_up_dense_points();
    set_up_reference();
  }

  void run(const std::function<void(const ComparedMap&)>& on_row) {
    on_row(reference());
    if (settings_.stop.stop_requested()) return;
    on_row(ours());
    if (settings_.stop.stop_requested()) return;
    const auto mesh = mesh_operator(mesh_);
    const VectorXd start = stacked(reference_), g = mesh->apply(start);
    const MapOnMesh on_mesh(*basis_, mesh_);
    const auto harmonic = harmonic_operator(*basis_, on_mesh, basis_->samples()),
               dense = harmonic_operator(*basis_, on_mesh, dense_);
    const Rival rivals[] = {
        {"Lipman 2012", "Triangle mesh with local frames, starting from the identity", *mesh, false,
         [&] { return by_local_frames(*mesh, g, settings_); }},
        {"Chen, Weber 2015", "Local frames for smooth harmonic maps", *dense, true,
         [&] { return by_local_frames(*harmonic, on_boundary_, settings_); }},
        {"Aigerman, Lipman 2013", "Triangle mesh, repeatedly limited by half-spaces", *mesh, false,
         [&] { return by_half_spaces(*mesh, start, settings_); }},
        {"Kovalsky et al. 2015",
         "Triangle mesh: triangles projected and joined again in turn, with tangent planes", *mesh,
         false, [&] { return by_tangent_planes(*mesh, start, settings_); }}};
    for (const Rival& rival : rivals) {
      const ComparedMap map = row_of(rival);
      if (settings_.stop.stop_requested()) return;
      on_row(map);
    }
  }

 private:
  struct Rival {
    const char *label, *hint;
    const DerivativeOperator& measured;  ///< the operator whose elements are measured
    bool smooth;                         ///< whether `measured` uses the dense points
    std::function<Projected()> project;
  };

  static const Mesh& mesh_of(const Rest& rest) {
    check(rest.mesh != nullptr, "comparison: a rest with a mesh");
    return *rest.mesh;
  }

  /// The points at which harmonic maps are measured: the mesh's vertices, and points between the
  /// boundary samples. The bounds are imposed only at the samples.
  void set_up_dense_points() {
    dense_ = derivative_samples(mesh_);
    for (const BoundaryPiece& piece : basis_->pieces())
      for (const double t : {0.25, 0.5, 0.75}) {
        dense_.push_back(bezier_point(basis_->domain().controls(piece.segment),
                                      piece.from + t * (piece.to - piece.from)));
        tangents_.push_back(piece.end - piece.start);
      }
  }

  /// The reference at the mesh's vertices, and its derivatives just inside the boundary's samples.
  void set_up_reference() {
    const Method& followed = method_named(choice(method_, rest_.parameters, "reference"));
    Rest rest = used_by(followed, rest_);
    rest.parameters = parameters_of(rest_, followed);
    rest.precision = Precision::full;
    const Pose pose = used_by(followed, pose_);
    SampledMap map = followed.prepare(rest, nullptr)->deform(pose, {});
    reference_ = map.f;
    rest.samples = basis_->inset(ReferenceSampler::kInset);
    rest.derivative_samples.clear();
    map = followed.prepare(rest, nullptr)->deform(pose, {true, false});
    if (!reference_.allFinite() || !map.fz.allFinite())
      throw Error(ErrorKind::failed, "the reference map is not finite; move its handles apart");
    on_boundary_.resize(4 * map.fz.size());
    for (Index i = 0; i < map.fz.size(); ++i)
      on_boundary_.segment<4>(4 * i) << map.fz[i].real(), map.fz[i].imag(), map.fzbar[i].real(),
          map.fzbar[i].imag();
  }

  /// Fills in the fields that all rows share.
  void finish(VectorXc f, ComparedMap& row) const {
    row.flipped_triangles = flipped_triangles(mesh_, f);
    Points boundary;
    for (const int v : mesh_.boundary) boundary.push_back(f[v]);
    row.turning_number = turning_number(boundary);
    row.f = std::move(f);
  }

  ComparedMap reference() const {
    ComparedMap row{"Followed map", "The reference itself, without limits"};
    measure(mesh_operator(mesh_)->apply(stacked(reference_)), row);
    finish(reference_, row);
    return row;
  }

  ComparedMap ours() const {
    ComparedMap row{"No folds (this program)", "Harmonic map, certified everywhere"};
    const auto deformer = method_.prepare(rest_, nullptr);
    SampledMap map;
    const double start = now_ms();
    map = deformer->deform(pose_, {true, false});
    row.milliseconds = now_ms() - start;
    row.iterations = map.iterations;
    row.settled = map.status == SampledMap::Status::certified;
    const auto points = deformer->point_map(pose_);
    VectorXd elements(4 * static_cast<Index>(dense_.size()));
    for (size_t i = 0; i < dense_.size(); ++i) {
      const PointMap::Value at = points->at(dense_[i]);
      elements.segment<4>(4 * static_cast<Index>(i)) << at.fz.real(), at.fz.imag(), at.fzbar.real(),
          at.fzbar.imag();
    }
    measure(elements, row);
    finish(map.f, row);
    row.turning_number = turning_number_of(elements);
    return row;
  }

  /// Computes the turning number from derivatives along the boundary, because the mesh's outline is
  /// too coarse where a smooth map bends sharply.
  double turning_number_of(const VectorXd& elements) const {
    const Index vertices = static_cast<Index>(mesh_.vertices.size());
    std::vector<Complex> tangents;
    for (size_t i = 0; i < tangents_.size(); ++i) {
      const Index at = 4 * (vertices + static_cast<Index>(i));
      tangents.push_back(Complex(elements[at], elements[at + 1]) * tangents_[i] +
                         Complex(elements[at + 2], elements[at + 3]) * std::conj(tangents_[i]));
    }
    double turns = 0;
    for (size_t i = 0; i < tangents.size(); ++i)
      turns += std::arg(tangents[(i + 1) % tangents.size()] / tangents[i]);
    return turns / (2 * kPi);
  }

  ComparedMap row_of(const Rival& rival) const {
    ComparedMap row{rival.label, rival.hint};
    const double start = now_ms();
    const Projected result = rival.project();
    row.milliseconds = now_ms() - start;
    row.iterations = result.iterations;
    row.settled = result.settled;
    const VectorXd elements = rival.measured.apply(result.x);
    measure(elements, row);
    VectorXc f = rival.measured.map(result.x);
    f.array() += (reference_ - f).mean();  // derivatives do not determine the translation
    finish(std::move(f), row);
    if (rival.smooth) row.turning_number = turning_number_of(elements);
    return row;
  }

  Rest rest_;
  Pose pose_;
  const Mesh& mesh_;
  const Method& method_;
  ProjectionSettings settings_;
  std::unique_ptr<BoundaryBasis> basis_;
  Points dense_;                   ///< the mesh's vertices, then points on the boundary
  std::vector<Complex> tangents_;  ///< tangents at the boundary points of dense_
  VectorXc reference_;
  VectorXd on_boundary_;
};

}  // namespace

void compare(const Rest& rest, const Pose& pose,
             const std::function<void(const ComparedMap&)>& on_row, std::stop_token stop) {
  Comparison(rest, pose, std::move(stop)).run(on_row);
}

}  // namespace holomorph
