// What a study says, key by key, as it was written.
#pragma once

#include <string>
#include <vector>

#include "equipoise/results/machine_page.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// The tables that forms and pages show, in the order of the guide.
inline constexpr const char* told_tables[]{"rotor",  "balancer", "speed",    "release", "initial",
                                           "limits", "sampling", "numerics", "units"};

/// Of the text of a study that parse_study() accepts, overrides applied: its tables in the order of the guide, numbers
/// and quantities as they stand there.
std::vector<GivenTable> given_tables(const std::string& toml_text, const std::string& name,
                                     const std::vector<std::string>& overrides = {});

/// Of a study that came otherwise: all its keys, in physical units if it has them.
std::vector<GivenTable> given_tables(const Study& study);

}  // namespace equipoise
