// Runs, names and compares ensembles.
#include "ensemble.hpp"

#include <algorithm>
#include <set>

#include "equipoise/core/statistics/comparison.hpp"

namespace equipoise::audit {

std::string kind_of_name(const std::string& name) {
  std::string kind = name.substr(0, name.find(" ("));
  for (const char* mark : {", period", ", quasi-periodic", ", chaotic", ", back after"})
    kind = kind.substr(0, kind.find(mark));
  return kind;
}

std::string Ensemble::name(std::size_t i) const {
  if (outcomes[i].kind != OutcomeKind::attracted) return name_of(outcomes[i].kind);
  const Attractor* a = catalogue.find(outcomes[i].attractor);
  return a ? a->name : "unlisted";
}

std::string Ensemble::kind(std::size_t i) const { return kind_of_name(name(i)); }

bool Ensemble::decided(std::size_t i) const {
  return outcomes[i].kind == OutcomeKind::attracted || outcomes[i].kind == OutcomeKind::stalled;
}

std::map<std::string, std::uint64_t> Ensemble::kinds() const {
  std::map<std::string, std::uint64_t> counts;
  for (std::size_t i = 0; i < outcomes.size(); ++i) ++counts[kind(i)];
  return counts;
}

std::vector<double> Ensemble::decision_times(const Study& study) const {
  const double settled = study.speed.driven() ? study.drive().pieces.back().begin
                                              : std::max(study.speed_profile().settled_time(), study.release_time());
  std::vector<double> times;
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    if (decided(i)) times.push_back(std::max(outcomes[i].time - settled, 0.0));
  std::sort(times.begin(), times.end());
  return times;
}

Ensemble run_ensemble(Study study, std::uint64_t starts, const BasinOptions& options) {
  Ensemble ensemble;
  BasinOptions all = options;
  all.outcome = [&](const Outcome& outcome) { ensemble.outcomes.push_back(outcome); };
  study.sampling.starts = starts;
  ensemble.own_rotors = !study.uncertain.empty();
  ensemble.result = basin(study, all, &ensemble.catalogue);
  return ensemble;
}

Pairs compare_pairs(const Ensemble& a, const Ensemble& b, bool undecided_too) {
  Pairs pairs;
  for (std::size_t i = 0; i < std::min(a.outcomes.size(), b.outcomes.size()); ++i) {
    if (!undecided_too && !(a.decided(i) && b.decided(i))) continue;
    ++pairs.compared;
    if (a.kind(i) == b.kind(i)) continue;
    if (pairs.differ++ == 0) pairs.first_difference = i;
  }
  return pairs;
}

SharesApart compare_shares(const Ensemble& a, const Ensemble& b) {
  SharesApart worst;
  const auto first = a.kinds(), second = b.kinds();
  std::set<std::string> kinds;
  for (const auto& list : {first, second})
    for (const auto& [kind, count] : list) kinds.insert(kind);
  const auto count = [](const auto& list, const std::string& kind) {
    const auto at = list.find(kind);
    return at == list.end() ? std::uint64_t{0} : at->second;
  };
  for (const std::string& kind : kinds) {
    const std::uint64_t n = a.outcomes.size(), m = b.outcomes.size(), k = count(first, kind), l = count(second, kind);
    const double share = static_cast<double>(l) / static_cast<double>(m);
    const double probability = agreement_p_value(k, n, {share, 0.0, m});
    if (probability < worst.probability)
      worst = {probability, kind, static_cast<double>(k) / static_cast<double>(n), share};
  }
  return worst;
}

}  // namespace equipoise::audit
