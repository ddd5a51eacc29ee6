// The studies on which trajectories and energies are compared: ball counts, supports, profiles, laws, release rules.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "equipoise/study/study.hpp"

namespace cases {

struct Case {
  std::string name;
  equipoise::Study study;
  double release;  ///< when the balls are let go, worked out by hand from the study's release rule
};

inline std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

/// All of them. Ball drag is strong enough (beta about 0.25) that no case is chaotic over 100 time units.
std::vector<Case> all();

}  // namespace cases
