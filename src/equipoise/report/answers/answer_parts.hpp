// Pieces that all answer sentences share.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// "With unbalance and rotor damping drawn anew for every start, the rotor ends ..."; just the sentence without keys.
std::string after_what_is_drawn(std::vector<std::string> keys, std::string sentence);

/// A limit that a study has.
struct ToldLimit {
  std::size_t place;  ///< in TransientGroup::exceeded
  std::string words;  ///< "5 mm is exceeded on the way"
};
std::vector<ToldLimit> told_limits(const Study& study);

}  // namespace equipoise
