// The kernels for processors with AVX-512. The build enables it for this file.
#define HOLOMORPH_KERNEL_TABLE kAvx512
#include "core/cauchy/cauchy_kernel.inc"
