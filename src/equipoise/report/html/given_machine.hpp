// The machine of a page, from the study as written.
#pragma once

#include <string>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/results/commands/machine_page.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// From a study's text that parse_study() accepts, with overrides applied. Once `stop` is set, what takes integration
/// is left out.
GivenMachine given_machine(const std::string& toml_text, const std::string& name,
                           const std::vector<std::string>& overrides = {}, const StopFlag* stop = nullptr);

/// From a study without text.
GivenMachine given_machine(const Study& study);

}  // namespace equipoise
