// The disk's own map is given by three pairs of arc lengths, improved by Nelder and Mead's simplex.
#include "core/outline_start.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/arithmetic.h"
#include "core/curve.h"
#include "core/error.h"
#include "core/riemann.h"

namespace holomorph {
namespace {

constexpr Index kPoints = 800;
constexpr size_t kStride = 4;  ///< of the places that the search looks at
constexpr double kPinWeight = 1000;
constexpr size_t kPinsTried = 3;
constexpr int kShifts = 16, kOffsets = 2, kRefined = 6, kSimplexSteps = 60;

/// An outline seen from the disk: angles at equal arc lengths, increasing from the first on.
struct Seen {
  const Polyline* line;
  double length = 0, offset = 0;  ///< arc length of the first angle
  VectorXd angles;
  Points points;
  RiemannMap map;
  Points on_circle = {};  ///< e^(i angle)

  /// In the disk; what is outside the outline is just inside its nearest place.
  Complex in_disk(Complex z) const {
    constexpr double kMost = 1 - 1e-9, kInside = 0.98;
    if (winding_number(points, z) != 0) {
      const Complex w = map.at(z);
      return w * std::min(1.0, kMost / std::abs(w));
    }
    const Polyline::Nearest at = line->nearest(z);
    return std::polar(kInside, angle_at(line->length_at(at.segment, at.parameter)));
  }

  /// By linear interpolation.
  double angle_at(double arc_length) const {
    const double count = static_cast<double>(angles.size());
    double place = (arc_length - offset) / length;
    const double turns = std::floor(place);
    place = (place - turns) * count;
    const Index i = std::min(static_cast<Index>(place), angles.size() - 1);
    const double next = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2 * kPi;
    return angles[i] + (place - static_cast<double>(i)) * (next - angles[i]) + turns * 2 * kPi;
  }
  double arc_length_at(double angle) const {
    const double turns = std::floor((angle - angles[0]) / (2 * kPi));
    angle -= turns * 2 * kPi;
    const auto after = std::upper_bound(angles.begin(), angles.end(), angle);
    const Index i = static_cast<Index>(after - angles.begin()) - 1;
    const double next = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2 * kPi;
    const double place = static_cast<double>(i) + (angle - angles[i]) / (next - angles[i]);
    return offset + length * (place / static_cast<double>(angles.size()) + turns);
  }
};

/// The arc length of the boundary's place nearest to a point. A deepest point has several: the
/// first one, so that rounding does not choose.
double nearest_length(const Polyline& outline, Complex z) {
  constexpr double kEqual = 1 + 1e-6;
  const double least = outline.nearest(z).distance;
  const Points& points = outline.points();
  for (Index i = 0; i < outline.segments(); ++i) {
    const auto on = nearest_on_segment(points[static_cast<size_t>(i)],
                                       points[static_cast<size_t>(i + 1) % points.size()], z);
    if (on.distance <= kEqual * least) return outline.length_at(i, on.t);
  }
  return 0;
}

/// The zipper is best where it starts: at the place nearest to the middle.
Seen seen(const Polyline& outline) {
  const Complex centre = deepest_point(outline);
  const double offset = nearest_length(outline, centre);
  Points points;
  for (Index i = 0; i < kPoints; ++i)
    points.push_back(outline.at(offset + outline.length() * static_cast<double>(i) /
                                             static_cast<double>(kPoints)));
  RiemannMap map(points, centre);
  Seen result{&outline, outline.length(), offset, map.angles(), std::move(points), std::move(map)};
  for (const double angle : result.angles) result.on_circle.push_back(std::polar(1.0, angle));
  return result;
}

/// The map of the disk to itself that takes three points of the circle to three others, on angles.
class DiskMap {
 public:
  DiskMap(const std::array<double, 3>& from, const std::array<double, 3>& to) {
    const Eigen::Matrix2cd a = to_line(from), b = to_line(to);
    Eigen::Matrix2cd inverse;
    inverse << b(1, 1), -b(0, 1), -b(1, 0), b(0, 0);
    m_ = inverse * a;
  }
  Complex operator()(Complex z) const {
    return (m_(0, 0) * z + m_(0, 1)) / (m_(1, 0) * z + m_(1, 1));
  }
  /// Of a point of the circle.
  double angle(Complex z) const {
    const Complex above = m_(0, 0) * z + m_(0, 1), below = m_(1, 0) * z + m_(1, 1);
    return std::arg(above * std::conj(below));
  }

