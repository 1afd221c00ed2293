// F'' = (1 / 2 pi i) sum of jump_j / (z_j - z), so that |F''| and |F'''| have simple bounds.
#include "core/certificate.h"

#include <algorithm>
#include <tuple>

#include "core/arithmetic.h"
#include "core/error.h"

namespace holomorph {

void Bounds::check_usable() const {
  if (!(k >= 0) || !(k < 1))
    throw Error(ErrorKind::bad_input, "the bound on angles, k, must be at least 0 and below 1");
  if (!(sigma > 0) || !(sigma < Sigma) || !std::isfinite(Sigma))
    throw Error(ErrorKind::bad_input,
                "the smallest stretch must be above 0 and below the largest one");
}

Bounds Bounds::tightened(double share) const {
  const double inwards = share * 0.5 * (std::log(Sigma) - std::log(sigma));
  return {k * (1 - share), sigma * std::exp(inwards), Sigma * std::exp(-inwards)};
}

namespace {

/// What a piece of the boundary sees of the polygon's vertices.
struct Sight {
  VectorXc second;        ///< F'' at the middle from the slopes' jumps
  VectorXd near, nearer;  ///< bounds of |F''| and |F'''| from their moduli
};

Sight sight_of(const Points& polygon, const BoundaryPiece& piece) {
  const Index n = static_cast<Index>(polygon.size());
  Sight sight{VectorXc(n), VectorXd(n), VectorXd(n)};
  const Complex middle = 0.5 * (piece.start + piece.end);
  for (Index j = 0; j < n; ++j) {
    const Complex z = polygon[static_cast<size_t>(j)];
    sight.second[j] = inverse(2 * kPi * kI * (z - middle));
    // The piece stays within bend / 8 of its chord.
    const double gap =
        std::max(nearest_on_segment(piece.start, piece.end, z).distance - piece.bend / 8, 1e-300);
    sight.near[j] = 1 / (2 * kPi * gap);
    sight.nearer[j] = sight.near[j] / gap;
  }
  return sight;
}

/// How far a piece's points are from its middle.
double reach_of(const BoundaryPiece& piece) {
  return 0.5 * piece.length + piece.bend / 8;
}

}  // namespace

Certifier::Function Certifier::function_of(const VectorXc& a) const {
  const Points& z = basis_.polygon();
  const Index n = a.size();
  Function f{a, VectorXc(n), VectorXc(n), VectorXd(n)};
  for (Index j = 0; j < n; ++j) {
    const Index next = (j + 1) % n;
    f.slopes[j] =
        quotient(a[next] - a[j], z[static_cast<size_t>(next)] - z[static_cast<size_t>(j)]);
  }
  for (Index j = 0; j < n; ++j) f.jumps[j] = f.slopes[j] - f.slopes[(j + n - 1) % n];
  f.moduli = f.jumps.cwiseAbs();
  return f;
}

Certifier::Certifier(const BoundaryBasis& basis)
    : basis_(basis), values_(basis.values(basis.samples())) {
  const Index count = static_cast<Index>(basis.pieces().size());
  second_.resize(count, basis.size());
  near_.resize(count, basis.size());
  nearer_.resize(count, basis.size());
  for (Index i = 0; i < count; ++i) {
    const Sight sight = sight_of(basis.polygon(), basis.pieces()[static_cast<size_t>(i)]);
    second_.row(i) = sight.second.transpose();
    near_.row(i) = sight.near.transpose();
    nearer_.row(i) = sight.nearer.transpose();
  }
}

// With s the slope of the coefficients along an edge and L = log (z_{e+1} - z) / (z_e - z):
// 2 pi i F = sum of (a_e + (z - z_e) s) L + a_{e+1} - a_e, and the last two cancel in the sum.
Certifier::Values Certifier::at(Complex z, const Function& l, const Function& nu) const {
  const Points& polygon = basis_.polygon();
  const size_t n = polygon.size();
  Complex sum_l = 0, sum_nu = 0, p = polygon[0] - z;
  for (size_t e = 0; e < n; ++e) {
    const Complex q = polygon[(e + 1) % n] - z;
    const Complex log(0.5 * std::log(std::norm(q) / std::norm(p)),
                      std::atan2(cross(p, q), dot(p, q)));
    const Index i = static_cast<Index>(e);
    sum_l += times(l.values[i] - times(p, l.slopes[i]), log);
    sum_nu += times(nu.values[i] - times(p, nu.slopes[i]), log);
    p = q;
  }
  const Complex factor = inverse(2 * kPi * kI);
  return {times(sum_l, factor), times(sum_nu, factor)};
}

bool Certifier::prove(const BoundaryPiece& piece, const Values& start, const Values& end,
                      double second_l, double second_nu, const Bounds& bounds,
                      Certificate::Bound& failed) const {
  // |F(z(x)) - chord| <= sup |F'' z'^2 + F' z''| / 8.
  const auto off = [&](double most, Complex from, Complex to) {
    double sum = most * piece.length * piece.length;
    // |F'| from the chord's slope, which F' equals on average.
    if (piece.bend > 0)
      sum += piece.bend *
             (std::abs(to - from) / std::abs(piece.end - piece.start) + 2 * most * reach_of(piece));
    return sum / 8;
  };
  const double dl = off(second_l, start.l, end.l), dnu = off(second_nu, start.nu, end.nu);
  for (const Values& at : {start, end}) {
    const double u = at.l.real(), w = std::abs(at.nu) + dnu;
    if (!(w <= bounds.k)) return failed = Certificate::Bound::k, false;
    if (!(u + dl + w <= std::log(bounds.Sigma))) return failed = Certificate::Bound::Sigma, false;
    if (!(w <= 1 - bounds.sigma * std::exp(dl - u)))
      return failed = Certificate::Bound::sigma, false;
  }
  return true;
}

void Certifier::halve(const BoundaryPiece& piece, const Values& start, const Values& end,
                      const Function& l, const Function& nu, double second_l, double second_nu,
                      const Bounds& bounds, int depth, Certificate& result) const {
  if (depth == 0) {
    if (result.open.empty()) result.where = 0.5 * (piece.start + piece.end);
    result.open.push_back(0.5 * (piece.start + piece.end));
    return;
  }
  const double middle = 0.5 * (piece.from + piece.to);
  const BoundaryPiece first = piece_of(basis_.domain(), piece.segment, piece.from, middle),
                      second = piece_of(basis_.domain(), piece.segment, middle, piece.to);
  const Values at_middle = at(first.end, l, nu);
  for (const auto& [half, from, to] :
       {std::tie(first, start, at_middle), std::tie(second, at_middle, end)}) {
    Certificate::Bound failed{};
    if (prove(half, from, to, second_l, second_nu, bounds, failed)) continue;
    if (result.open.empty()) result.failed = failed;
    halve(half, from, to, l, nu, second_l, second_nu, bounds, depth - 1, result);
  }
}

Certificate Certifier::certify(const LogMap& map, const Bounds& bounds, int depth) const {
  const Function fl = function_of(map.l), fnu = function_of(map.nu);
  const VectorXc l = values_ * map.l, nu = values_ * map.nu, l2 = second_ * fl.jumps,
                 nu2 = second_ * fnu.jumps;
  const VectorXd l3 = nearer_ * fl.moduli, nu3 = nearer_ * fnu.moduli, lb = near_ * fl.moduli,
                 nub = near_ * fnu.moduli;
  Certificate result;
  const Index count = l.size();
  for (Index i = 0; i < count; ++i) {
    const Index next = (i + 1) % count;
    const BoundaryPiece& piece = basis_.pieces()[static_cast<size_t>(i)];
    const Values start{l[i], nu[i]}, end{l[next], nu[next]};
    Certificate::Bound failed{};
    // What bounds |F''| on a piece bounds it on its halves.
    const double reach = reach_of(piece),
                 second_l = std::min(std::abs(l2[i]) + l3[i] * reach, lb[i]),
                 second_nu = std::min(std::abs(nu2[i]) + nu3[i] * reach, nub[i]);
    if (prove(piece, start, end, second_l, second_nu, bounds, failed)) continue;
    if (result.open.empty()) result.failed = failed;
    halve(piece, start, end, fl, fnu, second_l, second_nu, bounds, depth, result);
  }
  result.holds = result.open.empty();
  return result;
}

}  // namespace holomorph
