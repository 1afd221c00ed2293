// Cauchy coordinates against exact values, the identities they satisfy, and the array path.
#include "core/cauchy/cauchy.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "core/cauchy/cauchy_array.h"
#include "core/cauchy/inside.h"
#include "core/error.h"
#include "core/geometry/nearby_order.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::cauchy_test {
using nlohmann::json;

namespace {

/// The largest relative error per edge that the golden data allow.
constexpr double kGolden = 1e-13;

const char* const kFiles[] = {"convex_hex", "star5", "sliver", "concave_L", "notch_ratio1e4"};

json golden(const std::string& name) {
  std::ifstream file(std::string(HOLOMORPH_SOURCE) + "/tests/data/" + name + ".json");
  REQUIRE(file);
  return json::parse(file);
}

Complex complex_at(const json& flat, size_t i) {
  return {flat[2 * i].get<double>(), flat[2 * i + 1].get<double>()};
}
bool exists(const json& flat, size_t i) {
  return !flat[2 * i].is_null();
}

Points polygon_of(const json& data) {
  Points polygon;
  const json& list = data["polygon"];
  if (list[0].is_array())
    for (const json& z : list) polygon.push_back({z[0].get<double>(), z[1].get<double>()});
  else
    for (size_t i = 0; i < list.size() / 2; ++i) polygon.push_back(complex_at(list, i));
  return polygon;
}

/// The polygon with each edge raised to the degree that the data give for it.
Cage cage_of(const json& data) {
  Cage shape = polygon_cage(polygon_of(data));
  Cage wanted = shape;
  for (Index e = 0; e < shape.size(); ++e) wanted.segments[e].resize(data["degrees"][e].get<int>());
  return elevated_to(shape, wanted);
}

VectorXc row_at(const Cage& cage, const json& query, int order) {
  if (query["kind"] == "edge_limit") {
    const BoundaryPoint point{query["edge"].get<Index>(), query["t"].get<double>()};
    return cauchy_coordinates(cage, std::span(&point, 1), order).row(0).transpose();
  }
  const Complex z{query["z"][0].get<double>(), query["z"][1].get<double>()};
  return cauchy_coordinates(cage, std::span(&z, 1), order).row(0).transpose();
}

Points star(int n, double ripple, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(1 - ripple, 1 + ripple);
  Points polygon;
  for (int i = 0; i < n; ++i)
    polygon.push_back(100.0 * radius(random) * std::exp(kI * (2 * kPi * i / n)));
  return polygon;
}

Points random_points(int count, double half_width, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-half_width, half_width);
  Points points;
  for (int i = 0; i < count; ++i) {
    const double x = coordinate(random);
    points.push_back({x, coordinate(random)});
  }
  return points;
}

}  // namespace

TEST_CASE("Cauchy coordinates of every degree and order equal the golden values") {
  for (const char* name : kFiles) {
    const json data = golden(name);
    const Cage cage = cage_of(data);
    for (const json& query : data["queries"]) {
      const Complex z{query["z"][0].get<double>(), query["z"][1].get<double>()};
      for (const auto& [key, edges] : query["bezier"].items()) {
        const int order = std::stoi(key);
        double worst = 0;
        for (Index e = 0; e < cage.size(); ++e) {
          const int count = cage.degree(e) + 1;
          double scale = 0, error = 0;
          const bool incident = z == cage.vertex(e) || z == cage.end_vertex(e);
          if (incident) continue;  // compared below through the shared columns
          const bool on_edge = query["kind"] == "edge_limit" && query["edge"] == e;
          const VectorXc values = edge_coordinates(cage.vertex(e), cage.end_vertex(e),
                                                   cage.degree(e), z, order, on_edge);
          for (int m = 0; m < count; ++m) {
            const Complex exact = complex_at(edges[e], m);
            scale = std::max(scale, std::abs(exact));
            error = std::max(error, std::abs(values[m] - exact));
          }
          worst = std::max(worst, error / scale);
        }
        INFO(name << " " << query["kind"] << " z=" << z << " order " << order << " error "
                  << worst);
        CHECK(worst <= kGolden);
      }
    }
  }
}