 private:
  /// Takes three points of the circle to 0, 1 and infinity.
  static Eigen::Matrix2cd to_line(const std::array<double, 3>& angles) {
    const Complex p = std::polar(1.0, angles[0]), q = std::polar(1.0, angles[1]),
                  r = std::polar(1.0, angles[2]);
    Eigen::Matrix2cd m;
    m << (q - r), -p * (q - r), (q - p), -r * (q - p);
    return m;
  }
  Eigen::Matrix2cd m_;
};

/// In the unit disk, squared.
double hyperbolic_square(Complex z, Complex w) {
  constexpr double kFarthest = 1 - 1e-9;
  const double rho = std::abs((z - w) / (1.0 - std::conj(w) * z));
  const double distance = 2 * std::atanh(std::min(rho, kFarthest));
  return distance * distance;
}

}  // namespace

struct ConformalStart::Search {
  Seen source, target;
  double upright = 0;                 ///< weight of the turn's square
  std::vector<Complex> pins, pinned;  ///< in the disks of source and target

  /// Where three arc lengths of the source go.
  struct Pairs {
    std::array<double, 3> from, to;
  };
  Pairs chosen{};

  DiskMap disk_map(const Pairs& pairs) const {
    std::array<double, 3> from{}, to{};
    for (size_t k = 0; k < 3; ++k) {
      from[k] = source.angle_at(pairs.from[k]);
      to[k] = target.angle_at(pairs.to[k]);
    }
    return {from, to};
  }

  /// Of every `stride`-th place.
  std::vector<double> target_lengths(const DiskMap& map, size_t stride = 1) const {
    std::vector<double> lengths;
    for (size_t i = 0; i < source.on_circle.size(); i += stride) {
      const double length = target.arc_length_at(map.angle(source.on_circle[i]));
      lengths.push_back(lengths.empty()
                            ? length - std::floor(length / target.length) * target.length
                            : next_in_turn(lengths.back(), length, target.length));
    }
    return lengths;
  }

  /// The mean square of ln of the relative stretch, and the turn's; infinite for pairs in the wrong
  /// order.
  double cost(const Pairs& pairs) const {
    for (size_t k = 0; k < 3; ++k) {
      const double gap =
          k < 2 ? pairs.to[k + 1] - pairs.to[k] : pairs.to[0] + target.length - pairs.to[2];
      if (!(gap > 1e-3 * target.length)) return std::numeric_limits<double>::infinity();
    }
    const DiskMap map = disk_map(pairs);
    const std::vector<double> t = target_lengths(map, kStride);
    double sum = 0, missed = 0;
    for (size_t i = 0; i < pinned.size(); ++i) missed += hyperbolic_square(map(pins[i]), pinned[i]);
    for (size_t i = 0; i < t.size(); ++i) {
      const double step = (i + 1 < t.size() ? t[i + 1] : t[0] + target.length) - t[i];
      constexpr double kLeast = 1e-12;  // of a turn: points that coincide
      const double log =
          std::log(std::max(step / target.length, kLeast) * static_cast<double>(t.size()));
      sum += log * log;
    }
    const double turned = upright > 0 ? turn(t) : 0;
    return sum / static_cast<double>(t.size()) + upright * turned * turned + kPinWeight * missed;
  }

