// A search log kept in an output's journal.
#pragma once

#include <memory>

#include "equipoise/core/running/search_log.hpp"
#include "equipoise/results/io/journal.hpp"

namespace equipoise::io {

/// A log with the answers of earlier runs. New answers are kept for work that takes some seconds, and for all work that
/// is abandoned. After a write error no more are kept, but the work continues. The journal must outlive the log.
std::unique_ptr<SearchLog> notes_kept_in(Journal& journal);

/// Removes the journal if the results are complete; otherwise keeps only the search log in it.
void leave_notes(Journal& journal, bool complete);

}  // namespace equipoise::io
