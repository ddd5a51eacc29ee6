// What other groups printed, as data: each publication with its symbols, and its numbers row by row. A row says how its
// number is computed here.
// This room: what other groups published, as a table, and its judgement.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// A number and how far it may be off, as a half-width.
struct Estimate {
  double value = 0.0, error = 0.0;
};
inline Estimate exactly(double value) { return {value, 0.0}; }

/// How a publication's number is known.
enum class KnownBy {
  print,    ///< printed; the error is half a unit of its last digit, or of the digits that were noted
  plot,     ///< read off a plot; the error is that of reading
  formula,  ///< follows from a printed formula, evaluated here
  code,     ///< came out of the code that was published with it, run
};
inline constexpr std::array<const char*, 4> known_by_names{"printed", "read off", "formula", "code run"};

/// A symbol of the publication, and what it is in a study.
struct SymbolMapping {
  const char* theirs;
  const char* ours;
};

/// One number of a publication.
struct PublicationRow {
  const char* place;     ///< figure, equation or page
  const char* quantity;  ///< what it is
  const char* unit;      ///< empty: dimensionless
  KnownBy known_by = KnownBy::print;
  Estimate published{};
  std::vector<std::string> settings{};  ///< overrides of the publication's study
  /// The number as this program has it. Null: not computed, and `reason` says why.
  Estimate (*computed)(const Study& study, const RunOptions& options) = nullptr;
  const char* reason = "";                            ///< why it differs, or is not computed
  Estimate (*formula)(const Study& study) = nullptr;  ///< in place of `published`, for KnownBy::formula
  const char* study = nullptr;                        ///< where it is not the publication's
};

struct Publication {
  const char* name;      ///< on the command line
  const char* title;     ///< authors and year
  const char* citation;  ///< docs/reference/references.md has it too
  const char* seen;      ///< what of it was read
  const char* study;     ///< file in studies/publications, without ".toml"; empty: nothing of it is computed
  std::vector<SymbolMapping> symbols;
  std::vector<PublicationRow> rows;
};

/// In the order in which they are told.
const std::vector<Publication>& publications();
/// Null if there is none of this name.
const Publication* find_publication(std::string_view name);
/// The study of a row.
Study study_of(const Publication& publication, const PublicationRow& row);

}  // namespace equipoise
