// The symmetric Dirichlet energy of a map at a point, in the unknowns in which it is convex.
//
// With u = ln |f_z| and nu = conj(f_zbar) / f_z, p = |nu|^2 < 1, the energy is
//     e = (1 + p) (e^2u + e^-2u / (1 - p)^2),
// which is half the sum of the squared stretches and their inverse squares: 2 for a rigid motion,
// and infinite for a fold. It is convex in (u, nu). In the unknowns of Chen and Weber 2017 ("GPU-
// accelerated locally injective shape deformation"), which are f_z and f_zbar, it is not.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/types.h"

namespace holomorph {

/// e^l - 1, accurate for small l and exactly 0 for l = 0.
inline Complex exp_minus_one(Complex l) {
  const double grown = std::expm1(l.real()), half = std::sin(0.5 * l.imag()),
               bent = -2 * half * half;  // cos - 1
  return {grown + bent + grown * bent, (1 + grown) * std::sin(l.imag())};
}

/// The energy itself, or a convex increasing function of it that lowers the largest distortion.
struct IsometricEnergy {
  enum class Form {
    plain,        ///< e
    exponential,  ///< (exp(s (e - 2)) - 1) / s + 2, but a parabola where s (e - 2) > 30
    power         ///< 2 (e / 2)^s
  };
  Form form = Form::plain;
  double s = 1;

  /// The energy's value, gradient and Hessian in (u, Re nu, Im nu).
  struct Value {
    double value = 0;
    Eigen::Vector3d gradient;
    Eigen::Matrix3d hessian;
  };

  double value(double u, double a, double b) const {
    const double p = a * a + b * b, square = std::exp(2 * u), room = 1 - p;
    return formed((1 + p) * (square + 1 / (square * room * room)));
  }

  Value with_derivatives(double u, double a, double b) const {
    const double p = a * a + b * b, room = 1 - p, large = std::exp(2 * u), small = 1 / large,
                 h = (1 + p) / (room * room), h1 = (3 + p) / (room * room * room),
                 h2 = (10 + 2 * p) / (room * room * room * room);
    const double e = large * (1 + p) + small * h, e_u = 2 * (large * (1 + p) - small * h),
                 e_p = large + small * h1, e_up = 2 * (large - small * h1), e_pp = small * h2;
    Value result;
    result.gradient << e_u, 2 * a * e_p, 2 * b * e_p;
    result.hessian << 4 * e, 2 * a * e_up, 2 * b * e_up,             //
        2 * a * e_up, 2 * e_p + 4 * a * a * e_pp, 4 * a * b * e_pp,  //
        2 * b * e_up, 4 * a * b * e_pp, 2 * e_p + 4 * b * b * e_pp;
    result.value = formed(e);
    const double first = slope(e);
    result.hessian =
        first * result.hessian + curvature(e) * result.gradient * result.gradient.transpose();
    result.gradient *= first;
    return result;
  }

 private:
  static constexpr double kParabola = 30;  ///< before exp overflows at the start of a solve
  double formed(double e) const {
    const double y = s * (e - 2), beyond = y - kParabola;
    switch (form) {
      case Form::exponential:
        if (beyond > 0)
          return 2 + (std::exp(kParabola) * (1 + beyond + 0.5 * beyond * beyond) - 1) / s;
        return 2 + std::expm1(y) / s;
      case Form::power:
        return 2 * std::pow(e / 2, s);
      case Form::plain:
        break;
    }
    return e;
  }
  double slope(double e) const {
    const double y = s * (e - 2);
    switch (form) {
      case Form::exponential:
        return y > kParabola ? std::exp(kParabola) * (1 + y - kParabola) : std::exp(y);
      case Form::power:
        return s * std::pow(e / 2, s - 1);
      case Form::plain:
        break;
    }
    return 1;
  }
  double curvature(double e) const {
    switch (form) {
      case Form::exponential:
        return s * std::exp(std::min(s * (e - 2), kParabola));
      case Form::power:
        return 0.5 * s * (s - 1) * std::pow(e / 2, s - 2);
      case Form::plain:
        break;
    }
    return 0;
  }
};

}  // namespace holomorph
