// A record a note: its page and number where other records say which results they hold.
#include "equipoise/files/kept_notes.hpp"

#include <utility>
#include <vector>

namespace equipoise::store {

std::unique_ptr<Notes> notes_kept_in(Journal& journal) {
  auto notes =
      std::make_unique<Notes>([&journal](std::uint64_t page, std::uint64_t number, const std::vector<char>& answer) {
        journal.append({.kind = Journal::Kind::note, .first = page, .count = number}, answer.data(), answer.size());
      });
  for (const Journal::Record& record : journal.records()) {
    if (record.kind != Journal::Kind::note) continue;
    std::vector<char> answer(record.bytes);
    journal.read(record, 0, answer.size(), answer.data());
    notes->know(record.first, record.count, std::move(answer));
  }
  return notes;
}

void leave_notes(Journal& journal, bool complete) {
  complete ? journal.remove() : journal.keep_only(Journal::Kind::note);
}

}  // namespace equipoise::store
