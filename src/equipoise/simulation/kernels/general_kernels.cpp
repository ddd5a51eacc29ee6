// Kernels for rotors at a prescribed speed with a centred race, with all terms.
#define EQUIPOISE_KIND turning
#include "equipoise/simulation/kernels/kind_kernels.inc"
