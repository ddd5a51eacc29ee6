// Identifiers and names of branches.
#pragma once

#include <cstddef>
#include <vector>

#include "equipoise/analyses/continuation/parameter_line.hpp"
#include "equipoise/results/commands/branch.hpp"

namespace equipoise {

/// Gives every branch the name of its motion at most of its points, stable ones first, and the identifier for that
/// name. Among branches of one name, the one with the most `votes` (then the one that attracts at most values) gets the
/// identifier; the others are numbered and get free identifiers. Events get their branch's identifier; branches are
/// ordered by it. `systems`: by index of the value.
void name_branches(const std::vector<model::System>& systems, const std::vector<std::size_t>& votes,
                   std::vector<Branch>& branches);

}  // namespace equipoise
