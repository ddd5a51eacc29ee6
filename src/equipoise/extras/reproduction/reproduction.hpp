// The result of `equipoise reproduce`, and its text and JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/extras/literature/reproduction.hpp"
#include "equipoise/extras/reproduction/open_questions.hpp"
#include "equipoise/extras/reproduction/paper_figures.hpp"
#include "equipoise/extras/reproduction/table_7.hpp"
#include "equipoise/report/text/table_text.hpp"

namespace equipoise {

/// A picture file and what it shows.
struct Picture {
  std::string id, title, path;
};

struct Reproduction {
  std::vector<ReproducedTable> tables;
  std::vector<ConclusionRow> conclusions;
  std::vector<LeadReading> table_7_lead;
  std::vector<PaperFigure> figures;
  std::optional<OpenQuestions> open;
  std::vector<Picture> pictures;
  std::string command;                              ///< the command that made it
  bool partial = false;                             ///< stopped before everything was done
  double seconds = 0.0, cpu_seconds = 0.0;          ///< of all ensembles, including earlier runs' time for stored ones
  double run_seconds = 0.0, run_cpu_seconds = 0.0;  ///< of this run, with figures, slices and ensembles that were not
                                                    ///< stored
  std::uint64_t starts = 0, ensembles = 0;
  int threads = 0;
  std::string cpu_target;
  /// Whether a cell differs although agreement is claimed.
  bool differs() const;
};

/// Tables for the terminal.
std::string reproduction_text(const Reproduction& r, const TextStyle& style = wide_style);
/// One JSON object; docs/reference/commands/reproduce.md lists the keys.
std::string reproduction_json(const Reproduction& r);

}  // namespace equipoise
