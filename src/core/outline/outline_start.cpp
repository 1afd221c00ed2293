// Three pairs of arc lengths define the automorphism of the disk. The Nelder-Mead simplex method
// improves these pairs.
#include "core/outline/outline_start.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "core/arithmetic.h"
#include "core/error.h"
#include "core/geometry/deepest_point.h"
#include "core/geometry/polygon.h"
#include "core/outline/disk_map.h"
#include "core/outline/outline_samples.h"
#include "core/outline/riemann.h"

namespace holomorph {
namespace {

/// The number of points on each outline (more if it has thin parts), and the smallest distance
/// between points as a fraction of the length.
struct Sampling {
  Index points;
  double least;
};
constexpr Sampling kUsual{600, 1e-5}, kSharp{1000, 1e-9};
/// The largest number of points on an outline. The cost of a Riemann map grows with its square, and
/// an outline that needs more points is crowded in most cases.
constexpr size_t kMostPoints = 20'000;
/// Equally spaced points of each outline used by the search. More of them would move the minimum by
/// less than the iteration does.
constexpr Index kSearched = 120;
constexpr double kPinWeight = 1000;
constexpr size_t kPinsTried = 3;
constexpr int kShifts = 16, kOffsets = 2, kRefined = 6, kSimplexSteps = 60;

/// An outline and its Riemann map, with the functions from arc length to the angle on the circle
/// and back.
struct MappedOutline {
  const Polyline* line;
  RiemannMap map;
  PeriodicCurve angle_at, length_at;
  std::vector<double> lengths;         ///< equally spaced
  Points places = {}, on_circle = {};  ///< their points in the plane, and e^(i angle)

  double length() const { return line->length(); }

  /// The image of z in the disk. A point outside the outline is mapped to a point just inside the
  /// image of the nearest boundary point.
  Complex in_disk(Complex z) const {
    constexpr double kMost = 1 - 1e-9, kInside = 0.98;
    if (winding_number(line->points(), z) != 0) {
      const Complex w = map.at(z);
      return w * std::min(1.0, kMost / std::abs(w));
    }
    const Polyline::Nearest at = line->nearest(z);
    return std::polar(kInside, angle_at(line->length_at(at.segment, at.parameter)));
  }
};

/// The arc length of the boundary point nearest to z. A deepest point has several nearest points.
/// The first of these is taken, which makes the choice independent of rounding.
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

/// Rotates a list of arc lengths, once around, to start where the zipper is most accurate: near the
/// center and with a long step. The longer the first step, the more accurate all other steps are.
std::vector<double> from_long_step(std::vector<double> lengths, const Polyline& outline,
                                   Complex center) {
  constexpr double kNear = 1.4, kLonger = 1.001;
  const double near = kNear * outline.nearest(center).distance;
  size_t best = 0;
  double longest = 0;
  for (size_t i = 0; i + 1 < lengths.size(); ++i) {
    const double step = lengths[i + 1] - lengths[i];
    if (step > kLonger * longest && std::abs(outline.at(lengths[i]) - center) <= near)
      best = i, longest = step;
  }
  std::rotate(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(best), lengths.end());
  for (size_t i = lengths.size() - best; i < lengths.size(); ++i) lengths[i] += outline.length();
  return lengths;
}

/// None if the outline needs too many points.
std::optional<MappedOutline> mapped_outline(const Polyline& outline, Sampling sampling) {
  const Complex center = middle_point(outline);
  std::vector<double> lengths =
      graded_lengths(outline, nearest_length(outline, center), sampling.points, sampling.least);
  if (lengths.size() > kMostPoints) return {};
  lengths = from_long_step(std::move(lengths), outline, center);
  Points points;
  for (const double length : lengths) points.push_back(outline.at(length));
  RiemannMap map(points, center);
  std::vector<double> angles(map.angles().begin(), map.angles().end());
  const PeriodicCurve angle_at{std::move(lengths), std::move(angles), outline.length(), 2 * kPi};
  MappedOutline result{&outline, std::move(map), angle_at, angle_at.through_inverse(), {}};
  for (Index i = 0; i < kSearched; ++i) {
    const double length = angle_at.x[0] + outline.length() * static_cast<double>(i) / kSearched;
    result.lengths.push_back(length);
    result.places.push_back(outline.at(length));
    result.on_circle.push_back(std::polar(1.0, angle_at(length)));
  }
  return result;
}

}  // namespace

struct ConformalStart::Search {
  MappedOutline source, target;
  double upright = 0;                 ///< weight of the squared rotation
  Points given_pins;                  ///< positions in the plane
  std::vector<Complex> pins, pinned;  ///< positions in the disks of source and target

