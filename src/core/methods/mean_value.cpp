// Method `mean_value`: f = sum w_c b_c with mean value coordinates (Floater 2003; Hormann, Floater
// 2006 for polygons of any shape). They have a closed form and follow the cage's edges, but are
// negative beyond reflex corners.
#include <Eigen/SparseCore>
#include <algorithm>
#include <optional>

#include "core/geometry/orientation.h"
#include "core/methods/real_coordinates.h"
#include "core/methods/rows.h"

namespace holomorph {
namespace {

/// A number and its derivatives with respect to x and y.
struct Dual {
  double value = 0, x = 0, y = 0;

  Dual() = default;
  Dual(double value, double x = 0, double y = 0) : value(value), x(x), y(y) {}
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
double root(double a) {
  return std::sqrt(a);
}
double value_of(const Dual& a) {
  return a.value;
}
double value_of(double a) {
  return a;
}

/// An offset to a vertex along x and y: the derivatives with respect to z are -1.
template <class T>
T offset(double by, double x, double y) {
  if constexpr (std::is_same_v<T, Dual>) return {by, -x, -y};
  return by;
}

/// The mean value coordinates of an oriented polygon's vertices: numbers, or duals where
/// derivatives are needed, too.
///
/// All weights are multiplied by the distance of the nearest vertex and, if an edge subtends more
/// than a right angle at z, by the cotangent of half the widest angle. This keeps all terms
/// bounded, even on the edges.
template <class T>
class MeanValueWeights {
 public:
  explicit MeanValueWeights(PolygonView polygon)
      : polygon_(polygon),
        sides_(polygon.points().size()),
        angles_(sides_.size()),
        weights_(sides_.size()) {
    for (size_t i = 0; i < sides_.size(); ++i)
      next_.push_back(static_cast<size_t>(polygon.loops().next(static_cast<Index>(i))));
  }

  /// The coordinates at z, valid until the next call. If z is a vertex, duals have no meaning.
  const std::vector<T>& at(Complex z) {
    const size_t nearest = measure(z);
    if (value_of(sides_[nearest].length) == 0) {
      std::ranges::fill(weights_, T(0));
      weights_[nearest] = T(1);
      return weights_;
    }
    const std::optional<size_t> widest = find_angles();
    const T scale = widest ? angles_[*widest].cotangent() : T(1);
    const size_t n = sides_.size();
    std::ranges::fill(weights_, T(0));
    T sum(0);
    for (size_t i = 0; i < n; ++i) {
      const T half = widest == i ? T(1) : angles_[i].tangent() * scale;
      const T start = half * sides_[i].nearness, end = half * sides_[next_[i]].nearness;
      weights_[i] = weights_[i] + start;
      weights_[next_[i]] = weights_[next_[i]] + end;
      sum = sum + start + end;
    }
    // The weight of the nearest vertex is 1 minus all other weights. The usual formula would lose
    // precision next to that vertex, because its derivative suffers from cancellation.
    const T share = T(1) / sum;
    T rest(1);
    for (size_t i = 0; i < n; ++i) {
      if (i == nearest) continue;
      weights_[i] = weights_[i] * share;
      rest = rest - weights_[i];
    }
    weights_[nearest] = rest;
    return weights_;
  }

 private:
  struct Side {
    T x, y, length;
    T nearness;  ///< the distance of the nearest vertex divided by the length
  };
  struct Angle {
    T along, across, product;
    /// The tangent of half the angle, computed without cancellation.
    T tangent() const {
      return value_of(along) > 0 ? across / (product + along) : (product - along) / across;
    }
    T cotangent() const { return across / (product - along); }
  };

  /// Computes the sides, and returns the nearest vertex.
  size_t measure(Complex z) {
    const std::span<const Complex> vertices = polygon_.points();
    size_t nearest = 0;
    for (size_t i = 0; i < sides_.size(); ++i) {
      Side& side = sides_[i];
      side.x = offset<T>((vertices[i] - z).real(), 1, 0);
      side.y = offset<T>((vertices[i] - z).imag(), 0, 1);
      side.length = root(side.x * side.x + side.y * side.y);
      if (value_of(side.length) < value_of(sides_[nearest].length)) nearest = i;
    }
    for (Side& side : sides_) side.nearness = sides_[nearest].length / side.length;
    return nearest;
  }

