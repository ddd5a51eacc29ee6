// The page of a capacity as it is written.
#pragma once

#include <string>

#include "equipoise/results/capacity_result.hpp"
#include "equipoise/results/machine_page.hpp"

namespace equipoise {

/// One HTML file that needs nothing else, as of a sweep (html/sweep_html.hpp). `machine`: of the study as it is given.
std::string capacity_html(const CapacityResult& result, const GivenMachine& machine);

}  // namespace equipoise
