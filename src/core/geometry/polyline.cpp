// A tree of bounding boxes around runs of segments. Runs are halved until they have at most four
// segments.
#include "core/geometry/polyline.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace holomorph {
namespace {

constexpr Index kLeaf = 4;

}  // namespace

Polyline::Polyline(Points points, bool closed) : points_(std::move(points)), closed_(closed) {
  check(points_.size() >= (closed ? 3u : 2u), "polyline: two points or more, three if closed");
  lengths_.push_back(0);
  for (Index i = 0; i < segments(); ++i)
    lengths_.push_back(lengths_.back() + std::abs(end(i) - start(i)));
  Index nodes = 1;
  for (Index runs = segments(); runs > kLeaf; runs = (runs + 1) / 2) nodes = 2 * nodes + 1;
  boxes_.resize(static_cast<size_t>(nodes));
  build(0, 0, segments());
}

Polyline::Box Polyline::build(Index node, Index first, Index count) {
  Box box{start(first).real(), start(first).imag(), start(first).real(), start(first).imag()};
  const auto grow = [&](Complex z) {
    box.left = std::min(box.left, z.real()), box.right = std::max(box.right, z.real());
    box.bottom = std::min(box.bottom, z.imag()), box.top = std::max(box.top, z.imag());
  };
  if (count <= kLeaf) {
    for (Index i = first; i < first + count; ++i) grow(start(i)), grow(end(i));
  } else {
    const Index half = (count + 1) / 2;
    for (const Box& part :
         {build(2 * node + 1, first, half), build(2 * node + 2, first + half, count - half)})
      grow({part.left, part.bottom}), grow({part.right, part.top});
  }
  boxes_[static_cast<size_t>(node)] = box;
  return box;
}

Polyline::Nearest Polyline::nearest(Complex z, Index hint) const {
  Nearest best{start(0), 0, 0, std::abs(z - start(0))};
  try_segment(z, std::clamp<Index>(hint, 0, segments() - 1), best);
  search(z, 0, 0, segments(), best);
  return best;
}

void Polyline::try_segment(Complex z, Index segment, Nearest& best) const {
  const Complex from = start(segment), direction = end(segment) - from;
  const double t = std::clamp(dot(z - from, direction) / std::norm(direction), 0.0, 1.0);
  const Complex point = from + t * direction;
  const double distance = std::abs(z - point);
  if (distance < best.distance) best = {point, segment, t, distance};
}

void Polyline::search(Complex z, Index node, Index first, Index count, Nearest& best) const {
  const Box& box = boxes_[static_cast<size_t>(node)];
  const double dx = std::max({box.left - z.real(), 0.0, z.real() - box.right}),
               dy = std::max({box.bottom - z.imag(), 0.0, z.imag() - box.top});
  if (dx * dx + dy * dy >= best.distance * best.distance) return;
  if (count <= kLeaf) {
    for (Index i = first; i < first + count; ++i) try_segment(z, i, best);
    return;
  }
  const Index half = (count + 1) / 2;
  search(z, 2 * node + 1, first, half, best);
  search(z, 2 * node + 2, first + half, count - half, best);
}

Complex Polyline::at(double length) const {
  const Location location = location_at(length);
  return start(location.segment) +
         location.parameter * (end(location.segment) - start(location.segment));
}

Polyline::Location Polyline::location_at(double length) const {
  if (closed_) length -= std::floor(length / this->length()) * this->length();
  length = std::clamp(length, 0.0, this->length());
  const auto after = std::upper_bound(lengths_.begin(), lengths_.end(), length);
  const Index segment =
      std::clamp<Index>(static_cast<Index>(after - lengths_.begin()) - 1, 0, segments() - 1);
  const size_t i = static_cast<size_t>(segment);
  return {segment, (length - lengths_[i]) / (lengths_[i + 1] - lengths_[i])};
}

double Polyline::length_at(Index segment, double parameter) const {
  const size_t i = static_cast<size_t>(segment);
  return lengths_[i] + parameter * (lengths_[i + 1] - lengths_[i]);
}

double Polyline::diagonal() const {
  const Box& box = boxes_[0];
  return std::hypot(box.right - box.left, box.top - box.bottom);
}

// The largest extent over many directions. It is at least the diameter times the cosine of half the
// angle between two directions.
double Polyline::diameter() const {
  constexpr int kDirections = 50;
  double widest = 0;
  for (int k = 0; k < kDirections; ++k) {
    const Complex direction = std::polar(1.0, kPi * k / kDirections);
    const auto [least, most] =
        std::ranges::minmax(points_, {}, [&](Complex z) { return dot(direction, z); });
    widest = std::max(widest, dot(direction, most - least));
  }
  return widest;
}

Points without_repeats(const Points& points) {
  Points kept;
  for (const Complex& z : points)
    if (kept.empty() || z != kept.back()) kept.push_back(z);
  return kept;
}

void check_stroke(std::span<const Complex> points) {
  for (const Complex& z : points)
    if (!is_finite(z))
      throw Error(ErrorKind::bad_input, "the stroke has a point that is not finite");
  if (std::ranges::all_of(points, [&](Complex z) { return z == points[0]; }))
    throw Error(ErrorKind::bad_input,
                "the stroke has no length; draw it through two different points");
}

Points at_equal_lengths(const Polyline& line, Index count) {
  Points points;
  const double steps = static_cast<double>(line.closed() ? count : count - 1);
  for (Index i = 0; i < count; ++i)
    points.push_back(line.at(line.length() * static_cast<double>(i) / steps));
  return points;
}

double one_sided_distance(const Polyline& a, const Polyline& b) {
  double worst = 0;
  Index hint = 0;
  const auto measure = [&](Complex z) {
    const Polyline::Nearest nearest = b.nearest(z, hint);
    hint = nearest.segment;
    worst = std::max(worst, nearest.distance);
  };
  const Points& points = a.points();
  for (Index i = 0; i < a.segments(); ++i) {
    const Complex from = points[static_cast<size_t>(i)],
                  to = points[static_cast<size_t>(i + 1) % points.size()];
    measure(from);
    measure(0.5 * (from + to));
  }
  if (!a.closed()) measure(points.back());
  return worst;
}

}  // namespace holomorph
