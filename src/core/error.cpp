// A broken invariant ends the program. The autosave file holds everything up to the last commit.
#include "core/error.h"

#include <new>

#include <cstdio>
#include <cstdlib>

namespace holomorph {

std::string what_of(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) return "not enough memory";
  return error.what();
}

void check(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "holomorph: internal error; this condition failed: %s\n", what);
  std::abort();
}

}  // namespace holomorph
