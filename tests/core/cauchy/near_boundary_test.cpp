// Compares maps with 50-digit values on the boundary, and within rounding error of it and of its
// vertices.
#include <algorithm>
#include <limits>

#include "core/cauchy/cauchy.h"
#include "core/cauchy/cauchy_array.h"
#include "core/cauchy/cauchy_map.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/exact_cauchy.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::near_boundary_test {

namespace {

struct Case {
  Points polygon, displaced;
  double size = 1;
};

Case random_case(std::mt19937& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Case made;
  made.size = std::pow(10.0, uniform(-3, 6));
  const Complex offset = uniform(0, 1) < 0.3
                             ? Complex(0)
                             : std::pow(10.0, uniform(0, 6)) * std::polar(1.0, uniform(0, 7));
  const int corners = 3 + static_cast<int>(uniform(0, 6));
  const auto anywhere = [&] { return made.size * Complex(uniform(-0.4, 0.4), uniform(-0.4, 0.4)); };
  Points vertices, moves;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * kPi * (i + uniform(-0.3, 0.3)) / corners;
    vertices.push_back(offset + made.size * uniform(0.4, 1.0) * std::polar(1.0, angle));
    moves.push_back(anywhere());
  }
  // Some edges have extra vertices on them, up to rounding, like the finer boundaries that methods
  // use. The displacements of these vertices are linear along the edge or arbitrary.
  for (size_t i = 0; i < vertices.size(); ++i) {
    const size_t next = (i + 1) % vertices.size();
    made.polygon.push_back(vertices[i]);
    made.displaced.push_back(moves[i]);
    const int parts = static_cast<int>(uniform(1, 4));
    const bool straight = uniform(0, 1) < 0.5;
    for (int k = 1; k < parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      made.polygon.push_back((1 - t) * vertices[i] + t * vertices[next]);
      made.displaced.push_back(straight ? (1 - t) * moves[i] + t * moves[next] : anywhere());
    }
  }
  return made;
}

double after(double x, int ulps) {
  for (int i = 0; i < std::abs(ulps); ++i) x = std::nextafter(x, ulps < 0 ? -1e300 : 1e300);
  return x;
}
Complex after(Complex z, int x, int y) {
  return {after(z.real(), x), after(z.imag(), y)};
}

/// Doubles around vertices and midpoints of edges, and points at decreasing distances from
/// vertices, along edges and inward.
Points near_points(const Points& polygon, std::mt19937& random) {
  std::uniform_int_distribution<int> ulps(-4, 4);
  Points points;
  const size_t n = polygon.size();
  const auto around = [&](Complex z, int count) {
    points.push_back(z);
    for (int i = 0; i < count; ++i) {
      const int x = ulps(random);
      points.push_back(after(z, x, ulps(random)));
    }
  };
  for (size_t i = 0; i < n; ++i) {
    const Complex v = polygon[i], out = polygon[(i + 1) % n] - v, in = polygon[(i + n - 1) % n] - v;
    double angle = std::arg(in / out);
    if (angle <= 0) angle += 2 * kPi;
    around(v, 12);
    around(v + 0.5 * out, 4);
    for (int k = 1; k < 16; ++k) {
      const double fraction = std::pow(10.0, -k);
      around(v + fraction * out, 2);
      around(v + fraction * in, 2);
      points.push_back(v + fraction * out * std::polar(1.0, 0.5 * angle));
      points.push_back(v + fraction * out * std::polar(1.0, 0.99 * angle));
    }
  }
  std::ranges::shuffle(points, random);
  points.resize(std::min(points.size(), static_cast<size_t>(few_or_many(60, 200))));
  return points;
}

}  // namespace

