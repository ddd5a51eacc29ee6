// The machine of a page, from the study as written: what it states, key by key, and what follows.
#pragma once

#include <string>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/results/commands/machine_page.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The tables that forms and pages show, in the order of the guide. [[place]] is an array of tables: "place 1", ...
inline constexpr const char* told_tables[]{"rotor",  "place",     "balancer", "speed",    "release", "initial",
                                           "limits", "standards", "sampling", "numerics", "units"};

/// The tables of a study's text that parse_study() accepts, with overrides applied: in the order of the guide, with
/// numbers and quantities as written.
std::vector<GivenTable> given_tables(const std::string& toml_text, const std::string& name,
                                     const std::vector<std::string>& overrides = {});
/// For a study without text: all its keys, in physical units if it has them.
std::vector<GivenTable> given_tables(const Study& study);

/// From a study's text as above. Once `stop` is set, what takes integration is left out.
GivenMachine given_machine(const std::string& toml_text, const std::string& name,
                           const std::vector<std::string>& overrides = {}, const StopFlag* stop = nullptr);
/// From a study without text.
GivenMachine given_machine(const Study& study);

}  // namespace equipoise
