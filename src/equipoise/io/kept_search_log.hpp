// SearchLog kept in an output's journal.
#pragma once

#include <memory>

#include "equipoise/io/journal.hpp"
#include "equipoise/running/search_log.hpp"

namespace equipoise::io {

/// The notes of earlier runs; new ones are kept of work that takes some seconds, and of all work that is given up.
/// After a write error no more are kept, and work goes on. The journal outlives the notes.
std::unique_ptr<SearchLog> notes_kept_in(Journal& journal);

/// SearchLog of incomplete results stay; of complete ones nothing does.
void leave_notes(Journal& journal, bool complete);

}  // namespace equipoise::io
