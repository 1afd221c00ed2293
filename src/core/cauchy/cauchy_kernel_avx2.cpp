// The kernels for processors with AVX2 and FMA; the build compiles this file with those switched
// on.
#define HOLOMORPH_KERNEL_TABLE kAvx2
#include "core/cauchy/cauchy_kernel.inc"
