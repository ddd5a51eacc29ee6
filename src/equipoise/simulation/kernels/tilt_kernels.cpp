// Kernels for tilting rotors.
#define EQUIPOISE_KIND tilting
#include "equipoise/simulation/kernels/kind_kernels.inc"
