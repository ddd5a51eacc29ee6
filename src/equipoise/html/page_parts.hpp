// What all pages share: the machine, how it was computed, the study in full.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/drawing/document.hpp"
#include "equipoise/results/machine_page.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Charts beside each other; a single one may be `wide`.
DrawingRow drawn(const std::vector<Chart>& charts, const std::string& title, const std::string& caption, bool wide);

/// A page with its title, "Ball balancer: angle-grinder", and, first of all, the answer.
Document page_with(const Study& study, const std::string& answer);
/// Says so if not all cells are done.
void add_missing_cells(Document& document, std::size_t done, std::size_t cells);

/// "at random ball angles, seed 1"; `drawn`: keys of what is drawn with each start.
std::string starts_words(const Study& study, const std::vector<std::string>& drawn);

/// What a run took; next to no time is not told.
struct RunWords {
  std::string cpu_target;
  int threads = 1;
  double seconds = 0.0, cpu_seconds = 0.0;
};
/// Speed law, intervals, model, version, time; without a full stop.
std::string model_words(const Study& study, const RunWords& run);

/// Heading, what the study says, what follows, what to beware of. `given`: whose values these are.
void add_machine(Document& document, const GivenMachine& machine, const std::string& given);

/// The study in full, folded: in physical units if it has them, and without dimensions.
void add_study(Document& document, const Study& study);

}  // namespace equipoise
