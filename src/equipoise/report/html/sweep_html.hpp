// Writes the page of a sweep.
#pragma once

#include <string>

#include "equipoise/results/commands/machine_page.hpp"
#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

/// One self-contained HTML file, without network or scripts, for light and dark screens, phones, and two pages of A4.
/// Beyond forty cells the table is folded, and left out on paper; it ends after five thousand. `machine`: from the
/// original study (report/html/given_machine.hpp).
std::string sweep_html(const SweepResult& result, const GivenMachine& machine);

}  // namespace equipoise
