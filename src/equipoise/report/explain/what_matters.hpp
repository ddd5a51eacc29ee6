// Which of the estimated quantities matters most for balance, by formulas.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The viscosity of a study's oil at another temperature; none beyond the oil's law.
using OilAt = std::function<std::optional<double>(double kelvin)>;

/// What a change of the most important one does, and how that was judged. Once `stop` is set, that it was stopped.
std::string what_matters_most(const Study& study, const OilAt& oil_at, const StopFlag* stop);

}  // namespace equipoise
