// Cauchy coordinates on curved segments: the theorems that hold for straight cages, and the
// defining integral.
#include <random>

#include "core/cauchy/cauchy.h"
#include "core/cauchy/cauchy_map.h"
#include "support/catch.h"
#include "support/shapes.h"

namespace holomorph::curved_rest_test {
using shapes::curved_star;

namespace {

/// k! / (2 pi i) times the integral of B_m c' / (c - z)^(k+1) over a segment, by brute force: the
/// trapezoidal rule with the substitution t = x^3 (10 - 15 x + 6 x^2), which flattens both ends.
VectorXc by_definition(const Points& controls, int degree, Complex z, int order) {
  constexpr int kSteps = 3000;
  VectorXc sum = VectorXc::Zero(degree + 1);
  for (int i = 1; i < kSteps; ++i) {
    const double x = static_cast<double>(i) / kSteps;
    const double t = x * x * x * (10 + x * (-15 + 6 * x)), dt = 30 * x * x * (1 - x) * (1 - x);
    const int n = static_cast<int>(controls.size()) - 1;
    Complex slope = 0;
    double binomial = 1;
    for (int k = 0; k < n; ++k) {
      slope += static_cast<double>(n) * binomial * std::pow(t, k) * std::pow(1 - t, n - 1 - k) *
               (controls[k + 1] - controls[k]);
      binomial *= static_cast<double>(n - 1 - k) / (k + 1);
    }
    const Complex value =
        slope / std::pow(bezier_point(controls, t) - z, order + 1) * (dt / kSteps);
    double basis = 1;
    for (int m = 0; m <= degree; ++m) {
      sum[m] += basis * std::pow(t, m) * std::pow(1 - t, degree - m) * value;
      basis *= static_cast<double>(degree - m) / (m + 1);
    }
  }
  double factorial = 1;
  for (int k = 2; k <= order; ++k) factorial *= k;
  return factorial / (2 * kPi * kI) * sum;
}

Points inner_points(const Cage& cage, int count, unsigned seed) {
  const Polygon outline = outline_of(cage, 64);
  const Box box = box_of(outline);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(box.left, box.right), y(box.bottom, box.top);
  Points points;
  while (static_cast<int>(points.size()) < count) {
    const Complex z(x(random), y(random));
    if (winding_number(outline, z) != 0 && nearest_on_polygon(outline, z).distance > 1)
      points.push_back(z);
  }
  return points;
}

}  // namespace

TEST_CASE("Curved rest: rows reproduce constants and z inside, and vanish outside") {
  for (int degree = 2; degree <= 8; ++degree) {
    const Cage cage = curved_star(7, degree, 0.25, 100 + degree);
    const VectorXc b = controls_of(cage);
    const Points inside = inner_points(cage, 60, 5);
    const MatrixXc C = cauchy_coordinates(cage, inside), D = cauchy_coordinates(cage, inside, 1),
                   E = cauchy_coordinates(cage, inside, 2);
    for (size_t i = 0; i < inside.size(); ++i) {
      CHECK(std::abs(C.row(i).sum() - 1.0) <= 1e-12);
      CHECK(std::abs((C.row(i) * b)(0) - inside[i]) <= 1e-10);  // coordinates are up to 300
      CHECK(std::abs((D.row(i) * b)(0) - 1.0) <= 1e-10);
      CHECK(std::abs((E.row(i) * b)(0)) <= 1e-9);
    }
    Points outside;
    for (int i = 0; i < 20; ++i) outside.push_back(Complex(200, 200) + std::polar(260.0, 0.3 * i));
    const MatrixXc F = cauchy_coordinates(cage, outside);
    CHECK((F * b).cwiseAbs().maxCoeff() <= 1e-10);
    CHECK(F.rowwise().sum().cwiseAbs().maxCoeff() <= 1e-12);
  }
}

TEST_CASE("Curved rest: coordinates of all orders equal their defining integrals") {
  for (const int degree : {2, 3, 5}) {
    const Cage cage = curved_star(5, degree, 0.3, degree);
    const Points points = inner_points(cage, 6, 11);
    for (int order = 0; order <= 3; ++order) {
      const MatrixXc C = cauchy_coordinates(cage, points, order);
      for (size_t i = 0; i < points.size(); ++i) {
        VectorXc expected = VectorXc::Zero(cage.control_count());
        for (Index e = 0; e < cage.size(); ++e) {
          const VectorXc part = by_definition(cage.controls(e), degree, points[i], order);
          for (int m = 0; m <= degree; ++m)
            expected[(cage.control_offset(e) + m) % cage.control_count()] += part[m];
        }
        const double scale = expected.cwiseAbs().maxCoeff();
        INFO("degree " << degree << " order " << order << " at " << points[i]);
        CHECK((C.row(i).transpose() - expected).cwiseAbs().maxCoeff() <= 1e-10 * scale);
      }
    }
  }
}

TEST_CASE("Curved rest: subdividing segments does not change the map") {
  const Cage rest = curved_star(6, 3, 0.3, 4), pose = curved_star(6, 3, 0.2, 9);
  Cage cut_rest = rest, cut_pose = pose;
  insert_vertex(cut_rest, 2, 0.37);
  insert_vertex(cut_pose, 2, 0.37);
  insert_vertex(cut_rest, 0, 0.81);
  insert_vertex(cut_pose, 0, 0.81);
  const Points points = inner_points(rest, 80, 3);
  for (int order = 0; order <= 2; ++order) {
    const MatrixXc C = cauchy_coordinates(rest, points, order);
    const VectorXc whole = C * controls_of(pose),
                   cut = cauchy_coordinates(cut_rest, points, order) * controls_of(cut_pose);
    const double scale = (C.cwiseAbs() * controls_of(pose).cwiseAbs()).maxCoeff();
    CHECK((whole - cut).cwiseAbs().maxCoeff() <= 1e-12 * scale);
  }
}

TEST_CASE("Curved rest: raising the degree of rest and pose does not change the map") {
  const Cage rest = curved_star(6, 2, 0.3, 4), pose = curved_star(6, 2, 0.2, 9);
  Cage six = rest;
  for (Points& segment : six.segments) segment.resize(6);
  const Points points = inner_points(rest, 80, 3);
  const VectorXc low = cauchy_coordinates(rest, points) * controls_of(pose),
                 high = cauchy_coordinates(elevated_to(rest, six), points) *
                        controls_of(elevated_to(pose, six));
  CHECK((low - high).cwiseAbs().maxCoeff() <= 1e-13 * 300);
}

TEST_CASE("Curved rest: a straight segment with an uneven parametrization gives the same map") {
  // The line from 0 to 200, parametrized with uneven speed, at rest and posed.
  Cage uneven = polygon_cage(shapes::l_shape()), even = uneven;
  uneven.segments[0] = {{0, 0}, {30, 0}, {150, 0}};
  const Points points{{40, 40}, {10, 190}, {199, 1}, {120, 3}};
  const VectorXc a = cauchy_coordinates(uneven, points) * controls_of(uneven),
                 b = cauchy_coordinates(even, points) * controls_of(even);
  CHECK((a - b).cwiseAbs().maxCoeff() <= 1e-11);
}

TEST_CASE("Curved rest: boundary and vertex values are the limits from inside") {
  for (const bool clockwise : {false, true}) {
    Cage cage = curved_star(6, 3, 0.3, 8), pose = curved_star(6, 3, 0.2, 2);
    if (clockwise) cage = reversed(cage), pose = reversed(pose);
    const VectorXc b = controls_of(pose);
    for (Index e = 0; e < cage.size(); ++e)
      for (const double t : {0.0, 0.2, 0.5, 0.93}) {
        const BoundaryPoint at{e, t};
        const Complex z = position_of(cage, at);
        const Complex limit = (cauchy_coordinates(cage, std::span(&at, 1)) * b)(0);
        const Complex same = (cauchy_coordinates(cage, std::span(&z, 1)) * b)(0);
        CHECK(std::abs(limit - same) <= 1e-9);  // z is recognized as a boundary point
        // From inside the value differs by O(h log h).
        const Complex inward = (Complex(200, 200) - z) / std::abs(Complex(200, 200) - z);
        for (const double h : {1e-3, 1e-6, 1e-9}) {
          const Complex near = z + h * inward;
          const Complex value = (cauchy_coordinates(cage, std::span(&near, 1)) * b)(0);
          CHECK(std::abs(value - limit) <= 60 * h * std::abs(std::log(h)) + 1e-10);
        }
      }
  }
}

TEST_CASE("Curved rest: all orders stay accurate where two roots meet") {
  // The critical value of a parabola: c'(t) = 0 at a complex t outside the segment.
  Cage cage = polygon_cage(Points{{0, 0}, {100, 0}, {100, 100}, {0, 100}});
  cage.segments[0] = {{0, 0}, {50, -60}};
  const SegmentPolynomial segment(cage.controls(0));
  // c = 100 t - 120 i t (1 - t) has c' = 0 at t = 1/2 + 5/12 i, ...
  const Complex t = 0.5 + kI * (100.0 / 240.0);
  const Complex critical = 100.0 * t - 120.0 * kI * t * (1.0 - t);
  for (const double off : {0.0, 1e-9, 1e-6, 1e-3, 0.5}) {
    const Complex z = critical + off * std::polar(1.0, 0.7);
    for (int order = 0; order <= 2; ++order) {
      const Complex value =
          (cauchy_coordinates(cage, std::span(&z, 1), order) * controls_of(cage))(0);
      const Complex expected = order == 0 ? z : order == 1 ? Complex(1) : Complex(0);
      INFO("off " << off << " order " << order);
      CHECK(std::abs(value - expected) <= 1e-11);
    }
  }
}

TEST_CASE("Curved rest: scaling by 2^k is exact") {
  const Cage cage = curved_star(5, 3, 0.3, 6);
  Cage large = cage;
  for (Points& segment : large.segments)
    for (Complex& z : segment) z *= 1024.0;
  Points points = inner_points(cage, 20, 2), scaled = points;
  for (Complex& z : scaled) z *= 1024.0;
  for (int order = 0; order <= 2; ++order)
    CHECK(cauchy_coordinates(cage, points, order) ==
          cauchy_coordinates(large, scaled, order) * std::pow(1024.0, order));
}

TEST_CASE("Roots of a segment: there are as many as its degree, each on the curve's continuation") {
  for (int degree = 1; degree <= 8; ++degree) {
    const Cage cage = curved_star(3, degree, 0.4, 40 + degree);
    const SegmentPolynomial segment(cage.controls(1));
    REQUIRE(segment.degree() == degree);
    std::vector<Root> roots(degree);
    for (const Complex z : {Complex(200, 200), Complex(250, 170), cage.vertex(1) + 1e-7}) {
      segment.roots(z, roots);
      for (const Root& root : roots) {
        std::array<Complex, 2> curve;
        segment.taylor(root, curve);
        CHECK(std::abs(curve[0] - z) <= 1e-9 * std::abs(curve[1]) * (1 + std::abs(root.s)));
        CHECK(std::abs(root.s + root.q - 1.0) <= 1e-15 * (1 + std::abs(root.s)));
        CHECK(std::abs(curve[1] - segment.derivative(root)) <= 1e-10 * (1 + std::abs(curve[1])));
      }
    }
  }
}

TEST_CASE("Curved rest: the map at single points equals the matrix product for degrees 1 to 8") {
  for (int degree = 1; degree <= kHighestDegree; ++degree) {
    const Cage rest = curved_star(6, degree, 0.2, 40 + degree),
               pose = curved_star(6, degree, 0.2, 60 + degree);
    const CauchySum sum(rest, controls_of(pose) - controls_of(rest));
    Points points = inner_points(rest, 60, 2);
    const Complex center(200, 200);
    for (Index e = 0; e < rest.size(); ++e)  // and points next to the boundary
      for (const double off : {1e-2, 1e-5, 1e-9}) {
        const Complex z = position_of(rest, {e, 0.4});
        points.push_back(z + off * (center - z));
      }
    const VectorXc f = cauchy_coordinates(rest, points) * controls_of(pose),
                   df = cauchy_coordinates(rest, points, 1) * controls_of(pose);
    double worst = 0, worst_slope = 0;
    for (size_t i = 0; i < points.size(); ++i) {
      const CauchySum::ValueAndSlope at = sum.at(points[i]);
      worst = std::max(worst, std::abs(points[i] + at.f - f[i]) / 300);
      worst_slope = std::max(worst_slope, std::abs(1.0 + at.df - df[i]) / (1 + std::abs(df[i])));
    }
    INFO("degree " << degree << ": " << worst << ", slopes " << worst_slope);
    CHECK(worst <= (degree < 8 ? 1e-13 : 5e-13));
    CHECK(worst_slope <= 1e-11);
  }
}

TEST_CASE("Curved rest: single points on the boundary use their own segment, however it is cut") {
  // Where a segment was cut, the extensions of its neighbors also pass through its points.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> by(-1, 1);
  for (const bool straight : {true, false}) {
    Cage fine;
    const Cage cage = straight ? polygon_cage(shapes::l_shape()) : curved_star(7, 3, 0.2, 2);
    constexpr int kParts = 6;
    for (Index e = 0; e < cage.size(); ++e) {
      Points rest = cage.controls(e);
      for (int k = kParts; k > 1; --k) {
        SplitCurve halves = split(rest, 1.0 / k);
        halves.before.pop_back();
        fine.segments.push_back(halves.before);
        rest = halves.after;
      }
      rest.pop_back();
      fine.segments.push_back(rest);
    }
    VectorXc displacement(fine.control_count());
    for (Complex& d : displacement) d = {by(random), by(random)};
    const CauchySum sum(fine, displacement);
    Points points;
    for (Index e = 0; e < fine.size(); ++e)
      for (int k = 1; k < 20; ++k) points.push_back(position_of(fine, {e, k / 20.0}));
    const VectorXc exact = cauchy_coordinates(fine, points) * displacement;
    for (size_t i = 0; i < points.size(); ++i)
      REQUIRE(std::abs(sum.at(points[i]).f - exact[static_cast<Index>(i)]) < 1e-6);
  }
}

}  // namespace holomorph::curved_rest_test
