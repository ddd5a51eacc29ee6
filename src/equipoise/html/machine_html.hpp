// The page for one machine as it is written.
#pragma once

#include <string>

#include "equipoise/results/machine_page.hpp"

namespace equipoise {

/// One HTML file that needs nothing else, neither network nor scripts: for a screen by day and by night, a phone, and
/// two pages of A4, unless the study says more than most.
std::string machine_html(const MachinePage& page);

}  // namespace equipoise
