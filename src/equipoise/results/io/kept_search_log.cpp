// One record per answer, with page and number as `first` and `count`.
#include "equipoise/results/io/kept_search_log.hpp"

#include <utility>
#include <vector>

#include "equipoise/core/base/error.hpp"

namespace equipoise::io {

namespace {

// Less work is soon repeated, and a sweep has a thousand such pieces.
constexpr double worth_keeping = 2.0;

}  // namespace

std::unique_ptr<SearchLog> notes_kept_in(Journal& journal) {
  const auto keep = [&journal, full = false](std::uint64_t page, std::uint64_t number,
                                             const std::vector<char>& answer) mutable {
    try {
      if (!full)
        journal.append({.kind = Journal::Kind::note, .first = page, .count = number}, answer.data(), answer.size());
    } catch (const RunError&) {  // if results cannot be written either, they report it
      full = true;
    }
  };
  auto notes = std::make_unique<SearchLog>(keep, worth_keeping);
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

}  // namespace equipoise::io
