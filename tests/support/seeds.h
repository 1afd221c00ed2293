// Seeds for random tests.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "core/arithmetic.h"

namespace holomorph {

/// The fixed seeds of a test, so that it has the same answer each time. For soak tests, the
/// environment variable HOLOMORPH_FRESH replaces them by that many new ones, which are printed, and
/// HOLOMORPH_SEED by a single one, to repeat a failure.
inline std::vector<unsigned> seeds_of(const char* test, std::vector<unsigned> fixed) {
  if (const char* given = std::getenv("HOLOMORPH_SEED"))
    return {static_cast<unsigned>(std::strtoul(given, nullptr, 10))};
  const char* fresh = std::getenv("HOLOMORPH_FRESH");
  if (!fresh) return fixed;
  std::vector<unsigned> seeds(std::strtoul(fresh, nullptr, 10));
  for (unsigned& seed : seeds) {
    seed = std::random_device{}();
    std::printf("%s: HOLOMORPH_SEED=%u\n", test, seed);
  }
  std::fflush(stdout);
  return seeds;
}

/// Whether scripts/soak runs the test, which has time for all cases.
inline bool soaks() {
  return std::getenv("HOLOMORPH_FRESH") != nullptr;
}
/// How often to repeat something: `few` times in scripts/test, `many` times in scripts/soak.
inline int few_or_many(int few, int many) {
  return soaks() ? many : few;
}

/// All of a list in scripts/soak, and the first `few` of it in scripts/test. A failure in the rest
/// needs a case of its own, because a fixed seed would not reach it.
template <class T>
std::vector<T> first_of(std::vector<T> all, size_t few) {
  if (!soaks()) all.resize(few);
  return all;
}

/// A random number with both parts between -1 and 1. The order in which they are drawn does not
/// depend on the compiler, as it would in Complex(unit(random), unit(random)).
inline Complex random_complex(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double real = unit(random), imag = unit(random);
  return {real, imag};
}

}  // namespace holomorph
