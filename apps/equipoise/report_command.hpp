// The page for one machine, of whichever command is asked for it.
#pragma once

#include <string>
#include <vector>

#include "equipoise/shown/machine_page.hpp"

namespace equipoise::app {

/// Runs the ensemble and writes its page (.html). `study` is what `study_text` and `overrides` say.
MachinePage write_machine_page(const std::string& study_text, const std::string& name,
                               const std::vector<std::string>& overrides, const Study& study,
                               const BasinOptions& options, const std::string& path);

}  // namespace equipoise::app