  /// Computes the angles, and returns the widest one if it exceeds a right angle.
  std::optional<size_t> find_angles() {
    std::optional<size_t> widest;
    double least = 0;  // cosine
    for (size_t i = 0; i < angles_.size(); ++i) {
      const Side &a = sides_[i], &b = sides_[next_[i]];
      angles_[i] = {a.x * b.x + a.y * b.y, a.x * b.y - a.y * b.x, a.length * b.length};
      if (!(value_of(angles_[i].along) < 0)) continue;
      const double cosine = value_of(angles_[i].along) / value_of(angles_[i].product);
      if (cosine < least) least = cosine, widest = i;
    }
    return widest;
  }

  PolygonView polygon_;
  std::vector<size_t> next_;
  std::vector<Side> sides_;
  std::vector<Angle> angles_;
  std::vector<T> weights_;
};

/// A curved cage is replaced by a fine polygon. The polygon's vertices are weighted sums of the
/// control points.
class MeanValueCoordinates final : public RealCoordinates {
 public:
  explicit MeanValueCoordinates(const Cage& cage)
      : flat_(flattened(cage)),
        polygon_(polygon_cage(flat_)),
        controls_(weights_at(cage, flat_.locations).sparseView()) {}

  MatrixXd values(std::span<const Complex> points) const override {
    MeanValueWeights<double> weights(flat_);
    return of_controls<double>(
        points, [&](Complex z) -> const std::vector<double>& { return weights.at(z); });
  }

  MatrixXc slopes(std::span<const Complex> points) const override {
    MeanValueWeights<Dual> weights(flat_);
    std::vector<Complex> slopes(flat_.points.size());
    return of_controls<Complex>(points, [&](Complex z) -> const std::vector<Complex>& {
      const std::vector<Dual>& at = weights.at(point_inside_vertex(polygon_, z));
      std::ranges::transform(at, slopes.begin(), [](const Dual& w) { return Complex(w.x, -w.y); });
      return slopes;
    });
  }

 private:
  /// Multiplies the rows that `row` gives for points by the control points' weights.
  template <class T, class Row>
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> of_controls(std::span<const Complex> points,
                                                               Row row) const {
    constexpr Index kBlock = 64;  // columns that stay in the cache while they are written
    const auto count = static_cast<Index>(points.size());
    Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> result(count, controls_.cols()),
        block(static_cast<Index>(flat_.points.size()), kBlock);
    const Eigen::SparseMatrix<double> transposed = controls_.transpose();
    const bool is_polygon =
        controls_.rows() == controls_.cols() && controls_.nonZeros() == controls_.rows();
    for (Index first = 0; first < count; first += kBlock) {
      const Index size = std::min(kBlock, count - first);
      for (Index i = 0; i < size; ++i) {
        const std::vector<T>& weights = row(points[static_cast<size_t>(first + i)]);
        block.col(i) = Eigen::Map<const Eigen::Vector<T, Eigen::Dynamic>>(
            weights.data(), static_cast<Index>(weights.size()));
      }
      if (is_polygon)  // its vertices are the control points
        result.middleRows(first, size) = block.leftCols(size).transpose();
      else
        result.middleRows(first, size) =
            (transposed.template cast<T>() * block.leftCols(size)).transpose();
    }
    return result;
  }

  FlatCage flat_;
  Cage polygon_;
  Eigen::SparseMatrix<double> controls_;  ///< the control points' weights at the polygon's vertices
};

std::unique_ptr<Deformer> make_mean_value(const Rest& rest, const Deformer*) {
  return real_deformer(rest, mean_value_coordinates(oriented(rest.cage)));
}

}  // namespace

std::unique_ptr<RealCoordinates> mean_value_coordinates(const Cage& cage) {
  return std::make_unique<MeanValueCoordinates>(cage);
}

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
