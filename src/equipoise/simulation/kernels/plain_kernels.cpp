// Kernels for rotors whose equations do not depend on the rotor's angle.
#define EQUIPOISE_KIND plain
#include "equipoise/simulation/kernels/kind_kernels.inc"
