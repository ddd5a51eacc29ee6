// Publications computed again and judged, row by row; as text, JSON and a page.
#pragma once

#include <string>
#include <vector>

#include "equipoise/extras/publications/publication.hpp"
#include "equipoise/report/drawing/document.hpp"

namespace equipoise {

enum class RowVerdict {
  agrees,        ///< as near as both errors together allow
  differs,       ///< farther
  explained,     ///< farther, for a reason that is known
  not_computed,  ///< for a reason that is stated
};
inline constexpr std::array<const char*, 4> row_verdict_names{"agrees", "differs", "differs as known", "not computed"};
inline const char* name_of(RowVerdict v) { return row_verdict_names[static_cast<std::size_t>(v)]; }

struct JudgedRow {
  const PublicationRow* row;
  Estimate published, computed;  ///< `computed` only if the row was
  RowVerdict verdict = RowVerdict::not_computed;
};

struct JudgedPublication {
  const Publication* publication;
  std::vector<JudgedRow> rows;
};

struct JudgedPublications {
  std::vector<JudgedPublication> list;
  std::string command;
  bool partial = false;

  int count(RowVerdict verdict) const;
  /// Whether a row differs for no known reason.
  bool differs() const { return count(RowVerdict::differs) > 0; }
};

/// By both sides' errors.
RowVerdict judged(const Estimate& published, const Estimate& computed, const PublicationRow& row);
/// The publications of these names; progress is in rows. Throws InputError for a name that there is not.
JudgedPublications judge_publications(const std::vector<std::string>& names, const RunOptions& options = {});

/// Text within 80 columns for the terminal.
std::string publications_text(const JudgedPublications& r);
/// One JSON object; docs/reference/commands/reproduce.md lists the keys.
std::string publications_json(const JudgedPublications& r);
Document publications_document(const JudgedPublications& r);
/// What can be reproduced, a publication a line; `parts`: of Wright and Peng.
std::string publications_list(const std::vector<std::string>& parts);

}  // namespace equipoise
