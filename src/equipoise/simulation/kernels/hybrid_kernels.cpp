// Kernels for systems with contact or dry friction.
#define EQUIPOISE_KIND hybrid
#include "equipoise/simulation/kernels/kind_kernels.inc"
