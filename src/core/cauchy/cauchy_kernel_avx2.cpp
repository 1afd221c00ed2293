// The kernels for processors with AVX2 and FMA. The build enables both for this file.
#define HOLOMORPH_KERNEL_TABLE kAvx2
#include "core/cauchy/cauchy_kernel.inc"
