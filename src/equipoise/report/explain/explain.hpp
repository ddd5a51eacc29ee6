// What a study's numbers say before anything is simulated.
// This room: a study explained and checked.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/commands/explanation.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Takes any study that read_study() accepts. Of a rotor that tilts there are no rules of thumb, and no run-up. Once
/// `stop` is set, rates near balance are left out.
Explanation explain(const Study& study, const StopFlag* stop = nullptr);

/// Throws InputError for a study of which pages know nothing.
void check_pages(const Study& study);

/// Something that follows from a study: "critical speed", what is known of it, and more about it line by line.
struct Fact {
  std::string name;
  std::vector<std::string> lines;
};
/// How facts write their quantities, which are dimensionless.
struct FactNumbers {
  std::function<std::string(double, study::Dimension)> one, full;      ///< "0.2 mm"; where there is room for both forms
  std::function<std::string(double, double, study::Dimension)> range;  ///< "from 0 to 3.6 kg mm"
};
/// In the order in which they are shown.
std::vector<Fact> facts(const Explanation& e, const FactNumbers& numbers);

/// Whether the balls can balance the rotor, in one line.
std::string verdict_text(const Explanation& e);

/// Quantities, facts, rules of thumb and warnings; in physical units wherever the study has scales.
std::string explain_text(const Explanation& e, const TextStyle& style = wide_style);

/// JSON.
std::string explain_json(const Explanation& e);

}  // namespace equipoise
