// Seeds for random tests: fixed ones, and a random one that each run prints.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "core/arithmetic.h"

namespace holomorph {

/// The fixed seeds and a random one. The environment variable HOLOMORPH_SEED replaces all of them,
/// so that a failure can be reproduced.
inline std::vector<unsigned> seeds_of(const char* test, std::vector<unsigned> fixed) {
  if (const char* given = std::getenv("HOLOMORPH_SEED"))
    return {static_cast<unsigned>(std::strtoul(given, nullptr, 10))};
  fixed.push_back(std::random_device{}());
  std::printf("%s: HOLOMORPH_SEED=%u\n", test, fixed.back());
  std::fflush(stdout);
  return fixed;
}

/// A random number with both parts between -1 and 1. The order in which they are drawn does not
/// depend on the compiler, as it would in Complex(unit(random), unit(random)).
inline Complex random_complex(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double real = unit(random), imag = unit(random);
  return {real, imag};
}

}  // namespace holomorph
