// Hilbert coordinates and angle maps, compared with closed forms; harmonic coordinates, compared
// with a finite-difference solution.
#include "core/angles/angle_map.h"

#include <numeric>
#include <random>

#include "core/cauchy/cauchy.h"
#include "core/error.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "core/methods/real_coordinates.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::angle_test {

namespace {

Points star() {
  Points star;
  for (int i = 0; i < 20; ++i) star.push_back(std::polar(i % 2 ? 50.0 : 100.0, 2 * kPi * i / 20));
  return star;
}

/// The outline of an animal with a long neck, legs and a bent body.
Points animal() {
  return {{0, 0},     {14, 0},    {18, 60},   {80, 62},   {84, 0},    {98, 0},
          {104, 90},  {118, 170}, {130, 250}, {160, 252}, {162, 268}, {116, 276},
          {100, 200}, {88, 130},  {30, 120},  {4, 100}};
}

HilbertCoordinates coordinates_of(const Points& polygon, const std::vector<Index>& corners,
                                  double tolerance = 1e-3) {
  const Cage cage = polygon_cage(polygon);
  return {cage, corner_values(cage, corners), tolerance};
}

AngleMap angle_map(const Mesh& mesh, HilbertCoordinates coordinates) {
  return {mesh, std::make_shared<const HilbertCoordinates>(std::move(coordinates)), mesh.vertices,
          Precision::full};
}

std::vector<Index> all_of(const Points& polygon) {
  std::vector<Index> all(polygon.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Points along all edges, none of them at a vertex or where the coordinates are fitted.
std::vector<BoundaryPoint> along(const Points& polygon) {
  std::vector<BoundaryPoint> places;
  for (Index e = 0; e < static_cast<Index>(polygon.size()); ++e)
    for (int k = 1; k < 40; ++k) places.push_back({e, (k + 0.3 * std::sin(k)) / 40.0});
  return places;
}

Points at(const Points& polygon, const std::vector<BoundaryPoint>& places) {
  Points points;
  const Cage cage = polygon_cage(polygon);
  for (const BoundaryPoint& place : places) points.push_back(position_of(cage, place));
  return points;
}

int flipped_triangle_count(const Mesh& mesh, const VectorXc& f) {
  int count = 0;
  for (const auto& [a, b, c] : mesh.triangles) count += !(cross(f[b] - f[a], f[c] - f[a]) > 0);
  return count;
}

double size_of(const VectorXc& f) {
  return box_of(Points(f.begin(), f.end())).diagonal();
}

/// The boundary angles that rotate a polygon's edges to the directions of another polygon's edges.
VectorXd angles_between(const Points& from, const Points& to) {
  const size_t n = from.size();
  const auto way = [n](const Points& p, size_t i) { return p[(i + 1) % n] - p[i % n]; };
  VectorXd theta(2 * static_cast<Index>(n));
  double angle = std::arg(way(to, 0) / way(from, 0));
  for (size_t e = 0; e < n; ++e) {
    theta[static_cast<Index>(2 * e + 1)] = theta[static_cast<Index>(2 * ((e + 1) % n))] = angle;
    angle += std::arg(way(to, e + 1) / way(to, e)) - std::arg(way(from, e + 1) / way(from, e));
  }
  return theta;
}

}  // namespace

TEST_CASE("Hilbert coordinates: real parts are linear between corners and jump at them") {
  for (const Points& polygon :
       {Points{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, shapes::l_shape(), star(), animal()}) {
    const auto places = along(polygon);
    const Points points = at(polygon, places);
    for (const Index every : {1, 2}) {
      std::vector<Index> corners;
      for (Index i = 0; i < static_cast<Index>(polygon.size()); i += every) corners.push_back(i);
      if (corners.size() < 3) continue;
      const HilbertCoordinates coordinates = coordinates_of(polygon, corners, 1e-4);
      const MatrixXc h = coordinates.at(points);
      const MatrixXd wanted = coordinates.parts().values(places);
      INFO(polygon.size() << " vertices, " << corners.size() << " corners, "
                          << coordinates.unknowns() << " unknowns");
      CHECK(coordinates.error() <= 1e-4);
      CHECK((h.real() - wanted).cwiseAbs().maxCoeff() <= 5e-4);
      CHECK((wanted.rowwise().sum().array() - 1).abs().maxCoeff() <= 1e-12);
      CHECK((h.rowwise().sum().real().array() - 1).abs().maxCoeff() <= 1e-5);
    }
  }
}

TEST_CASE("Hilbert coordinates: real parts also match on curved boundaries") {
  Cage cage = polygon_cage(shapes::l_shape());
  for (Points& segment : cage.segments) segment.resize(3);
  cage = elevated_to(polygon_cage(shapes::l_shape()), cage);
  for (Points& segment : cage.segments) {
    segment[1] += Complex(6, -8);
    segment[2] += Complex(5, 9);
  }
  const HilbertCoordinates coordinates(cage, corner_values(cage, {0, 2, 3, 5}), 1e-4);
  std::vector<BoundaryPoint> places;
  Points points;
  for (Index e = 0; e < cage.size(); ++e)
    for (int k = 1; k < 40; ++k) {
      places.push_back({e, (k + 0.3 * std::sin(k)) / 40.0});
      points.push_back(position_of(cage, places.back()));
    }
  const MatrixXd wanted = coordinates.parts().values(places);
  CHECK((coordinates.at(points).real() - wanted).cwiseAbs().maxCoeff() <= 5e-4);
  CHECK((wanted.rowwise().sum().array() - 1).abs().maxCoeff() <= 1e-12);
}

TEST_CASE("Hilbert coordinates: the values of Re(a z) at the corners give a z") {
  const Points polygon = shapes::l_shape();
  const HilbertCoordinates coordinates = coordinates_of(polygon, all_of(polygon), 1e-6);
  const Complex a(0.3, -1.2);
  VectorXd theta(2 * static_cast<Index>(polygon.size()));
  for (size_t j = 0; j < polygon.size(); ++j)
    theta[static_cast<Index>(2 * j)] = theta[static_cast<Index>(2 * j + 1)] =
        (a * polygon[j]).real();
  const Points points{{40, 40}, {150, 50}, {50, 150}, {90, 20}};
  const VectorXc h = coordinates.at(points) * theta, slope = coordinates.at(points, 1) * theta;
  for (Index i = 0; i < h.size(); ++i) {
    CHECK(std::abs((h[i] - h[0]) - a * (points[static_cast<size_t>(i)] - points[0])) <= 1e-4);
    CHECK_THAT(h[i].real(), Catch::WithinAbs((a * points[static_cast<size_t>(i)]).real(), 1e-4));
    CHECK(std::abs(slope[i] - a) <= 1e-5);
  }
}

TEST_CASE("Hilbert coordinates: fewer than three corners are refused, straight corners are not") {
  CHECK_THROWS_WITH(coordinates_of(shapes::l_shape(), {0, 2}), Catch::Contains("three corners"));
  // A straight corner works like any other.
  const Points square{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}};
  const HilbertCoordinates coordinates = coordinates_of(square, {0, 1, 3, 4}, 1e-4);
  const auto places = along(square);
  CHECK((coordinates.at(at(square, places)).real() - coordinates.parts().values(places))
            .cwiseAbs()
            .maxCoeff() <= 5e-4);
}

/// A rough cage with as many holes as asked for.
Cage rough_cage(unsigned seed, int holes) {
  std::mt19937 random(seed);
  Cage cage =
      polygon_cage(shapes::star(std::uniform_int_distribution(60, 110)(random), 0.15, seed));
  for (int hole = 0; hole < holes; ++hole) {
    cage.starts.push_back(cage.size());
    for (int i = 0; i < 12; ++i)
      cage.segments.push_back(
          {Complex(170 + 60 * hole, 200) + std::polar(15.0, -2 * kPi * i / 12.0)});
  }
  return cage;
}

/// The functions of harmonic coordinates, one for each vertex.
RealParts vertex_weights(const Cage& cage) {
  RealParts parts{
      [cage](std::span<const BoundaryPoint> places) { return weights_at(cage, places); },
      MatrixXd::Zero(cage.size(), cage.size()), MatrixXd(cage.size(), 3)};
  const VectorXc vertices = controls_of(cage);
  parts.linear << VectorXd::Ones(cage.size()), vertices.real(), vertices.imag();
  return parts;
}

TEST_CASE("Hilbert coordinates: many points at once give what each gives alone") {
  for (const unsigned seed : seeds_of("many points of Hilbert coordinates", {3}))
    for (const Cage& cage :
         {rough_cage(seed, 0), rough_cage(seed, 2), shapes::curved_star(30, 3, 0.1, seed)}) {
      std::vector<Index> corners(static_cast<size_t>(cage.size()));
      std::iota(corners.begin(), corners.end(), 0);
      const HilbertCoordinates coordinates(
          cage, cage.starts.empty() ? corner_values(cage, corners) : vertex_weights(cage));
      Points points;
      const FlatCage flat = flattened(cage);
      for (const Complex& z : domain_mesh(cage, {few_or_many(2500, 6000)}).vertices)
        if (nearest_on_polygon(flat, z).distance > 1e-6) points.push_back(z);
      for (const int order : {0, 1}) {
        const MatrixXc all = coordinates.at(points, order);
        const double size = all.cwiseAbs().maxCoeff();
        CAPTURE(seed, order, cage.size(), size);
        for (size_t i = 0; i < points.size(); i += 37) {
          const MatrixXc alone = coordinates.at({&points[i], 1}, order);
          REQUIRE((alone - all.row(static_cast<Index>(i))).cwiseAbs().maxCoeff() <= 1e-10 * size);
        }
      }
    }
}

TEST_CASE("Hilbert coordinates: sums with fixed weights equal the coordinates' sums") {
  for (const Points& polygon : {star(), animal()}) {
    const HilbertCoordinates coordinates = coordinates_of(polygon, all_of(polygon));
    const Points points = domain_mesh(polygon_cage(polygon), {200}).vertices;
    Points inside;
    for (const Complex& z : points)
      if (std::ranges::find(polygon, z) == polygon.end()) inside.push_back(z);
    const MatrixXc all = coordinates.at(inside);
    const VectorXd weights = VectorXd::LinSpaced(all.cols(), -1, 2).array().sin();
    const VectorXc sum = coordinates.values(inside, coordinates.sum(weights));
    CHECK((sum - all * weights).cwiseAbs().maxCoeff() <= 1e-10);
  }
}

TEST_CASE("Angle maps: the sum of all angles equals the rows times the angles") {
  const Mesh mesh = domain_mesh(polygon_cage(star()), {200});
  const AngleMap map = angle_map(mesh, coordinates_of(star(), all_of(star())));
  const VectorXd theta = VectorXd::LinSpaced(40, -0.3, 0.4);
  const Points points{{3, 5}, {-20, 11}, {60, -2}};
  const VectorXc sum = map.coordinates().values(points, map.sum(theta));
  CHECK((sum - map.rows(points) * theta).cwiseAbs().maxCoeff() <= 1e-10);
}

TEST_CASE("Angle maps: zero angles give the identity up to translation") {
  const Points polygon = animal();
  const Mesh mesh = domain_mesh(polygon, {3000});
  AngleMap map = angle_map(mesh, coordinates_of(polygon, all_of(polygon)));
  VectorXc f;
  map.map(VectorXd::Zero(2 * static_cast<Index>(polygon.size())), f);
  const Complex anchor = map.anchor();
  for (Index i = 0; i < f.size(); ++i)
    REQUIRE(std::abs(f[i] - (mesh.vertices[static_cast<size_t>(i)] - anchor)) <= 1e-10);
}

TEST_CASE("Angle maps: angles that grow linearly along a bar give an exponential") {
  // theta = a x gives f = (exp(i a z) - 1) / (i a), up to scale and translation.
  const Points bar{{0, 0}, {6, 0}, {6, 1}, {0, 1}};
  const Mesh mesh = domain_mesh(bar, {8000});
  AngleMap map = angle_map(mesh, coordinates_of(bar, all_of(bar), 1e-9));
  const Complex anchor = map.anchor();
  for (const auto& [degrees, tolerance] :
       {std::pair(90.0, 1e-10), {540.0, 1.5e-7}, {900.0, 1.1e-6}}) {
    const double a = degrees * kPi / 180 / 6;
    VectorXd theta(8);
    theta << 0, 0, 6 * a, 6 * a, 6 * a, 6 * a, 0, 0;
    VectorXc f;
    map.map(theta, f);
    const auto exact = [&](Complex z) {
      return std::exp(a * anchor.imag()) * (std::exp(kI * a * z) - 1.0) / (kI * a);
    };
    double off = 0;
    for (Index i = 0; i < f.size(); ++i)
      off = std::max(
          off, std::abs(f[i] - (exact(mesh.vertices[static_cast<size_t>(i)]) - exact(anchor))));
    INFO(degrees << " degrees: " << off / size_of(f));
    CHECK(off <= tolerance * size_of(f));
    CHECK(flipped_triangle_count(mesh, f) == 0);
  }
}

TEST_CASE(
    "Angle maps: edges with constant angles stay straight and have the prescribed directions") {
  struct Pair {
    Points from, to;
    double degrees;
  };
  for (const auto& [from, to, degrees] :
       {Pair{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 0}, {1.6, 0}, {0.55, 0.5}, {0.2, 1.5}}, 0.02},
        Pair{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
             {{0, 0}, {2, 0}, {2, 1}, {1.3, 1.2}, {0.9, 2}, {-0.3, 1.9}},
             6e-4}}) {
    const Mesh mesh = domain_mesh(from, {6000});
    AngleMap map = angle_map(mesh, coordinates_of(from, all_of(from), 1e-6));
    VectorXc f;
    map.map(angles_between(from, to), f);
    const size_t n = from.size();
    for (size_t e = 0; e < n; ++e) {
      const Complex a = f[mesh.cage_vertices[e]], b = f[mesh.cage_vertices[(e + 1) % n]];
      CHECK(std::abs(std::arg((b - a) / (to[(e + 1) % n] - to[e]))) <= degrees * kPi / 180);
      for (const int v : mesh.boundary)
        if (nearest_on_segment(from[e], from[(e + 1) % n], mesh.vertices[static_cast<size_t>(v)])
                .distance < 1e-12)
          REQUIRE(std::abs(cross(b - a, f[v] - a)) <= 2e-6 * std::norm(b - a));
    }
    CHECK(flipped_triangle_count(mesh, f) <=
          1);  // a triangle with three vertices on a straight edge
  }
}

