// Studies drawn over the whole space of legal settings, each determined by a seed and its number.
#pragma once

#include <cstdint>
#include <string>

#include "equipoise/study/contents/study.hpp"

namespace equipoise::audit {

struct DrawnStudy {
  int number = 0;
  std::string kind;  ///< the kind it was drawn for, in a few words
  Study study;
};

/// Study `number` of `seed`. Numbers cycle through all kinds of studies (kind_count), so that any kind_count successive
/// numbers include each. Everything else is drawn.
DrawnStudy draw_study(std::uint64_t seed, int number);

extern const int kind_count;

}  // namespace equipoise::audit
