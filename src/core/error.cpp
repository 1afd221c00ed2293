// A broken invariant ends the program: the autosave file holds everything up to the last commit.
#include "core/error.h"

#include <cstdio>
#include <cstdlib>

namespace holomorph {

void check(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "holomorph: this is a bug: %s\n", what);
  std::abort();
}

}  // namespace holomorph