TEST_CASE("Maps next to the boundary agree with 50-digit values, by every code path") {
  for (const unsigned seed : seeds_of("near boundary", {1, 2, 3})) {
    std::mt19937 random(seed);
    for (int round = 0; round < few_or_many(1, 2); ++round) {
      const Case made = random_case(random);
      const Points points = near_points(made.polygon, random);
      const Cage cage = polygon_cage(made.polygon);
      const VectorXc d = Eigen::Map<const VectorXc>(made.displaced.data(),
                                                    static_cast<Index>(made.displaced.size()));
      const VectorXc exactly = cauchy_coordinates(cage, points) * d;
      const VectorXc portable =
          as_complex(planar_coordinates<double>(cage, points, 0, Kernel::portable)) * d;
      const VectorXc fast = as_complex(planar_coordinates<double>(cage, points, 0)) * d;
      const VectorXc slopes = as_complex(planar_coordinates<double>(cage, points, 1)) * d;
      const CauchySum sum(cage, d);
      for (size_t i = 0; i < points.size(); ++i) {
        const Index row = static_cast<Index>(i);
        const Complex z = points[i];
        const exact::Image at = exact::image_of(made.polygon, made.displaced, z);
        const CauchySum::ValueAndSlope single = sum.at(z);
        double off = 0, slope_off = 0;
        for (const Complex f : {exactly[row], portable[row], fast[row], single.f})
          off = std::max(off, std::abs(z + f - at.f));
        for (const Complex df : {slopes[row], single.df})
          slope_off = std::max(slope_off, std::abs(1.0 + df - at.df));
        double change = 0, slope_change = 0;
        const double largest = std::max(std::abs(z.real()), std::abs(z.imag())),
                     ulp = after(largest, 1) - largest;
        // Within rounding error of a vertex, the derivative is unbounded.
        const bool at_vertex = std::ranges::any_of(
            made.polygon, [&](Complex v) { return std::abs(z - v) <= 32 * ulp; });
        if (off > 1e-9 * made.size || slope_off > 1e-9) {
          constexpr int kDirections = 16;
          for (int way = 0; way < kDirections; ++way)
            for (const double ulps : {1, 4, 16}) {
              const exact::Image there =
                  exact::image_of(made.polygon, made.displaced,
                                  z + std::polar(1.4142 * ulps * ulp, 2 * kPi * way / kDirections));
              change = std::max(change, std::abs(there.f - at.f));
              slope_change = std::max(slope_change, std::abs(there.df - at.df));
            }
        }
        INFO("seed " << seed << " round " << round << " size " << made.size << " point " << i
                     << " z " << z.real() << " " << z.imag());
        // An image is z plus a displacement. If z lies just outside, the image is therefore off by
        // z's distance from the boundary, even where the map compresses.
        CHECK(off <= 1e-9 * made.size + std::max(change, 16 * ulp));
        CHECK(is_finite(slopes[row]));
        if (!at_vertex) CHECK(slope_off <= 1e-9 + slope_change);
      }
    }
  }
}

TEST_CASE(
    "Derivatives at vertices where nothing bends equal those of the edge without the vertex") {
  for (const unsigned seed : seeds_of("vertices that do not bend", {11, 12, 13})) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(0.1, 0.9);
    std::uniform_int_distribution<int> ulps(-3, 3);
    for (int round = 0; round < 20; ++round) {
      Case plain = random_case(random);
      const size_t edge = random() % plain.polygon.size(), next = (edge + 1) % plain.polygon.size();
      const double t = part(random);
      const Complex z = (1 - t) * plain.polygon[edge] + t * plain.polygon[next];
      Points polygon = plain.polygon, displaced = plain.displaced;
      const auto at = [&](Points& points) { return points.begin() + static_cast<long>(edge) + 1; };
      polygon.insert(at(polygon), z);
      // The displacement that is linear along the edge, at the rounded vertex.
      const Complex step = plain.polygon[next] - plain.polygon[edge],
                    fraction = (z - plain.polygon[edge]) / step;
      displaced.insert(at(displaced), plain.displaced[edge] + fraction * (plain.displaced[next] -
                                                                          plain.displaced[edge]));
      Points points{z};
      for (int k = 0; k < 20; ++k) {
        const int x = ulps(random);
        points.push_back(after(z, x, ulps(random)));
      }
      const Eigen::Map<const VectorXc> d(displaced.data(), static_cast<Index>(displaced.size()));
      const Cage cage = polygon_cage(polygon);
      const VectorXc slopes = as_complex(planar_coordinates<double>(cage, points, 1)) * d;
      const CauchySum sum(cage, d);
      const Complex wanted = exact::image_of(plain.polygon, plain.displaced, z).df;
      // Rounding of the vertex and of its displacement acts as a slope along the shorter part of
      // the edge.
      const double rounding = 1e3 * std::numeric_limits<double>::epsilon() *
                              (1 + std::abs(z) / (std::min(t, 1 - t) * std::abs(step)));
      for (size_t i = 0; i < points.size(); ++i) {
        INFO("seed " << seed << " round " << round << " point " << i);
        CHECK(std::abs(1.0 + slopes[static_cast<Index>(i)] - wanted) <= 1e-9 + rounding);
        CHECK(std::abs(1.0 + sum.at(points[i]).df - wanted) <= 1e-9 + rounding);
      }
    }
  }
}

