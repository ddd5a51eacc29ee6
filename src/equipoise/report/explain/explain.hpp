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

/// Takes any study that read_study() accepts. For a tilting rotor there are no rules of thumb, and no run-up. Once
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
std::string json_text(const Explanation& e);

/// What was understood of a study, in a few lines: before anything is computed of it.
struct StudyCheck {
  std::string leave_out;                  ///< why no balancer can help, if that is known at once
  std::string machine, unbalance, balls;  ///< as understood, in the study's units
  /// What the study does not state and what matters, each a few words: "balls free from t = 0".
  std::vector<std::string> assumed;
  /// Which of the estimated quantities matters most, and how that was judged.
  std::string most;

  std::string text() const;  ///< at most six lines
};

/// Among what is assumed of a study with uncertain values: what follows without simulation takes them so.
extern const char* const medians_assumed;

/// Of a text that parse_study() takes; throws what it throws. Uncertain values are taken at their medians. Once `stop`
/// is set, what takes integration is left out.
StudyCheck check_study(const std::string& toml_text, const std::string& name,
                       const std::vector<std::string>& overrides = {}, const StopFlag* stop = nullptr);

}  // namespace equipoise
