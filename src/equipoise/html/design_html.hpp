// A design as a page to be taken to a meeting.
#pragma once

#include <string>

#include "equipoise/html/given_machine.hpp"
#include "equipoise/results/design_result.hpp"

namespace equipoise {

/// The answer first; then the chosen design beside the study as it is, the front, margins, what limits it, the machine,
/// how it was found, and the chosen study in full. `machine`: what the study gives, before anything is chosen.
std::string design_html(const DesignResult& result, const GivenMachine& machine);

}  // namespace equipoise