TEST_CASE("Angle maps: random corner angles up to 60 degrees cause no folds") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> by(-kPi / 3, kPi / 3);
  for (const Points& polygon : {shapes::l_shape(), star(), animal()}) {
    const Mesh mesh = domain_mesh(polygon, {4000});
    const HilbertCoordinates coordinates = coordinates_of(polygon, all_of(polygon), 1e-4);
    AngleMap map = angle_map(mesh, coordinates);
    for (int run = 0; run < 10; ++run) {
      VectorXd theta(2 * static_cast<Index>(polygon.size()));
      for (size_t j = 0; j < polygon.size(); ++j) {
        const double turn = by(random),
                     jump = std::min(by(random),
                                     coordinates.angle(static_cast<Index>(j)) - 5 * kPi / 180);
        theta[static_cast<Index>(2 * j)] = turn - jump / 2;
        theta[static_cast<Index>(2 * j + 1)] = turn + jump / 2;
      }
      VectorXc f;
      map.map(theta, f);
      INFO(polygon.size() << " vertices, run " << run);
      CHECK(flipped_triangle_count(mesh, f) == 0);
    }
  }
}

TEST_CASE(
    "Harmonic coordinates: they match finite differences, are positive, and follow the cage") {
  // On an L of three unit squares, solved by successive over-relaxation on a grid of spacing 1 /
  // 160.
  const Points polygon{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  constexpr int n = 160;
  Rest rest;
  rest.cage = polygon_cage(polygon);
  rest.precision = Precision::full;
  const Mesh mesh = domain_mesh(rest.cage, {2000});
  rest.samples = mesh.vertices;
  rest.mesh = std::make_shared<const Mesh>(mesh);
  const auto deformer = method_named("harmonic").prepare(rest, nullptr);
  for (const size_t moved : {size_t{1}, size_t{3}}) {
    Pose pose{rest.cage, {}};
    pose.cage.segments[moved][0] += 1.0;
    SampledMap map = deformer->deform(pose, {});
    const auto weight = [&](Complex z) {  // linear along the edges next to the vertex
      double w = 0;
      for (const size_t other : {(moved + 1) % 6, (moved + 5) % 6}) {
        const auto on = nearest_on_segment(polygon[moved], polygon[other], z);
        if (on.distance < 1e-9) w = std::max(w, 1 - on.t);
      }
      return w;
    };
    MatrixXd h = MatrixXd::Zero(2 * n + 1, 2 * n + 1);
    const auto inside = [](int i, int j) {
      return i > 0 && j > 0 && i < 2 * n && j < 2 * n && (i < n || j < n);
    };
    for (int i = 0; i <= 2 * n; ++i)
      for (int j = 0; j <= 2 * n; ++j)
        if (!inside(i, j)) h(i, j) = weight(Complex(i, j) / static_cast<double>(n));
    for (int sweep = 0; sweep < 1100; ++sweep)
      for (int i = 1; i < 2 * n; ++i)
        for (int j = 1; j < 2 * n; ++j)
          if (inside(i, j))
            h(i, j) +=
                1.98 * (0.25 * (h(i - 1, j) + h(i + 1, j) + h(i, j - 1) + h(i, j + 1)) - h(i, j));
    double off = 0, least = 1;
    for (size_t v = 0; v < mesh.vertices.size(); ++v) {
      const Complex z = mesh.vertices[v], by = map.f[static_cast<Index>(v)] - z;
      least = std::min(least, by.real());
      const double x = z.real() * n, y = z.imag() * n;
      const int i = std::min(static_cast<int>(x), 2 * n - 1),
                j = std::min(static_cast<int>(y), 2 * n - 1);
      const double s = x - i, t = y - j;
      const double grid = (1 - s) * ((1 - t) * h(i, j) + t * h(i, j + 1)) +
                          s * ((1 - t) * h(i + 1, j) + t * h(i + 1, j + 1));
      if (std::abs(z - Complex(1, 1)) > 0.1) off = std::max(off, std::abs(by.real() - grid));
    }
    CHECK(off <= 1e-3);
    CHECK(least >= -1e-4);
  }
  // The boundary is mapped onto the posed edges.
  Pose bent{rest.cage, {}};
  for (size_t j = 0; j < polygon.size(); ++j)
    bent.cage.segments[j][0] += Complex(0.2 * std::sin(3.0 * j), 0.3 * std::cos(5.0 * j));
  SampledMap map = deformer->deform(bent, {});
  for (const int v : mesh.boundary) {
    double nearest = 1;
    for (Index e = 0; e < 6; ++e)
      nearest = std::min(
          nearest,
          nearest_on_segment(bent.cage.vertex(e), bent.cage.end_vertex(e), map.f[v]).distance);
    REQUIRE(nearest <= 1e-3);
  }
}

}  // namespace holomorph::angle_test
