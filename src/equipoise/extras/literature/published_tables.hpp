// The seven tables of Wright and Peng (2019) as data: the printed numbers, their studies, errors in the print; readings
// fitted to table 7; the tables computed again and judged, under either speed law.
// This room: what Wright and Peng printed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/statistics/comparison.hpp"
#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// One printed number.
struct PublishedCell {
  std::string attractor;  ///< "balanced", or the paper's name V1 to V4
  std::string printed;    ///< as in the file; in percent, or a fraction of one if `fraction`
  bool fraction = false;  ///< less than one start in percent, so it must be a fraction
  PublishedShare share;
};

/// One ensemble: a printed row, or one cell of a table whose cells are separate ensembles.
struct PublishedRow {
  std::string study;       ///< its study in studies/paper, without ending
  std::string label;       ///< "T0 = 25"
  std::string series;      ///< distinguishes rows of the same parameter: "beta = 0.05"; empty if not needed
  double parameter = 0.0;  ///< the number in `label`
  std::vector<PublishedCell> cells;
  std::string slip;  ///< what is wrong with the printed row; empty if nothing is. Cells of such a row are not judged
};

struct PublishedTable {
  int number = 0;
  std::string title;
  std::string parameter;  ///< "Omega", "T0"
  bool ramps = false;     ///< the speed varies, so that the speed law matters
  std::string unclaimed;  ///< why agreement is claimed with none of the cells; empty if it is claimed
  std::vector<PublishedRow> rows;
};

/// All seven. Throws RunError if the library was built without their data.
const std::vector<PublishedTable>& published_tables();

/// The balanced share of `second` compared with that of `first`; names of studies in studies/paper.
struct Contrast {
  std::string first, second;
};

/// One conclusion that a reader draws from the printed numbers.
struct Conclusion {
  enum class Kind {
    rises,      ///< every second share is larger than its first
    unchanged,  ///< every pair differs by less than `margin`
  };
  std::string text;
  int table = 0;
  Kind kind = Kind::rises;
  std::vector<Contrast> contrasts;
};

/// Differences below one percentage point do not matter to anyone who chooses a spin-up.
inline constexpr double unchanged_margin = 0.01;

/// What the printed tables show, as contrasts between two ensembles each, to be tested under either speed law.
const std::vector<Conclusion>& conclusions();

/// The study of a row: the file in studies/paper, with its ramp under `law`.
Study study_of(const PublishedRow& row, model::SpeedLaw law);

/// A reading of table 7 that was fitted to its printed shares, in words: laws and release, when a start counted as
/// balanced, resulting shares in percent, starts per row, deviance from the printed shares, cells minus numbers fitted.
/// docs/evidence/table-7.md describes the search.
using Table7Reading = std::array<std::string, 6>;
/// From docs/evidence/table-7-candidates.csv. Throws RunError if the library was built without it.
std::vector<Table7Reading> table_7_readings();

/// Source of the numbers.
extern const char* const published_citation;

/// Two equal balls, mu = 0.05 each, lambda = 0.01; zeta and beta as varied in the figures and tables. [speed] and all
/// other settings at their defaults.
inline Study paper_rotor(double zeta = 0.5, double beta = 0.05) {
  Study study;
  model::Parameters& p = study.parameters;
  p.balls = 2;
  p.eccentricity = 0.01;
  p.damping = {zeta, zeta};
  p.mass[0] = p.mass[1] = 0.05;
  p.drag[0] = p.drag[1] = beta;
  return study;
}

/// One row's starts under one law.
struct EnsembleResult : BasinResult {  ///< its times are those of all runs
  std::vector<bool> balanced;          ///< start by start, for comparisons on common starts
  /// Share of the attractor that the paper calls by this name ("balanced", "V1"); of no starts if it was not met.
  Share share_of(const std::string& attractor) const;
};

enum class Verdict { agrees, differs, not_comparable };
/// "agrees", "differs", "not comparable".
const char* name_of(Verdict verdict);

struct ReproducedCell {
  const PublishedCell* published = nullptr;
  Share computed;        ///< 95 % Wilson interval
  double p_value = 1.0;  ///< probability of a difference at least this large by chance
  Verdict verdict = Verdict::not_comparable;
  std::string reason;  ///< why it is not comparable
};

struct ReproducedRow {
  const PublishedRow* published = nullptr;
  std::optional<EnsembleResult> by_published_law, by_kinematic_law;  ///< at constant speed only the first is set
  std::vector<ReproducedCell> cells;                                 ///< judged under the published law
  std::optional<ShareDifference> law_difference;  ///< balanced share, kinematic minus published, 99 %, common starts
  std::string follow_up;                          ///< why more starts than asked were taken; empty if they were not

  /// use(ensemble, law) for each law that was computed.
  template <class Use>
  void for_each_law(const Use& use) const {
    if (by_published_law) use(*by_published_law, model::SpeedLaw::published);
    if (by_kinematic_law) use(*by_kinematic_law, model::SpeedLaw::kinematic);
  }
};

struct CellCounts {
  int agreeing = 0, differing = 0, not_comparable = 0;
  int below_one_percent = 0;  ///< judged cells with p < 0.01 each; chance gives one in a hundred
};

struct ReproducedTable : CellCounts {
  const PublishedTable* published = nullptr;
  std::vector<ReproducedRow> rows;
  double single_limit = 0.0;  ///< a cell differs if its p value is below this: 1 % over all judged cells of the table
};

/// One conclusion tested under one law.
struct ConclusionResult {
  enum class Answer {
    holds,         ///< every difference certainly lies where the conclusion says
    reversed,      ///< every difference certainly lies on the other side
    contradicted,  ///< at least one certainly does
    open,          ///< none does, but not all are certain
    not_asked,
  };
  Answer answer = Answer::not_asked;
  std::vector<ShareDifference> differences;  ///< one per contrast, 99 %, common starts
};
const char* name_of(ConclusionResult::Answer answer);

struct ConclusionRow {
  const Conclusion* conclusion = nullptr;
  ConclusionResult published, kinematic;
  /// Whether either law was asked.
  bool asked() const { return !published.differences.empty() || !kinematic.differences.empty(); }
};

/// Fills in counts and verdicts of a table whose rows are computed.
void judge(ReproducedTable& table);
/// Conclusions from the rows that are available.
std::vector<ConclusionRow> judge_conclusions(const std::vector<ReproducedTable>& tables);

}  // namespace equipoise
