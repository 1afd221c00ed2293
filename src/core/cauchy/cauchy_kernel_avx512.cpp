// The kernels for processors with AVX-512; the build compiles this file with that switched on.
#define HOLOMORPH_KERNEL_TABLE kAvx512
#include "core/cauchy/cauchy_kernel.inc"
