// Kernels for rotors that tilt.
#define EQUIPOISE_KIND tilting
#include "equipoise/simulation/kernels/kind_kernels.inc"
