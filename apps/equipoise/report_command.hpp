// Writes the page for one machine, for any command.
#pragma once

#include <string>
#include <vector>

#include "equipoise/shown/machine_page.hpp"

namespace equipoise::app {

/// Runs the ensemble and writes its page (.html). `study` must result from `study_text` and `overrides`.
MachinePage write_machine_page(const std::string& study_text, const std::string& name,
                               const std::vector<std::string>& overrides, const Study& study,
                               const BasinOptions& options, const std::string& path);

}  // namespace equipoise::app