TEST_CASE("Cauchy coordinates at vertices are the limits from inside, for mixed degrees") {
  for (const char* name : kFiles) {
    const json data = golden(name);
    const Cage cage = cage_of(data);
    for (const json& query : data["queries"]) {
      if (query["kind"] != "vertex_limit") continue;
      const VectorXc row = row_at(cage, query, 0);
      for (Index v = 0; v < cage.size(); ++v) {
        const Complex exact = complex_at(query["bezier_shared"], v);
        INFO(name << " vertex " << query["vertex"] << " column " << v);
        CHECK(std::abs(row[cage.control_offset(v)] - exact) <=
              kGolden * std::max(1e-3, std::abs(exact)));
      }
      for (Index e = 0; e < cage.size(); ++e)
        for (int m = 1; m < cage.degree(e); ++m)
          if (exists(query["bezier"]["0"][e], m)) {
            const Complex exact = complex_at(query["bezier"]["0"][e], m);
            CHECK(std::abs(row[cage.control_offset(e) + m] - exact) <=
                  kGolden * std::max(1e-3, std::abs(exact)));
          }
      CHECK_FALSE(row_at(cage, query, 1).allFinite());
    }
  }
}

TEST_CASE("Derivatives at vertices: limits where they exist, and NaN next to the vertex") {
  for (const unsigned seed : seeds_of("derivatives at vertices", {1, 2, 3, 4})) {
    std::mt19937 random(seed);
    const Cage cage = seed % 4 == 0
                          ? polygon_cage(shapes::star(6, 0.4, seed))
                          : shapes::curved_star(4 + static_cast<int>(seed % 3),
                                                2 + static_cast<int>(seed % 4), 0.2, seed);
    for (int order = 1; order <= 3; ++order)
      for (Index v = 0; v < cage.size(); ++v) {
        CAPTURE(seed, order, v);
        const Complex vertex = cage.vertex(v);
        const VectorXc row = cauchy_coordinates(cage, Points{vertex}, order).row(0);
        // At this distance inside, the others have come close to their limits.
        const double reach = 1e-7 * std::abs(cage.end_vertex(v) - vertex);
        const Complex in = vertex - cage.vertex(cage.before(v)), out = cage.end_vertex(v) - vertex;
        Complex inside = vertex + reach * kI * (in / std::abs(in) + out / std::abs(out));
        if (!contains(cage, inside)) inside = 2.0 * vertex - inside;
        Points close{inside};
        for (const double ulps : {1, -1, 4, -4, 16, -16})
          close.push_back(vertex * (1 + ulps * std::numeric_limits<double>::epsilon()));
        const MatrixXc near = cauchy_coordinates(cage, close, order);
        int limits = 0;
        for (Index c = 0; c < row.size(); ++c) {
          if (!is_finite(row[c])) continue;
          ++limits;
          for (size_t i = 0; i < close.size(); ++i)
            if (i == 0 || contains(cage, close[i]))
              CHECK(std::abs(row[c] - near(static_cast<Index>(i), c)) <=
                    1e-3 * (1 + std::abs(row[c])));
        }
        const Index before = cage.degree(cage.before(v)), after = cage.degree(v),
                    beyond = std::min<Index>(order, before) + std::min<Index>(order, after);
        CHECK(limits == row.size() - 1 - beyond);
      }
  }
}

TEST_CASE("The map of target control points and its derivatives equal the golden map") {
  for (const char* name : kFiles) {
    const json data = golden(name);
    const Cage cage = cage_of(data);
    VectorXc target(cage.control_count());
    for (Index e = 0; e < cage.size(); ++e)
      for (int m = 0; m < cage.degree(e); ++m)
        target[cage.control_offset(e) + m] = complex_at(data["target"][e], m);
    for (const json& query : data["queries"])
      for (size_t order = 0; order < query["map"].size(); ++order) {
        const VectorXc row = row_at(cage, query, static_cast<int>(order));
        // The error measure of the data sums |C b| per edge, before shared columns are added up.
        double scale = 0;
        for (Index e = 0; e < cage.size(); ++e) {
          const json& exact = query["bezier"][std::to_string(order)][e];
          for (int m = 0; m <= cage.degree(e); ++m)
            if (exists(exact, m))
              scale += std::abs(complex_at(exact, m) * complex_at(data["target"][e], m));
        }
        const Complex image = (row.transpose() * target)(0);
        const Complex exact{query["map"][order][0].get<double>(),
                            query["map"][order][1].get<double>()};
        INFO(name << " " << query["kind"] << " order " << order);
        CHECK(std::abs(image - exact) <= kGolden * std::max(scale, std::abs(exact)));
      }
  }
}

