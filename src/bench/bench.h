// The benchmarks of `holomorph bench`: medians of repeated runs, compared with goals.
#pragma once

#include <functional>
#include <string>

#include "bench/table.h"

namespace holomorph::bench {

struct Result {
  Row row;
  double median = 0;
  int runs = 0;
  std::string detail = {};  ///< further results, as text
};

enum class Extent { usual, with_long };

/// The rows that are measured: those whose name contains `filter`. Without a filter, long
/// benchmarks are included only by Extent::with_long. The published methods that are compared on a
/// folded bar are one row here.
std::vector<Row> chosen_rows(const std::string& filter, Extent extent);

/// Measures these rows. Calls `report` with each result as soon as it is known. Cost: without a
/// filter, less than three minutes on two cores.
void measure(const std::string& filter, Extent extent,
             const std::function<void(const Result&)>& report);

}  // namespace holomorph::bench