  /// Nelder and Mead's simplex in the three target lengths.
  Pairs refined(const Pairs& start) const {
    struct Corner {
      Eigen::Vector3d x;
      double cost;
    };
    const auto at = [&](const Eigen::Vector3d& x) {
      Pairs pairs = start;
      std::copy(x.begin(), x.end(), pairs.to.begin());
      return Corner{x, cost(pairs)};
    };
    const Eigen::Vector3d origin(start.to[0], start.to[1], start.to[2]);
    std::array<Corner, 4> simplex{at(origin), at(origin), at(origin), at(origin)};
    for (int k = 0; k < 3; ++k)
      simplex[static_cast<size_t>(k + 1)] =
          at(origin + 0.03 * target.length * Eigen::Vector3d::Unit(k));
    for (int step = 0; step < kSimplexSteps; ++step) {
      std::ranges::sort(simplex, {}, &Corner::cost);
      const Eigen::Vector3d middle = (simplex[0].x + simplex[1].x + simplex[2].x) / 3;
      const Corner reflected = at(2 * middle - simplex[3].x);
      if (reflected.cost < simplex[0].cost) {
        const Corner expanded = at(3 * middle - 2 * simplex[3].x);
        simplex[3] = expanded.cost < reflected.cost ? expanded : reflected;
      } else if (reflected.cost < simplex[2].cost) {
        simplex[3] = reflected;
      } else if (const Corner contracted = at(0.5 * (middle + simplex[3].x));
                 contracted.cost < simplex[3].cost) {
        simplex[3] = contracted;
      } else {
        for (size_t k = 1; k < 4; ++k) simplex[k] = at(0.5 * (simplex[0].x + simplex[k].x));
      }
    }
    const Corner& best = *std::ranges::min_element(simplex, {}, &Corner::cost);
    Pairs pairs = start;
    std::copy(best.x.begin(), best.x.end(), pairs.to.begin());
    return pairs;
  }

  /// By how much a picture is turned of whose boundary every kStride-th place goes there.
  double turn(const std::vector<double>& lengths) const {
    Complex from_sum = 0, to_sum = 0, both = 0;
    const double n = static_cast<double>(lengths.size());
    for (size_t i = 0; i < lengths.size(); ++i) {
      const Complex from = source.points[kStride * i], to = target.line->at(lengths[i]);
      from_sum += from, to_sum += to, both += std::conj(from) * to;
    }
    return std::arg(both - std::conj(from_sum) * to_sum / n);
  }

  /// Three thirds of the source to three thirds of the target, from different places.
  std::vector<Pairs> by_thirds() const {
    std::vector<Pairs> starts;
    for (int offset = 0; offset < kOffsets; ++offset)
      for (int shift = 0; shift < kShifts; ++shift) {
        Pairs& pairs = starts.emplace_back();
        for (size_t k = 0; k < 3; ++k) {
          const double third = static_cast<double>(k) / 3;
          pairs.from[k] = source.length * (third + offset / 6.0);
          pairs.to[k] = target.length * (third + static_cast<double>(shift) / kShifts);
        }
      }
    return starts;
  }

  /// The disk's maps that take a pin to its place, by their turn.
  std::vector<Pairs> through_pin(Complex pin, Complex place) const {
    std::vector<Pairs> starts;
    for (int shift = 0; shift < kShifts; ++shift) {
      Pairs& pairs = starts.emplace_back();
      for (size_t k = 0; k < 3; ++k) {
        pairs.from[k] = source.length * static_cast<double>(k) / 3;
        const Complex z = std::polar(1.0, source.angle_at(pairs.from[k]));
        const Complex turned =
            std::polar(1.0, 2 * kPi * shift / kShifts) * (z - pin) / (1.0 - std::conj(pin) * z);
        const Complex image = (turned + place) / (1.0 + std::conj(place) * turned);
        pairs.to[k] = target.arc_length_at(std::arg(image));
        if (k > 0)
          pairs.to[k] += std::ceil((pairs.to[k - 1] - pairs.to[k]) / target.length) * target.length;
      }
    }
    return starts;
  }

  Pairs best() const {
    std::vector<std::pair<double, Pairs>> starts;
    const auto add = [&](const std::vector<Pairs>& more) {
      for (const Pairs& pairs : more) starts.emplace_back(cost(pairs), pairs);
    };
    add(by_thirds());
    for (size_t i = 0; i < std::min(pinned.size(), kPinsTried); ++i)
      add(through_pin(pins[i], pinned[i]));
    std::ranges::sort(starts, {}, [](const auto& start) { return start.first; });
    std::pair<double, Pairs> best = starts[0];
    for (size_t i = 0; i < kRefined; ++i) {
      const Pairs pairs = refined(starts[i].second);
      if (const double cost = this->cost(pairs); cost < best.first) best = {cost, pairs};
    }
    return best.second;
  }

