// Kernels for systems with contact or dry friction.
#define EQUIPOISE_KIND hybrid
#define EQUIPOISE_RUN_KIND run_hybrid_batch
#include "equipoise/simulation/kernels/kind_kernels.inc"
