// Kernels for rotors whose equations do not depend on the rotor's angle.
#define EQUIPOISE_KIND plain
#define EQUIPOISE_RUN_KIND run_plain_batch
#include "equipoise/simulation/kernels/kind_kernels.inc"