  void want(const Points& places) {
    check(places.empty() || places.size() == pins.size(), "outline start: a place for each pin");
    pinned.clear();
    for (const Complex& z : places) pinned.push_back(target.in_disk(z));
  }

  Correspondence correspondence() const {
    Correspondence result;
    result.source_length = source.length;
    result.target_length = target.length;
    result.target = target_lengths(disk_map(chosen));
    for (Index i = 0; i < kPoints; ++i)
      result.source.push_back(source.offset + source.length * static_cast<double>(i) /
                                                  static_cast<double>(kPoints));
    result.badness = std::sqrt(cost(chosen));
    return result;
  }
};

Correspondence Correspondence::inverse() const {
  return {target, source, target_length, source_length, badness};
}

ConformalStart::ConformalStart(const Polyline& source, const Polyline& target, double upright,
                               const Points& pins)
    : search_(new Search{seen(source), seen(target), upright, {}, {}}) {
  for (const Complex& z : pins) search_->pins.push_back(search_->source.in_disk(z));
}

ConformalStart::~ConformalStart() = default;

bool ConformalStart::is_crowded() const {
  constexpr double kApart = 1e-12, kMost = 0.2;
  const auto crowded = [&](const Seen& seen) {
    Index close = 0;
    for (Index i = 1; i < seen.angles.size(); ++i)
      close += seen.angles[i] - seen.angles[i - 1] < kApart;
    return static_cast<double>(close) > kMost * static_cast<double>(seen.angles.size());
  };
  return crowded(search_->source) || crowded(search_->target);
}

Correspondence ConformalStart::best(const Points& pinned) {
  search_->want(pinned);
  search_->chosen = search_->best();
  return search_->correspondence();
}

Correspondence ConformalStart::follow(const Points& pinned) {
  search_->want(pinned);
  std::vector<Search::Pairs> starts{search_->chosen};
  if (!pinned.empty()) {
    const auto more = search_->through_pin(search_->pins[0], search_->pinned[0]);
    starts.insert(starts.end(), more.begin(), more.end());
  }
  search_->chosen = search_->refined(*std::ranges::min_element(
      starts, {}, [&](const Search::Pairs& pairs) { return search_->cost(pairs); }));
  return search_->correspondence();
}

Complex deepest_point(const Polyline& outline) {
  const Box box = box_of(outline.points());
  const Complex corner(box.left, box.bottom), size(box.width(), box.height());
  Complex best;
  double most = -1;
  constexpr int kCells = 24;
  for (double reach = 1; reach > 1e-14; reach /= kCells / 4.0) {
    const Complex from = most < 0 ? corner : best - 0.5 * reach * size;
    for (int i = 0; i < kCells; ++i)
      for (int j = 0; j < kCells; ++j) {
        const Complex z = from + reach * Complex((i + 0.5) / kCells * size.real(),
                                                 (j + 0.5) / kCells * size.imag());
        const double distance = outline.nearest(z).distance;
        if (distance > most && winding_number(outline.points(), z) != 0) most = distance, best = z;
      }
  }
  if (most < 0) throw Error(ErrorKind::bad_input, "the outline encloses nothing");
  return best;
}

double Correspondence::operator()(double length) const {
  const double turns = std::floor((length - source.front()) / source_length);
  length -= turns * source_length;
  const auto after = std::upper_bound(source.begin(), source.end(), length);
  const size_t i = static_cast<size_t>(after - source.begin()) - 1;
  const bool last = i + 1 == source.size();
  const double s = last ? source[0] + source_length : source[i + 1],
               t = last ? target[0] + target_length : target[i + 1];
  return target[i] + (length - source[i]) / (s - source[i]) * (t - target[i]) +
         turns * target_length;
}

}  // namespace holomorph
