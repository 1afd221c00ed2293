// Segments that meet at a vertex are evaluated at the same position, given as an offset from that
// vertex.
#include "core/cauchy/cauchy_rows.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/arithmetic.h"
#include "core/error.h"
#include "core/geometry/orientation.h"

namespace holomorph {
namespace {

constexpr double kNear = 0.05;     ///< in units of a vertex's reach: poles are omitted if closer
constexpr double kPole = 1e-5;     ///< closer than this, separate segments would lose digits
constexpr double kInside = 1e-12;  ///< in units of a vertex's reach
/// Factor of the tolerance outside the loop. A point on a cage must also count as a boundary point
/// of finer loops along this cage, although their vertices are rounded.
constexpr double kOutside = 3;
/// At a distance of this many rounding errors, a shift by one rounding error does not matter.
constexpr double kRecovers = 1e10;

}  // namespace

CauchyRows::CauchyRows(const Cage& cage, int order, AtVertices at_vertices)
    : cage_(cage), order_(order), at_vertices_(at_vertices) {
  for (Index e = 0; e < cage.size(); ++e) {
    offsets_.push_back(cage.control_offset(e));
    segments_.emplace_back(cage.controls(e));
    reach_.push_back(std::min(std::abs(cage.end_vertex(e) - cage.vertex(e)),
                              std::abs(cage.vertex(e) - cage.vertex(cage.before(e)))));
  }
}

Index CauchyRows::column(size_t segment, int m) const {
  return m < cage_.degree(static_cast<Index>(segment)) ? offsets_[segment] + m
                                                       : offsets_[next(segment)];
}

Complex CauchyRows::inwards(size_t vertex) const {
  const Complex in = -segments_[before(vertex)].derivative({1, 0}),
                out = segments_[vertex].derivative({0, 1});
  return kInside * reach_[vertex] * interior_bisector(out, in);
}

CauchyRows::EvalPoint CauchyRows::eval_point_on(const Contact& contact) const {
  const size_t segment = static_cast<size_t>(contact.segment);
  if (contact.is_vertex() && order_ > 0 && at_vertices_ == AtVertices::from_inside)
    return {{segments_[segment].start(), inwards(segment)}, {}};
  return {contact.point, contact};
}

CauchyRows::EvalPoint CauchyRows::eval_point_at(Complex z) const {
  const auto contact = contact_of(segments_, z, kOutside);
  return contact ? eval_point_on(*contact) : EvalPoint{z, {}};
}

bool CauchyRows::is_undefined(const EvalPoint& eval_point) const {
  return eval_point.on && eval_point.on->is_vertex() && order_ > 0;
}

/// The coordinates of one segment's control points.
VectorXc CauchyRows::coordinates(const EvalPoint& eval_point, size_t segment) const {
  const size_t after = next(segment);
  const Index number = static_cast<Index>(segment);
  const int degree = cage_.degree(number);
  if (eval_point.on && eval_point.on->is_vertex()) {
    const size_t vertex = static_cast<size_t>(eval_point.on->segment);
    if (segment == vertex || after == vertex) {
      const size_t last = before(vertex);
      const VertexLimit limit =
          vertex_limit(segments_[last], cage_.degree(static_cast<Index>(last)), segments_[vertex],
                       cage_.degree(eval_point.on->segment));
      return segment == vertex ? limit.own : limit.before;
    }
  }
  const auto is_near = [&](size_t vertex) {
    return order_ > 0 &&
           std::abs(segments_[vertex].start() - eval_point.point) < kNear * reach_[vertex];
  };
  const bool own = eval_point.on && eval_point.on->segment == number;
  return segment_coordinates(segments_[segment], degree, eval_point.point, order_,
                             own ? &*eval_point.on : nullptr, {is_near(segment), is_near(after)});
}

VectorXc CauchyRows::whole_row(const EvalPoint& eval_point) const {
  if (is_undefined(eval_point)) return row_of_limits(eval_point);
  VectorXc row = VectorXc::Zero(cage_.control_count());
  for (size_t e = 0; e < segments_.size(); ++e) {
    const VectorXc values = coordinates(eval_point, e);
    for (Index m = 0; m < values.size(); ++m) row[column(e, static_cast<int>(m))] += values[m];
  }
  if (order_ == 2) set_second_derivatives(row, eval_point.point);
  return row;
}

/// The row at a vertex, where the derivatives of some coordinates have no limit. A control point
/// has one if its Bernstein polynomial vanishes there, with as many of its derivatives.
VectorXc CauchyRows::row_of_limits(const EvalPoint& eval_point) const {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const size_t vertex = static_cast<size_t>(eval_point.on->segment), last = before(vertex);
  const EvalPoint inside{{segments_[vertex].start(), inwards(vertex)}, {}};
  VectorXc row = VectorXc::Zero(cage_.control_count());
  for (size_t e = 0; e < segments_.size(); ++e) {
    const VectorXc values = coordinates(e == vertex || e == last ? inside : eval_point, e);
    const Index degree = values.size() - 1;
    for (Index m = 0; m <= degree; ++m) {
      const bool diverges = (e == vertex && m <= order_) || (e == last && degree - m <= order_);
      row[column(e, static_cast<int>(m))] += diverges ? Complex(kNaN, kNaN) : values[m];
    }
  }
  return row;
}

VectorXc CauchyRows::row(Complex z) const {
  return whole_row(eval_point_at(z));
}

VectorXc CauchyRows::row(BoundaryPoint point) const {
  return whole_row(eval_point_on(contact_at(segments_, point.segment, point.t)));
}

/// Replaces the second derivatives at vertices between two straight edges by their rational form,
/// which is free of cancellation.
void CauchyRows::set_second_derivatives(VectorXc& row, const FinePoint& z) const {
  for (Index v = 0; v < cage_.size(); ++v) {
    const size_t vertex = static_cast<size_t>(v);
    if (cage_.degree(v) != 1 || cage_.degree(static_cast<Index>(before(vertex))) != 1) continue;
    const Complex last = cage_.vertex(cage_.before(v)), after = cage_.end_vertex(v);
    const Complex product = times(times(last - z, cage_.vertex(v) - z), after - z);
    row[offsets_[vertex]] = times(after - last, inverse(2 * kPi * times(kI, product)));
  }
}

std::optional<CauchyRows::Patch> CauchyRows::patch(Complex z) const {
  const auto contact = contact_of(segments_, z, kOutside);
  const EvalPoint eval_point = contact ? eval_point_on(*contact) : EvalPoint{z, {}};
  size_t own = contact ? static_cast<size_t>(contact->segment) : segments_.size();
  if (!contact && order_ > 0)
    for (size_t v = 0; v < segments_.size(); ++v)
      if (std::abs(segments_[v].start() - z) < kPole * reach_[v]) own = v;
  if (own == segments_.size()) return {};
  // Extend the range of segments in both directions along the loop, as far as a shift by a rounding
  // error matters.
  const Loops loops = cage_.loops();
  const Index loop = loops.loop_of(static_cast<Index>(own));
  const size_t first = static_cast<size_t>(loops.first(loop)),
               n = static_cast<size_t>(loops.length(loop));
  const auto segment = [&](size_t k) { return first + k % n; };
  const double far = kRecovers * rounding_of(segments_[own], z, 0.5, 0.5);
  const auto is_affected = [&](size_t k) {
    return std::abs(segments_[segment(k)].start() - z) < far;
  };
  size_t from = own - first + n - 1, to = own - first + n + 1;
  while (to - from < n && is_affected(from)) --from;
  while (to - from < n && is_affected(to + 1)) ++to;
  Patch patch;
  if (to - from + 3 >= n) {
    patch.values = whole_row(eval_point);
    patch.columns.resize(static_cast<size_t>(patch.values.size()));
    std::iota(patch.columns.begin(), patch.columns.end(), Index{0});
    return patch;
  }
  // Fill the columns of these segments. The adjacent segments on both sides contribute to them,
  // too.
  for (size_t k = from; k <= to; ++k)
    for (int m = 0; m < cage_.degree(static_cast<Index>(segment(k))); ++m)
      patch.columns.push_back(column(segment(k), m));
  patch.columns.push_back(column(segment(to + 1), 0));
  patch.values = VectorXc::Zero(static_cast<Index>(patch.columns.size()));
  Index at = 0;
  for (size_t k = from - 1; k <= to + 1; ++k) {
    const VectorXc values = coordinates(eval_point, segment(k));
    const Index degree = values.size() - 1;
    if (k < from) {
      patch.values[0] += values[degree];
    } else if (k > to) {
      patch.values[at] += values[0];
    } else {
      patch.values.segment(at, degree + 1) += values;
      at += degree;
    }
  }
  return patch;
}

namespace {

template <class Point>
MatrixXc rows(const Cage& cage, std::span<const Point> places, int order) {
  if (order < 0) throw Error(ErrorKind::bad_input, "the order of a derivative cannot be negative");
  const Orientation orientation(cage);
  const CauchyRows builder(orientation.turned(cage), order, CauchyRows::AtVertices::not_a_number);
  MatrixXc result(static_cast<Index>(places.size()), cage.control_count());
  const std::vector<Index> column = orientation.columns(cage);
  for (Index i = 0; i < result.rows(); ++i) {
    Point place = places[static_cast<size_t>(i)];
    if constexpr (std::is_same_v<Point, BoundaryPoint>) place = orientation.turned(place);
    const VectorXc row = builder.row(place);
    for (Index c = 0; c < row.size(); ++c) result(i, c) = row[column[static_cast<size_t>(c)]];
  }
  return result;
}

}  // namespace

MatrixXc cauchy_coordinates(const Cage& cage, std::span<const Complex> points, int order) {
  return rows(cage, points, order);
}

MatrixXc cauchy_coordinates(const Cage& cage, std::span<const BoundaryPoint> points, int order) {
  return rows(cage, points, order);
}

}  // namespace holomorph
