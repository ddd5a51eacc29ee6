// The machine of a page, from the study that was written.
#pragma once

#include <string>
#include <vector>

#include "equipoise/results/machine_page.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Of the text of a study that parse_study() accepts, overrides applied.
GivenMachine given_machine(const std::string& toml_text, const std::string& name,
                           const std::vector<std::string>& overrides = {});

/// Of a study that came otherwise.
GivenMachine given_machine(const Study& study);

}  // namespace equipoise
