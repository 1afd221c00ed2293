// F'' = (1 / 2 pi i) sum of jump_j / (z_j - z), which gives simple bounds on |F''| and |F'''|.
#include "core/bounded/certificate.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>

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

VertexInfluence influence_of(PolygonView polygon, const BoundaryPiece& piece) {
  const Index n = polygon.size();
  VertexInfluence influence{VectorXc(n), VectorXd(n), VectorXd(n)};
  const Complex middle = 0.5 * (piece.start + piece.end);
  for (Index j = 0; j < n; ++j) {
    const Complex z = polygon[j];
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
  const PolygonView z = basis_.polygon();
  const Loops loops = z.loops();
  const Index n = a.size();
  Function f{a, VectorXc(n), VectorXc(n), VectorXd(n)};
  for (Index j = 0; j < n; ++j) {
    const Index next = loops.next(j);
    f.slopes[j] = quotient(a[next] - a[j], z[next] - z[j]);
  }
  for (Index j = 0; j < n; ++j) f.jumps[j] = f.slopes[j] - f.slopes[loops.before(j)];
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
  Complex sum_l = 0, sum_w = 0;
  PolygonView(basis_.polygon()).for_each_edge([&](Index i, Complex a, Complex b) {
    const Complex p = a - z, q = b - z;
    const Complex log(0.5 * std::log(std::norm(q) / std::norm(p)),
                      std::atan2(cross(p, q), dot(p, q)));
    sum_l += times(l.values[i] - times(p, l.slopes[i]), log);
    sum_w += times(w.values[i] - times(p, w.slopes[i]), log);
  });
  const Complex factor = inverse(2 * kPi * kI);
  return {times(sum_l, factor), times(sum_w, factor)};
}

namespace {

/// |F(z(x)) - chord| <= sup |F'' z'^2 + F' z''| / 8. The bound on |F'| uses the chord's slope,
/// which is the mean of F'.
double off_chord(const BoundaryPiece& piece, double second, Complex from, Complex to) {
  double sum = second * piece.length * piece.length;
  if (piece.bend > 0)
    sum += piece.bend *
           (std::abs(to - from) / std::abs(piece.end - piece.start) + 2 * second * reach_of(piece));
  return sum / 8;
}

/// A bound on how far |f_z| = e^u may lie below the chord of its values at a piece's ends.
double below_chord(Complex from, Complex to) {
  const double change = to.real() - from.real();
  return change * change / 8 * std::exp(std::max(from.real(), to.real()));
}

}  // namespace

std::vector<Certifier::Leaf> Certifier::leaves_of(const LogMap& map, const Function& l,
                                                  const Function& w) const {
  const VectorXc at_l = values_ * map.l, at_w = values_ * map.w, l2 = second_ * l.jumps,
                 w2 = second_ * w.jumps;
  const VectorXd l3 = nearer_ * l.moduli, w3 = nearer_ * w.moduli, lb = near_ * l.moduli,
                 wb = near_ * w.moduli;
  const Index count = at_l.size();
  const Loops loops = basis_.sample_loops();
  std::vector<Leaf> leaves;
  for (Index i = 0; i < count; ++i) {
    const Index next = loops.next(i);
    const BoundaryPiece& piece = basis_.pieces()[static_cast<size_t>(i)];
    const double reach = reach_of(piece);
    leaves.push_back({piece,
                      {at_l[i], at_w[i]},
                      {at_l[next], at_w[next]},
                      std::min(std::abs(l2[i]) + l3[i] * reach, lb[i]),
                      std::min(std::abs(w2[i]) + w3[i] * reach, wb[i])});
  }
  return leaves;
}

/// Bounds on |F''| on a piece also hold on its halves.
std::pair<Certifier::Leaf, Certifier::Leaf> Certifier::halved(const Leaf& leaf, const Function& l,
                                                              const Function& w) const {
  const BoundaryPiece& piece = leaf.piece;
  const double middle = 0.5 * (piece.from + piece.to);
  Leaf first = leaf, second = leaf;
  first.piece = piece_of(basis_.domain(), piece.segment, piece.from, middle);
  second.piece = piece_of(basis_.domain(), piece.segment, middle, piece.to);
  first.end = second.start = at(first.piece.end, l, w);
  return {first, second};
}

/// How much e^u (1 + |nu|), with chords of both factors, can exceed its values at a leaf's ends.
double Certifier::above_ends(const Leaf& leaf) {
  const double size = std::exp(leaf.end.l.real()) - std::exp(leaf.start.l.real()),
               shear = std::abs(leaf.end.w) - std::abs(leaf.start.w);
  return std::max(0.0, -size * shear) / 4;
}

/// One proof in progress.
class Certifier::Proof {
 public:
  Proof(const Certifier& certifier, const LogMap& map, const Bounds& bounds)
      : l(certifier.function_of(map.l)),
        w(certifier.function_of(map.w)),
        certifier_(certifier),
        second_(map.second),
        bounds_(bounds) {}

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
    const auto [first, second] = certifier_.halved(leaf, l, w);
    prove(first, depth - 1);
    prove(second, depth - 1);
  }

  Function l, w;
  Certificate result;

 private:
  /// A bound that cannot be proved from the values at the leaf's ends and the second derivatives.
  /// Empty when all are proved.
  std::optional<Bound> unproved_bound(const Leaf& leaf) const {
    const double dl = off_chord(leaf.piece, leaf.second_l, leaf.start.l, leaf.end.l),
                 dw = off_chord(leaf.piece, leaf.second_w, leaf.start.w, leaf.end.w);
    if (second_ == LogMap::Second::nu) {
      const double above = std::exp(dl) * above_ends(leaf);
      return first_of(unproved_bound_of_nu(leaf.start, dl, dw, above),
                      unproved_bound_of_nu(leaf.end, dl, dw, above));
    }
    const double below = below_chord(leaf.start.l, leaf.end.l);
    return first_of(unproved_bound_of_psi(leaf.start, dl, dw, below),
                    unproved_bound_of_psi(leaf.end, dl, dw, below));
  }

  /// An end of the leaf at which a bound is violated. Empty when there is none.
  std::optional<Complex> broken_end(const Leaf& leaf) const {
    const auto is_broken = [&](const Values& at) {
      return second_ == LogMap::Second::nu ? unproved_bound_of_nu(at, 0, 0, 0).has_value()
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

  /// A bound that l and w may violate if they differ from these values by up to dl and dw, and the
  /// largest size is greater by `above`. Empty when there is none.
  std::optional<Bound> unproved_bound_of_nu(const Values& at, double dl, double dw,
                                            double above) const {
    const double u = at.l.real(), w = std::abs(at.w) + dw;
    if (!(w <= bounds_.k)) return Bound::k;
    if (!(std::exp(u + dl) * (1 + w) + above <= bounds_.Sigma)) return Bound::Sigma;
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
};

Certificate Certifier::certify(const LogMap& map, const Bounds& bounds, int depth) const {
  Proof proof(*this, map, bounds);
  for (const Leaf& leaf : leaves_of(map, proof.l, proof.w)) proof.prove(leaf, depth);
  proof.result.holds = proof.result.unproved.empty();
  return std::move(proof.result);
}

/// Halves the leaf with the largest possible value of a quantity until that value is nearly
/// attained.
class Certifier::Search {
 public:
  Search(const Certifier& certifier, const LogMap& map)
      : certifier_(certifier),
        second_(map.second),
        l_(certifier.function_of(map.l)),
        w_(certifier.function_of(map.w)),
        leaves_(certifier.leaves_of(map, l_, w_)) {}

  Extremes run() { return {largest(kShear), 1 / largest(kInverse), largest(kSize)}; }

 private:
  enum Quantity { kShear, kInverse, kSize };  // |nu|, 1 / smallest size, and largest size

  /// A bound on a quantity where l and w differ from these values by up to dl and dw, and |f_z| may
  /// be smaller by `below`.
  double bound(Quantity quantity, const Values& at, double dl, double dw, double below) const {
    const double size = std::exp(at.l.real()), most = std::exp(dl) * size,
                 least = std::exp(-dl) * (size - below), w = std::abs(at.w) + dw;
    if (second_ == LogMap::Second::nu) {
      const double smallest = std::exp(-dl) * size * (1 - w);
      if (quantity == kShear) return w;
      if (quantity == kSize) return most * (1 + w);
      return smallest > 0 ? 1 / smallest : kUnknown;
    }
    if (quantity == kSize) return most + w;
    if (quantity == kShear) return least > 0 ? w / least : kUnknown;
    return least > w ? 1 / (least - w) : kUnknown;
  }
  double possible(Quantity quantity, const Leaf& leaf) const {
    const double dl = off_chord(leaf.piece, leaf.second_l, leaf.start.l, leaf.end.l),
                 dw = off_chord(leaf.piece, leaf.second_w, leaf.start.w, leaf.end.w),
                 below = second_ == LogMap::Second::nu ? 0 : below_chord(leaf.start.l, leaf.end.l);
    const double at_ends = std::max(bound(quantity, leaf.start, dl, dw, below),
                                    bound(quantity, leaf.end, dl, dw, below));
    const bool is_product = quantity == kSize && second_ == LogMap::Second::nu;
    return is_product ? at_ends + std::exp(dl) * above_ends(leaf) : at_ends;
  }

  double largest(Quantity quantity) const {
    constexpr double kClose = 0.01, kSmall = 1e-4;
    constexpr int kMostHalvings = 4000;
    std::priority_queue<std::pair<double, size_t>> queue;
    std::vector<Leaf> leaves = leaves_;
    double attained = 0;
    const auto add = [&](size_t i) {
      attained = std::max({attained, bound(quantity, leaves[i].start, 0, 0, 0),
                           bound(quantity, leaves[i].end, 0, 0, 0)});
      queue.emplace(possible(quantity, leaves[i]), i);
    };
    for (size_t i = 0; i < leaves.size(); ++i) add(i);
    for (int halvings = 0; halvings < kMostHalvings; ++halvings) {
      const auto [most, i] = queue.top();
      if (most <= attained * (1 + kClose) + kSmall) break;
      queue.pop();
      auto [first, second] = certifier_.halved(leaves[i], l_, w_);
      leaves[i] = first;
      leaves.push_back(second);
      add(i);
      add(leaves.size() - 1);
    }
    return queue.top().first;
  }

  static constexpr double kUnknown = std::numeric_limits<double>::infinity();
  const Certifier& certifier_;
  LogMap::Second second_;
  Function l_, w_;
  std::vector<Leaf> leaves_;
};

Extremes Certifier::extremes(const LogMap& map) const {
  return Search(*this, map).run();
}

}  // namespace holomorph
