// The polygon is a mitered offset of the boundary. The offset is halved until the polygon is simple
// and contains the domain.
#include "core/cauchy/boundary_basis.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <numeric>

#include "core/arithmetic.h"
#include "core/cauchy/cauchy.h"
#include "core/cauchy/cauchy_array.h"
#include "core/error.h"
#include "core/geometry/orientation.h"
#include "core/solvers/dense.h"

namespace holomorph {
namespace {

/// The corners of a polygon, moved outward. Corner i ends up at distance distances[i] from the
/// lines of both adjacent edges, except at a spike.
Polygon mitered(const Polygon& polygon, const std::vector<double>& distances) {
  const PolygonView view = polygon;
  const Loops loops = view.loops();
  constexpr double kLongest = 12;  // length of a miter, in units of the distance
  Polygon outer{{}, polygon.starts};
  for (Index i = 0; i < view.size(); ++i) {
    const Complex before = view[i] - view[loops.before(i)], after = view[loops.next(i)] - view[i];
    const Complex u = -kI * before / std::abs(before), v = -kI * after / std::abs(after);
    Complex miter = u + v;
    const double size = std::norm(miter);
    // At a spike, the miter would be too long and is shortened. In a notch, it must keep its full
    // length; otherwise, the sides would intersect before its end.
    const bool spike = cross(before, after) >= 0;
    if (spike && size < 4 / (kLongest * kLongest))
      miter = kLongest * before / std::abs(before);
    else
      miter *= 2 / std::max(size, 1e-12);
    outer.points.push_back(view[i] + distances[static_cast<size_t>(i)] * miter);
  }
  return outer;
}

/// The number of equal parts into which each segment is divided: at least one each, about `wanted`
/// in total, and enough in each hole for a round shape unless there are many.
std::vector<int> parts_of(const Cage& domain, const std::vector<double>& lengths, int wanted) {
  double total = 0;
  for (const double length : lengths) total += length;
  const Loops loops = domain.loops();
  constexpr int kFewestInHoles = 300;
  const int around = std::clamp(kFewestInHoles / static_cast<int>(loops.count()), 5, 12);
  std::vector<int> parts;
  for (Index e = 0; e < domain.size(); ++e) {
    const Index loop = loops.loop_of(e);
    const int length = static_cast<int>(loops.length(loop)),
              fewest = loop == 0 ? 1 : (around + length - 1) / length;
    parts.push_back(std::max(
        fewest, static_cast<int>(std::lround(wanted * lengths[static_cast<size_t>(e)] / total))));
  }
  return parts;
}

/// The piece divided into parts of equal parameter length.
std::vector<BoundaryPiece> subdivided(const Cage& domain, const BoundaryPiece& piece, int parts) {
  std::vector<BoundaryPiece> pieces;
  const double step = (piece.to - piece.from) / parts;
  for (int k = 0; k < parts; ++k)
    pieces.push_back(piece_of(domain, piece.segment, piece.from + k * step,
                              k + 1 == parts ? piece.to : piece.from + (k + 1) * step));
  return pieces;
}

/// An upper bound on the distance between a piece and its chord.
double sagitta(const BoundaryPiece& piece) {
  return piece.bend / 8;
}

/// About `wanted` pieces of equal length, at least one for each segment, and more where they would
/// deviate from their chords by more than `flat`.
std::vector<BoundaryPiece> cut(const Cage& domain, int wanted, double flat) {
  const std::vector<int> parts = parts_of(domain, lengths_of(domain), wanted);
  std::vector<BoundaryPiece> pieces;
  for (Index e = 0; e < domain.size(); ++e)
    for (const BoundaryPiece& piece :
         subdivided(domain, piece_of(domain, e, 0, 1), parts[static_cast<size_t>(e)])) {
      constexpr double kMostParts = 6;
      const double more = std::ceil(std::sqrt(sagitta(piece) / flat));
      const auto finer =
          subdivided(domain, piece, static_cast<int>(std::clamp(more, 1.0, kMostParts)));
      pieces.insert(pieces.end(), finer.begin(), finer.end());
    }
  return pieces;
}

/// The starts of the pieces, as one loop for each loop of the domain.
Polygon starts_of(const Cage& domain, const std::vector<BoundaryPiece>& pieces) {
  const Loops loops = domain.loops();
  Polygon starts;
  for (size_t i = 0; i < pieces.size(); ++i) {
    if (i > 0 && loops.loop_of(pieces[i].segment) != loops.loop_of(pieces[i - 1].segment))
      starts.starts.push_back(static_cast<Index>(i));
    starts.points.push_back(pieces[i].start);
  }
  return starts;
}

bool crosses(Complex a, Complex b, Complex c, Complex d) {
  return cross(b - a, c - a) * cross(b - a, d - a) <= 0 &&
         cross(d - c, a - c) * cross(d - c, b - c) <= 0;
}

/// Whether a polygon is simple and surrounds `inner` at a distance of more than `distance`
/// everywhere, also in its holes.
bool is_around(PolygonView polygon, PolygonView inner, double distance) {
  if (self_crossing(polygon)) return false;
  for (Index l = 0; l < polygon.loops().count(); ++l)  // a large offset turns a hole inside out
    if ((signed_area(polygon.loop(l)) > 0) != (l == 0)) return false;
  for (const Complex& z : inner.points())
    if (winding_number(polygon, z) != 1 || nearest_on_polygon(polygon, z).distance <= distance)
      return false;
  bool around = true;
  polygon.for_each_edge([&](Index, Complex a, Complex b) {
    if (!around) return;
    around = winding_number(inner, a) == 0 && nearest_on_polygon(inner, a).distance > distance;
    if (!around) return;
    inner.for_each_edge(
        [&](Index, Complex c, Complex d) { around = around && !crosses(a, b, c, d); });
  });
  return around;
}

/// A polygon around the domain, and the boundary piece that belongs to each of its edges.
struct Surrounding {
  Polygon polygon;
  std::vector<BoundaryPiece> pieces;
};

Surrounding surrounding(const Cage& domain, int wanted, double distance) {
  const FlatCage fine = flattened(domain);
  for (int vertices = wanted; vertices <= 4 * wanted; vertices *= 2) {
    const std::vector<BoundaryPiece> pieces = cut(domain, vertices, 1.5 * distance);
    const Polygon inner = starts_of(domain, pieces);
    const Loops loops = PolygonView(inner).loops();
    double off = distance;
    for (int halving = 0; halving < 12; ++halving, off *= 0.5) {
      std::vector<double> distances;  // chords of curves cut off parts of the domain
      for (size_t i = 0; i < pieces.size(); ++i) {
        const BoundaryPiece& before =
            pieces[static_cast<size_t>(loops.before(static_cast<Index>(i)))];
        distances.push_back(off + 1.5 * std::max(sagitta(pieces[i]), sagitta(before)));
      }
      const Polygon outer = mitered(inner, distances);
      if (is_around(outer, fine, 0.3 * off)) return {outer, pieces};
    }
  }
  throw Error(
      ErrorKind::bad_input,
      "this method cannot be used with this cage: parts of the cage nearly touch; move them apart");
}

}  // namespace

std::vector<double> lengths_of(const Cage& domain) {
  std::vector<double> lengths;
  for (Index e = 0; e < domain.size(); ++e) {
    const Points controls = domain.controls(e);
    constexpr int kSteps = 32;
    double length = 0;
    const int steps = is_straight(domain, e) ? 1 : kSteps;
    for (int k = 0; k < steps; ++k)
      length += std::abs(bezier_point(controls, (k + 1.0) / steps) -
                         bezier_point(controls, static_cast<double>(k) / steps));
    lengths.push_back(length);
  }
  return lengths;
}

BoundaryPiece piece_of(const Cage& domain, Index segment, double from, double to) {
  BoundaryPiece piece{segment, from, to, 0, 0, 0, 0};
  if (domain.degree(segment) == 1) {
    const Complex a = domain.vertex(segment), b = domain.end_vertex(segment);
    piece.start = from == 0 ? a : a + from * (b - a);
    piece.end = to == 1 ? b : a + to * (b - a);
    piece.length = std::abs(piece.end - piece.start);
    return piece;
  }
  Points controls = domain.controls(segment);
  if (to < 1) controls = split(controls, to).before;
  if (from > 0) controls = split(controls, from / to).after;
  piece.start = controls.front();
  piece.end = controls.back();
  const double n = static_cast<double>(controls.size()) - 1;
  for (size_t m = 0; m + 1 < controls.size(); ++m)
    piece.length = std::max(piece.length, n * std::abs(controls[m + 1] - controls[m]));
  if (is_straight(domain, segment)) return piece;
  for (size_t m = 0; m + 2 < controls.size(); ++m)
    piece.bend = std::max(
        piece.bend, n * (n - 1) * std::abs(controls[m] - 2.0 * controls[m + 1] + controls[m + 2]));
  return piece;
}

namespace {

/// The vertices of a loop between which coefficients are interpolated: one for each `spacing` along
/// the loop, and those where the loop bends.
std::vector<Index> kept_vertices(PolygonView polygon, Index loop, double spacing) {
  constexpr double kMostBent = 1.2;  // length of the path between two kept vertices over its chord
  const Loops loops = polygon.loops();
  std::vector<Index> kept{loops.first(loop)};
  double along = 0, kept_at = 0, mark = spacing;
  for (Index i = loops.first(loop) + 1; i < loops.end(loop); ++i) {
    along += std::abs(polygon[i] - polygon[i - 1]);
    const Complex next = polygon[loops.next(i)];
    const double path = along - kept_at + std::abs(next - polygon[i]);
    if (along < mark && path < kMostBent * std::abs(next - polygon[kept.back()])) continue;
    kept.push_back(i);
    kept_at = along;
    mark = spacing * (std::floor(along / spacing) + 1);
  }
  return kept;
}

/// The vertices that have coefficients of their own in a basis with at most about `most` unknowns,
/// for each loop.
std::vector<std::vector<Index>> kept_vertices(PolygonView polygon, Index most) {
  const Loops loops = polygon.loops();
  std::vector<double> lengths(static_cast<size_t>(loops.count()), 0);
  double around = 0;
  polygon.for_each_edge([&](Index i, Complex a, Complex b) {
    lengths[static_cast<size_t>(loops.loop_of(i))] += std::abs(b - a);
    around += std::abs(b - a);
  });
  std::vector<std::vector<Index>> kept;
  for (Index l = 0; l < loops.count(); ++l) {
    constexpr double kFewest = 12;
    if (most < polygon.size()) {
      kept.push_back(kept_vertices(
          polygon, l,
          std::min(around / static_cast<double>(most), lengths[kept.size()] / kFewest)));
    } else {
      kept.emplace_back(static_cast<size_t>(loops.length(l)));
      std::iota(kept.back().begin(), kept.back().end(), loops.first(l));
    }
  }
  return kept;
}

/// The matrix that extends the coefficients at these vertices to all vertices, without changing the
/// values of 1 and z. Two vertices of each hole have the coefficient 0.
Eigen::SparseMatrix<Complex> extension(PolygonView polygon,
                                       const std::vector<std::vector<Index>>& kept) {
  std::vector<Eigen::Triplet<Complex>> entries;
  int columns = 0;
  for (size_t l = 0; l < kept.size(); ++l) {
    const size_t count = kept[l].size();
    std::vector<int> column(count, -1);
    for (size_t k = 0; k < count; ++k)
      if (l == 0 || (k != 0 && k != count / 2)) column[k] = columns++;
    const auto add = [&](Index vertex, size_t k, Complex weight) {
      if (column[k] >= 0) entries.emplace_back(static_cast<int>(vertex), column[k], weight);
    };
    for (size_t k = 0; k < count; ++k) {
      const size_t after = (k + 1) % count;
      const Index first = kept[l][k], last = kept[l][after];
      add(first, k, 1);
      for (Index i = polygon.loops().next(first); i != last; i = polygon.loops().next(i)) {
        const Complex part = quotient(polygon[i] - polygon[first], polygon[last] - polygon[first]);
        add(i, k, 1.0 - part);
        add(i, after, part);
      }
    }
  }
  Eigen::SparseMatrix<Complex> matrix(polygon.size(), columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

BoundaryBasis::BoundaryBasis(const Cage& domain, int basis, int samples, std::optional<int> most)
    : domain_(oriented(domain)) {
  check_rest_cage(domain);
  const double around = perimeter(flattened(domain_));
  const int vertices = std::max(basis, 25);
  constexpr double kOffset = 0.05;  // in mean edge lengths: for 50 vertices, 0.1 % of the loop
  Surrounding around_domain = surrounding(domain_, vertices, kOffset * around / vertices);
  polygon_ = std::move(around_domain.polygon);
  const int each = std::max(2, static_cast<int>(std::lround(1.0 * samples / vertices)));
  for (const BoundaryPiece& piece : around_domain.pieces)
    for (const BoundaryPiece& part : subdivided(domain_, piece, each)) pieces_.push_back(part);
  samples_ = starts_of(domain_, pieces_);
  const Eigen::SparseMatrix<Complex> extended =
      extension(polygon_, kept_vertices(polygon_, most.value_or(static_cast<int>(size()))));
  MatrixXc c = values(samples_.points) * extended;
  check(c.rows() >= c.cols(), "boundary basis: at least as many samples as vertices");
  const double root = std::sqrt(static_cast<double>(c.rows()));
  const auto [q, r] = orthonormal(std::move(c));
  const MatrixXc inverse = root * solve_upper(r, MatrixXc::Identity(r.rows(), r.cols()));
  coefficients_ = extended * inverse;
  at_samples_ = root * q;
  one_ = at_samples_.adjoint().rowwise().mean();
}

MatrixXc BoundaryBasis::whitened(const MatrixXc& values) const {
  return matrix_product(values, coefficients_);
}

VectorXd BoundaryBasis::sample_weights() const {
  VectorXd weights = VectorXd::Zero(static_cast<Index>(pieces_.size()));
  for (Index i = 0; i < weights.size(); ++i) {
    const BoundaryPiece& piece = pieces_[static_cast<size_t>(i)];
    const double half = 0.5 * std::abs(piece.end - piece.start);
    weights[i] += half;
    weights[sample_loops().next(i)] += half;
  }
  return weights / weights.sum();
}

VectorXc BoundaryBasis::coefficients(const VectorXc& unknowns) const {
  return coefficients_ * unknowns;
}

Points BoundaryBasis::inset(double share) const {
  const FlatCage fine = flattened(domain_);
  const PolygonView at = samples_;
  Points inner = samples_.points;
  for (Index i = 0; i < at.size(); ++i) {
    const Complex in = at[sample_loops().before(i)] - at[i],
                  out = at[sample_loops().next(i)] - at[i];
    Complex step = share * std::min(std::abs(in), std::abs(out)) * interior_bisector(out, in);
    // Do not move beyond the middle of a thin part.
    for (int halving = 0; halving < 20 && (winding_number(fine, at[i] + step) != 1 ||
                                           winding_number(fine, at[i] + 2.0 * step) != 1);
         ++halving)
      step *= 0.5;
    inner[static_cast<size_t>(i)] += step;
  }
  return inner;
}

MatrixXc BoundaryBasis::values(std::span<const Complex> points, int order) const {
  return as_complex(planar_coordinates<double>(polygon_cage(polygon_), points, order));
}

HolomorphicFit::Fit HolomorphicFit::operator()(const VectorXc& values) const {
  VectorXc x = unknowns(values);
  return {x, rows_ * x};
}

}  // namespace holomorph
