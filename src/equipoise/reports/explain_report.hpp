// A study explained, for people and for machines.
#pragma once

#include <string>

#include "equipoise/results/explanation.hpp"

namespace equipoise {

/// Whether the balls can balance the rotor, in a line.
std::string verdict_text(const Explanation& e);

/// For people. Physical units wherever the study has scales.
std::string explain_text(const Explanation& e);

/// For machines.
std::string explain_json(const Explanation& e);

}  // namespace equipoise
