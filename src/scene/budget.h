// Limits on the memory and time that a file may use, so that an untrusted file cannot exhaust the
// machine.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"

namespace holomorph {

/// Limits on what is read and prepared. Each can be raised on the command line.
struct Budget {
  double pixels = 256e6;      ///< of all pictures of a scene together
  double coordinates = 50e6;  ///< control points (those of curves count twice) times sample points
  double operators = 1e9;     ///< bytes of the maps kept for keyframes
  double scene = 64e6;        ///< bytes of a scene file
  double groups = 256;        ///< nesting levels of groups in an SVG file
  double frames = 100000;     ///< of one film
};

/// The limits in force. Set them before anything is read; access is not synchronized between
/// threads.
const Budget& budget();
void set_budget(const Budget& budget);

/// The command-line option of a limit: its name, the name of its unit, its help text, and the size
/// of one unit.
struct BudgetOption {
  const char *name, *unit, *what;
  double Budget::*limit;
  double per_unit;
};
const std::vector<BudgetOption>& budget_options();

/// Throws Error{bad_input} if `amount` is above a limit: "WHAT 300 megapixels; the limit is 256.
/// Start with --max-pixels 300 to raise it".
void check_budget(double Budget::*limit, double amount, const std::string& what);

}  // namespace holomorph
