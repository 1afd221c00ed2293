// glibc only keeps blocks below its threshold for mapped memory, which is at most 32 MB.
#include "system/memory.h"

#include <sys/resource.h>

#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace holomorph {

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kMegabyte = 1 << 20, kLargestBlock = 32 * kMegabyte, kKept = 256 * kMegabyte;
  mallopt(M_MMAP_THRESHOLD, kLargestBlock);
  mallopt(M_TRIM_THRESHOLD, kKept);
#endif
}

void return_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

long page_faults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

}  // namespace holomorph
