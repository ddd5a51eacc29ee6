// What to beware of in a study.
#pragma once

#include "equipoise/results/explanation.hpp"

namespace equipoise {

/// To an explanation that has all else.
void add_warnings(Explanation& e);

}  // namespace equipoise
