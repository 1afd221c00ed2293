#include "bench/bench.h"

#include <algorithm>
#include <cstdio>

#include "bench/measures.h"
#include "core/clock.h"

namespace holomorph::bench {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool is_chosen(const Benchmark& benchmark, const std::string& filter, Extent extent) {
  if (filter.empty()) return extent == Extent::with_long || !benchmark.is_long;
  return std::ranges::any_of(benchmark.rows,
                             [&](const Row& row) { return contains(row.name, filter); });
}

/// The row that stands for the methods of compare_on_folded_bar().
bool compares(const std::string& filter, Extent extent) {
  return filter.empty() ? extent == Extent::with_long : contains(kCompared, filter);
}

}  // namespace

double median_ms(int runs, const std::function<void()>& work) {
  work();
  std::vector<double> times;
  for (int i = 0; i < runs; ++i) {
    const double start = now_ms();
    work();
    times.push_back(now_ms() - start);
  }
  std::nth_element(times.begin(), times.begin() + runs / 2, times.end());
  return times[runs / 2];
}

std::vector<Row> chosen_rows(const std::string& filter, Extent extent) {
  std::vector<Row> rows;
  for (const Benchmark& benchmark : benchmarks())
    if (is_chosen(benchmark, filter, extent))
      for (const Row& row : benchmark.rows)
        if (contains(row.name, filter)) rows.push_back(row);
  if (compares(filter, extent)) rows.push_back({std::string(kCompared) + "each method", "ms"});
  return rows;
}

void measure(const std::string& filter, Extent extent,
             const std::function<void(const Result&)>& report) {
  for (const Benchmark& benchmark : benchmarks()) {
    if (!is_chosen(benchmark, filter, extent)) continue;
    const std::vector<double> values = benchmark.measured(benchmark.runs);
    for (size_t i = 0; i < values.size(); ++i) {
      if (!contains(benchmark.rows[i].name, filter)) continue;
      Result result{benchmark.rows[i], values[i], benchmark.runs};
      if (i == 0 && benchmark.larger_one) {
        char growth[100];
        std::snprintf(growth, sizeof growth, "%.1f times with twice the %s",
                      benchmark.larger_one(benchmark.runs) / values[i], benchmark.larger.c_str());
        result.detail = growth;
      }
      report(result);
    }
  }
  if (compares(filter, extent)) compare_on_folded_bar(report);
}

}  // namespace holomorph::bench
