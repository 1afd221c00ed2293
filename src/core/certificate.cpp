// F'' = (1 / 2 pi i) sum of jump_j / (z_j - z), so that |F''| and |F'''| have simple bounds.
#include "core/certificate.h"

#include <algorithm>

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

struct Derivatives {
  VectorXc second;  ///< row of F'' at the middle
  VectorXd third;   ///< row of bounds of |F'''|
};

Derivatives derivatives_at(const Points& polygon, const BoundaryPiece& piece) {
  const Index n = static_cast<Index>(polygon.size());
  Derivatives row{VectorXc(n), VectorXd(n)};
  const Complex middle = 0.5 * (piece.start + piece.end);
  for (Index j = 0; j < n; ++j) {
    const Complex z = polygon[static_cast<size_t>(j)];
    row.second[j] = inverse(2 * kPi * kI * (z - middle));
    // The piece stays within bend / 8 of its chord.
    const double gap =
        std::max(nearest_on_segment(piece.start, piece.end, z).distance - piece.bend / 8, 1e-300);
    row.third[j] = 1 / (2 * kPi * gap * gap);
  }
  return row;
}

}  // namespace

Certifier::Certifier(const BoundaryBasis& basis)
    : basis_(basis), values_(basis.values(basis.samples())) {
  const Index count = static_cast<Index>(basis.pieces().size());
  second_.resize(count, basis.size());
  third_.resize(count, basis.size());
  for (Index i = 0; i < count; ++i) {
    const Derivatives row = derivatives_at(basis.polygon(), basis.pieces()[static_cast<size_t>(i)]);
    second_.row(i) = row.second.transpose();
    third_.row(i) = row.third.transpose();
  }
}

VectorXc Certifier::jumps_of(const VectorXc& a) const {
  const Points& z = basis_.polygon();
  const Index n = a.size();
  VectorXc slope(n), jump(n);
  for (Index j = 0; j < n; ++j) {
    const Index next = (j + 1) % n;
    slope[j] = quotient(a[next] - a[j], z[static_cast<size_t>(next)] - z[static_cast<size_t>(j)]);
  }
  for (Index j = 0; j < n; ++j) jump[j] = slope[j] - slope[(j + n - 1) % n];
  return jump;
}

bool Certifier::prove(const BoundaryPiece& piece, const Values& start, const Values& end,
                      Complex l2, double l3, Complex nu2, double nu3, const Bounds& bounds,
                      Certificate::Bound& failed) const {
  // |F(z(x)) - chord| <= sup |F'' z'^2 + F' z''| / 8; the middle is within half the length and
  // bend.
  const double reach = 0.5 * piece.length + piece.bend / 8,
               chord = std::abs(piece.end - piece.start);
  const auto off = [&](Complex second, double third, Complex from, Complex to) {
    const double most = std::abs(second) + third * reach;
    double sum = most * piece.length * piece.length;
    // |F'| from the chord's slope, which F' equals on average.
    if (piece.bend > 0) sum += piece.bend * (std::abs(to - from) / chord + 2 * most * reach);
    return sum / 8;
  };
  const double dl = off(l2, l3, start.l, end.l), dnu = off(nu2, nu3, start.nu, end.nu);
  for (const Values& at : {start, end}) {
    const double u = at.l.real(), w = std::abs(at.nu) + dnu;
    // With k = 0 the map is conformal: nu is 0 exactly.
    if (!(w <= bounds.k)) return failed = Certificate::Bound::k, false;
    if (!(u + dl + w <= std::log(bounds.Sigma))) return failed = Certificate::Bound::Sigma, false;
    if (!(w <= 1 - bounds.sigma * std::exp(dl - u)))
      return failed = Certificate::Bound::sigma, false;
  }
  return true;
}

void Certifier::halve(const BoundaryPiece& piece, const Values& start, const Values& end,
                      const LogMap& map, const Slopes& jumps, const Bounds& bounds, int depth,
                      Certificate& result) const {
  const Derivatives row = derivatives_at(basis_.polygon(), piece);
  Certificate::Bound failed{};
  if (prove(piece, start, end, row.second.transpose() * jumps.l, row.third.dot(jumps.l.cwiseAbs()),
            row.second.transpose() * jumps.nu, row.third.dot(jumps.nu.cwiseAbs()), bounds, failed))
    return;
  if (depth == 0) {
    if (result.open.empty()) result.failed = failed, result.where = 0.5 * (piece.start + piece.end);
    result.open.push_back(0.5 * (piece.start + piece.end));
    return;
  }
  const double middle = 0.5 * (piece.from + piece.to);
  const BoundaryPiece first = piece_of(basis_.domain(), piece.segment, piece.from, middle),
                      second = piece_of(basis_.domain(), piece.segment, middle, piece.to);
  const MatrixXc c = basis_.values(std::span(&first.end, 1));
  const Values at{(c * map.l)(0), (c * map.nu)(0)};
  halve(first, start, at, map, jumps, bounds, depth - 1, result);
  halve(second, at, end, map, jumps, bounds, depth - 1, result);
}

Certificate Certifier::certify(const LogMap& map, const Bounds& bounds, int depth) const {
  const Slopes jumps{jumps_of(map.l), jumps_of(map.nu)};
  const VectorXc l = values_ * map.l, nu = values_ * map.nu, l2 = second_ * jumps.l,
                 nu2 = second_ * jumps.nu;
  const VectorXd l3 = third_ * jumps.l.cwiseAbs(), nu3 = third_ * jumps.nu.cwiseAbs();
  Certificate result;
  const Index count = l.size();
  for (Index i = 0; i < count; ++i) {
    const Index next = (i + 1) % count;
    const BoundaryPiece& piece = basis_.pieces()[static_cast<size_t>(i)];
    const Values start{l[i], nu[i]}, end{l[next], nu[next]};
    Certificate::Bound failed{};
    if (!prove(piece, start, end, l2[i], l3[i], nu2[i], nu3[i], bounds, failed))
      halve(piece, start, end, map, jumps, bounds, depth, result);
  }
  result.holds = result.open.empty();
  return result;
}

}  // namespace holomorph
