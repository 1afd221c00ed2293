// F'' = (1 / 2 pi i) sum of jump_j / (z_j - z), which gives simple bounds on |F''| and |F'''|.
#include "core/bounded/certificate.h"

#include <algorithm>

#include "core/arithmetic.h"
#include "core/error.h"

namespace holomorph {

void Bounds::check_usable() const {
  if (!(k >= 0) || !(k < 1))
    throw Error(ErrorKind::bad_input, "the angle bound k must be at least 0 and less than 1");
  if (!(sigma > 0) || !(sigma < Sigma) || !std::isfinite(Sigma))
    throw Error(ErrorKind::bad_input,
                "the smallest stretch must be positive and less than the largest stretch, which "
                "must be finite");
}

Bounds Bounds::tightened(double fraction) const {
  const double inwards = fraction * 0.5 * (std::log(Sigma) - std::log(sigma));
  return {k * (1 - fraction), sigma * std::exp(inwards), Sigma * std::exp(-inwards)};
}

const char* bound_name(Bound bound) {
  static constexpr const char* kNames[] = {"max growth", "smallest size", "max shear"};
  return kNames[static_cast<int>(bound)];
}

LogMap scaled(LogMap map, Complex factor) {
  // Cauchy coordinates sum to one, so adding a constant to all coefficients of l adds it to l.
  // conj(Psi) is also multiplied by the factor.
  map.l.array() += std::log(factor);
  map.w *= map.second == LogMap::Second::nu ? std::conj(factor) / factor : std::conj(factor);
  return map;
}

Derivatives derivatives_of(const LogMap& map, const VectorXc& l, const VectorXc& w) {
  Derivatives d{l.array().exp(), w};
  if (map.second == LogMap::Second::nu) d.psi = w.cwiseProduct(d.phi);
  return d;
}

Derivatives second_derivatives_of(const LogMap& map, const Derivatives& first, const VectorXc& w,
                                  const VectorXc& l1, const VectorXc& w1) {
  Derivatives d{l1.cwiseProduct(first.phi), w1};
  if (map.second == LogMap::Second::nu) d.psi = (w1 + w.cwiseProduct(l1)).cwiseProduct(first.phi);
  return d;
}

namespace {

/// The influence of the polygon's vertices on a piece of the boundary, as weights for the jumps of
/// the slopes.
struct VertexInfluence {
  VectorXc second;        ///< give F'' at the piece's midpoint
  VectorXd near, nearer;  ///< with the moduli of the jumps, bound |F''| and |F'''| on the piece
};

VertexInfluence influence_of(const Points& polygon, const BoundaryPiece& piece) {
  const Index n = static_cast<Index>(polygon.size());
  VertexInfluence influence{VectorXc(n), VectorXd(n), VectorXd(n)};
  const Complex middle = 0.5 * (piece.start + piece.end);
  for (Index j = 0; j < n; ++j) {
    const Complex z = polygon[static_cast<size_t>(j)];
    influence.second[j] = inverse(2 * kPi * kI * (z - middle));
    // The piece stays within bend / 8 of its chord.
    const double gap =
        std::max(nearest_on_segment(piece.start, piece.end, z).distance - piece.bend / 8, 1e-300);
    influence.near[j] = 1 / (2 * kPi * gap);
    influence.nearer[j] = influence.near[j] / gap;
  }
  return influence;
}

/// A bound on the distance of a piece's points from its midpoint.
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
    const VertexInfluence influence =
        influence_of(basis.polygon(), basis.pieces()[static_cast<size_t>(i)]);
    second_.row(i) = influence.second.transpose();
    near_.row(i) = influence.near.transpose();
    nearer_.row(i) = influence.nearer.transpose();
  }
}

// With s the slope of the coefficients along an edge and L = log (z_{e+1} - z) / (z_e - z):
// 2 pi i F = sum of (a_e + (z - z_e) s) L + a_{e+1} - a_e, and the terms without L cancel in the
// sum.
Certifier::Values Certifier::at(Complex z, const Function& l, const Function& w) const {
  const Points& polygon = basis_.polygon();
  const size_t n = polygon.size();
  Complex sum_l = 0, sum_w = 0, p = polygon[0] - z;
  for (size_t e = 0; e < n; ++e) {
    const Complex q = polygon[(e + 1) % n] - z;
    const Complex log(0.5 * std::log(std::norm(q) / std::norm(p)),
                      std::atan2(cross(p, q), dot(p, q)));
    const Index i = static_cast<Index>(e);
    sum_l += times(l.values[i] - times(p, l.slopes[i]), log);
    sum_w += times(w.values[i] - times(p, w.slopes[i]), log);
    p = q;
  }
  const Complex factor = inverse(2 * kPi * kI);
  return {times(sum_l, factor), times(sum_w, factor)};
}

/// One proof in progress.
class Certifier::Proof {
 public:
  Proof(const Certifier& certifier, const LogMap& map, const Bounds& bounds)
      : l(certifier.function_of(map.l)),
        w(certifier.function_of(map.w)),
        certifier_(certifier),
        second_(map.second),
        bounds_(bounds),
        log_Sigma_(std::log(bounds.Sigma)) {}

  /// A piece, the values of l and w at its ends, and bounds on |l''| and |w''| along it.
  struct Leaf {
    BoundaryPiece piece;
    Values start, end;
    double second_l = 0, second_w = 0;
  };

