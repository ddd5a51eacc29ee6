// The paper computed again: figures, table 7, open questions; all of it, as `equipoise reproduce` shows it.
// This room: the paper computed again, and judged.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/analyses/one_study/observation.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/core/statistics/share.hpp"
#include "equipoise/extras/literature/published_tables.hpp"
#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/report/drawing/document.hpp"
#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// Speed laws to compute ramps under. At constant speed there is no difference.
enum class LawChoice { published, kinematic, both };
inline constexpr std::array<const char*, 3> law_choice_names{"published", "kinematic", "both"};

/// Progress is in starts of all ensembles requested, then in curves, pixels and starts of the other parts.
struct ReproduceOptions : RunOptions {
  std::vector<int> tables;  ///< 1 to 7
  LawChoice laws = LawChoice::both;
  std::uint64_t starts = 0;  ///< per row; 0: as many as in the paper
  /// Folder for a NetCDF file of every ensemble's outcomes; empty: none. Ensembles found there are reused or resumed.
  std::string folder;
  std::vector<std::string> figures;  ///< among paper_figure_ids()
  bool future = false;               ///< the open questions
  int slice_pixels = 64;             ///< along each side of their basin slices
};

/// Shares at one speed: of starts all over the box, and of starts at rest with the same ball angles.
struct BoxShares {
  double speed = 0.0;
  BasinResult box, rest;
};

struct OpenQuestions {
  BasinSlice eccentricity_and_angle;  ///< lambda and phi_1, the balls opposite each other
  BasinSlice eccentricity_and_mass;   ///< lambda and mu, the balls at -pi/2 and pi/2
  std::vector<BoxShares> boxes;       ///< by rising speed
  bool complete = true;               ///< false: stopped; the parts that are here are valid
};

/// The rotor of the paper's section 4 (zeta = 0.5, mu = beta = 0.05, lambda = 0.01) at constant speed 2.4, balls free
/// and everything at rest in the rotating frame, unless a question varies it. The box of the third question: |x|, |y|
/// <= 0.2, |x'|, |y'| <= 0.5, |phi_i'| <= 2.4, any ball angles. The paper names no box, and shares depend on it. This
/// one includes the motions that starts at rest come to (r up to 0.15, x' to 0.25, ball rates to -2.38), rotors held
/// further out, and balls from rest in the fixed frame at speed 2.4 to as fast again ahead of the rotor.
OpenQuestions open_questions(const ReproduceOptions& settings);

struct FigureSeries {
  std::string label;
  model::SpeedLaw law = model::SpeedLaw::published;
  std::vector<double> t, r;
  std::string study;  ///< resolved, as TOML
};
struct FigurePanel {
  std::string title;
  std::vector<FigureSeries> series;
};
struct PaperFigure {
  std::string id, title, caption;
  std::string choice;  ///< how a gap in the paper's caption was filled here; empty if there is none
  std::vector<FigurePanel> panels;
};

/// "figure-attractors", "figure-transients", "figure-ball-lag", "figure-release".
std::vector<std::string> paper_figure_ids();

/// Computes a figure's curves by simulate(). Panels are empty if stopped early. `id`: one of paper_figure_ids().
PaperFigure paper_figure(const std::string& id, const StopFlag* stop = nullptr);

/// Columns panel, series, law, t, r, after comment lines with the caption and every curve's study.
std::string figure_csv(const PaperFigure& figure);

/// A printed row of table 7 (docs/evidence/table-7.md): the ramp function rises from 0 to 3 until T0, stays until T1
/// and falls to 2 until T2.
struct Table7Row {
  double t0, t1, t2;
  double printed;  ///< balanced, in percent of 300 000 starts
  std::string label() const;
};
inline constexpr std::array<Table7Row, 4> table_7_rows{
    {{50, 400, 500, 98.43}, {100, 300, 500, 97.19}, {100, 400, 500, 97.64}, {200, 400, 500, 93.64}}};

/// A test of balance at a finite time: r stays below `tolerance` throughout [from, to], multiples of table_7_window, or
/// at one time if both are equal.
struct Table7Test {
  double from, to, tolerance;
};
inline constexpr double table_7_window = 10.0;

/// How many of the starts observed in windows of table_7_window pass `test`.
std::uint64_t called_balanced(const Observation& observation, const Table7Test& test);

struct LeadReading {
  Table7Row row;
  Share balanced;  ///< starts that pass the test
};

/// The best lead, not a claim: kinematic law, balls released at 2.2, balanced if r stays below 0.00134 from t = 630 to
/// 730. The release was chosen among 96 protocols; time and tolerance were FITTED to the printed shares; none is in the
/// paper's text. Uses starts 0 .. starts - 1 of seed 1. Throws RunError if stopped early.
std::vector<LeadReading> observe_table_7_lead(std::uint64_t starts, int threads = 0, const StopFlag* stop = nullptr);

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

/// One JSON object; docs/reference/commands/reproduce.md lists the keys.
std::string json_text(const Reproduction& r);

/// What can be reproduced: "table-1" to "table-7", the figures, "future", and "tables", "figures", "all".
std::vector<std::string> reproducible();
/// Options for these; empty: everything. Throws InputError for names that are not in reproducible().
ReproduceOptions options_for(const std::vector<std::string>& what);

/// Everything requested, judged and summed up. The caller draws the pictures. After a stop the result is partial, and
/// missing rows of tables are marked. Throws as basin() does.
Reproduction reproduce(const ReproduceOptions& options);

// The same as a report: its blocks, plots, words and numbers.

/// Each drawing stands below a heading whose anchor names it ("table-3", "figure-transients"). `explorer`: address of
/// the explorer's page, to which every row's study then links; may be empty.
Document reproduction_document(const Reproduction& r, const std::string& explorer = "");

/// Agreeing, differing and not comparable cells of all tables.
CellCounts all_cells(const Reproduction& r);

/// What a slice over lambda and a ball's angle, or over lambda and mu, shows of the eccentricity that the balls
/// balance. Values are those of pixel centres. Empty for an incomplete slice.
std::string balanced_text(const BasinSlice& map);

}  // namespace equipoise