  Pairs chosen{};
  bool sharp = false;
  /// The maps that are not in use: the finer ones or the usual ones.
  std::optional<std::pair<MappedOutline, MappedOutline>> spare = {};

  DiskMap disk_map(const Pairs& pairs) const {
    std::array<double, 3> from{}, to{};
    for (size_t k = 0; k < 3; ++k) {
      from[k] = source.angle_at(pairs.from[k]);
      to[k] = target.angle_at(pairs.to[k]);
    }
    return {from, to};
  }

  /// The arc lengths on one outline that correspond to points on the other outline's circle, in
  /// order.
  static std::vector<double> lengths_on(const MappedOutline& to, const DiskMap& map,
                                        const Points& on_circle) {
    std::vector<double> lengths;
    for (const Complex& point : on_circle) {
      const double length = to.length_at(map.angle(point));
      lengths.push_back(lengths.empty() ? length - std::floor(length / to.length()) * to.length()
                                        : next_modulo(lengths.back(), length, to.length()));
    }
    return lengths;
  }

  /// The mean square of ln of the relative stretch between equal steps and the steps of `lengths`.
  static double stretch(const std::vector<double>& lengths, double total) {
    double sum = 0;
    for (size_t i = 0; i < lengths.size(); ++i) {
      const double step =
          (i + 1 < lengths.size() ? lengths[i + 1] : lengths[0] + total) - lengths[i];
      constexpr double kLeast = 1e-15;  // fraction of the whole length, for points that coincide
      const double log =
          std::log(std::max(step / total, kLeast) * static_cast<double>(lengths.size()));
      sum += log * log;
    }
    return sum / static_cast<double>(lengths.size());
  }

  /// The cost described at ConformalStart's constructor; infinite for pairs in the wrong order.
  double cost(const Pairs& pairs) const {
    for (size_t k = 0; k < 3; ++k) {
      const double gap =
          k < 2 ? pairs.to[k + 1] - pairs.to[k] : pairs.to[0] + target.length() - pairs.to[2];
      if (!(gap > 0)) return std::numeric_limits<double>::infinity();
    }
    const DiskMap map = disk_map(pairs);
    const std::vector<double> t = lengths_on(target, map, source.on_circle),
                              s = lengths_on(source, map.inverse(), target.on_circle);
    double missed = 0;
    for (size_t i = 0; i < pinned.size(); ++i) missed += hyperbolic_square(map(pins[i]), pinned[i]);
    const double turned = upright > 0 ? turn(t) : 0;
    return 0.5 * (stretch(t, target.length()) + stretch(s, source.length())) +
           upright * turned * turned + kPinWeight * missed;
  }