TEST_CASE("Curved boundaries: single points agree with rows at and next to vertices") {
  for (const unsigned seed : seeds_of("curved vertices", {51, 52, 53, 54})) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> by(-30, 30);
    std::uniform_int_distribution<int> ulps(-3, 3);
    const Cage cage = shapes::curved_star(5 + static_cast<int>(seed % 4),
                                          2 + static_cast<int>(seed % 3), 0.2, seed);
    VectorXc d(cage.control_count());
    for (Complex& move : d) move = Complex(by(random), by(random));
    const CauchySum sum(cage, d);
    Points points;
    for (Index v = 0; v < cage.size(); ++v)
      for (int k = 0; k < 10; ++k) {
        const int x = k == 0 ? 0 : ulps(random);
        points.push_back(after(cage.vertex(v), x, k == 0 ? 0 : ulps(random)));
        points.push_back(after(position_of(cage, {v, 0.1 * k + 0.05}), x, -x));
      }
    const VectorXc exact = cauchy_coordinates(cage, points) * d,
                   fast = as_complex(planar_coordinates<double>(cage, points)) * d;
    for (size_t i = 0; i < points.size(); ++i) {
      INFO("seed " << seed << ", point " << i);
      CHECK(std::abs(fast[static_cast<Index>(i)] - exact[static_cast<Index>(i)]) <= 1e-9);
      CHECK(std::abs(sum.at(points[i]).f - exact[static_cast<Index>(i)]) <= 1e-7);
    }
  }
}

namespace {

/// A slanted pentagon with handles of all kinds, posed at random, of any size and at any position.
struct PosedHandles {
  Rest rest;
  Pose pose;
  double size = 100;
};
PosedHandles random_handles(const Method& method, std::mt19937& random, bool outline) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  PosedHandles made;
  made.size = std::pow(10.0, uniform(-3, 6));
  // Not so far away that too few digits are left for the map.
  const Complex offset =
      std::polar(std::min(1e6, made.size * std::pow(10.0, uniform(-1, 5))), uniform(0, 2 * kPi));
  const auto at = [&](double x, double y) { return offset + made.size / 100 * Complex(x, y); };
  const auto moved = [&](Complex z) {
    return z + made.size / 100 * Complex(uniform(-12, 12), uniform(-12, 12));
  };
  Points corners, posed;
  for (int i = 0; i < 5; ++i) {
    const Complex way = std::polar(uniform(70, 100), 2 * kPi * (i + uniform(-0.2, 0.2)) / 5);
    corners.push_back(at(way.real(), way.imag()));
    posed.push_back(moved(corners.back()));
  }
  Rest& rest = made.rest;
  rest.cage = polygon_cage(corners);
  rest.precision = Precision::full;
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {400}));
  made.pose.cage = polygon_cage(posed);
  if (method.uses_pins) {
    rest.pins = {{at(-20, -10), false}, {at(20, 15), false}};
    for (const RestPin& pin : rest.pins) made.pose.pins.push_back({moved(pin.position)});
  }
  if (method.uses_strokes) {
    rest.strokes = {{at(-30, 20), at(-10, 25), at(10, 20)}};
    made.pose.strokes.emplace_back();
    for (const Complex z : rest.strokes[0]) made.pose.strokes[0].push_back(moved(z));
  }
  if (outline) rest.outline = posed;
  return made;
}

}  // namespace

