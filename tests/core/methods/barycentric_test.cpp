// Other authors' cage coordinates: mean value coordinates, and Green coordinates, which are the
// same as Cauchy coordinates.

#include "core/cauchy/cauchy.h"
#include "core/cauchy/quadrature.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/shapes.h"

namespace holomorph::barycentric_test {

namespace {

/// Green coordinates (Lipman, Levin, Cohen-Or 2008) by their definition, with the potential
/// G = ln|w - z| / 2 pi: phi_i is the integral over the boundary of G's normal derivative times the
/// hat function of vertex i, and psi_j is the integral of -G over edge j.
struct Green {
  VectorXd phi, psi;
};

Green green_coordinates(const Points& polygon, Complex z) {
  const size_t n = polygon.size();
  Green green{VectorXd::Zero(static_cast<Index>(n)), VectorXd::Zero(static_cast<Index>(n))};
  const GaussRule& rule = gauss_rule(64);
  for (size_t j = 0; j < n; ++j) {
    const Complex a = polygon[j], way = polygon[(j + 1) % n] - a,
                  normal = -kI * way / std::abs(way);
    for (size_t k = 0; k < 64; ++k) {
      const double t = rule.nodes[k], weight = rule.weights[k] * std::abs(way);
      const Complex w = a + t * way - z;
      const double slope = dot(w, normal) / std::norm(w) / (2 * kPi);
      green.phi[static_cast<Index>(j)] += weight * (1 - t) * slope;
      green.phi[static_cast<Index>((j + 1) % n)] += weight * t * slope;
      green.psi[static_cast<Index>(j)] -= weight * std::log(std::abs(w)) / (2 * kPi);
    }
  }
  return green;
}

}  // namespace

TEST_CASE("Green coordinates are Cauchy coordinates") {
  const Points polygon{{0, 0}, {4, 0}, {5, 3}, {2, 2}, {-1, 4}};
  const Cage cage = polygon_cage(polygon);
  const size_t n = polygon.size();
  Points posed;
  for (const Complex& z : polygon)
    posed.push_back(z * Complex(0.8, 0.3) + 0.2 * std::conj(z * z) + 1.0);
  for (const Complex z : {Complex(2, 1), {1, 1.5}, {3.5, 1.2}, {0.5, 2}}) {
    const Green green = green_coordinates(polygon, z);
    Complex by_green = 0, by_cauchy = 0;
    for (size_t j = 0; j < n; ++j) {
      const Complex way = polygon[(j + 1) % n] - polygon[j],
                    posed_way = posed[(j + 1) % n] - posed[j];
      // s_j n_j in that paper: the posed edge's outer normal, scaled by the edge's growth.
      const Complex grown_normal = -kI * posed_way / std::abs(way);
      by_green += green.phi[static_cast<Index>(j)] * posed[j] +
                  green.psi[static_cast<Index>(j)] * grown_normal;
    }
    const MatrixXc cauchy = cauchy_coordinates(cage, std::span<const Complex>(&z, 1));
    for (size_t j = 0; j < n; ++j) by_cauchy += cauchy(0, static_cast<Index>(j)) * posed[j];
    CHECK(std::abs(by_green - by_cauchy) <= 1e-12 * 10);  // for a map of size 10
  }
}

TEST_CASE("Mean value coordinates: they follow the cage, and are negative beyond a reflex corner") {
  Rest rest;
  rest.cage = polygon_cage(shapes::l_shape());
  rest.precision = Precision::full;
  const Mesh mesh = domain_mesh(rest.cage, {1500});
  rest.samples = mesh.vertices;
  rest.mesh = std::make_shared<const Mesh>(mesh);
  const auto mean_value = method_named("mean_value").prepare(rest, nullptr),
             harmonic = method_named("harmonic").prepare(rest, nullptr);
  Pose pose{rest.cage, {}};
  for (size_t j = 0; j < 6; ++j)
    pose.cage.segments[j][0] += Complex(20 * std::sin(3.0 * j), 30 * std::cos(5.0 * j));
  SampledMap map = mean_value->deform(pose, {});
  for (const int v : mesh.boundary) {
    double nearest = 1e9;
    for (Index e = 0; e < 6; ++e)
      nearest = std::min(
          nearest,
          nearest_on_segment(pose.cage.vertex(e), pose.cage.end_vertex(e), map.f[v]).distance);
    REQUIRE(nearest <= 1e-9);
  }
  // The coordinate of a single vertex, read off as a displacement.
  const auto least = [&](Deformer& deformer, size_t vertex) {
    Pose one{rest.cage, {}};
    one.cage.segments[vertex][0] += 1.0;
    SampledMap moved = deformer.deform(one, {});
    double low = 1;
    for (size_t v = 0; v < mesh.vertices.size(); ++v)
      low = std::min(low, (moved.f[static_cast<Index>(v)] - mesh.vertices[v]).real());
    return low;
  };
  double mean_value_low = 1, harmonic_low = 1;
  for (size_t j = 0; j < 6; ++j) {
    mean_value_low = std::min(mean_value_low, least(*mean_value, j));
    harmonic_low = std::min(harmonic_low, least(*harmonic, j));
  }
  CHECK(mean_value_low < -0.005);
  CHECK(harmonic_low > -2e-3);
}

}  // namespace holomorph::barycentric_test
