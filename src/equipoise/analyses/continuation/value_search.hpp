// The attractors at one value of a parameter, found from pilot and random starts.
#pragma once

#include <cstdint>
#include <vector>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

struct ValueSearch {
  std::vector<Motion> motions;    ///< stable motions, and balance
  std::vector<Motion> commonest;  ///< of every name the one that most starts come to
};

/// What `attractors` finds with this many random starts, on one thread; `warm_start_states` are followed as well.
ValueSearch attractors_at(const Study& study, std::uint64_t starts,
                          const std::vector<std::vector<double>>& warm_start_states, const StopFlag* stop);

}  // namespace equipoise
