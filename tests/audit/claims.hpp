// Whether what was said of a start still holds long after: judged by its late motion alone.
#pragma once

#include <string>

#include "ensemble.hpp"
#include "late_motion.hpp"

namespace equipoise::audit {

/// `study`: the start's own. Empty if what `ensemble` says of start `i` agrees with what the start does late; else what
/// does not.
std::string contradiction(const Study& study, const Ensemble& ensemble, std::size_t i, const LateMotion& late,
                          const LookTimes& times);

}  // namespace equipoise::audit
