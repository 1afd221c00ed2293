// exp(i H) is integrated from the middle outwards, the cage's vertices last.
#include "core/angle_map.h"

#include <algorithm>

#include "core/antiderivative.h"
#include "core/outline_start.h"

namespace holomorph {
namespace {

int deepest_vertex(const Mesh& mesh, const Cage& cage) {
  const Complex middle = deepest_point(Polyline(flattened(cage).points, true));
  const auto nearest =
      std::ranges::min_element(mesh.vertices, {}, [&](Complex z) { return std::norm(z - middle); });
  return static_cast<int>(nearest - mesh.vertices.begin());
}

}  // namespace

AngleMap::AngleMap(const Mesh& mesh, std::shared_ptr<const HilbertCoordinates> coordinates,
                   const Points& samples, Precision precision)
    : coordinates_(std::move(coordinates)), ways_(mesh, coordinates_->cage()) {
  const Cage& cage = coordinates_->cage();
  const int root = deepest_vertex(mesh, cage);
  anchor_ = mesh.vertices[static_cast<size_t>(root)];
  at_anchor_ = coordinates_->at({&anchor_, 1}).imag();
  const MeshTree tree(mesh, root);
  for (const MeshTree::Edge& edge : tree.edges()) ways_.add(edge.from, edge.to);
  if (samples != mesh.vertices)
    for (const Complex& z : samples) node_of_sample_.push_back(ways_.add_node(z));
  angles_.resize(cage.size());
  for (Index j = 0; j < cage.size(); ++j) angles_[j] = coordinates_->angle(j);
  const MatrixXc h = coordinates_->at(ways_.places());
  const auto keep = [&]<class T>(Parts<T> parts) {
    parts.re = h.real().template cast<T>();
    parts.im = (h.imag().rowwise() - at_anchor_).template cast<T>();
    h_ = std::move(parts);
  };
  if (precision == Precision::full)
    keep(Parts<double>{});
  else
    keep(Parts<float>{});
}

void AngleMap::turn_to(const VectorXd& theta, bool draft) {
  std::vector<Index> changed;
  if (draft && theta_.size() == theta.size())
    for (Index c = 0; c < theta.size(); ++c)
      if (theta[c] != theta_[c]) changed.push_back(c);
  const bool few = draft && theta_.size() == theta.size() &&
                   2 * static_cast<Index>(changed.size()) < theta.size();
  std::visit(
      [&]<class T>(const Parts<T>& h) {
        if (few) {
          for (const Index c : changed) {
            const double by = theta[c] - theta_[c];
            turn_ += by * h.re.col(c).template cast<double>();
            shrink_ += by * h.im.col(c).template cast<double>();
          }
        } else {
          const auto by = theta.cast<T>().eval();
          turn_ = (h.re * by).template cast<double>();
          shrink_ = (h.im * by).template cast<double>();
        }
      },
      h_);
  theta_ = theta;
}

void AngleMap::map(const VectorXd& theta, VectorXc& f, bool draft) {
  turn_to(theta, draft);
  VectorXc slopes(turn_.size());
  for (Index i = 0; i < slopes.size(); ++i) slopes[i] = std::polar(std::exp(-shrink_[i]), turn_[i]);
  // f' is a power of the distance near a vertex: its exponent is the jump, in angles.
  const VectorXd exponents = -(coordinates_->parts().jumps * theta).cwiseQuotient(angles_);
  nodes_.setZero(ways_.nodes());
  ways_.integrate(slopes, exponents, nodes_);
  if (node_of_sample_.empty()) {
    f = nodes_;
    return;
  }
  f.resize(static_cast<Index>(node_of_sample_.size()));
  for (Index i = 0; i < f.size(); ++i) f[i] = nodes_[node_of_sample_[static_cast<size_t>(i)]];
}

VectorXc AngleMap::logarithm(const MatrixXc& rows, const VectorXd& theta) const {
  const Complex at_anchor = kI * at_anchor_.dot(theta);
  return kI * ((rows * theta.cast<Complex>()).array() - at_anchor);
}

}  // namespace holomorph
