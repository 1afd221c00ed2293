#include "core/bounded/log_inbetween.h"

#include <algorithm>

#include "core/error.h"

namespace holomorph {

LogInbetween::LogInbetween(std::shared_ptr<const BoundaryBasis> basis,
                           std::shared_ptr<const Mesh> mesh, const Points& stations)
    : sums_(std::move(basis), std::move(mesh), stations),
      stations_(stations),
      locator_(sums_.mesh()) {}

double LogInbetween::mean_argument(const LogMap& map) const {
  return sums_.evaluated().function(map.l).imag().mean();
}

double LogInbetween::argument_at(const LogMap& map, size_t station) const {
  return sums_.evaluated().function(map.l)[locator_.vertex_near(stations_[station])].imag();
}

/// How much l and nu of two keys differ.
double LogInbetween::distance(const LogKey& a, const LogKey& b) const {
  return sums_.norm(sums_.of({{-1, &a.map}, {1, &b.map}}));
}

/// The derivative at key `at`, as weights of the keys: that of the parabola through the key and its
/// two neighbors. It is halved until the inner points of both Bezier curves at the key certify; 0
/// if a neighbor is missing.
std::array<double, 4> LogInbetween::velocity(const LogCurve& curve, size_t at) const {
  const LogKey *before = curve.keys[at - 1], *here = curve.keys[at], *after = curve.keys[at + 1];
  if (!before || !after) return {};
  for (const LogKey* key : {before, here, after})
    if (key->map.second != LogMap::Second::nu) return {};
  const double h0 = here->time - before->time, h1 = after->time - here->time;
  std::array<double, 4> velocity{};
  velocity[at - 1] = -h1 / (h0 * (h0 + h1));
  velocity[at + 1] = h0 / (h1 * (h0 + h1));
  velocity[at] = -velocity[at - 1] - velocity[at + 1];
  // Where the picture rests before or after the key, it must not move. Elsewhere this does not
  // matter (compare Fritsch, Carlson 1980).
  const double most = 3 * std::min(distance(*before, *here) / h0, distance(*here, *after) / h1);
  const double speed = sums_.norm(curve.sum(velocity, sums_));
  if (speed > most)
    for (double& weight : velocity) weight *= most / speed;
  const auto certifies = [&](double step, const LogKey& other) {
    std::array<double, 4> weights{};
    for (size_t k = 0; k < 4; ++k) weights[k] = step * velocity[k] + (k == at ? 1 : 0);
    constexpr double kRoom = 0.1;  // less than kGrowth, because curves may bulge
    return sums_.certify(curve.sum(weights, sums_), extremes_of(*here, other), kRoom);
  };
  constexpr int kHalvings = 4;
  for (int halving = 0; halving < kHalvings; ++halving) {
    if (certifies(-h0 / 3, *before) && certifies(h1 / 3, *after)) return velocity;
    for (double& weight : velocity) weight *= 0.5;
  }
  return {};
}

double LogInbetween::slide(const LogKey& from, const LogKey& to,
                           const std::vector<char>& held) const {
  const VectorXc at_from = sums_.integrals(sums_.of({{1, &from.map}})),
                 at_to = sums_.integrals(sums_.of({{1, &to.map}}));
  double most = 0;
  for (const double u : {0.25, 0.5, 0.75}) {
    const VectorXc off = sums_.integrals(sums_.of({{1 - u, &from.map}, {u, &to.map}})) -
                         (1 - u) * at_from - u * at_to;
    std::optional<Complex> first;
    for (size_t i = 0; i < held.size(); ++i) {  // integrals start at station 0
      if (!held[i]) continue;
      const Complex here = i == 0 ? Complex(0) : off[static_cast<Index>(i) - 1];
      if (first) most = std::max(most, std::abs(here - *first));
      if (!first) first = here;
    }
  }
  return most;
}

LogInterval LogInbetween::interval(const std::array<const LogKey*, 4>& keys, bool smooth,
                                   const std::vector<char>& held, size_t most) const {
  check(held.size() == stations_.size(), "in-between: one mark for each station");
  LogCurve curve{keys, {}, smooth};
  curve.controls[0][1] = curve.controls[1][1] = 1;
  curve.controls[2][2] = curve.controls[3][2] = 1;
  if (smooth) {
    const double third = (keys[2]->time - keys[1]->time) / 3;
    const auto start = velocity(curve, 1), end = velocity(curve, 2);
    for (size_t k = 0; k < 4; ++k) {
      curve.controls[1][k] += third * start[k];
      curve.controls[2][k] -= third * end[k];
    }
  }
  StillStations still;
  for (size_t i = 0; i < held.size(); ++i) {
    if (!held[i]) continue;
    still.numbers.push_back(static_cast<Index>(i));
    still.positions.push_back(stations_[i]);
  }
  still.kept = std::min(most, still.numbers.size());
  return LogInterval(sums_, locator_, curve, still);
}

}  // namespace holomorph
