// The benchmarks of `holomorph bench`: medians of repeated runs, compared with goals.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace holomorph::bench {

struct Result {
  std::string name, unit;
  double median = 0, goal = 0;  ///< a goal of 0 means no goal
  int runs = 0;
  std::string detail = {};  ///< further results, as text
};

/// Runs every benchmark whose name contains `filter`. Calls `report` with each result as soon as
/// the benchmark has finished.
std::vector<Result> measured(const std::string& filter,
                             const std::function<void(const Result&)>& report);

}  // namespace holomorph::bench