TEST_CASE("Degree 1 gives the regular coordinates C, D and D2, by both paths") {
  for (const char* name : kFiles) {
    const json data = golden(name);
    const Points polygon = polygon_of(data);
    const Cage cage = polygon_cage(polygon);
    const Index n = cage.size();
    for (const json& query : data["queries"])
      for (const auto& [key, values] : query["regular"].items()) {
        const int order = std::stoi(key);
        const Complex z{query["z"][0].get<double>(), query["z"][1].get<double>()};
        const VectorXc row = row_at(cage, query, order);
        const bool vertex = query["kind"] == "vertex_limit";
        for (Index j = 0; j < n; ++j) {
          const Complex exact = complex_at(values, j);
          double scale = std::abs(exact);
          if (!vertex && order < 2) {
            const bool limit = query["kind"] == "edge_limit";
            const Index before = (j + n - 1) % n;
            scale = std::abs(edge_coordinates(polygon[before], polygon[j], 1, z, order,
                                              limit && query["edge"] == before)[1]) +
                    std::abs(edge_coordinates(polygon[j], polygon[(j + 1) % n], 1, z, order,
                                              limit && query["edge"] == j)[0]);
          }
          INFO(name << " " << query["kind"] << " order " << order << " z=" << z << " j=" << j);
          CHECK(std::abs(row[j] - exact) <= kGolden * std::max(scale, vertex ? 1e-3 : 0.0));
          if (order < 2 && query["kind"] != "edge_limit") {
            for (const Kernel choice : {Kernel::portable, Kernel::automatic}) {
              const auto array = planar_coordinates<double>(polygon_cage(polygon), std::span(&z, 1),
                                                            order, choice);
              CHECK(std::abs(array(0, j) - exact) <=
                    kGolden * std::max(scale, vertex ? 1e-3 : 0.0));
            }
          }
        }
      }
  }
}

TEST_CASE("Generalized coordinates of Weber and Gotsman are moments of degree 2") {
  for (const char* name : kFiles) {
    const json data = golden(name);
    const Points polygon = polygon_of(data);
    const size_t n = polygon.size();
    for (const json& query : data["queries"]) {
      if (query["kind"] == "vertex_limit") continue;
      const Complex z{query["z"][0].get<double>(), query["z"][1].get<double>()};
      for (int order = 0; order < 2; ++order)
        for (size_t e = 0; e < n; ++e) {
          const bool on_edge = query["kind"] == "edge_limit" && query["edge"] == e;
          const VectorXc M =
              edge_coordinates(polygon[e], polygon[(e + 1) % n], 2, z, order, on_edge);
          const json& exact = query["generalized"][std::to_string(order)];
          const double scale = M.cwiseAbs().maxCoeff();
          CHECK(std::abs(2.0 * M[1] - complex_at(exact["CE"], e)) <= 2 * kGolden * scale);
          CHECK(std::abs(M[0] - M[1] / 2.0 - complex_at(exact["CVp"], e)) <= 2 * kGolden * scale);
          CHECK(std::abs(M[2] - M[1] / 2.0 - complex_at(exact["CVm"], (e + 1) % n)) <=
                2 * kGolden * scale);
        }
    }
  }
}

TEST_CASE("Cauchy coordinates: rows reproduce constants and z inside, and vanish outside") {
  const Points polygon = star(12, 0.4, 7);
  Cage cage = polygon_cage(polygon);
  Cage degrees = cage;
  for (Index e = 0; e < cage.size(); ++e) degrees.segments[e].resize(1 + e % 5);
  cage = elevated_to(cage, degrees);
  const Points points = random_points(200, 150, 3);
  const MatrixXc C = cauchy_coordinates(cage, points), D = cauchy_coordinates(cage, points, 1);
  const VectorXc b = controls_of(cage);
  for (size_t i = 0; i < points.size(); ++i) {
    const double inside = winding_number(polygon, points[i]) ? 1 : 0;
    const double tolerance = 1e-12;  // 12 edges and 35 terms of 1e-14
    CHECK(std::abs(C.row(i).sum() - inside) <= tolerance);
    CHECK(std::abs((C.row(i) * b)(0) - inside * points[i]) <= 100 * tolerance);
    CHECK(std::abs(D.row(i).sum()) <= tolerance);
    CHECK(std::abs((D.row(i) * b)(0) - inside) <= 100 * tolerance);
  }
}

