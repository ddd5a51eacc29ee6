// Parts that all results' documents share: how they begin, how they were computed, the machine, the full study.
// This room: results as documents for a meeting, and studies as forms.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/report/drawing/document.hpp"
#include "equipoise/results/commands/machine_page.hpp"
#include "equipoise/results/commands/sweep_result.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// A result's document with its title, "Ball balancer: angle-grinder", a verdict if there is one, the answer if there
/// is one, and the study in a few lines, with those on what is `drawn` (uncertain_text()).
Document document_with(const Study& study, const std::string& answer, const std::string& drawn,
                       const std::optional<Notice>& verdict = {});

/// One line for every uncertain value: "drawn with each start: rotor.eccentricity uniform, 0.005 to 0.015", and one for
/// what the study states of starts although they draw it. Empty if there are none. Omits keys that are `set` otherwise.
std::string uncertain_text(const Study& study, const std::vector<std::string>& set = {});

/// "at random ball angles, seed 1"; `drawn`: keys of values that each start draws.
std::string starts_words(const Study& study, const std::vector<std::string>& drawn);
/// "final speed from 1.5 to 6 (46 values); ball drag 0.05, 0.1": what varies.
std::string varied_words(const std::vector<SweepAxis>& axes);

/// The last block of every result: a heading, `words`, and then speed law, intervals, model, version, and what the run
/// took (`computed`; may be empty).
void add_origin(Document& document, const Study& study, const std::string& words, const std::string& computed);

/// The tables that forms and pages show, in the order of the guide. [[place]] is an array of tables: "place 1", ...
inline constexpr const char* told_tables[]{"rotor",  "place",     "balancer", "speed",    "release", "initial",
                                           "limits", "standards", "sampling", "numerics", "units"};

/// The tables of a study's text that parse_study() accepts, with overrides applied: in the order of the guide, with
/// numbers and quantities as written.
std::vector<GivenTable> given_tables(const std::string& toml_text, const std::string& name,
                                     const std::vector<std::string>& overrides = {});
/// For a study without text: all its keys, in physical units if it has them.
std::vector<GivenTable> given_tables(const Study& study);

/// From a study's text as above. Once `stop` is set, what takes integration is left out.
GivenMachine given_machine(const std::string& toml_text, const std::string& name,
                           const std::vector<std::string>& overrides = {}, const StopFlag* stop = nullptr);
/// From a study without text.
GivenMachine given_machine(const Study& study);

/// The whole page of a result: its document, the machine, and the study in full. One self-contained HTML file, without
/// network or scripts, for light and dark screens, phones, and two pages of A4 unless the study states more than most.
/// `machine`: from the original study.
std::string document_page(Document document, const Study& study, const GivenMachine& machine);
template <class Result>
std::string result_page(const Result& result, const GivenMachine& machine) {
  return document_page(document_of(result), result.study, machine);
}

}  // namespace equipoise