  /// Tries to prove the bounds on a leaf, halving it up to `depth` times. Records where this fails.
  void prove(const Leaf& leaf, int depth) {
    const auto failed = unproved_bound(leaf);
    if (!failed) return;
    const BoundaryPiece& piece = leaf.piece;
    if (result.unproved.empty()) result.failed = *failed;
    // If an end violates a bound, halving cannot help.
    const auto broken = broken_end(leaf);
    if (broken || depth == 0) {
      const Complex unproved = broken ? *broken : middle_of(piece);
      if (result.unproved.empty()) result.where = unproved;
      if (result.unproved.empty() || result.unproved.back() != unproved)
        result.unproved.push_back(unproved);
      return;
    }
    // Bounds on |F''| on a piece also hold on its halves.
    const Cage& domain = certifier_.basis_.domain();
    const double middle = 0.5 * (piece.from + piece.to);
    Leaf first = leaf, second = leaf;
    first.piece = piece_of(domain, piece.segment, piece.from, middle);
    second.piece = piece_of(domain, piece.segment, middle, piece.to);
    first.end = second.start = certifier_.at(first.piece.end, l, w);
    prove(first, depth - 1);
    prove(second, depth - 1);
  }

  Function l, w;
  Certificate result;

 private:
  /// |F(z(x)) - chord| <= sup |F'' z'^2 + F' z''| / 8. The bound on |F'| uses the chord's slope,
  /// which is the mean of F'.
  static double off_chord(const BoundaryPiece& piece, double second, Complex from, Complex to) {
    double sum = second * piece.length * piece.length;
    if (piece.bend > 0)
      sum += piece.bend * (std::abs(to - from) / std::abs(piece.end - piece.start) +
                           2 * second * reach_of(piece));
    return sum / 8;
  }

  /// A bound that cannot be proved from the values at the leaf's ends and the second derivatives.
  /// Empty when all are proved.
  std::optional<Bound> unproved_bound(const Leaf& leaf) const {
    const double dl = off_chord(leaf.piece, leaf.second_l, leaf.start.l, leaf.end.l),
                 dw = off_chord(leaf.piece, leaf.second_w, leaf.start.w, leaf.end.w);
    if (second_ == LogMap::Second::nu)
      return first_of(unproved_bound_of_nu(leaf.start, dl, dw),
                      unproved_bound_of_nu(leaf.end, dl, dw));
    // |f_z| = e^u lies below its chord by at most (Delta u)^2 / 8 max e^u.
    const double from = leaf.start.l.real(), to = leaf.end.l.real(),
                 below = (to - from) * (to - from) / 8 * std::exp(std::max(from, to));
    return first_of(unproved_bound_of_psi(leaf.start, dl, dw, below),
                    unproved_bound_of_psi(leaf.end, dl, dw, below));
  }

  /// An end of the leaf at which a bound is violated. Empty when there is none.
  std::optional<Complex> broken_end(const Leaf& leaf) const {
    const auto is_broken = [&](const Values& at) {
      return second_ == LogMap::Second::nu ? unproved_bound_of_nu(at, 0, 0).has_value()
                                           : unproved_bound_of_psi(at, 0, 0, 0).has_value();
    };
    if (is_broken(leaf.start)) return leaf.piece.start;
    if (is_broken(leaf.end)) return leaf.piece.end;
    return {};
  }
  Complex middle_of(const BoundaryPiece& piece) const {
    return piece_of(certifier_.basis_.domain(), piece.segment, piece.from,
                    0.5 * (piece.from + piece.to))
        .end;
  }

  static std::optional<Bound> first_of(std::optional<Bound> a, std::optional<Bound> b) {
    return a ? a : b;
  }

  /// A bound that l and w may violate if they differ from these values by up to dl and dw. Empty
  /// when there is none.
  std::optional<Bound> unproved_bound_of_nu(const Values& at, double dl, double dw) const {
    const double u = at.l.real(), w = std::abs(at.w) + dw;
    if (!(w <= bounds_.k)) return Bound::k;
    if (!(u + dl + w <= log_Sigma_)) return Bound::Sigma;
    if (!(w <= 1 - bounds_.sigma * std::exp(dl - u))) return Bound::sigma;
    return {};
  }
  std::optional<Bound> unproved_bound_of_psi(const Values& at, double dl, double dw,
                                             double below) const {
    const double size = std::exp(at.l.real()), w = std::abs(at.w) + dw;
    const double least = std::exp(-dl) * (size - below);
    if (!(w <= bounds_.k * least)) return Bound::k;
    if (!(std::exp(dl) * size + w <= bounds_.Sigma)) return Bound::Sigma;
    if (!(least - w >= bounds_.sigma)) return Bound::sigma;
    return {};
  }

  const Certifier& certifier_;
  LogMap::Second second_;
  const Bounds& bounds_;
  double log_Sigma_;
};

Certificate Certifier::certify(const LogMap& map, const Bounds& bounds, int depth) const {
  Proof proof(*this, map, bounds);
  const VectorXc l = values_ * map.l, w = values_ * map.w, l2 = second_ * proof.l.jumps,
                 w2 = second_ * proof.w.jumps;
  const VectorXd l3 = nearer_ * proof.l.moduli, w3 = nearer_ * proof.w.moduli,
                 lb = near_ * proof.l.moduli, wb = near_ * proof.w.moduli;
  const Index count = l.size();
  for (Index i = 0; i < count; ++i) {
    const Index next = (i + 1) % count;
    const BoundaryPiece& piece = basis_.pieces()[static_cast<size_t>(i)];
    const double reach = reach_of(piece);
    proof.prove({piece,
                 {l[i], w[i]},
                 {l[next], w[next]},
                 std::min(std::abs(l2[i]) + l3[i] * reach, lb[i]),
                 std::min(std::abs(w2[i]) + w3[i] * reach, wb[i])},
                depth);
  }
  proof.result.holds = proof.result.unproved.empty();
  return std::move(proof.result);
}

}  // namespace holomorph
