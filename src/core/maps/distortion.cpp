// Singular values of the Jacobian from the Wirtinger derivatives; zeros of f_z by winding numbers.
#include "core/maps/distortion.h"

#include <limits>

#include "core/arithmetic.h"
#include "core/error.h"

namespace holomorph {

Distortion distortion_of(const SampledMap& map) {
  check(map.fz.size() == map.f.size(), "distortion_of: the map was sampled with its derivatives");
  const Index n = map.fz.size();
  Distortion result{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < n; ++i) {
    const double a = std::abs(map.fz[i]), b = std::abs(map.fzbar[i]);
    const double most = a + b, least = a - b;
    result.k[i] = a > 0 ? b / a : 1.0;
    result.area[i] = least > 0 ? std::log2(most * least) : -kInfinity;
    result.stretch[i] = least > 0 ? std::max(most, 1 / least) : kInfinity;
  }
  return result;
}

int flipped_triangles(const Mesh& mesh, const VectorXc& f) {
  int count = 0;
  for (const auto& [i, j, k] : mesh.triangles) count += !(cross(f[j] - f[i], f[k] - f[i]) > 0);
  return count;
}

bool is_immersion(const Mesh& mesh, const VectorXc& f) {
  if (flipped_triangles(mesh, f) > 0) return false;
  VectorXd angles = VectorXd::Zero(f.size());
  for (const Triangle& t : mesh.triangles)
    for (size_t k = 0; k < 3; ++k)
      angles[t[k]] +=
          std::arg(times(f[t[(k + 2) % 3]] - f[t[k]], std::conj(f[t[(k + 1) % 3]] - f[t[k]])));
  for (const int v : mesh.boundary) angles[v] = 0;
  return angles.maxCoeff() < 3 * kPi;
}

bool MapReport::locally_injective() const {
  return zeros.empty() && flipped_triangles == 0 && std::abs(turning_number - 1) < 0.01;
}

MapReport report_of(const Mesh& mesh, const SampledMap& map) {
  check(map.fz.size() == static_cast<Index>(mesh.vertices.size()),
        "report_of: derivatives per vertex");
  MapReport report;
  const Eigen::ArrayXd a = map.fz.cwiseAbs(), b = map.fzbar.cwiseAbs();
  report.max_k = a.minCoeff() > 0 ? (b / a).maxCoeff() : 1.0;
  report.max_sigma = (a + b).maxCoeff();
  report.min_sigma = (a - b).minCoeff();

  const auto increment = [&](int from, int to) {
    const Complex x = map.fz[from], y = map.fz[to];
    return std::atan2(cross(x, y), dot(x, y));
  };
  for (const auto& [i, j, k] : mesh.triangles) {
    const double winding = (increment(i, j) + increment(j, k) + increment(k, i)) / (2 * kPi);
    if (std::abs(winding) > 0.5)
      report.zeros.push_back((mesh.vertices[i] + mesh.vertices[j] + mesh.vertices[k]) / 3.0);
  }
  report.flipped_triangles = flipped_triangles(mesh, map.f);
  Polygon image{{}, mesh.starts};
  for (const int v : mesh.boundary) image.points.push_back(map.f[v]);
  report.turning_number = is_immersion(mesh, map.f) ? 1 : turning_number(image, part_count(mesh));
  report.simple_boundary = !self_crossing(image).has_value();
  return report;
}

double isometric_energy_of(const Mesh& mesh, const VectorXc& f) {
  double sum = 0, total = 0;
  for (const Triangle& t : mesh.triangles) {
    const Complex a = mesh.vertices[static_cast<size_t>(t[0])];
    const double area = cross(mesh.vertices[static_cast<size_t>(t[1])] - a,
                              mesh.vertices[static_cast<size_t>(t[2])] - a);
    const LinearDerivatives here = derivatives_in(mesh, t, f);
    const double x = std::norm(here.fz), y = std::norm(here.fzbar), d = x - y;
    if (!(d > 0)) return std::numeric_limits<double>::infinity();
    sum += area * (x + y) * (1 + 1 / (d * d));
    total += area;
  }
  return sum / total;
}

LinearDerivatives derivatives_in(const Mesh& mesh, const Triangle& t, const VectorXc& f) {
  LinearDerivatives at{};  // f_z and f_zbar times four times the triangle's area
  for (int a = 0; a < 3; ++a) {
    const Complex side = opposite_side(mesh, t, a);
    at.fz += times(-kI * std::conj(side), f[t[a]]);
    at.fzbar += times(kI * side, f[t[a]]);
  }
  const double over = 1 / (4 * area_of(mesh, t));
  return {at.fz * over, at.fzbar * over};
}

VertexDerivatives vertex_derivatives(const Mesh& mesh, const VectorXc& f) {
  const Index n = f.size();
  VertexDerivatives at{VectorXc::Zero(n), VectorXc::Zero(n)};
  VectorXd areas = VectorXd::Zero(n);
  for (const Triangle& t : mesh.triangles) {
    const LinearDerivatives here = derivatives_in(mesh, t, f);
    const double area = area_of(mesh, t);
    for (const int v : t) {
      at.fz[v] += area * here.fz;
      at.fzbar[v] += area * here.fzbar;
      areas[v] += area;
    }
  }
  at.fz.array() /= areas.array();
  at.fzbar.array() /= areas.array();
  return at;
}

MapReport report_of_linear(const Mesh& mesh, const VectorXc& f) {
  SampledMap map;
  map.f = f;
  VertexDerivatives at = vertex_derivatives(mesh, f);
  map.fz = std::move(at.fz);
  map.fzbar = std::move(at.fzbar);
  MapReport report = report_of(mesh, map);
  report.max_k = report.max_sigma = 0;
  report.min_sigma = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles) {
    const LinearDerivatives here = derivatives_in(mesh, t, f);
    const double a = std::abs(here.fz), b = std::abs(here.fzbar);
    report.max_k = std::max(report.max_k, a > 0 ? b / a : 1.0);
    report.max_sigma = std::max(report.max_sigma, a + b);
    report.min_sigma = std::min(report.min_sigma, a - b);
  }
  return report;
}

}  // namespace holomorph
