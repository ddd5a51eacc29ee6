// Kernels for rotors at a prescribed speed with a centred race, with all terms.
#define EQUIPOISE_KIND turning
#define EQUIPOISE_RUN_KIND run_general_batch
#include "equipoise/simulation/kernels/kind_kernels.inc"