TEST_CASE("Cauchy coordinates: each order is the derivative of the previous one") {
  const Cage cage = elevated_to(polygon_cage(star(7, 0.2, 1)), [] {
    Cage c = polygon_cage(star(7, 0.2, 1));
    c.segments[2].resize(4);
    return c;
  }());
  const Complex z{12.0, -7.0};
  const double h = 1e-3;
  for (int order = 0; order < 3; ++order) {
    const Points around{z - h, z + h, z - kI * h, z + kI * h};
    const MatrixXc rows = cauchy_coordinates(cage, around, order);
    const MatrixXc exact = cauchy_coordinates(cage, std::span(&z, 1), order + 1);
    CHECK((0.5 / h * (rows.row(1) - rows.row(0)) - exact).cwiseAbs().maxCoeff() <= 1e-8);
    CHECK((0.5 / (h * kI) * (rows.row(3) - rows.row(2)) - exact).cwiseAbs().maxCoeff() <= 1e-8);
  }
}

TEST_CASE("Cauchy coordinates: scaling by a power of two scales the rows exactly") {
  const Points polygon = star(9, 0.3, 5);
  const Points points = random_points(64, 120, 11);
  const double scale = 1024;
  Points scaled_polygon = polygon, scaled_points = points;
  for (Complex& z : scaled_polygon) z *= scale;
  for (Complex& z : scaled_points) z *= scale;
  for (int order = 0; order < 4; ++order) {
    const MatrixXc before = cauchy_coordinates(polygon_cage(polygon), points, order);
    const MatrixXc after = cauchy_coordinates(polygon_cage(scaled_polygon), scaled_points, order);
    CHECK(after * std::pow(scale, order) == before);
  }
  for (int order = 0; order < 2; ++order) {
    const auto before = planar_coordinates<double>(polygon_cage(polygon), points, order);
    const auto after =
        planar_coordinates<double>(polygon_cage(scaled_polygon), scaled_points, order);
    CHECK(after.re * std::pow(scale, order) == before.re);
    CHECK(after.im * std::pow(scale, order) == before.im);
  }
}

TEST_CASE("A clockwise cage gives the coordinates of the reversed one, column by column") {
  const Points polygon = star(8, 0.3, 2);
  Cage cage = polygon_cage(polygon);
  Cage degrees = cage;
  degrees.segments[3].resize(3);
  cage = elevated_to(cage, degrees);
  const Cage clockwise = reversed(cage);
  const Points points = random_points(50, 60, 4);
  const VectorXc b = controls_of(cage), turned = controls_of(clockwise);
  const MatrixXc C = cauchy_coordinates(cage, points), R = cauchy_coordinates(clockwise, points);
  for (Index c = 0; c < b.size(); ++c)
    for (Index r = 0; r < b.size(); ++r)
      if (b[c] == turned[r]) CHECK((C.col(c) - R.col(r)).cwiseAbs().maxCoeff() <= 1e-15);
  Points back = vertices_of(clockwise);
  const auto array = planar_coordinates<double>(polygon_cage(back), points);
  const MatrixXc reference = cauchy_coordinates(polygon_cage(back), points);
  CHECK((array.re - reference.real()).cwiseAbs().maxCoeff() <= 1e-14);
  CHECK((array.im - reference.imag()).cwiseAbs().maxCoeff() <= 1e-14);
}

