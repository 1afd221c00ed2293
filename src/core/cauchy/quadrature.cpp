// Computes nodes by Newton's method on the Legendre recurrence, in extended precision.
#include "core/cauchy/quadrature.h"

#include <array>
#include <cmath>

#include "core/error.h"

namespace holomorph {
namespace {

constexpr int kMost = 64;

GaussRule computed_rule(int size) {
  GaussRule rule{std::vector<double>(size), std::vector<double>(size)};
  for (int i = 0; i < size; ++i) {
    long double x = std::cos(3.14159265358979323846264338L * (i + 0.75L) / (size + 0.5L));
    long double slope = 0;
    for (int step = 0; step < 100; ++step) {
      long double p = 1, before = 0;
      for (int k = 1; k <= size; ++k) {
        const long double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = size * (x * p - before) / (x * x - 1);
      const long double move = p / slope;
      x -= move;
      if (std::abs(move) < 1e-19L) break;
    }
    rule.nodes[i] = static_cast<double>(0.5L * (1 - x));
    rule.weights[i] = static_cast<double>(1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

}  // namespace

const GaussRule& gauss_rule(int nodes) {
  check(nodes >= 1 && nodes <= kMost, "gauss_rule: 1 to 64 nodes");
  static const auto rules = [] {
    std::array<GaussRule, kMost> all;
    for (int i = 0; i < kMost; ++i) all[i] = computed_rule(i + 1);
    return all;
  }();
  return rules[nodes - 1];
}

}  // namespace holomorph
