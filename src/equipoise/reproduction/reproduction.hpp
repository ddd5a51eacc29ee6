// All that `equipoise reproduce` found, and its forms for people and for machines.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/literature/reproduction.hpp"
#include "equipoise/reproduction/open_questions.hpp"
#include "equipoise/reproduction/paper_figures.hpp"

namespace equipoise {

/// A picture file and what it shows.
struct Picture {
  std::string id, title, path;
};

/// A row of table 7 under the reading that fits it best of those that test balance: a lead, not a claim.
struct LeadRow {
  std::string label;
  double printed = 0.0;  ///< percent
  Share balanced;
};

/// All that `equipoise reproduce` found.
struct Reproduction {
  std::vector<ReproducedTable> tables;
  std::vector<ConclusionRow> conclusions;
  std::vector<LeadRow> table_7_lead;
  std::vector<PaperFigure> figures;
  std::optional<OpenQuestions> open;
  std::vector<Picture> pictures;
  std::string command;                              ///< that made it
  bool partial = false;                             ///< stopped before all was done
  double seconds = 0.0, cpu_seconds = 0.0;          ///< of all ensembles, with what earlier runs spent on stored ones
  double run_seconds = 0.0, run_cpu_seconds = 0.0;  ///< of this run, with figures, maps and what was not stored
  std::uint64_t starts = 0, ensembles = 0;
  int threads = 0;
  std::string cpu_target;
  /// A cell that is claimed to agree differs.
  bool differs() const;
};

/// Tables for the terminal.
std::string reproduction_text(const Reproduction& r);
/// One JSON object; docs/guide/command-line.md lists the keys.
std::string reproduction_json(const Reproduction& r);

}  // namespace equipoise
