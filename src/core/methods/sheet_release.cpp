#include "core/methods/sheet_release.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace holomorph {
namespace {

/// Pins by how much two maps differ in their turns, the most first.
std::vector<size_t> most_turned(const SheetState& a, const SheetState& b) {
  std::vector<size_t> pins(a.turns.size());
  std::iota(pins.begin(), pins.end(), 0);
  std::ranges::stable_sort(pins, std::greater(),
                           [&](size_t i) { return std::abs(a.turns[i] - b.turns[i]); });
  return pins;
}

/// Turns that may lead to the draft where those of the draft do not, the likeliest ones first.
std::vector<Turns> candidates(const Turns& turns, const std::vector<size_t>& pins) {
  const Turns none(turns.size());
  std::vector<Turns> all{none};
  for (const size_t pin : pins) {
    if (!turns[pin]) continue;
    for (const double more : {-2 * kPi, 2 * kPi}) {
      all.push_back(turns);
      all.back()[pin] = stored_turn(*turns[pin] + more);
    }
    all.push_back(turns);
    all.back()[pin].reset();
    all.push_back(none);
    all.back()[pin] = turns[pin];
  }
  return all;
}

}  // namespace

std::optional<ReleasedSheet> released_sheet(const SheetSolver& solver,
                                            const SheetHandles::Target& target,
                                            const SheetState& draft, const SheetState& final,
                                            const std::stop_token& stop) {
  constexpr double kSame = 1e-3;  // of the size
  constexpr double kMuchNearer = 0.5;
  constexpr size_t kMostPins = 4;
  const SheetState shown = solver.settled(target, draft, stop);
  const auto apart = [&](const SheetState& state) {
    return (state.f - shown.f).cwiseAbs().maxCoeff() / solver.domain().size;
  };
  const double own = apart(final);
  if (own <= kSame) return {};
  std::vector<size_t> pins = most_turned(shown, final);
  pins.resize(std::min(pins.size(), kMostPins));
  std::optional<ReleasedSheet> best;
  double least = kMuchNearer * own;
  for (const Turns& turns : candidates(target.turns, pins)) {
    SheetHandles::Target other = target;
    other.turns = turns;
    SheetState state = solver.solved(other, stop);
    const double there = apart(state);
    if (there >= least) continue;
    least = there;
    best = {turns, std::move(state)};
    if (there <= kSame) break;
  }
  return best;
}

}  // namespace holomorph
