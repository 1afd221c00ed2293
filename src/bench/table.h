// The table of all benchmarks.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace holomorph::bench {

/// A row of the results. Its value is to be at most the goal.
struct Row {
  std::string name, unit;
  std::optional<double> goal = {};
};

/// A measurement, which yields the values of one or more rows.
struct Benchmark {
  std::vector<Row> rows;
  int runs = 1;                                           ///< whose median is taken
  std::function<std::vector<double>(int runs)> measured;  ///< the rows' values
  std::string larger = {};  ///< what is twice as large in the next measurement
  std::function<double(int runs)> larger_one = {};  ///< shows how the first value grows, or empty
  bool is_long = false;                             ///< runs only where it is asked for
};

/// All benchmarks in the order in which they run.
std::vector<Benchmark> benchmarks();

}  // namespace holomorph::bench
