#include "core/methods/sheet_release.h"

#include <algorithm>
#include <cmath>

namespace holomorph {
namespace {

/// The pins with turns whose turns differ most between two maps, the most different one first.
std::vector<size_t> most_turned(const Turns& turns, const SheetState& a, const SheetState& b) {
  constexpr size_t kMost = 4;
  std::vector<size_t> pins;
  for (size_t i = 0; i < turns.size(); ++i)
    if (turns[i]) pins.push_back(i);
  std::ranges::stable_sort(pins, std::greater(),
                           [&](size_t i) { return std::abs(a.turns[i] - b.turns[i]); });
  pins.resize(std::min(pins.size(), kMost));
  return pins;
}

/// Turns that may lead to a map where the given ones do not, the likeliest ones first.
std::vector<Turns> candidates(const Turns& turns, const std::vector<size_t>& pins,
                              const SheetState& map) {
  std::vector<Turns> all;
  const auto add = [&](Turns each) {
    if (each != turns && std::ranges::find(all, each) == all.end()) all.push_back(std::move(each));
  };
  const auto with = [](Turns each, size_t pin, std::optional<double> turn) {
    each[pin] = turn;
    return each;
  };
  const Turns none(turns.size());
  Turns own = turns;
  for (size_t i = 0; i < turns.size(); ++i)
    if (turns[i]) own[i] = stored_turn(map.turns[i]);
  add(own);
  add(none);
  for (const size_t pin : pins) {
    for (const double more : {-2 * kPi, 2 * kPi})
      add(with(turns, pin, stored_turn(*turns[pin] + more)));
    add(with(turns, pin, std::nullopt));
    add(with(none, pin, turns[pin]));
  }
  return all;
}

}  // namespace

std::optional<ReleasedSheet> released_sheet(const SheetSolver& solver,
                                            const SheetHandles::Target& target,
                                            const SheetState& draft, const SheetState& found,
                                            const std::stop_token& stop) {
  constexpr double kSame = 1e-3;  // of the size
  constexpr double kMuchNearer = 0.5;
  const SheetState shown = solver.settled(target, draft, stop);
  const auto apart = [&](const SheetState& state) {
    return (state.f - shown.f).cwiseAbs().maxCoeff() / solver.domain().size;
  };
  const double own = apart(found);
  if (own <= kSame) return {};
  const std::vector<size_t> pins = most_turned(target.turns, shown, found);
  std::optional<ReleasedSheet> best;
  double least = kMuchNearer * own;
  for (const Turns& turns : candidates(target.turns, pins, shown)) {
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
