// Limits on the memory and time that a file may use. They keep an untrusted file from exhausting
// the machine.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "system/process.h"

namespace holomorph {

/// Limits on the data that is read and prepared. Each can be raised on the command line.
struct Budget {
  double pixels = 256e6;       ///< total pixels of all pictures in a scene
  double coordinates = 50e6;   ///< control points (twice for curves) times sample points
  double operators = 1e9;      ///< bytes of the maps kept for keyframes
  double scene = 64e6;         ///< bytes of a scene file
  double groups = 256;         ///< nesting levels of groups in an SVG file
  double frames = 100000;      ///< frames in one film
  double reader_seconds = 20;  ///< processor time of a program that reads a drawing or a frame
  double reader_memory = 1e9;  ///< bytes of memory of such a program
};

/// The current limits. Set them before reading any file.
Budget budget();
void set_budget(const Budget& budget);

/// The command-line option that sets a limit: the option's name, the name of its unit, the help
/// text, the limit, and the size of one unit.
struct BudgetOption {
  const char *name, *unit, *what;
  double Budget::*limit;
  double per_unit;
};
const std::vector<BudgetOption>& budget_options();

/// The limits of a program that reads a drawing, or a frame of a film.
ProgramLimits reader_limits();
/// A limit, for messages about what needs more: "20 s. Start with --max-reader-seconds 40 to
/// raise it".
std::string limit_text(double Budget::*limit);
/// Throws Error{bad_input} if `amount` is above a limit: "WHAT 300 megapixels; the limit is 256.
/// Start with --max-pixels 300 to raise it".
void check_budget(double Budget::*limit, double amount, const std::string& what);

}  // namespace holomorph