  /// Minimizes the cost over the three target lengths by the Nelder-Mead simplex method.
  Pairs refined(const Pairs& start) const {
    struct SimplexVertex {
      Eigen::Vector3d x;
      double cost;
    };
    const auto at = [&](const Eigen::Vector3d& x) {
      Pairs pairs = start;
      std::copy(x.begin(), x.end(), pairs.to.begin());
      return SimplexVertex{x, cost(pairs)};
    };
    const Eigen::Vector3d origin(start.to[0], start.to[1], start.to[2]);
    std::array<SimplexVertex, 4> simplex{at(origin), at(origin), at(origin), at(origin)};
    for (int k = 0; k < 3; ++k)
      simplex[static_cast<size_t>(k + 1)] =
          at(origin + 0.03 * target.length() * Eigen::Vector3d::Unit(k));
    for (int step = 0; step < kSimplexSteps; ++step) {
      std::ranges::sort(simplex, {}, &SimplexVertex::cost);
      const Eigen::Vector3d middle = (simplex[0].x + simplex[1].x + simplex[2].x) / 3;
      const SimplexVertex reflected = at(2 * middle - simplex[3].x);
      if (reflected.cost < simplex[0].cost) {
        const SimplexVertex expanded = at(3 * middle - 2 * simplex[3].x);
        simplex[3] = expanded.cost < reflected.cost ? expanded : reflected;
      } else if (reflected.cost < simplex[2].cost) {
        simplex[3] = reflected;
      } else if (const SimplexVertex contracted = at(0.5 * (middle + simplex[3].x));
                 contracted.cost < simplex[3].cost) {
        simplex[3] = contracted;
      } else {
        for (size_t k = 1; k < 4; ++k) simplex[k] = at(0.5 * (simplex[0].x + simplex[k].x));
      }
    }
    const SimplexVertex& best = *std::ranges::min_element(simplex, {}, &SimplexVertex::cost);
    Pairs pairs = start;
    std::copy(best.x.begin(), best.x.end(), pairs.to.begin());
    return pairs;
  }

  /// The angle by which the picture is rotated if the search points of its boundary are mapped to
  /// these arc lengths.
  double turn(const std::vector<double>& lengths) const {
    Complex from_sum = 0, to_sum = 0, both = 0;
    const double n = static_cast<double>(lengths.size());
    for (size_t i = 0; i < lengths.size(); ++i) {
      const Complex from = source.places[i], to = target.line->at(lengths[i]);
      from_sum += from, to_sum += to, both += std::conj(from) * to;
    }
    return std::arg(both - std::conj(from_sum) * to_sum / n);
  }

  /// Pairs that take thirds of the source to thirds of the target, from different starting points.
  std::vector<Pairs> by_thirds() const {
    std::vector<Pairs> starts;
    for (int offset = 0; offset < kOffsets; ++offset)
      for (int shift = 0; shift < kShifts; ++shift) {
        Pairs& pairs = starts.emplace_back();
        for (size_t k = 0; k < 3; ++k) {
          const double third = static_cast<double>(k) / 3;
          pairs.from[k] = source.length() * (third + offset / 6.0);
          pairs.to[k] = target.length() * (third + static_cast<double>(shift) / kShifts);
        }
      }
    return starts;
  }

