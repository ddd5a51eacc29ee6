// Is a rotor whose balls stay where they are balanced as well as its imperfections allow?
#pragma once

#include "equipoise/base/error.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// Takes gravity, the supports' inequality, the race's offset and dry friction away little by little, at constant
/// `speed` (not 0), from the state `z` (model/machine.hpp) on, and says whether the balls then come to a stable
/// balanced state and none of them moves by more than a quarter of a turn on the way. `tolerance`: of a step;
/// `patience`: how long to wait at the end.
bool fades_to_balance(const model::Parameters& p, double speed, const double* z, double tolerance, double patience,
                      const StopFlag* stop);

}  // namespace equipoise