TEST_CASE("The array path equals the stable formula, and AVX2 equals portable, to 1e-14") {
  for (const int n : {3, 10, 100}) {
    const Points polygon = star(n, 0.3, 17);
    Points points = random_points(1000, 110, 23);
    points.push_back(polygon[1]);                       // a vertex
    points.push_back(0.5 * (polygon[0] + polygon[1]));  // a point on an edge, up to rounding
    for (int order = 0; order < 2; ++order) {
      const MatrixXc exact = cauchy_coordinates(polygon_cage(polygon), points, order);
      const auto portable =
          planar_coordinates<double>(polygon_cage(polygon), points, order, Kernel::portable);
      for (const Kernel choice :
           {has_avx2() ? Kernel::avx2 : Kernel::portable, Kernel::automatic}) {
        const auto fast = planar_coordinates<double>(polygon_cage(polygon), points, order, choice);
        for (Index i = 0; i < exact.rows(); ++i) {
          if (!exact.row(i).allFinite()) {  // a vertex: the limit for linear functions
            const MatrixXc row = as_complex(fast).row(i);
            CHECK(std::abs(row.sum()) <= 1e-13);
            CHECK(std::abs((row * controls_of(polygon_cage(polygon)))(0) - 1.0) <= 1e-12);
            continue;
          }
          // Coordinates are sums of edge halves, which may cancel.
          double scale = exact.row(i).cwiseAbs().maxCoeff();
          for (int e = 0; e < n; ++e)
            if (points[i] != polygon[e] && points[i] != polygon[(e + 1) % n])
              scale = std::max(
                  scale, edge_coordinates(polygon[e], polygon[(e + 1) % n], 1, points[i], order)
                             .cwiseAbs()
                             .maxCoeff());
          const double tolerance = 1e-14 * scale;
          CHECK((portable.re.row(i) - exact.row(i).real()).cwiseAbs().maxCoeff() <= tolerance);
          CHECK((portable.im.row(i) - exact.row(i).imag()).cwiseAbs().maxCoeff() <= tolerance);
          CHECK((portable.re.row(i) - fast.re.row(i)).cwiseAbs().maxCoeff() <= tolerance);
          CHECK((portable.im.row(i) - fast.im.row(i)).cwiseAbs().maxCoeff() <= tolerance);
        }
      }
    }
  }
}

TEST_CASE("Planar products equal Eigen's, for both kernels") {
  const Index rows = 1037, inner = 23, columns = 5;
  PlanarMatrix<double> a(rows, inner), b(inner, columns), c(rows, columns);
  a.re.setRandom(), a.im.setRandom(), b.re.setRandom(), b.im.setRandom();
  MatrixXc A(rows, inner), B(inner, columns);
  A.real() = a.re, A.imag() = a.im, B.real() = b.re, B.imag() = b.im;
  const MatrixXc exact = A * B;
  for (const Kernel choice : {Kernel::portable, Kernel::automatic}) {
    multiply(a, b, c, choice);
    CHECK((c.re - exact.real()).cwiseAbs().maxCoeff() <= 1e-13);
    CHECK((c.im - exact.imag()).cwiseAbs().maxCoeff() <= 1e-13);
  }
}

TEST_CASE("Points rounded onto an edge take the limit from inside") {
  const Points polygon = star(5, 0.3, 9);
  for (Index e = 0; e < 5; ++e)
    for (const double t : {0.1, 0.37, 0.5, 0.93}) {
      const Cage cage = polygon_cage(polygon);
      const BoundaryPoint exact{e, t};
      const Complex rounded = position_of(cage, exact);
      const MatrixXc a = cauchy_coordinates(cage, std::span(&exact, 1));
      const MatrixXc b = cauchy_coordinates(cage, std::span(&rounded, 1));
      CHECK((a - b).cwiseAbs().maxCoeff() <= 1e-13);
      CHECK(std::abs(b.sum() - 1.0) <= 1e-13);
    }
}

TEST_CASE("Cauchy coordinates reject negative orders") {
  const Cage cage = polygon_cage(star(4, 0.1, 1));
  const Complex z{0, 0};
  CHECK_THROWS_AS(cauchy_coordinates(cage, std::span(&z, 1), -1), Error);
}

TEST_CASE("Coordinates of scattered points: sorting them changes nothing but the speed") {
  for (const unsigned seed : seeds_of("scattered points", {1, 2})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const Points polygon = shapes::star(7 + static_cast<int>(random() % 20), 0.4, random());
    Points points;
    for (int i = 0; i < 3000; ++i)
      points.push_back(Complex(200, 200) + 190.0 * random_complex(random));
    REQUIRE(are_scattered(points));
    const std::vector<Index> order = nearby_order(points);
    std::vector<Index> sorted = order;
    std::ranges::sort(sorted);
    for (Index i = 0; i < 3000; ++i) CHECK(sorted[static_cast<size_t>(i)] == i);
    Points in_order;
    for (const Index i : order) in_order.push_back(points[static_cast<size_t>(i)]);
    CHECK_FALSE(are_scattered(in_order));
    const Cage cage = polygon_cage(polygon);
    const MatrixXc all = as_complex(planar_coordinates<double>(cage, points)),
                   ordered = as_complex(planar_coordinates<double>(cage, in_order));
    double most = 0;
    for (Index i = 0; i < 3000; ++i)
      most = std::max(
          most, (all.row(order[static_cast<size_t>(i)]) - ordered.row(i)).cwiseAbs().maxCoeff());
    CHECK(most == 0);
    for (size_t i = 0; i < 3000; i += 100)
      CHECK((all.row(static_cast<Index>(i)) - cauchy_coordinates(cage, std::span(&points[i], 1)))
                .norm() < 1e-13);
  }
}

