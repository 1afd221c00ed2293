#include "core/sheet/smooth_map.h"

#include <algorithm>
#include <map>
#include <set>

namespace holomorph {
namespace {

/// The parts of the way to the linear map, in turn.
constexpr std::array<double, 4> kStraight{0, 0.25, 0.5, 1};

/// The triangles on both sides of each edge.
class EdgeTriangles {
 public:
  explicit EdgeTriangles(const std::vector<Triangle>& triangles) : triangles_(triangles) {
    for (size_t i = 0; i < triangles.size(); ++i)
      for (size_t k = 0; k < 3; ++k)
        left_of_[{triangles[i][(k + 1) % 3], triangles[i][(k + 2) % 3]}] = i;
  }
  /// The triangle across the edge opposite a corner.
  std::optional<size_t> across(size_t triangle, size_t corner) const {
    const Triangle& t = triangles_[triangle];
    const auto found = left_of_.find({t[(corner + 2) % 3], t[(corner + 1) % 3]});
    if (found == left_of_.end()) return {};
    return found->second;
  }

 private:
  const std::vector<Triangle>& triangles_;
  std::map<std::pair<int, int>, size_t> left_of_;
};

}  // namespace

std::vector<std::pair<int, double>> smooth_row(const Mesh& mesh, const VertexGradients& gradients,
                                               const Location& location) {
  const Triangle& t = mesh.triangles[static_cast<size_t>(location.triangle)];
  std::array<SmoothCorner, 3> corners{};
  for (size_t k = 0; k < 3; ++k) corners[k].z = mesh.vertices[static_cast<size_t>(t[k])];
  const auto value = [&] { return CubicThirds(corners).at(location.weights).f; };
  std::map<int, double> row;
  for (size_t k = 0; k < 3; ++k) {
    SmoothCorner& corner = corners[k];
    corner.f = 1;
    row[t[k]] += value().real();
    corner.f = 0;
    // The value is linear in f_x and f_y, with real weights.
    corner.fz = 0.5, corner.fzbar = 0.5;
    const double by_x = value().real();
    corner.fz = -0.5 * kI, corner.fzbar = 0.5 * kI;
    const double by_y = value().real();
    corner.fz = corner.fzbar = 0;
    using Weights = Eigen::SparseMatrix<Complex, Eigen::RowMajor>;
    for (Weights::InnerIterator at(gradients.weights(), t[k]); at; ++at)
      row[static_cast<int>(at.col())] += 2 * (by_x * at.value().real() - by_y * at.value().imag());
  }
  return {row.begin(), row.end()};
}

SmoothMap::SmoothMap(std::shared_ptr<const Mesh> mesh, std::shared_ptr<const MeshLocator> locator,
                     VectorXc f, VectorXc fz, VectorXc fzbar)
    : mesh_(std::move(mesh)),
      locator_(std::move(locator)),
      f_(std::move(f)),
      fz_(std::move(fz)),
      fzbar_(std::move(fzbar)) {
  cubics_.reserve(mesh_->triangles.size());
  for (size_t i = 0; i < mesh_->triangles.size(); ++i) cubics_.push_back(smooth_cubics(i));
}

CubicThirds SmoothMap::smooth_cubics(size_t triangle) const {
  std::array<SmoothCorner, 3> corners;
  for (size_t k = 0; k < 3; ++k) {
    const int v = mesh_->triangles[triangle][k];
    corners[k] = {mesh_->vertices[static_cast<size_t>(v)], f_[v], fz_[v], fzbar_[v]};
  }
  return CubicThirds(corners);
}

PointMap::Value SmoothMap::at(Complex z) const {
  return at(locator_->near(z));
}

PointMap::Value SmoothMap::at(const Location& location) const {
  return cubics_[static_cast<size_t>(location.triangle)].at(location.weights);
}

SmoothMap::Guarded SmoothMap::guard() {
  std::vector<size_t> folded;
  for (size_t i = 0; i < cubics_.size(); ++i)
    if (!cubics_[i].is_positive()) folded.push_back(i);
  Guarded guarded;
  if (folded.empty()) return guarded;
  const EdgeTriangles around(mesh_->triangles);
  std::vector<size_t> levels(cubics_.size(), 0);
  std::set<size_t> changed;
  while (!folded.empty() && !guarded.unproved) {
    std::set<size_t> touched;
    for (const size_t i : folded) {
      if (levels[i] + 1 == kStraight.size()) {
        guarded.unproved = i;
        break;
      }
      ++levels[i];
      touched.insert(i);
      for (size_t k = 0; k < 3; ++k)
        if (const auto other = around.across(i, k)) touched.insert(*other);
    }
    folded.clear();
    for (const size_t i : touched) {
      std::array<double, 3> edges{};
      for (size_t k = 0; k < 3; ++k) {
        const auto other = around.across(i, k);
        edges[k] = kStraight[std::max(levels[i], other ? levels[*other] : 0)];
      }
      cubics_[i] = smooth_cubics(i);
      cubics_[i].straighten(edges, kStraight[levels[i]]);
      if (!cubics_[i].is_positive()) folded.push_back(i);
    }
    changed.merge(touched);
  }
  guarded.straightened =
      cubics_.size() - static_cast<size_t>(std::ranges::count(levels, size_t{0}));
  if (!guarded.unproved) guarded.unproved = with_wrong_angle(changed);
  return guarded;
}

/// A triangle at an inner vertex around which the image does not close after one turn, among the
/// vertices of some triangles.
std::optional<size_t> SmoothMap::with_wrong_angle(const std::set<size_t>& among) const {
  std::map<int, double> angles;
  for (const size_t i : among)
    for (const int v : mesh_->triangles[i]) angles[v] = 0;
  for (size_t i = 0; i < cubics_.size(); ++i)
    for (size_t k = 0; k < 3; ++k)
      if (const auto at = angles.find(mesh_->triangles[i][k]); at != angles.end()) {
        const auto [next, center, before] = cubics_[i].directions(k);
        at->second += std::arg(center / next) + std::arg(before / center);
      }
  constexpr double kRounding = 1e-6;
  const std::vector<char> outer = boundary_marks(*mesh_);
  for (const size_t i : among)
    for (const int v : mesh_->triangles[i]) {
      if (outer[static_cast<size_t>(v)] == 0 && std::abs(angles[v] - 2 * kPi) > kRounding) return i;
    }
  return {};
}

}  // namespace holomorph
