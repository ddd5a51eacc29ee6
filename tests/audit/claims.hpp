// Whether a start's result still holds long after, judged by its late motion alone.
#pragma once

#include <string>

#include "ensemble.hpp"
#include "late_motion.hpp"

namespace equipoise::audit {

/// `study`: the start's own. Empty if what `ensemble` says of start `i` agrees with its late motion; else the
/// contradiction.
std::string contradiction(const Study& study, const Ensemble& ensemble, std::size_t i, const LateMotion& late,
                          const LookTimes& times);

}  // namespace equipoise::audit
