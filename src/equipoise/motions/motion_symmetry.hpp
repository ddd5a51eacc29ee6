// Exchange of equal balls: which motions it leaves alone, which it makes from others.
#pragma once

#include "equipoise/model/parameters.hpp"
#include "equipoise/motions/motion.hpp"

namespace equipoise {

/// Motion::copies of a motion described in all else.
int count_copies(const model::Parameters& p, const Motion& motion);

/// The motion is a member of a continuum of balanced states.
bool is_balanced_continuum(const model::Parameters& p, const Motion& motion);

/// Motion::half_period_exchange.
bool is_half_period_exchange(const model::Parameters& p, double speed, const PeriodicOrbit& orbit);

}  // namespace equipoise
