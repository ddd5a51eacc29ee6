// Notes kept in an output's journal.
#pragma once

#include <memory>

#include "equipoise/base/notes.hpp"
#include "equipoise/files/journal.hpp"

namespace equipoise::store {

/// The notes of earlier runs; new ones are kept of work that takes some seconds, and of all work that is given up.
/// After a write error no more are kept, and work goes on. The journal outlives the notes.
std::unique_ptr<Notes> notes_kept_in(Journal& journal);

/// Notes of incomplete results stay; of complete ones nothing does.
void leave_notes(Journal& journal, bool complete);

}  // namespace equipoise::store
