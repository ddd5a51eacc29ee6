// The page of a design.
#pragma once

#include <string>

#include "equipoise/report/html/given_machine.hpp"
#include "equipoise/results/commands/design_result.hpp"

namespace equipoise {

/// The answer first; then the chosen design beside the original study, the front, margins, what limits it, the machine,
/// how it was found, and the full chosen study. `machine`: from the study before anything is chosen.
std::string design_html(const DesignResult& result, const GivenMachine& machine);

}  // namespace equipoise
