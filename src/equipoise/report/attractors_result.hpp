// The attractors of a study, for people and for machines.
#pragma once

#include <string>
#include <vector>

#include "equipoise/motions/catalogue.hpp"
#include "equipoise/report/basin_result.hpp"

namespace equipoise {

struct AttractorsResult {
  Catalogue catalogue;
  BasinResult basin;  ///< shares of the starts that were searched
};

/// Probability with which a search of `starts` independent starts misses an attractor of this share.
double miss_probability(double share, std::uint64_t starts);

/// A table for the terminal.
std::string attractors_text(const AttractorsResult& result);
/// One JSON object. docs/guide/command-line.md lists the keys.
std::string attractors_json(const AttractorsResult& result);

}  // namespace equipoise
