// Studies drawn over the whole space of legal settings, each a function of a seed and its number.
#pragma once

#include <cstdint>
#include <string>

#include "equipoise/study/study.hpp"

namespace equipoise::audit {

struct DrawnStudy {
  int number = 0;
  std::string kind;  ///< what it was drawn for, in a few words
  Study study;
};

/// Study `number` of `seed`. Numbers go round through all kinds of settings (kind_count of them), so that any
/// kind_count successive ones hold each; what else a study has is drawn.
DrawnStudy draw_study(std::uint64_t seed, int number);

extern const int kind_count;

}  // namespace equipoise::audit
