// Portable code of every kind of kernel, where nearly every processor runs code for wider registers instead: compiled
// once, with fewer optimisations and the same results.
#define EQUIPOISE_PORTABLE_KERNELS  // not declared but compiled
#include "hwy/highway.h"

#include "equipoise/simulation/kernels/kernel-inl.hpp"
