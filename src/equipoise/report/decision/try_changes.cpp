// Ensembles of studies with one thing changed: a look at each, and a closer one at those that may serve.
#include "equipoise/report/decision/verdict.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/core/running/reporting.hpp"
#include "equipoise/core/running/run_info.hpp"

namespace equipoise {

namespace {

// Whether more starts would give the same answer: too few meet the limits, or too many end vibrating.
bool surely_fails(const TriedChange& t) { return t.decision == Decision::change || t.decision == Decision::do_not_fit; }

class Trials {
 public:
  Trials(const Study& study, const RunOptions& options)
      : changes_(usual_changes(study)), options_(options), searches_(changes_.size()), begin_(cpu_seconds()) {}

  std::vector<TriedChange> run() {
    for (std::size_t k = 0; k < changes_.size() && !is_over(); ++k) {
      if (options_.progress) options_.progress({k, changes_.size(), "changes", {}, false});
      // A look saves nothing where changes do not fail: then the next one is tried on all starts at once.
      const bool looks = done_.empty() || surely_fails(done_.back().second);
      if (looks && !look(k, starts_of_a_look)) continue;
      if ((!looks || !surely_fails(done_.back().second)) && !look(k, starts_of_a_change)) continue;
      if (done_.back().second.decision == Decision::fit) return told();
    }
    look_closer();
    return told();
  }

 private:
  double spent() const { return cpu_seconds() - begin_; }
  bool is_over() const { return is_set(options_.stop) || spent() > seconds_for_changes; }

  // Judges change `k`, in place of an earlier look. False if it could not, or took too long.
  bool look(std::size_t k, std::uint64_t starts) {
    BasinOptions one;
    one.threads = options_.threads;
    one.stop = options_.stop;
    one.stop_asked = [this, begin = spent()] {
      return spent() > longest_for_changes || spent() - begin > longest_for_a_change;
    };
    one.cpu_target = options_.cpu_target;
    one.transients = true;
    one.search = SearchMode::few;
    one.searches = &searches_[k];
    Study study = changes_[k].study;
    study.sampling.starts = starts;
    const BasinResult result = basin(study, one);
    if (result.partial) return false;
    std::optional<TriedChange> judged = tried_change(changes_[k].words, result);
    if (!judged) return false;
    const auto before = std::find_if(done_.begin(), done_.end(), [&](const auto& d) { return d.first == k; });
    if (before == done_.end()) {
      done_.emplace_back(k, *std::move(judged));
      return true;
    }
    judged->seconds += before->second.seconds;
    judged->cpu_seconds += before->second.cpu_seconds;
    before->second = *std::move(judged);
    return true;
  }

  // Of changes that all fail, those that may be the best are tried on all starts.
  void look_closer() {
    while (!done_.empty() && !is_over()) {
      const auto best = std::min_element(
          done_.begin(), done_.end(), [](const auto& a, const auto& b) { return serves_better(a.second, b.second); });
      const auto open = std::find_if(done_.begin(), done_.end(), [&](const auto& d) {
        return d.second.starts < starts_of_a_change && may_serve_better(d.second, best->second);
      });
      if (open == done_.end() || !look(open->first, starts_of_a_change)) return;
    }
  }

  std::vector<TriedChange> told() {
    std::vector<TriedChange> all;
    for (auto& [k, judged] : done_) all.push_back(std::move(judged));
    return all;
  }

  const std::vector<Change> changes_;
  const RunOptions& options_;
  std::vector<AttractorSearchCache> searches_;  // of each change, so that its second look has the first one's
  const double begin_;
  std::vector<std::pair<std::size_t, TriedChange>> done_;
};

}  // namespace

std::vector<TriedChange> try_changes(const Study& study, const RunOptions& options) {
  return reported(options, [&](const RunOptions& inner) { return Trials(study, inner).run(); });
}

std::vector<TriedChange> changes_asked_for(const BasinResult& result, const RunOptions& options) {
  if (result.partial) return {};
  const auto verdict = verdict_of(result);
  return verdict && verdict->asks_for_changes() ? try_changes(result.study, options) : std::vector<TriedChange>{};
}

}  // namespace equipoise