  /// The automorphisms of the disk that take a pin to its target, with different rotations.
  std::vector<Pairs> through_pin(Complex pin, Complex point) const {
    std::vector<Pairs> starts;
    for (int shift = 0; shift < kShifts; ++shift) {
      Pairs& pairs = starts.emplace_back();
      for (size_t k = 0; k < 3; ++k) {
        pairs.from[k] = source.length() * static_cast<double>(k) / 3;
        const Complex z = std::polar(1.0, source.angle_at(pairs.from[k]));
        const Complex turned =
            std::polar(1.0, 2 * kPi * shift / kShifts) * (z - pin) / (1.0 - std::conj(pin) * z);
        const Complex image = (turned + point) / (1.0 + std::conj(point) * turned);
        pairs.to[k] = target.length_at(std::arg(image));
        if (k > 0)
          pairs.to[k] +=
              std::ceil((pairs.to[k - 1] - pairs.to[k]) / target.length()) * target.length();
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

  void map_pins() {
    pins.clear();
    for (const Complex& z : given_pins) pins.push_back(source.in_disk(z));
  }

  void set_targets(const Points& places) {
    check(places.empty() || places.size() == pins.size(), "outline start: one target for each pin");
    pinned.clear();
    for (const Complex& z : places) pinned.push_back(target.in_disk(z));
  }

  /// The correspondence through all sample points of both outlines.
  Correspondence correspondence() const {
    const DiskMap map = disk_map(chosen), back = map.inverse();
    std::vector<double> from = source.angle_at.x;
    Points on_circle;
    for (const double angle : source.angle_at.y) on_circle.push_back(std::polar(1.0, angle));
    std::vector<double> to = lengths_on(target, map, on_circle);
    const auto add = [](double length, double total, std::vector<double>& lengths) {
      lengths.push_back(length - std::floor((length - lengths.front()) / total) * total);
    };
    for (size_t i = 0; i < target.angle_at.x.size(); ++i) {
      add(source.angle_at.inverse_at(back.angle(std::polar(1.0, target.angle_at.y[i]))),
          source.length(), from);
      add(target.angle_at.x[i], target.length(), to);
    }
    // Sort each list separately. The map is increasing, but rounding may change the order.
    std::ranges::sort(from);
    std::ranges::sort(to);
    return {{std::move(from), std::move(to), source.length(), target.length()},
            std::sqrt(cost(chosen))};
  }
};

ConformalStart::ConformalStart(const Polyline& source, const Polyline& target, double upright,
                               const Points& pins) {
  std::optional<MappedOutline> from = mapped_outline(source, kUsual),
                               to = mapped_outline(target, kUsual);
  if (!from || !to) return;
  search_.reset(new Search{std::move(*from), std::move(*to), upright, pins, {}, {}, {}});
  search_->map_pins();
}

ConformalStart::~ConformalStart() = default;

bool ConformalStart::is_crowded() const {
  if (!search_) return true;
  constexpr double kApart = 1e-12, kMost = 0.2;
  const auto crowded = [&](const MappedOutline& mapped_outline) {
    Index close = 0;
    for (size_t i = 1; i < mapped_outline.lengths.size(); ++i)
      close += mapped_outline.angle_at(mapped_outline.lengths[i]) -
                   mapped_outline.angle_at(mapped_outline.lengths[i - 1]) <
               kApart;
    return static_cast<double>(close) > kMost * static_cast<double>(mapped_outline.lengths.size());
  };
  return crowded(search_->source) || crowded(search_->target);
}

bool ConformalStart::is_near_crowded() const {
  constexpr double kLeast = 5e-13 * 2 * kPi, kPart = 0.01;
  const auto crowded = [&](const MappedOutline& mapped_outline) {
    return std::ranges::any_of(mapped_outline.lengths, [&](double length) {
      return mapped_outline.angle_at(length + kPart * mapped_outline.length()) -
                 mapped_outline.angle_at(length) <
             kLeast;
    });
  };
  return crowded(search_->source) || crowded(search_->target);
}

Correspondence ConformalStart::best(const Points& pinned) {
  search_->set_targets(pinned);
  search_->chosen = search_->best();
  return search_->correspondence();
}

bool ConformalStart::is_sharp() const {
  return search_->sharp;
}

bool ConformalStart::use_sharp(bool sharp) {
  Search& search = *search_;
  if (sharp == search.sharp) return true;
  try {
    if (!search.spare) {
      std::optional<MappedOutline> source = mapped_outline(*search.source.line, kSharp),
                                   target = mapped_outline(*search.target.line, kSharp);
      if (!source || !target) return false;
      search.spare.emplace(std::move(*source), std::move(*target));
    }
  } catch (const Error&) {
    return false;  // finer vertices may coincide in the zipper even if coarser vertices do not
  }
  std::swap(search.source, search.spare->first);
  std::swap(search.target, search.spare->second);
  search.sharp = sharp;
  search.map_pins();
  return true;
}

Correspondence ConformalStart::last(const Points& pinned) {
  search_->set_targets(pinned);
  return search_->correspondence();
}

void ConformalStart::use_upright(double weight) {
  search_->upright = weight;
}

Correspondence ConformalStart::least_stretched() {
  const double upright = std::exchange(search_->upright, 0);
  Correspondence result = best();
  search_->upright = upright;
  return result;
}

const ConformalStart::Pairs& ConformalStart::pairs() const {
  return search_->chosen;
}

Correspondence ConformalStart::follow(const Points& pinned, const Pairs& from) {
  search_->set_targets(pinned);
  std::vector<Pairs> starts{from};
  if (!pinned.empty()) {
    const auto more = search_->through_pin(search_->pins[0], search_->pinned[0]);
    starts.insert(starts.end(), more.begin(), more.end());
  }
  search_->chosen = search_->refined(*std::ranges::min_element(
      starts, {}, [&](const Pairs& pairs) { return search_->cost(pairs); }));
  return search_->correspondence();
}

}  // namespace holomorph
