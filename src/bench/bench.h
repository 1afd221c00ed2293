// The benchmarks of `holomorph bench`: medians of repeated runs, compared with goals.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace holomorph::bench {

struct Result {
  std::string name, unit;
  double median = 0;
  std::optional<double> goal = {};  ///< at most
  int runs = 0;
  std::string detail = {};  ///< further results, as text
};

/// Runs every benchmark whose name contains `filter`. Calls `report` with each result as soon as
/// the benchmark has finished.
std::vector<Result> measured(const std::string& filter,
                             const std::function<void(const Result&)>& report);

}  // namespace holomorph::bench
