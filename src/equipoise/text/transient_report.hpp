// The transients of an ensemble as text and as JSON.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "equipoise/results/transient_result.hpp"

namespace equipoise {

/// A table for the terminal, in the units of the study's scales: mm, N, mm/s, s; else dimensionless.
std::string transient_text(const TransientResult& result, const Study& study);

/// e omega in mm/s of the mean residual unbalance at the end, at the speed that the starts of `group` came to. Empty
/// for a dimensionless study, and if a driven rotor's speed was never measured.
std::optional<double> left_grade(const TransientGroup& group, const Study& study);

/// The object "transients" of basin_json(), in the same units, which it names.
nlohmann::ordered_json transient_json(const TransientResult& result, const Study& study);

}  // namespace equipoise
