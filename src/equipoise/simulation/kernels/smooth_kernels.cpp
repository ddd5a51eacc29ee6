// Kernels for every smooth system.
#define EQUIPOISE_KIND smooth
#include "equipoise/simulation/kernels/kind_kernels.inc"
