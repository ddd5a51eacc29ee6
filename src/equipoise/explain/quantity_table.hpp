// The table of a study's quantities, in the order of its own tables.
#pragma once

#include <vector>

#include "equipoise/results/explanation.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

std::vector<ExplainedQuantity> quantity_table(const Study& study);

}  // namespace equipoise
