// A single table names all limits, for error messages and the command line.
#include "scene/budget.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <mutex>

namespace holomorph {
namespace {

struct Current {
  std::mutex mutex;
  Budget budget;
};
Current& current() {
  static Current current;
  return current;
}

/// The amount as text, rounded up to at least three digits.
std::string shown(double amount) {
  char text[40];
  const double step = amount >= 100 ? 1 : std::pow(10, std::floor(std::log10(amount)) - 2);
  std::snprintf(text, sizeof text, "%.10g", std::ceil(amount / step - 1e-9) * step);
  return text;
}

}  // namespace

Budget budget() {
  const std::lock_guard lock(current().mutex);
  return current().budget;
}

void set_budget(const Budget& budget) {
  const std::lock_guard lock(current().mutex);
  current().budget = budget;
}

const std::vector<BudgetOption>& budget_options() {
  static const std::vector<BudgetOption> all{
      {"--max-pixels", "megapixels", "Limit for all pictures of a scene", &Budget::pixels, 1e6},
      {"--max-coordinates", "million coordinates",
       "Limit for control points times mesh vertices or points", &Budget::coordinates, 1e6},
      {"--max-keyframe-memory", "MB", "Limit for the memory of the maps at keyframes",
       &Budget::operators, 1e6},
      {"--max-scene-size", "MB", "Limit for the size of a scene file", &Budget::scene, 1e6},
      {"--max-groups", "levels", "Limit for nested groups in an SVG file", &Budget::groups, 1},
      {"--max-frames", "frames", "Limit for one film", &Budget::frames, 1},
      {"--max-reader-seconds", "s",
       "Limit for the processor time of a program that reads a drawing, or a frame of a film",
       &Budget::reader_seconds, 1},
      {"--max-reader-memory", "MB", "Limit for the memory of such a program",
       &Budget::reader_memory, 1e6}};
  return all;
}

ProgramLimits reader_limits() {
  const Budget most = budget();
  return {most.reader_seconds, most.reader_memory};
}

std::string limit_text(double Budget::*limit) {
  const auto found = std::ranges::find(budget_options(), limit, &BudgetOption::limit);
  const double most = budget().*limit / found->per_unit;
  return shown(most) + " " + found->unit + ". Start with " + found->name + " " + shown(2 * most) +
         " to raise it";
}

void check_budget(double Budget::*limit, double amount, const std::string& what) {
  const double most = budget().*limit;
  if (!(amount > most)) return;
  const auto found = std::ranges::find(budget_options(), limit, &BudgetOption::limit);
  const std::string needed = shown(amount / found->per_unit);
  throw Error(ErrorKind::bad_input, what + " " + needed + " " + found->unit + "; the limit is " +
                                        shown(most / found->per_unit) + ". Start with " +
                                        found->name + " " + needed + " to raise it");
}

}  // namespace holomorph
