// Method `mean_value`: f = sum w_c b_c with mean value coordinates (Floater 2003; Hormann, Floater
// 2006 for polygons of any shape): closed form, along the cage, but negative beyond reflex corners.
#include "core/methods/real_coordinates.h"
#include "core/methods/rows.h"
#include "core/polyline.h"

namespace holomorph {
namespace {

/// A number and its derivatives in the plane.
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

/// The mean value coordinates of a polygon's vertices at z, inside it but not on it.
std::vector<Dual> mean_value_coordinates(const Points& polygon, Complex z) {
  struct Side {
    Dual x, y, length;
  };
  std::vector<Side> sides;
  for (const Complex& vertex : polygon) {
    const Dual x{(vertex - z).real(), -1, 0}, y{(vertex - z).imag(), 0, -1};
    sides.push_back({x, y, root(x * x + y * y)});
  }
  const size_t n = polygon.size();
  std::vector<Dual> weights(n);
  Dual sum;
  for (size_t i = 0; i < n; ++i) {
    const Side &a = sides[i], &b = sides[(i + 1) % n];
    const Dual along = a.x * b.x + a.y * b.y, across = a.x * b.y - a.y * b.x,
               product = a.length * b.length;
    // tan of half the angle that the edge is seen under, in the form that loses no digits.
    const Dual half = along.value > 0 ? across / (product + along) : (product - along) / across;
    weights[i] = weights[i] + half / a.length;
    weights[(i + 1) % n] = weights[(i + 1) % n] + half / b.length;
    sum = sum + half / a.length + half / b.length;
  }
  for (Dual& weight : weights) weight = weight / sum;
  return weights;
}

/// Of a curved cage: those of a fine polygon on it, whose vertices are sums of control points.
class MeanValueCoordinates final : public RealCoordinates {
 public:
  explicit MeanValueCoordinates(const Cage& cage)
      : flat_(flattened(cage)),
        edge_(flat_.points, true),
        controls_(weights_at(cage, flat_.places)) {}

  MatrixXc at(std::span<const Complex> points, int order) const override {
    MatrixXc of_vertices(static_cast<Index>(points.size()), controls_.rows());
    for (size_t i = 0; i < points.size(); ++i) {
      const Index row = static_cast<Index>(i);
      if (order == 0)
        of_vertices.row(row) = values(points[i]).cast<Complex>();
      else
        of_vertices.row(row) = slopes(points[i]);
    }
    return of_vertices * controls_.cast<Complex>();
  }

 private:
  static constexpr double kOnEdge = 1e-12;  ///< of the size

  /// On the polygon they are linear between its vertices.
  Eigen::RowVectorXd values(Complex z) const {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(controls_.rows());
    const Polyline::Nearest near = edge_.nearest(z);
    if (near.distance <= kOnEdge * edge_.diagonal()) {
      row[near.segment] = 1 - near.parameter;
      row[(near.segment + 1) % row.size()] += near.parameter;
      return row;
    }
    const std::vector<Dual> weights = mean_value_coordinates(flat_.points, z);
    for (Index c = 0; c < row.size(); ++c) row[c] = weights[static_cast<size_t>(c)].value;
    return row;
  }

  /// At the edge, from just inside.
  Eigen::RowVectorXcd slopes(Complex z) const {
    constexpr double kInside = 1e-4;
    const Polyline::Nearest near = edge_.nearest(z);
    if (near.distance <= kInside * edge_.diagonal()) {
      const size_t i = static_cast<size_t>(near.segment);
      const Complex a = flat_.points[i], way = flat_.points[(i + 1) % flat_.points.size()] - a;
      const double t = std::clamp(near.parameter, 0.02, 0.98);
      z = a + t * way + kInside * edge_.diagonal() * kI * way / std::abs(way);
    }
    const std::vector<Dual> weights = mean_value_coordinates(flat_.points, z);
    Eigen::RowVectorXcd row(controls_.rows());
    for (Index c = 0; c < row.size(); ++c) {
      const Dual& weight = weights[static_cast<size_t>(c)];
      row[c] = {weight.x, -weight.y};
    }
    return row;
  }

  FlatCage flat_;
  Polyline edge_;
  MatrixXd controls_;  ///< of the polygon's vertices
};

std::unique_ptr<Deformer> prepare(const Rest& rest, const Deformer*) {
  check_rest_cage(rest.cage);
  return real_deformer(rest,
                       std::make_shared<const MeanValueCoordinates>(counter_clockwise(rest.cage)));
}

}  // namespace

Method mean_value_method() {
  return {"mean_value",
          "Mean value",
          "Along the cage as Harmonic is, in closed form; to compare: beyond reflex corners it "
          "overshoots.",
          {},
          false,
          false,
          true,
          prepare};
}

}  // namespace holomorph
