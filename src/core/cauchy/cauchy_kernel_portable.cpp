// The kernels for any processor of the architecture.
#define HOLOMORPH_KERNEL_TABLE kPortable
#include "core/cauchy/cauchy_kernel.inc"
