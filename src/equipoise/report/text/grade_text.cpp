// Grades, and quantiles of the unbalance left with theirs.
#include "equipoise/report/text/grade_text.hpp"

#include <fmt/format.h>

#include "equipoise/report/text/quantities.hpp"
#include "equipoise/results/commands/left_grade.hpp"

namespace equipoise {

std::string grade_text(double grade_mm_s) {
  constexpr double nothing = 1e-3;  // mm/s: a micrometre per second, a four hundredth of the best grade
  if (grade_mm_s < nothing) return "G 0";
  const auto met = model::standard_grade_met(grade_mm_s);
  return met ? fmt::format("G {:.3g} (within grade G {})", grade_mm_s, *met)
             : fmt::format("G {:.3g} (beyond grade G {})", grade_mm_s, model::standard_balance_grades.back());
}

void to_json(Json& json, const BalanceGrade& grade) {
  json = object("mm_per_s", grade.mm_per_s, "standard", model::standard_grade_met(grade.mm_per_s));
}

namespace {

std::string amount_text(double unbalance, const Study& study) {
  if (!study.scales) return fmt::format("{:.3g}", unbalance);
  const double grade = left_balance_grade(unbalance, study);
  const auto met = model::standard_grade_met(grade);
  return fmt::format("{} ({})", engineering(unbalance * study.scales->unbalance(), study::Dimension::unbalance),
                     met ? fmt::format("G {}", *met) : "beyond G 4000");
}

}  // namespace

std::string left_unbalance_text(const std::vector<OutcomeShare>& attractors, const Study& study) {
  std::string text;
  for (const OutcomeShare& a : attractors) {
    if (a.unbalance.empty()) continue;
    text += fmt::format("Unbalance left, {}: ", a.name);
    for (std::size_t k = 0; k < a.unbalance.size(); ++k) {
      const double share = unbalance_quantiles[k];
      text += fmt::format("{}{} {}", k ? ", " : "",
                          share < 1.0 ? fmt::format("{:.0f} % below", 100.0 * share) : "all within",
                          amount_text(a.unbalance[k], study));
    }
    text += fmt::format("; the rotor's own is {}.\n", amount_text(study.parameters.eccentricity, study));
  }
  return text;
}

void put_left_unbalance(Json& json, const OutcomeShare& a, const Study& study) {
  if (a.unbalance.empty()) return;
  Json& left = json["left_unbalance"] = object("probability", unbalance_quantiles, "unbalance", a.unbalance);
  if (!study.scales) return;
  for (const double u : a.unbalance) {
    left["unbalance_si"].push_back(u * study.scales->unbalance());
    left["balance_grade"].push_back(BalanceGrade{left_balance_grade(u, study)});
  }
}

}  // namespace equipoise
