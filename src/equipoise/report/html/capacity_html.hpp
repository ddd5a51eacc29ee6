// Writes the page of a capacity.
#pragma once

#include <string>

#include "equipoise/results/commands/capacity_result.hpp"
#include "equipoise/results/commands/machine_page.hpp"

namespace equipoise {

/// One self-contained HTML file, as for a sweep (report/html/sweep_html.hpp). `machine`: from the original study.
std::string capacity_html(const CapacityResult& result, const GivenMachine& machine);

}  // namespace equipoise
