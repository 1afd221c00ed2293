// exp(i H) is integrated outward from the anchor. Paths continue from boundary vertices only if no
// other path exists.
#include "core/angles/angle_map.h"

#include <algorithm>

#include "core/arithmetic.h"
#include "core/geometry/deepest_point.h"
#include "core/mesh/antiderivative.h"

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
    : coordinates_(std::move(coordinates)), paths_(mesh, coordinates_->cage(), precision) {
  const Cage& cage = coordinates_->cage();
  const int root = deepest_vertex(mesh, cage);
  anchor_ = mesh.vertices[static_cast<size_t>(root)];
  at_anchor_ = coordinates_->at({&anchor_, 1}).imag();
  const MeshTree tree(mesh, root);
  // Usually, the samples begin with the vertices, which then need not be searched for.
  const auto is_vertex = [&](size_t i) {
    return i < mesh.vertices.size() && samples[i] == mesh.vertices[i];
  };
  std::vector<char> wanted(mesh.vertices.size(), 0);
  for (size_t i = 0; i < samples.size(); ++i)
    wanted[is_vertex(i) ? i : static_cast<size_t>(paths_.vertex_near(samples[i]))] = 1;
  for (auto edge = tree.edges().rbegin(); edge != tree.edges().rend(); ++edge)
    if (wanted[static_cast<size_t>(edge->to)]) wanted[static_cast<size_t>(edge->from)] = 1;
  for (const MeshTree::Edge& edge : tree.edges())
    if (wanted[static_cast<size_t>(edge.to)]) paths_.add(edge.from, edge.to);
  for (size_t i = 0; i < samples.size(); ++i)
    nodes_of_samples_.push_back(is_vertex(i) ? static_cast<int>(i) : paths_.add_node(samples[i]));
  angles_.resize(cage.size());
  for (Index j = 0; j < cage.size(); ++j) angles_[j] = coordinates_->angle(j);
  const auto keep = [&]<class T>(Parts<T> parts) {
    const Points& points = paths_.quadrature_points();
    parts.re.resize(static_cast<Index>(points.size()), at_anchor_.size());
    parts.im.resize(parts.re.rows(), parts.re.cols());
    coordinates_->for_each_group(points, 0, [&](const PointGroup& group, const MatrixXc& rows) {
      parts.re(group.indices, kAll) = rows.real().template cast<T>();
      parts.im(group.indices, kAll) = (rows.imag().rowwise() - at_anchor_).template cast<T>();
    });
    h_ = std::move(parts);
  };
  if (precision == Precision::full)
    keep(Parts<double>{});
  else
    keep(Parts<float>{});
}

void AngleMap::set_angles(const VectorXd& theta, bool draft) {
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
            re_h_theta_ += by * h.re.col(c).template cast<double>();
            im_h_theta_ += by * h.im.col(c).template cast<double>();
          }
        } else {
          const auto by = theta.cast<T>().eval();
          re_h_theta_ = (h.re * by).template cast<double>();
          im_h_theta_ = (h.im * by).template cast<double>();
        }
      },
      h_);
  theta_ = theta;
}

VectorXd AngleMap::exponents(const VectorXd& theta) const {
  return -(coordinates_->parts().jumps * theta).cwiseQuotient(angles_);
}

VectorXc AngleMap::integral(const VectorXc& values) const {
  VectorXc nodes = VectorXc::Zero(paths_.nodes());
  paths_.integrate(values, exponents(theta_), nodes);
  VectorXc f(static_cast<Index>(nodes_of_samples_.size()));
  for (Index i = 0; i < f.size(); ++i) f[i] = nodes[nodes_of_samples_[static_cast<size_t>(i)]];
  return f;
}

void AngleMap::map(const VectorXd& theta, VectorXc& f, bool draft) {
  set_angles(theta, draft);
  derivatives_.resize(re_h_theta_.size());
  for (Index i = 0; i < derivatives_.size(); ++i)
    derivatives_[i] = std::polar(std::exp(-im_h_theta_[i]), re_h_theta_[i]);
  f = integral(derivatives_);
}

MatrixXc AngleMap::jacobian() const {
  MatrixXc by(static_cast<Index>(nodes_of_samples_.size()), theta_.size());
  std::visit(
      [&](const auto& h) {
        for (Index c = 0; c < theta_.size(); ++c) {
          VectorXc column(derivatives_.size());
          for (Index i = 0; i < column.size(); ++i)
            column[i] = times(Complex(-h.im(i, c), h.re(i, c)), derivatives_[i]);
          by.col(c) = integral(column);
        }
      },
      h_);
  return by;
}

MatrixXc AngleMap::rows(std::span<const Complex> points) const {
  return coordinates_->at(points).rowwise() - kI * at_anchor_.cast<Complex>();
}

HilbertCoordinates::Sum AngleMap::sum(const VectorXd& theta) const {
  HilbertCoordinates::Sum sum = coordinates_->sum(theta);
  sum.linear[0] -= kI * at_anchor_.dot(theta);
  return sum;
}

}  // namespace holomorph
