// A table of indices.
#include "equipoise/report/reports/sensitivity_report.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "equipoise/report/answers/start_text.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

std::string distribution_text(const UncertainValue& v) {
  switch (v.kind) {
    case DistributionKind::uniform:
      return fmt::format("uniform, {} to {}", v.text(v.numbers[0]), v.text(v.numbers[1]));
    case DistributionKind::loguniform:
      return fmt::format("log-uniform, {} to {}", v.text(v.numbers[0]), v.text(v.numbers[1]));
    case DistributionKind::normal: {
      const std::string cut =
          v.between ? fmt::format(", cut to {} to {}", v.text((*v.between)[0]), v.text((*v.between)[1])) : "";
      return fmt::format("normal, mean {}, standard deviation {}{}", v.text(v.numbers[0]), v.text(v.numbers[1]), cut);
    }
    case DistributionKind::values:
      break;
  }
  constexpr std::size_t most_shown = 6;
  std::string text = "one of ";
  for (std::size_t k = 0; k < std::min(v.numbers.size(), most_shown); ++k)
    text += (k ? ", " : "") + v.text(v.numbers[k]);
  return v.numbers.size() > most_shown ? fmt::format("{}, .. ({} values)", text, v.numbers.size()) : text;
}

std::string range_text(const Estimate& e) { return fmt::format("{:.2f} to {:.2f}", e.low, e.high); }

}  // namespace

std::string uncertain_text(const Study& study, const std::vector<std::string>& set) {
  std::string text;
  for (const UncertainValue& v : study.uncertain.values)
    if (std::find(set.begin(), set.end(), v.key) == set.end())
      text += fmt::format("drawn with each start: {} {}\n", v.key, distribution_text(v));
  text += drawn_instead_text(study);
  return text.empty() ? text : text + "\n";
}

void add_sensitivity(Document& document, const SensitivityResult& r) {
  if (r.inputs.empty()) {
    document.add(Paragraph{r.rows == 0 ? "What balance depends on: nothing was followed to the end."
                                       : fmt::format("What balance depends on: nothing; of {} starts {} balanced.",
                                                     2 * r.rows, r.balanced.count == 0 ? "none" : "all")});
  } else {
    DocumentTable table{{"balance depends on", "first order", "95 % interval", "total", "95 % interval"}};
    for (const auto& [key, indices] : r.inputs)
      table.rows.push_back(row_of(
          "tntnt", {key == start_input ? "where the start begins" : key, fmt::format("{:.2f}", indices.first.value),
                    range_text(indices.first), fmt::format("{:.2f}", indices.total.value), range_text(indices.total)}));
    table.caption =
        "First order: the part of the variance of \"ends balanced\" that goes away on average if this alone is known; "
        "total: the part that is left if all else is.";
    document.add(std::move(table));
  }
  document.add(Paragraph{
      fmt::format("{} starts in {} rows, {} of the independent starts balanced ({}){}.{}", r.evaluations, r.rows,
                  percent(r.balanced.share, digits_for(r.balanced)), interval(r.balanced),
                  r.undecided > 0 ? fmt::format("; {} undecided ones count as not balanced", r.undecided) : "",
                  r.partial ? " PARTIAL: stopped before all rows were done." : "")});
}

void to_json(Json& json, const InputSensitivity& input) {
  json = object("key", input.key, "first", input.indices.first, "total", input.indices.total);
}

void to_json(Json& json, const SensitivityResult& r) {
  json = object("rows", r.rows, "evaluations", r.evaluations, "undecided", r.undecided, "partial", r.partial,
                "balanced", r.balanced);
}

}  // namespace equipoise
