// H and the map are both fitted with normal equations.
#include "core/compared/published_angles.h"

#include <algorithm>

#include "core/angles/hilbert.h"
#include "core/cauchy/cauchy.h"
#include "core/solvers/factors.h"

namespace holomorph {

PublishedAngles::PublishedAngles(const Cage& cage, const std::vector<Index>& corners,
                                 Complex anchor, int pieces)
    : anchor_(anchor) {
  const FlatCage flat = flattened(cage);
  const RealParts angles = corner_values(cage, corners);
  const double length = perimeter(flat.points) / pieces;
  // Parts of about equal length; every vertex of the polygon is an end of a part.
  std::vector<BoundaryPoint> starts;
  std::vector<double> lengths;  // the length of each part in the cage's parameter
  Points nodes;
  for (size_t i = 0; i < flat.points.size(); ++i) {
    const Complex a = flat.points[i], b = flat.points[(i + 1) % flat.points.size()];
    const auto& [segment, from] = flat.locations[i];
    const bool last = i + 1 == flat.points.size() || flat.locations[i + 1].segment != segment;
    const double to = last ? 1 : flat.locations[i + 1].t;
    const int count = std::max(1, static_cast<int>(std::lround(std::abs(b - a) / length)));
    for (int k = 0; k < count; ++k) {
      nodes.push_back(a + (b - a) * (static_cast<double>(k) / count));
      starts.push_back({segment, from + (to - from) * k / count});
      lengths.push_back((to - from) / count);
    }
  }
  for (size_t i = 0; i < nodes.size(); ++i)
    parts_.push_back({nodes[i], nodes[(i + 1) % nodes.size()], 0, 0});
  // Consecutive parts share the function at their common end, except at corners.
  Index count = 0;
  for (size_t i = 0; i < parts_.size(); ++i) {
    parts_[i].start = count++;
    const size_t next = (i + 1) % parts_.size();
    const bool corner =
        starts[next].t == 0 && std::ranges::find(corners, starts[next].segment) != corners.end();
    parts_[i].end = corner ? count++ : next == 0 ? 0 : count;
  }
  nodes_ = polygon_cage(nodes);

  const auto points_at = [&](const std::vector<double>& within) {
    std::vector<BoundaryPoint> locations;
    Points points;
    std::vector<Index> parts;
    for (size_t i = 0; i < parts_.size(); ++i)
      for (const double t : within) {
        locations.push_back({starts[i].segment, starts[i].t + t * lengths[i]});
        points.push_back(parts_[i].from + t * (parts_[i].to - parts_[i].from));
        parts.push_back(static_cast<Index>(i));
      }
    return std::tuple(locations, points, parts);
  };
  const auto [locations, points, parts] = points_at({0.1, 0.3, 0.5, 0.7, 0.9});
  const MatrixXc basis = functions(points, parts);
  MatrixXd rows(basis.rows(), 2 * basis.cols());
  rows << basis.real(), -basis.imag();
  MatrixXd gram = transposed_matrix_product(rows, rows);
  gram.diagonal().array() += 1e-12 * gram.diagonal().mean();
  const MatrixXd x =
      solve_symmetric_all(gram, transposed_matrix_product(rows, angles.values(locations)));
  coefficients_ = x.topRows(basis.cols()) + kI * x.bottomRows(basis.cols());
  const MatrixXc at_anchor = functions({&anchor_, 1}, {Index{-1}}) * coefficients_;
  slopes_ = (basis * coefficients_).rowwise() - kI * at_anchor.imag().row(0).cast<Complex>();

  const auto [other_positions, other_points, other_parts] =
      points_at({0.001, 0.02, 0.2, 0.4, 0.6, 0.8, 0.98, 0.999});
  error_ = ((functions(other_points, other_parts) * coefficients_).real() -
            angles.values(other_positions))
               .cwiseAbs()
               .maxCoeff();

  const MatrixXc derivative = cauchy_coordinates(nodes_, std::span<const Complex>(points), 1);
  MatrixXc normal = derivative.adjoint() * derivative;
  normal.diagonal().array() += 1e-12 * normal.diagonal().real().mean();
  fit_ = solve_hermitian_all(normal, derivative.adjoint());
}

/// `parts` holds, for each point, the part of the boundary on which it lies, or -1 if it is inside.
MatrixXc PublishedAngles::functions(std::span<const Complex> points,
                                    const std::vector<Index>& parts) const {
  Index count = 0;
  for (const EdgePart& part : parts_) count = std::max({count, part.start + 1, part.end + 1});
  MatrixXc values = MatrixXc::Zero(static_cast<Index>(points.size()), count);
  for (size_t i = 0; i < points.size(); ++i)
    for (size_t j = 0; j < parts_.size(); ++j) {
      const EdgePart& part = parts_[j];
      const VectorXc of_ends =
          edge_coordinates(part.from, part.to, 1, points[i], 0, parts[i] == static_cast<Index>(j));
      values(static_cast<Index>(i), part.start) += of_ends[0];
      values(static_cast<Index>(i), part.end) += of_ends[1];
    }
  return values;
}

PublishedAngles::Values PublishedAngles::map(const VectorXd& theta, const Points& samples) const {
  const VectorXc slopes = (kI * (slopes_ * theta.cast<Complex>())).array().exp();
  const VectorXc posed = fit_ * slopes;
  Points all = samples, off_ends = samples;
  all.push_back(anchor_);
  const VectorXc f = cauchy_coordinates(nodes_, std::span<const Complex>(all)) * posed;
  const Index n = static_cast<Index>(samples.size());
  // f' is not defined where parts meet, so it is evaluated slightly inside.
  const Points ends = vertices_of(nodes_);
  constexpr double kInside = 1e-3;
  for (Complex& z : off_ends)
    if (std::ranges::find(ends, z) != ends.end()) z += kInside * (anchor_ - z);
  return {f.head(n).array() - f[n],
          cauchy_coordinates(nodes_, std::span<const Complex>(off_ends), 1) * posed};
}

}  // namespace holomorph
