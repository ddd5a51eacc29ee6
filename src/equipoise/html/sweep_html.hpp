// The page of a sweep as it is written.
#pragma once

#include <string>

#include "equipoise/results/machine_page.hpp"
#include "equipoise/results/sweep_result.hpp"

namespace equipoise {

/// One HTML file that needs nothing else, neither network nor scripts: for a screen by day and by night, a phone, and
/// two pages of A4. Of more than forty cells the table is folded, and left out on paper; it ends after five thousand.
/// `machine`: of the study as it is given (html/given_machine.hpp).
std::string sweep_html(const SweepResult& result, const GivenMachine& machine);

}  // namespace equipoise
