// Results of benchmarks as text and JSON, and their comparison with earlier ones.
#pragma once

#include <map>

#include "bench/bench.h"

namespace holomorph::bench {

/// Where benchmarks run.
struct Machine {
  std::string processor, commit;  ///< "unknown" where they cannot be found out
  int cores = 0;
  double load = 0;  ///< mean number of running processes in the minute before the run
};
Machine this_machine();

std::string line_of(const Result& result);
std::string line_of(const Row& row);
/// The three parts of an object with the machine and a list of rows: what precedes the rows, each
/// row, and what follows. Written one after the other, they keep the rows of a run that is stopped.
std::string json_head(const Machine& machine);
std::string json_row(const Result& result, bool is_first);
inline constexpr const char kJsonTail[] = "\n  ]\n}\n";

/// The medians of earlier results, by their names.
using Medians = std::map<std::string, double>;
/// The medians in a text of these parts. Throws Error{bad_input} if it has no list of rows.
/// `name` is used in messages.
Medians medians_of(const std::string& text, const std::string& name);
/// What has become of a result, such as "  (was 12.3, now 0.52 times as much)"; empty if there was
/// no such result.
std::string change_since(const Medians& before, const Result& result);

}  // namespace holomorph::bench