TEST_CASE("Inside: points on the chords of curved segments") {
  // A square whose sides bulge out or in, turned by right and by other angles. Points on a chord
  // are inside if the side bulges out. The rows of the coordinates sum to 1 inside and to 0
  // outside.
  for (const unsigned seed : seeds_of("points on chords", {1, 2})) {
    std::mt19937 random(seed);
    for (int trial = 0; trial < 40; ++trial) {
      const double turn =
          trial % 3 == 0 ? 0.25 * kPi * (trial % 8) : 3 * random_complex(random).real();
      const Complex factor =
          trial % 3 == 1 ? Complex(std::round(8 * std::cos(turn)), std::round(8 * std::sin(turn)))
                         : 9.0 * std::polar(1.0, turn);
      if (factor == 0.0) continue;
      const int degree = 2 + trial % 2;
      Cage cage;
      std::vector<bool> out;
      const Complex corners[] = {0, 4, Complex(4, 4), Complex(0, 4)};
      for (size_t e = 0; e < 4; ++e) {
        out.push_back(random() % 2 == 0);
        const Complex a = corners[e], b = corners[(e + 1) % 4],
                      bulge = Complex(0, out[e] ? -0.25 : 0.25) * (b - a);
        Points segment{factor * a};
        for (int k = 1; k < degree; ++k)
          segment.push_back(factor * (a + static_cast<double>(k) / degree * (b - a) + bulge));
        cage.segments.push_back(segment);
      }
      const Inside inside(cage);
      for (Index e = 0; e < 4; ++e)
        for (const double t : {0.25, 0.375, 0.5, 0.75}) {
          const Complex z = cage.vertex(e) + t * (cage.vertex((e + 1) % 4) - cage.vertex(e));
          CAPTURE(seed, trial, degree, turn, e, t);
          REQUIRE(inside.contains(z) == out[static_cast<size_t>(e)]);
          const double sum = cauchy_coordinates(cage, Points{z}, 0).sum().real();
          REQUIRE(sum == Approx(out[static_cast<size_t>(e)] ? 1 : 0).margin(1e-9));
        }
    }
  }
}

TEST_CASE("Inside: curves and holes, compared with fine polygons; the boundary is inside") {
  for (const unsigned seed : seeds_of("inside of cages", {1, 2})) {
    std::mt19937 random(seed);
    for (const int degree : {1, 2, 3, 4}) {
      Cage cage = shapes::curved_star(7, degree, 0.3, seed + static_cast<unsigned>(degree));
      cage.starts.push_back(cage.size());
      const Cage hole = shapes::curved_star(5, degree, 0.3, seed + 90);
      for (const Points& segment : hole.segments) {
        Points smaller;
        for (const Complex& z : segment)
          smaller.push_back(Complex(200, 200) + 0.2 * (z - Complex(200, 200)));
        cage.segments.push_back(smaller);
      }
      const Inside inside(cage);
      const Polygon fine = outline_of(cage, 4000);
      for (int i = 0; i < few_or_many(150, 3000); ++i) {
        Complex z = Complex(200, 200) + 130.0 * random_complex(random);
        if (i % 3 == 0) {  // next to the boundary
          const Index e = static_cast<Index>(random() % static_cast<unsigned>(cage.size()));
          const double t = 0.5 + 0.5 * random_complex(random).real();
          z = position_of(cage, {e, t}) + 0.01 * random_complex(random);
        }
        if (nearest_on_polygon(fine, z).distance < 1e-4) continue;
        CAPTURE(seed, degree, z);
        REQUIRE(inside.contains(z) == encloses(fine, z));
        REQUIRE(contains(cage, z) == inside.contains(z));
      }
      for (Index e = 0; e < cage.size(); ++e)
        for (const double t : {0.0, 1e-9, 0.1, 0.5, 0.99})
          REQUIRE(inside.contains(position_of(cage, {e, t})));
    }
  }
}

}  // namespace holomorph::cauchy_test
