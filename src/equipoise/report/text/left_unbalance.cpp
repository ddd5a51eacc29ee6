// Quantiles of the unbalance left, and their balance quality grades.
#include "equipoise/report/text/left_unbalance.hpp"

#include <optional>

#include <fmt/format.h>

#include "equipoise/report/text/engineering.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/words/text.hpp"
#include "equipoise/results/commands/left_grade.hpp"

namespace equipoise {

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
    text += fmt::format(words::text::unbalance_left, a.name);
    for (std::size_t k = 0; k < a.unbalance.size(); ++k) {
      const double share = unbalance_quantiles[k];
      text += fmt::format("{}{} {}", k ? ", " : "",
                          share < 1.0 ? fmt::format("{:.0f} % below", 100.0 * share) : words::text::all_within,
                          amount_text(a.unbalance[k], study));
    }
    text += fmt::format(words::text::rotors_own, amount_text(study.parameters.eccentricity, study));
  }
  return text;
}

nlohmann::ordered_json left_unbalance_json(const OutcomeShare& a, const Study& study) {
  if (a.unbalance.empty()) return nullptr;
  nlohmann::ordered_json json = {{"probability", unbalance_quantiles}, {"unbalance", a.unbalance}};
  if (!study.scales) return json;
  for (const double u : a.unbalance) {
    json["unbalance_si"].push_back(u * study.scales->unbalance());
    json["balance_grade"].push_back(grade_json(left_balance_grade(u, study)));
  }
  return json;
}

}  // namespace equipoise
