// Parts that all pages share: the machine, how it was computed, the full study.
// This room: pages for a meeting.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/results/commands/machine_page.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// A page with its title, "Ball balancer: angle-grinder", a verdict if there is one, and the answer.
Document page_with(const Study& study, const std::string& answer, const std::optional<Notice>& verdict = {});
/// Adds a note if some cells are missing.
void add_missing_cells(Document& document, std::size_t done, std::size_t cells);

/// "at random ball angles, seed 1"; `drawn`: keys of values that each start draws.
std::string starts_words(const Study& study, const std::vector<std::string>& drawn);

/// What a run took; negligible times are omitted.
struct RunWords {
  std::string cpu_target;
  int threads = 1;
  double seconds = 0.0, cpu_seconds = 0.0;
};
/// Speed law, intervals, model, version, time; without a full stop.
std::string model_words(const Study& study, const RunWords& run);

/// Heading, the study's statements, what follows, warnings. `given`: whose values these are; `fold`: rules of thumb are
/// shown on demand, and what is assumed stands in a section of its own.
void add_machine(Document& document, const GivenMachine& machine, const std::string& given, bool fold = false);

/// The full study, folded: in physical units if it has them, and dimensionless.
void add_study(Document& document, const Study& study);

}  // namespace equipoise
