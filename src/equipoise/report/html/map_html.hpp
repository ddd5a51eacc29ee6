// Writes the page of a basin slice.
#pragma once

#include <string>

#include "equipoise/results/commands/basin_slice.hpp"
#include "equipoise/results/commands/machine_page.hpp"

namespace equipoise {

/// One self-contained HTML file, without network or scripts, for light and dark screens, phones, and two pages of A4.
/// At most 640 pixels along a side are drawn, and the page says so. `machine`: from the original study
/// (report/html/given_machine.hpp).
std::string map_html(const BasinSlice& map, const GivenMachine& machine);

}  // namespace equipoise
