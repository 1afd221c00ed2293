// What files may cost at most, so that no stranger's file takes all memory or time.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"

namespace holomorph {

/// Limits on what is read and prepared. Each can be raised on the command line.
struct Budget {
  double pixels = 256e6;      ///< of all pictures of a scene together
  double coordinates = 50e6;  ///< control points, those of curves twice, times places of a map
  double operators = 1e9;     ///< bytes of the maps that are kept for a layer's keyframes
  double scene = 64e6;        ///< bytes of a scene file
  double groups = 256;        ///< levels of groups in an SVG file
  double frames = 100000;     ///< of one film
};

/// What the program allows. Set before anything is read; not guarded against threads.
const Budget& budget();
void set_budget(const Budget& budget);

/// A budget's option on the command line, the unit that it counts in, and what that unit is called.
struct BudgetOption {
  const char *name, *unit, *what;
  double Budget::*limit;
  double per_unit;
};
const std::vector<BudgetOption>& budget_options();

/// Throws Error{bad_input} where `amount` is above a limit: "WHAT need 300 megapixels; at most 256
/// are allowed. Start with --max-pixels 300 to raise the limit."
void check_budget(double Budget::*limit, double amount, const std::string& what);

}  // namespace holomorph
