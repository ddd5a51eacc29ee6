// Which of the stated limits one start keeps.
#pragma once

#include <array>

#include "equipoise/results/columns/transient_figures.hpp"

namespace equipoise {

/// Of limits that are not stated, all are kept. Whatever is not known, such as the speed of a start that was not
/// watched for long enough, keeps none.
struct LimitsOfStart {
  std::array<bool, transient_limits.size()> exceeded{}, exceeded_at_end{};
  bool at_end = true, on_the_way = true;  ///< Within

  bool both() const { return at_end && on_the_way; }
};

/// `speed`: the rotor's in the end; `frequency`: omega_c in rad/s, read for limits that need a study with units.
LimitsOfStart limits_of_start(const Limits& limits, const TransientRow& row, double speed, double frequency);

}  // namespace equipoise
