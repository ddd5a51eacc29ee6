// The figure itself, and the standard's grade that it meets.
#include "equipoise/report/text/grade_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "equipoise/machine/balance/balance_grade.hpp"
#include "equipoise/report/words/text.hpp"

namespace equipoise {

std::string grade_text(double grade_mm_s) {
  constexpr double nothing = 1e-3;  // mm/s: a micrometre per second, a four hundredth of the best grade
  if (grade_mm_s < nothing) return "G 0";
  const auto met = model::standard_grade_met(grade_mm_s);
  return met ? fmt::format(words::text::within_grade, grade_mm_s, *met)
             : fmt::format(words::text::beyond_grade, grade_mm_s, model::standard_balance_grades.back());
}

nlohmann::ordered_json grade_json(double grade_mm_s) {
  nlohmann::ordered_json json{{"mm_per_s", grade_mm_s}, {"standard", nullptr}};
  if (const auto met = model::standard_grade_met(grade_mm_s)) json["standard"] = *met;
  return json;
}

}  // namespace equipoise
