// The reference is sampled a little inside the boundary, where its derivatives are smooth.
#include "core/bounded/bounded_reference.h"

#include "core/error.h"
#include "core/maps/argument.h"

namespace holomorph {
namespace {

constexpr size_t kInnerSamples = 300;
/// The distance is measured at every second sample. The bounds hold at all samples.
constexpr Index kFitStride = 2;

}  // namespace

Bounds bounds_of(const Parameters& values) {
  const Method& method = usual_method(MethodUse::bounds);
  return {parameter(method, values, "k"), parameter(method, values, "sigma"),
          parameter(method, values, "Sigma")};
}

ReferenceSampler::ReferenceSampler(const Rest& rest, const Method& method,
                                   const BoundaryBasis& basis, const MapOnMesh& mesh)
    : method_(method), basis_(basis), on_mesh_(mesh), mesh_(rest.mesh) {
  set_up_points(*rest.mesh, basis);
  fit_ = HolomorphicFit(basis, points_.boundary);
  Rest followed = used_by(method, rest);
  followed.parameters = parameters_of(rest, method);
  followed.precision = Precision::full;  // affordable for so few samples
  followed.samples = points_.boundary;
  for (const int v : anchors_) followed.samples.push_back(mesh_->vertices[static_cast<size_t>(v)]);
  for (const RestPin& pin : rest.pins) {
    const bool inside = locate(*mesh_, mesh_->vertices, pin.position).has_value();
    pins_.push_back(inside ? std::optional(static_cast<Index>(followed.samples.size()))
                           : std::nullopt);
    if (inside) followed.samples.push_back(pin.position);
  }
  followed.derivative_samples.clear();
  deformer_ = method.prepare(followed, nullptr);
}

void ReferenceSampler::set_up_points(const Mesh& mesh, const BoundaryBasis& basis) {
  const Points inset = basis.inset(kInset);
  const Loops loops = basis.sample_loops();
  for (Index l = 0; l < loops.count(); ++l) {
    if (l > 0) points_.holes.push_back(static_cast<Index>(points_.boundary.size()));
    for (Index i = loops.first(l); i < loops.end(l); i += kFitStride)
      points_.boundary.push_back(inset[static_cast<size_t>(i)]);
  }
  const std::vector<char> outer = boundary_marks(mesh);
  std::vector<int> inner;
  for (size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!outer[v]) inner.push_back(static_cast<int>(v));
  const std::vector<int>& anchors = inner.empty() ? mesh.boundary : inner;
  const size_t step = std::max<size_t>(1, anchors.size() / kInnerSamples);
  for (size_t i = 0; i < anchors.size(); i += step) anchors_.push_back(anchors[i]);
  if (inner.empty()) return;  // derivatives of references are not smooth on the boundary
  for (const int v : anchors_) points_.inner.push_back(mesh.vertices[static_cast<size_t>(v)]);
}

void ReferenceSampler::deform(const Pose& pose, EvalOptions options, const Solution* from) {
  options.derivatives = true;
  map_ = deformer_->deform(used_by(method_, pose), options, from);
  if (!map_.f.allFinite())
    throw Error(ErrorKind::failed,
                "the reference map has values that are not finite; move its handles apart");
}

bool ReferenceSampler::is_identity() const {
  constexpr double kRounding = 1e-10;
  const Index m = static_cast<Index>(points_.boundary.size()),
              inner = static_cast<Index>(points_.inner.size());
  const double far = kRounding * box_of(mesh_->vertices).diagonal();
  for (Index i = 0; i < m; ++i)
    if (std::abs(map_.f[i] - points_.boundary[static_cast<size_t>(i)]) > far) return false;
  for (size_t i = 0; i < anchors_.size(); ++i)
    if (std::abs(anchor_images()[i] - mesh_->vertices[static_cast<size_t>(anchors_[i])]) > far)
      return false;
  return (map_.fz.head(m + inner).array() - 1.0).abs().maxCoeff() <= kRounding &&
         map_.fzbar.head(m + inner).cwiseAbs().maxCoeff() <= kRounding;
}

std::optional<Complex> ReferenceSampler::pin_image(size_t pin) const {
  return pins_[pin] ? std::optional(map_.f[*pins_[pin]]) : std::nullopt;
}

BoundedReference ReferenceSampler::reference(Points& zeros) const {
  const Index m = static_cast<Index>(points_.boundary.size()),
              inner = static_cast<Index>(points_.inner.size());
  const VectorXc fz = map_.fz.head(m);
  // The nearest holomorphic function determines the winding number and the zeros.
  const auto [unknowns, fitted] = fit_(fz);
  const VectorXc& gamma = method_.harmonic ? fz : fitted;
  std::vector<Zero> found;
  zeros.clear();
  const PolygonView boundary(points_.boundary, points_.holes);
  if (winds_around_zero(boundary, gamma)) {
    found = zeros_of(*mesh_, on_mesh_.function(basis_.coefficients(unknowns)));
    // Drop zeros between the loop of samples and the boundary.
    std::erase_if(found,
                  [&](const Zero& zero) { return winding_number(boundary, zero.position) == 0; });
    for (const Zero& zero : found) zeros.push_back(zero.position);
  }
  const VectorXd theta = boundary_argument(boundary, gamma, found);
  BoundedReference target;
  target.log_fz.resize(m);
  const double least = 1e-6 * fz.cwiseAbs().maxCoeff();
  for (Index i = 0; i < m; ++i)
    target.log_fz[i] = {std::log(std::max(std::abs(fz[i]), least)), theta[i]};
  target.psi = map_.fzbar.head(m).conjugate();
  target.inner_psi = map_.fzbar.segment(m, inner).conjugate();
  target.nu = (target.psi.array() / fz.array()).matrix();
  target.inner_nu = (target.inner_psi.array() / map_.fz.segment(m, inner).array()).matrix();
  return target;
}

std::span<const Complex> ReferenceSampler::anchor_images() const {
  return {map_.f.data() + points_.boundary.size(), anchors_.size()};
}

}  // namespace holomorph
