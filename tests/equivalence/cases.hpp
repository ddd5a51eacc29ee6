// The studies on which trajectories and energies are compared: ball counts, supports, profiles, laws, release rules.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "equipoise/study/contents/study.hpp"

namespace cases {

struct Case {
  std::string name;
  equipoise::Study study;
  double release;  ///< when the balls are released, by hand from the study's release rule
};

inline std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

/// All cases. Ball drag is so strong (beta about 0.25) that none is chaotic over 100 time units.
std::vector<Case> all();

}  // namespace cases
