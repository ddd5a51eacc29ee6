// Balance quality, and the unbalance that balls held by dry friction leave: in words and as JSON.
#pragma once

#include <string>
#include <vector>

#include "equipoise/report/text/json.hpp"

namespace equipoise {

/// "G 147 (within grade G 250)" for a balance quality in mm/s; "G 0" below anything measurable.
std::string grade_text(double grade_mm_s);
/// In JSON with the standard's grade that it meets; null beyond all grades.
struct BalanceGrade {
  double mm_per_s;
};
void to_json(Json& json, const BalanceGrade& grade);

/// One line for every attractor that is a continuum caused by friction; empty without any.
std::string left_unbalance_text(const std::vector<OutcomeShare>& attractors, const Study& study);
/// "left_unbalance", if the attractor is such a continuum.
void put_left_unbalance(Json& json, const OutcomeShare& attractor, const Study& study);

}  // namespace equipoise
