// Method `mean_value`: f = sum w_c b_c with mean value coordinates (Floater 2003; Hormann, Floater
// 2006 for polygons of any shape). They have a closed form and follow the cage's edges, but are
// negative beyond reflex corners.
#include <algorithm>

#include "core/geometry/orientation.h"
#include "core/methods/real_coordinates.h"
#include "core/methods/rows.h"

namespace holomorph {
namespace {

/// A number and its derivatives with respect to x and y.
struct Dual {
  double value = 0, x = 0, y = 0;

  Dual operator+(const Dual& o) const { return {value + o.value, x + o.x, y + o.y}; }
  Dual operator-(const Dual& o) const { return {value - o.value, x - o.x, y - o.y}; }
  Dual operator*(const Dual& o) const {
    return {value * o.value, x * o.value + value * o.x, y * o.value + value * o.y};
  }
  Dual operator/(const Dual& o) const {
    const double q = value / o.value;
    return {q, (x - q * o.x) / o.value, (y - q * o.y) / o.value};
  }
};

Dual root(const Dual& a) {
  const double r = std::sqrt(a.value);
  return {r, a.x / (2 * r), a.y / (2 * r)};
}

/// The mean value coordinates of an oriented polygon's vertices at z, which must not be a vertex.
///
/// All weights are multiplied by the distance of the nearest vertex and, if an edge subtends more
/// than a right angle at z, by the cotangent of half the widest angle. This keeps all terms
/// bounded, even on the edges.
std::vector<Dual> mean_value_coordinates(PolygonView polygon, Complex z) {
  struct Side {
    Dual x, y, length;
  };
  std::vector<Side> sides;
  for (const Complex& vertex : polygon.points()) {
    const Dual x{(vertex - z).real(), -1, 0}, y{(vertex - z).imag(), 0, -1};
    sides.push_back({x, y, root(x * x + y * y)});
  }
  const auto nearest_side =
      std::ranges::min_element(sides, {}, [](const Side& s) { return s.length.value; });
  const Dual nearest = nearest_side->length;
  const size_t n = sides.size();
  const auto after = [&](size_t i) {
    return static_cast<size_t>(polygon.loops().next(static_cast<Index>(i)));
  };
  struct Angle {
    Dual along, across, product;
    /// The tangent of half the angle, computed without cancellation.
    Dual tangent() const {
      return along.value > 0 ? across / (product + along) : (product - along) / across;
    }
    Dual cotangent() const { return across / (product - along); }
  };
  std::vector<Angle> angles;
  for (size_t i = 0; i < n; ++i) {
    const Side &a = sides[i], &b = sides[after(i)];
    angles.push_back({a.x * b.x + a.y * b.y, a.x * b.y - a.y * b.x, a.length * b.length});
  }
  const size_t widest = static_cast<size_t>(
      std::ranges::min_element(angles, {},
                               [](const Angle& a) { return a.along.value / a.product.value; }) -
      angles.begin());
  const bool is_wide = angles[widest].along.value < 0;
  const Dual scale = is_wide ? angles[widest].cotangent() : Dual{1, 0, 0};
  std::vector<Dual> weights(n);
  Dual sum;
  for (size_t i = 0; i < n; ++i) {
    const Dual half = is_wide && i == widest ? Dual{1, 0, 0} : angles[i].tangent() * scale;
    const Dual start = half * (nearest / sides[i].length),
               end = half * (nearest / sides[after(i)].length);
    weights[i] = weights[i] + start;
    weights[after(i)] = weights[after(i)] + end;
    sum = sum + start + end;
  }
  // The weight of the nearest vertex is 1 minus all other weights. The usual formula would lose
  // precision next to that vertex, because its derivative suffers from cancellation.
  Dual rest{1, 0, 0};
  const size_t own = static_cast<size_t>(nearest_side - sides.begin());
  for (size_t i = 0; i < n; ++i) {
    if (i == own) continue;
    weights[i] = weights[i] / sum;
    rest = rest - weights[i];
  }
  weights[own] = rest;
  return weights;
}

/// A curved cage is replaced by a fine polygon. The polygon's vertices are weighted sums of the
/// control points.
class MeanValueCoordinates final : public RealCoordinates {
 public:
  explicit MeanValueCoordinates(const Cage& cage)
      : flat_(flattened(cage)),
        polygon_(polygon_cage(flat_)),
        controls_(weights_at(cage, flat_.locations)) {}

  MatrixXc at(std::span<const Complex> points, int order) const override {
    MatrixXc of_vertices(static_cast<Index>(points.size()), controls_.rows());
    for (size_t i = 0; i < points.size(); ++i)
      of_vertices.row(static_cast<Index>(i)) = row(points[i], order);
    return of_vertices * controls_.cast<Complex>();
  }

 private:
  Eigen::RowVectorXcd row(Complex z, int order) const {
    Eigen::RowVectorXcd row = Eigen::RowVectorXcd::Zero(controls_.rows());
    const auto vertex = std::ranges::find(flat_.points, z);
    if (vertex != flat_.points.end()) {
      if (order == 0) {
        row[vertex - flat_.points.begin()] = 1;
        return row;
      }
      z = point_inside_vertex(polygon_, z);
    }
    const std::vector<Dual> weights = mean_value_coordinates(flat_, z);
    for (Index c = 0; c < row.size(); ++c) {
      const Dual& weight = weights[static_cast<size_t>(c)];
      row[c] = order == 0 ? Complex(weight.value) : Complex(weight.x, -weight.y);
    }
    return row;
  }

  FlatCage flat_;
  Cage polygon_;
  MatrixXd controls_;  ///< the control points' weights at the polygon's vertices
};

std::unique_ptr<Deformer> make_mean_value(const Rest& rest, const Deformer*) {
  return real_deformer(rest, std::make_shared<const MeanValueCoordinates>(oriented(rest.cage)));
}

}  // namespace

Method mean_value_method() {
  return {
      .id = "mean_value",
      .label = "Mean value",
      .summary = "Keeps edges straight. Reacts to distant points, too.",
      .hint =
          "Follows the cage's edges like Harmonic, without preparation. For comparison: it "
          "overshoots beyond corners that point inwards.",
      .harmonic = false,
      .make = make_mean_value,
  };
}

}  // namespace holomorph
