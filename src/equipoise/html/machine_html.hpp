// Writes the page for one machine.
#pragma once

#include <string>

#include "equipoise/results/machine_page.hpp"

namespace equipoise {

/// One self-contained HTML file, without network or scripts, for light and dark screens, phones, and two pages of A4
/// unless the study states more than most.
std::string machine_html(const MachinePage& page);

}  // namespace equipoise
