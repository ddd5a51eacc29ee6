// Notes that are kept beside an output, among its unfinished results.
#pragma once

#include <memory>

#include "equipoise/base/notes.hpp"
#include "equipoise/files/journal.hpp"

namespace equipoise::store {

/// What earlier runs into this journal noted, and where new notes go: those of work that takes some seconds, and of all
/// work that is given up. The journal outlives them. A disk that cannot take a note ends no work; from then on none is
/// kept.
std::unique_ptr<Notes> notes_kept_in(Journal& journal);

/// Those that work on incomplete results goes on with stay, as notes alone; of complete ones nothing does.
void leave_notes(Journal& journal, bool complete);

}  // namespace equipoise::store
