// The page of a map as it is written.
#pragma once

#include <string>

#include "equipoise/results/basin_slice.hpp"
#include "equipoise/results/machine_page.hpp"

namespace equipoise {

/// One HTML file that needs nothing else, neither network nor scripts: for a screen by day and by night, a phone, and
/// two pages of A4. At most 640 pixels along a side are drawn, and it says so. `machine`: of the study as it is given
/// (html/given_machine.hpp).
std::string map_html(const BasinSlice& map, const GivenMachine& machine);

}  // namespace equipoise
