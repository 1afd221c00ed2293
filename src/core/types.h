// The scalar and array types used throughout the program.
//
// A point in the plane is a Complex, in image pixels: the origin is at the lower left of the image
// and y points up.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <span>
#include <vector>

namespace holomorph {

using Complex = std::complex<double>;
using Eigen::Index;
using VectorXc = Eigen::VectorXcd;
using MatrixXd = Eigen::MatrixXd;
using VectorXd = Eigen::VectorXd;
using MatrixXc = Eigen::MatrixXcd;
using Points = std::vector<Complex>;

/// All rows or columns of a matrix, as an index.
#if EIGEN_VERSION_AT_LEAST(3, 4, 90)
inline const auto& kAll = Eigen::placeholders::all;
#else
inline const auto& kAll = Eigen::all;
#endif

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr Complex kI{0.0, 1.0};

/// Scalar product of two plane vectors.
inline double dot(Complex a, Complex b) {
  return a.real() * b.real() + a.imag() * b.imag();
}
/// Signed area of the parallelogram (a, b): positive when b lies counter-clockwise of a.
inline double cross(Complex a, Complex b) {
  return a.real() * b.imag() - a.imag() * b.real();
}
inline bool is_finite(Complex z) {
  return std::isfinite(z.real()) && std::isfinite(z.imag());
}
/// Whether the coordinates are small enough that products of four of them do not overflow.
inline bool is_moderate(Complex z) {
  return std::abs(z.real()) <= 1e70 && std::abs(z.imag()) <= 1e70;
}

/// The entries of a vector.
inline std::span<const Complex> as_span(const VectorXc& vector) {
  return {vector.data(), static_cast<size_t>(vector.size())};
}

/// An axis-aligned box; empty until a point is included.
struct Box {
  double left = 1e300, bottom = 1e300, right = -1e300, top = -1e300;

  void include(Complex z) {
    left = std::min(left, z.real());
    right = std::max(right, z.real());
    bottom = std::min(bottom, z.imag());
    top = std::max(top, z.imag());
  }
  bool empty() const { return right < left; }
  double width() const { return right - left; }
  double height() const { return top - bottom; }
  Complex center() const { return {0.5 * (left + right), 0.5 * (bottom + top)}; }
  double diagonal() const { return std::hypot(width(), height()); }
  bool contains(Complex z) const {
    return z.real() >= left && z.real() <= right && z.imag() >= bottom && z.imag() <= top;
  }
  /// Counterclockwise from the lower left one.
  std::array<Complex, 4> corners() const {
    return {Complex(left, bottom), {right, bottom}, {right, top}, {left, top}};
  }
  bool operator==(const Box&) const = default;
};

/// The bounding box of the points.
template <class Range>
Box box_of(const Range& points) {
  Box box;
  for (const Complex& z : points) box.include(z);
  return box;
}

}  // namespace holomorph