TEST_CASE("Contract: next to the boundary no method jumps, and no point makes the call fail") {
  for (const unsigned seed : seeds_of("boundaries of all methods", {21, 22})) {
    for (const Method& method : methods())
      for (const bool outline : {false, true}) {
        if (outline && !method.uses_outline) continue;
        std::mt19937 random(seed);
        PosedHandles made = random_handles(method, random, outline);
        const Points corners = vertices_of(made.rest.cage);
        std::uniform_int_distribution<int> ulps(-3, 3);
        std::uniform_real_distribution<double> part(0.02, 0.98);
        // Points so close together that rounding hardly distinguishes them. The first of them is
        // well inside.
        std::vector<size_t> firsts;
        const auto cluster = [&](Complex z, Complex inwards) {
          firsts.push_back(made.rest.samples.size());
          made.rest.samples.push_back(z + 1e-10 * inwards);
          made.rest.samples.push_back(z + 1e-12 * inwards);
          for (int i = 0; i < 8; ++i) {
            const int x = ulps(random);
            made.rest.samples.push_back(after(z, x, ulps(random)));
          }
          made.rest.samples.push_back(z);
        };
        for (size_t i = 0; i < 5; ++i) {
          const Complex v = corners[i], out = corners[(i + 1) % 5] - v,
                        in = corners[(i + 4) % 5] - v;
          cluster(v, out + in);
          for (const double t : {0.5, 0.25, part(random), part(random)})
            cluster(v + t * out, kI * out);
        }
        firsts.push_back(made.rest.samples.size());
        SampledMap map;
        const auto deformer = method.prepare(made.rest, nullptr);
        map = deformer->deform(made.pose, {true});
        const auto single = deformer->point_map(made.pose);
        for (size_t k = 0; k + 1 < firsts.size(); ++k) {
          const bool corner = k % 5 == 0;
          const Index first = static_cast<Index>(firsts[k]);
          // The points are up to 1e-10 of the size apart, and the images no farther than the
          // derivatives allow. At corners, maps and their derivatives may be powers of the
          // distance.
          constexpr double kUlps = 64;
          const double rounding = kUlps * std::numeric_limits<double>::epsilon() *
                                  std::abs(made.rest.samples[static_cast<size_t>(first)]);
          const double slope = std::abs(map.fz[first]) + std::abs(map.fzbar[first]);
          const double near =
              corner ? 1e-2 * made.size : (1e-9 + 2e-10 * slope) * made.size + rounding;
          for (Index i = first; i < static_cast<Index>(firsts[k + 1]); ++i) {
            const Complex z = made.rest.samples[static_cast<size_t>(i)];
            INFO(method.id << (outline ? " onto an outline" : "") << ", seed " << seed
                           << (corner ? ", corner " : ", edge ") << k / 5 << ", point "
                           << i - first);
            CHECK(std::abs(map.f[i] - map.f[first]) <= near);
            if (single) CHECK(std::abs(single->at(z).f - map.f[i]) <= near);
            CHECK(is_finite(map.fz[i]));
            // ARAP has the derivatives of triangles, and at vertices of a finer boundary
            // derivatives are unbounded.
            if (!corner && method.id != "arap" && !outline)
              CHECK(std::abs(map.fz[i] - map.fz[first]) <= 1e-3 * std::abs(map.fz[first]));
          }
        }
      }
  }
}

}  // namespace holomorph::near_boundary_test
