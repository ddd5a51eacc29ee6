// Which of the estimated quantities matters most for balance, by formulas.
#pragma once

#include <string>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// What a change of the most important one does, and how that was judged. Once `stop` is set, that it was stopped.
std::string what_matters_most(const Study& study, const StopFlag* stop);

}  // namespace equipoise
