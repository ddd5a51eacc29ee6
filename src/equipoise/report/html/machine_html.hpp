// Writes the page for one machine.
#pragma once

#include <span>
#include <string>

#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/results/commands/machine_page.hpp"

namespace equipoise {

/// One self-contained HTML file, without network or scripts, for light and dark screens, phones, and two pages of A4
/// unless the study states more than most. It begins with the verdict, and shows the changes that were `tried`.
std::string machine_html(const MachinePage& page, std::span<const TriedChange> tried = {});

}  // namespace equipoise
