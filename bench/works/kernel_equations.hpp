// The equations alone, as kernels evaluate them.
#pragma once

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::bench {

/// Evaluates the equations `count` times in every lane, each from the result of the one before. Returns the number of
/// lanes.
int evaluate_derivatives(const model::Parameters& p, double speed, long count, double* checksum);

}  // namespace equipoise::bench
