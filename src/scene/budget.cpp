// One table says what each budget is called, for messages and for the command line.
#include "scene/budget.h"

#include <algorithm>
#include <cmath>

namespace holomorph {
namespace {

Budget& current() {
  static Budget budget;
  return budget;
}

std::string shown(double amount) {
  char text[40];
  std::snprintf(text, sizeof text, "%.0f", std::ceil(amount - 1e-9));
  return text;
}

}  // namespace

const Budget& budget() {
  return current();
}

void set_budget(const Budget& budget) {
  current() = budget;
}

const std::vector<BudgetOption>& budget_options() {
  static const std::vector<BudgetOption> all{
      {"--max-pixels", "megapixels", "Of all pictures of a scene", &Budget::pixels, 1e6},
      {"--max-coordinates", "million coordinates", "Control points times mesh vertices, or points",
       &Budget::coordinates, 1e6},
      {"--max-keyframes", "MB", "Of memory for the maps at keyframes", &Budget::operators, 1e6},
      {"--max-scene", "MB", "Of a scene file", &Budget::scene, 1e6},
      {"--max-groups", "levels", "Of groups in an SVG file", &Budget::groups, 1},
      {"--max-frames", "frames", "Of one film", &Budget::frames, 1}};
  return all;
}

void check_budget(double Budget::*limit, double amount, const std::string& what) {
  const double most = budget().*limit;
  if (!(amount > most)) return;
  const auto found = std::ranges::find(budget_options(), limit, &BudgetOption::limit);
  const std::string needed = shown(amount / found->per_unit);
  throw Error(ErrorKind::bad_input, what + " " + needed + " " + found->unit + "; at most " +
                                        shown(most / found->per_unit) +
                                        " are allowed. Start with " + found->name + " " + needed +
                                        " to raise the limit");
}

}  // namespace holomorph
