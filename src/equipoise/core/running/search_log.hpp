// The search log: intermediate results with which interrupted work continues.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/core/base/bytes.hpp"
#include "equipoise/core/base/random.hpp"
#include "equipoise/core/base/stop_flag.hpp"

namespace equipoise {

/// Answers of earlier runs, by page and number. New answers are passed on to be kept. The work must ask the same
/// questions in the same order every time.
class SearchLog {
 public:
  /// Called from any thread, but never from two at once. Its exceptions leave the work.
  using Keep = std::function<void(std::uint64_t page, std::uint64_t number, const std::vector<char>& answer)>;

  SearchLog() = default;
  /// A page's answers are kept once its work has taken `worth` seconds, or when it is abandoned.
  explicit SearchLog(Keep keep, double worth = 0.0) : keep_(std::move(keep)), worth_(worth) {}

  /// Adds an answer of an earlier run, before the work begins.
  void know(std::uint64_t page, std::uint64_t number, std::vector<char> answer) {
    known_.insert_or_assign({page, number}, std::move(answer));
  }

 private:
  friend class NotePage;

  const std::vector<char>* find(std::uint64_t page, std::uint64_t number) const {
    const auto at = known_.find({page, number});
    return at == known_.end() ? nullptr : &at->second;
  }
  void keep(std::uint64_t page, std::uint64_t number, const std::vector<char>& answer) {
    const std::lock_guard lock(keeping_);
    if (keep_) keep_(page, number, answer);
  }

  Keep keep_;
  double worth_ = 0.0;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::vector<char>> known_;
  std::mutex keeping_;
};

/// For answers that may have any value.
struct AnyAnswer {
  template <class Answer>
  bool operator()(const Answer&) const {
    return true;
  }
};

/// The answers of one piece of work. Destroying the page before finish() abandons the work.
class NotePage {
 public:
  /// `subject`: everything that the work depends on. Without `notes` every answer is computed.
  NotePage(SearchLog* notes, const std::string& subject);
  ~NotePage();
  NotePage(const NotePage&) = delete;
  NotePage& operator=(const NotePage&) = delete;

  /// The work is done: answers not kept so far are dropped.
  void finish() { waiting_.clear(); }

  /// The known answer to `question`, else the result of `work`. That is noted unless `stop` is set by then.
  /// A known answer counts only if fits(answer): it comes from a file.
  template <class Work, class Fits = AnyAnswer>
  auto answer(const char* question, const StopFlag* stop, const Work& work, const Fits& fits = {}) {
    return answer_at(reserve(1), question, stop, work, fits);
  }

  /// The first of `count` numbers for answers computed in parallel.
  std::uint64_t reserve(std::size_t count) { return std::exchange(next_, next_ + count); }
  template <class Work, class Fits = AnyAnswer>
  auto answer_at(std::uint64_t number, const char* question, const StopFlag* stop, const Work& work,
                 const Fits& fits = {}) {
    using Answer = decltype(work());
    if (!notes_) return work();
    const std::uint64_t asked = hash_of(question);
    if (const std::vector<char>* known = notes_->find(page_, number)) {
      Answer result{};
      std::uint64_t told = 0;
      BytesIn in(*known);
      in(told, result);
      if (in.whole() && told == asked && fits(result)) return result;
    }
    Answer result = work();
    if (is_set(stop)) return result;  // it may have been cut short
    keep(number, bytes_of(asked, result));
    return result;
  }

 private:
  void keep(std::uint64_t number, std::vector<char> answer);
  void hand_on();

  SearchLog* const notes_;
  const std::uint64_t page_;
  std::uint64_t next_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::vector<std::pair<std::uint64_t, std::vector<char>>> waiting_;  // by number
  std::mutex writing_;
};

/// `page` may be null: nothing is noted.
template <class Work, class Fits = AnyAnswer>
auto noted(NotePage* page, const char* question, const StopFlag* stop, const Work& work, const Fits& fits = {}) {
  return page ? page->answer(question, stop, work, fits) : work();
}

}  // namespace equipoise
