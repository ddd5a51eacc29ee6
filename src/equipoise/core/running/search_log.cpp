// Pages and answers of the search log, by number.
#include "equipoise/core/running/search_log.hpp"

#include <exception>

namespace equipoise {

// Two of a run's hundred pages share a number once in 10^15 runs.
NotePage::NotePage(SearchLog* notes, const std::string& subject) : notes_(notes), page_(hash_of(subject)) {}

NotePage::~NotePage() {
  try {
    hand_on();
  } catch (const std::exception&) {  // a full disk costs only time
  }
}

void NotePage::keep(std::uint64_t number, std::vector<char> answer) {
  const std::lock_guard lock(writing_);
  waiting_.emplace_back(number, std::move(answer));
  if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count() >= notes_->worth_) hand_on();
}

void NotePage::hand_on() {
  for (const auto& [number, answer] : waiting_) notes_->keep(page_, number, answer);
  waiting_.clear();
}

}  // namespace equipoise
