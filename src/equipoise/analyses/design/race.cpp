// Gives every candidate a first look, and more starts to those that may beat the best so far.
#include "equipoise/analyses/design/race.hpp"

#include <algorithm>
#include <set>

#include "equipoise/analyses/design/settings.hpp"

namespace equipoise {

namespace {

constexpr std::uint64_t more_starts = 4;  // halves an interval
constexpr int raises = 3;
// A search among a few values ends before its budget is spent: after this many points in a row that were all known.
// Batches are no measure: an optimiser that learns nothing new restarts with ever larger ones.
constexpr std::size_t most_idle = 5000;

}  // namespace

std::size_t Race::enter(const SearchPoint& point) {
  DesignCandidate candidate;
  candidate.settings = problem_.settings_at(point);
  const auto [at, fresh] = places_.emplace(text_of(candidate.settings), candidates_.size());
  if (fresh) candidates_.push_back(std::move(candidate));
  return at->second;
}

void Race::look(const std::vector<std::size_t>& places, std::uint64_t starts) {
  std::vector<WantedSample> wanted;
  for (const std::size_t k : places) wanted.push_back({candidates_[k].changes(), starts, seed_});
  const auto take = [&] {
    for (std::size_t k = 0; k < places.size(); ++k)
      if (const DesignSample* sample = ensembles_.sample(wanted[k])) candidates_[places[k]].search = *sample;
  };
  try {
    ensembles_.run(wanted);
  } catch (const SearchOver&) {  // stopped: expensive candidates may have left no time for more than this batch
    take();
    throw;
  }
  take();
  for (const std::size_t k : places) take_into_leaders(k);
}

// A candidate that has become worse than it looked releases those that it beat; they are searched again at the end.
void Race::take_into_leaders(std::size_t place) {
  std::erase(leaders_, place);
  const DesignSample& sample = candidates_[place].search;
  for (const std::size_t k : leaders_)
    if (standing_.beats(candidates_[k].search, Side::doubtful, sample, Side::doubtful)) return;
  std::erase_if(leaders_, [&](std::size_t k) {
    return standing_.beats(sample, Side::doubtful, candidates_[k].search, Side::doubtful);
  });
  leaders_.push_back(place);
}

// The most promising first: not all may be affordable.
std::vector<std::size_t> Race::might_win(const std::vector<std::size_t>& places) const {
  std::vector<std::size_t> rivals;
  std::vector<const DesignSample*> samples;
  for (const std::size_t k : places) {
    const DesignSample& sample = candidates_[k].search;
    const bool beaten =
        sample.figures.empty() || std::any_of(leaders_.begin(), leaders_.end(), [&](std::size_t leader) {
          return leader != k && standing_.beats(candidates_[leader].search, Side::estimate, sample, Side::hopeful);
        });
    if (beaten) continue;
    rivals.push_back(k);
    samples.push_back(&sample);
  }
  std::vector<std::size_t> result;
  for (const std::size_t k : standing_.order(samples, Side::doubtful)) result.push_back(rivals[k]);
  return result;
}

// Larger samples get at most half as much as first looks: near the end all candidates are about equally good.
void Race::raise(std::vector<std::size_t> places) {
  std::uint64_t starts = problem_.first_look();
  for (int k = 0; k < raises; ++k) {
    starts *= more_starts;
    std::vector<std::size_t> affordable;
    for (const std::size_t place : might_win(places)) {
      if (candidates_[place].search.starts >= starts) continue;
      if (2 * (raised_ + starts) > looked_ || ensembles_.trajectories() + starts > budget_) break;
      raised_ += starts;
      affordable.push_back(place);
    }
    if (affordable.empty()) return;
    look(affordable, starts);
    places = affordable;
  }
}

void Race::note_best() {
  if (leaders_.empty()) return;
  std::vector<const DesignSample*> samples;
  for (const std::size_t k : leaders_) samples.push_back(&candidates_[k].search);
  const DesignCandidate& best = candidates_[leaders_[standing_.order(samples, Side::doubtful).front()]];
  const DesignStep step{ensembles_.trajectories(), standing_.violation(best.search, Side::worst),
                        best.search.figures.empty() ? 0.0 : best.search.figures[problem_.objectives().front()].value};
  if (history_.empty() || history_.back().value != step.value || history_.back().violation != step.violation)
    history_.push_back(step);
  told_(&best);
}

std::vector<SearchWorth> Race::judge(const std::vector<SearchPoint>& points) {
  if (ensembles_.stopped() || ensembles_.out_of_time())
    throw SearchOver();  // known points start no ensemble that would notice
  std::vector<std::size_t> places, fresh;
  std::set<std::size_t> seen;
  const std::size_t known = candidates_.size();
  if (known == 0) {  // the study itself comes first
    candidates_.push_back(problem_.as_it_is());
    fresh.push_back(0);
  }
  for (const SearchPoint& point : points) {
    places.push_back(enter(point));
    if (places.back() >= known && seen.insert(places.back()).second) fresh.push_back(places.back());
  }
  idle_ = fresh.empty() ? idle_ + points.size() : 0;
  const std::uint64_t left = budget_ - std::min(budget_, ensembles_.trajectories());
  const bool last = idle_ > most_idle || fresh.size() * problem_.first_look() > left;
  if (last) {
    fresh.resize(std::min<std::size_t>(fresh.size(), left / problem_.first_look()));
    candidates_.resize(known + fresh.size());  // without those that will not be looked at
  }
  try {
    look(fresh, problem_.first_look());
    looked_ += fresh.size() * problem_.first_look();
    raise(fresh);
  } catch (const SearchOver&) {  // stopped: a candidate without a sample does not count
    std::erase_if(candidates_, [](const DesignCandidate& c) { return c.search.starts == 0 && c.search.note.empty(); });
    leaders_.clear();
    throw;
  }
  note_best();
  if (last) throw SearchOver();
  std::vector<SearchWorth> worths;
  for (const std::size_t k : places) worths.push_back(standing_.worth(candidates_[k].search));
  return worths;
}

}  // namespace equipoise
