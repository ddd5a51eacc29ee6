// Search, choice, check, margins.
#include "equipoise/analyses/design/design.hpp"

#include <algorithm>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include "equipoise/analyses/design/ensembles.hpp"
#include "equipoise/analyses/design/margins.hpp"
#include "equipoise/analyses/design/race.hpp"
#include "equipoise/analyses/design/search.hpp"
#include "equipoise/analyses/design/standing.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"
#include "equipoise/study/contents/below_resonance.hpp"

namespace equipoise {

namespace {

// Parts of the budget.
constexpr double for_search = 0.65, for_choice = 0.1, for_check = 0.15, for_margins = 0.1;
// With one objective, this many candidates are followed further. With requirements, several are then checked, in case
// the first turns out to miss them; one is chosen.
constexpr std::size_t most_chosen_from = 16, most_checked = 4;
constexpr std::uint64_t raise_by = 2;  // in the choice: more starts, interval by interval
constexpr std::size_t most_in_front = 24;
// Starts of one ensemble. More would not improve a figure usefully. Fewer than in the first look would know less than
// the search did; where starts are cheap, at least this many are used.
constexpr std::uint64_t most_starts = 100'000, fewest_starts_of_cheap = 500;

class DesignRun {
 public:
  DesignRun(const DesignProblem& problem, const DesignOptions& options)
      : problem_(problem), options_(options), standing_(problem), own_(problem.as_it_is()) {
    result_.study = problem.study();
    result_.variables = problem.variables();
    for (const FigureSource& f : problem.figures()) result_.figures.push_back(f.figure);
    result_.objectives = problem.objectives();
    result_.limits = problem.limits();
    result_.method = problem.method();
    result_.budget = problem.trajectories();
    result_.search_seed = problem.study().sampling.seed;
    // Any other number will do: starts of different seeds share nothing.
    result_.held_out_seed = (result_.search_seed + 1'000'003) & 0x7fffffffffffffff;
    result_.identity = problem.identity();
    result_.proposed = problem.proposed();
    note_machine(result_, options);
  }

  DesignResult run() {
    const RunClock clock;
    KeptSamples kept;
    if (!options_.output.empty())
      file_ = io::open_design_file(options_.output, result_.identity, most_ensembles(), kept);
    ensembles_ = std::make_unique<DesignEnsembles>(problem_, options_, file_.get(), std::move(kept));
    find();
    ensembles_->close();
    result_.trajectories = ensembles_->trajectories();
    result_.resumed = ensembles_->resumed();
    leave_out();
    if (result_.chosen) {
      const DesignCandidate& best = result_.front[*result_.chosen];
      result_.feasible = standing_.violation(best.best_known(), Side::worst) == 0.0;
      result_.limited_by = design_limits_reached(problem_, standing_, best);
      result_.best_study = to_toml(problem_.tree_of(best.changes()));
    }
    result_.took(clock.time());
    if (file_ && !result_.partial)
      io::finish_design_file(*file_, result_, most_ensembles(), ensembles_->kept_samples());
    return std::move(result_);
  }

 private:
  // Below the critical speed no balanced state attracts, so that all that require balance have been found wanting.
  void leave_out() {
    if (!result_.chosen || !problem_.requires_balance()) return;
    const auto below = [&](const std::vector<DesignSetting>& settings) {
      return runs_below_resonance(problem_.study_of(settings, problem_.first_look(), result_.search_seed));
    };
    result_.leave_out = below({}) && below(result_.front[*result_.chosen].changes());
    if (!result_.leave_out) return;
    result_.front.clear();
    result_.chosen.reset();
    result_.before.reset();
    result_.margins.clear();
    result_.trajectories = 0;
    result_.partial = false;
  }

  std::uint64_t part(double share) const {
    return static_cast<std::uint64_t>(share * static_cast<double>(result_.budget));
  }
  std::uint64_t fewest_starts() const { return std::min(problem_.first_look(), fewest_starts_of_cheap); }
  std::uint64_t each(std::uint64_t budget, std::size_t count) const {
    return std::clamp(budget / std::max<std::size_t>(count, 1), fewest_starts(), most_starts);
  }
  // Every ensemble has at least this many starts. The last parts of the work may exceed a small budget.
  std::size_t most_ensembles() const { return static_cast<std::size_t>(2 * result_.budget / fewest_starts()) + 1000; }

  void find() {
    Race race(problem_, standing_, *ensembles_, part(for_search), result_.search_seed,
              [this](const DesignCandidate* best) { tell(best); });
    const SearchSpace space{problem_.dimensions(), result_.objectives.size(),
                            std::max<std::uint64_t>(part(for_search) / (problem_.first_look() * 3 / 2), 8)};
    search(problem_.method(), space, problem_.seed(),
           [&](const std::vector<SearchPoint>& points) { return race.judge(points); });
    result_.history = race.history();
    std::vector<DesignCandidate> candidates = race.candidates();
    result_.candidates = candidates.size();
    if (!candidates.empty() && candidates.front().as_it_is) own_ = candidates.front();
    result_.partial = ensembles_->stopped();
    const bool cut = ensembles_->out_of_time() && !result_.partial;
    ensembles_->after_search();
    take_front(candidates, false);
    try {
      if (cut) check_best();
      if (!cut && !result_.partial) choose(candidates);
      if (!cut && !result_.partial) check();
      if (!cut && !result_.partial) move();
    } catch (const SearchOver&) {
      result_.partial = true;
    }
    result_.partial = result_.partial || cut;
  }

  bool one_objective() const { return result_.objectives.size() == 1; }

  static std::vector<const DesignSample*> samples_of(const std::vector<DesignCandidate>& candidates) {
    std::vector<const DesignSample*> samples;
    for (const DesignCandidate& c : candidates) samples.push_back(&c.best_known());
    return samples;
  }

  // Candidates that no other beats; `reserves`: with one objective also the next few.
  void take_front(const std::vector<DesignCandidate>& candidates, bool reserves) {
    result_.front.clear();
    result_.chosen.reset();
    const auto samples = samples_of(candidates);
    std::vector<std::size_t> places;
    if (reserves && one_objective()) {
      places = standing_.order(samples, Side::doubtful);  // samples differ in size: this discounts a small sample's
                                                          // luck
      places.resize(std::min(places.size(), result_.limits.empty() ? 1 : most_checked));
    } else {
      places = standing_.front(samples, Side::estimate);
    }
    for (const std::size_t k : thinned(places)) result_.front.push_back(candidates[k]);
    if (result_.front.empty()) return;
    result_.chosen = one_objective() ? 0 : standing_.middle(samples_of(result_.front));
  }

  // Evenly along the first objective, keeping both ends.
  static std::vector<std::size_t> thinned(const std::vector<std::size_t>& places) {
    if (places.size() <= most_in_front) return places;
    std::vector<std::size_t> kept;
    for (std::size_t k = 0; k < most_in_front; ++k)
      kept.push_back(places[k * (places.size() - 1) / (most_in_front - 1)]);
    return kept;
  }

  // Whether this one may be better than the best one known.
  bool may_be_best(const DesignSample& sample, const DesignSample& best) const {
    return !standing_.beats(best, Side::doubtful, sample, Side::hopeful);
  }

  // Takes more of the same starts for the candidates that looked best.
  void choose(const std::vector<DesignCandidate>& candidates) {
    if (candidates.empty()) return;
    const auto samples = samples_of(candidates);
    std::vector<std::size_t> places;
    if (one_objective()) {
      places = standing_.order(samples, Side::doubtful);
      const DesignSample& best = *samples[places.front()];
      std::stable_partition(places.begin(), places.end(),
                            [&](std::size_t k) { return may_be_best(*samples[k], best); });
      places.resize(std::min(places.size(), most_chosen_from));
    } else {
      places = thinned(standing_.front(samples, Side::doubtful));
    }
    std::vector<DesignCandidate> finalists;
    for (const std::size_t k : places) finalists.push_back(candidates[k]);
    std::iota(places.begin(), places.end(), std::size_t{0});
    if (one_objective())
      tell_apart(finalists);
    else
      follow_on(finalists, places, each(part(for_choice), finalists.size()));
    tell(nullptr);
    take_front(finalists, true);
  }

  void follow_on(std::vector<DesignCandidate>& finalists, const std::vector<std::size_t>& places,
                 std::uint64_t starts) {
    std::vector<WantedSample> wanted;
    for (const std::size_t k : places)
      wanted.push_back({finalists[k].changes(), std::max(starts, finalists[k].search.starts), result_.search_seed});
    const std::vector<DesignSample> larger = ensembles_->run(wanted);
    for (std::size_t k = 0; k < places.size(); ++k) finalists[places[k]].search = larger[k];
  }

  // While several may be the best, takes more starts for those known least, the most promising first.
  void tell_apart(std::vector<DesignCandidate>& finalists) {
    std::uint64_t left = part(for_choice);
    for (;;) {
      const auto samples = samples_of(finalists);
      std::vector<std::size_t> rivals = standing_.order(samples, Side::doubtful);
      const DesignSample& best = *samples[rivals.front()];
      std::erase_if(rivals,
                    [&](std::size_t k) { return samples[k]->figures.empty() || !may_be_best(*samples[k], best); });
      std::uint64_t fewest = most_starts;
      for (const std::size_t k : rivals) fewest = std::min(fewest, samples[k]->starts);
      const std::uint64_t starts = std::min(std::max(raise_by * fewest, fewest_starts()), most_starts);
      std::vector<std::size_t> raised;
      for (const std::size_t k : rivals) {
        if (rivals.size() < 2 || samples[k]->starts > fewest || starts == fewest || starts > left) continue;
        left -= starts;
        raised.push_back(k);
      }
      if (raised.empty()) return;
      follow_on(finalists, raised, starts);
    }
  }

  // In the time that is left: the study as it is and the best one on as many fresh starts as a first look has.
  void check_best() {
    if (!result_.chosen) return;
    const DesignCandidate best = result_.front[*result_.chosen];
    if (!own_.search.figures.empty()) result_.before = own_.search;
    result_.front = {best};
    result_.chosen = 0;
    judge_front(problem_.first_look());
    keep_first();
  }

  // The study as it is and the front on starts that the search did not see.
  void judge_front(std::uint64_t starts) {
    std::vector<WantedSample> wanted{{{}, starts, result_.held_out_seed, true}};
    for (const DesignCandidate& c : result_.front) wanted.push_back({c.changes(), starts, result_.held_out_seed, true});
    const std::vector<DesignSample> samples = ensembles_->run(wanted);
    result_.before = samples.front();
    for (std::size_t k = 0; k < result_.front.size(); ++k) result_.front[k].held_out = samples[k + 1];
  }

  // The search's choice stands, unless it turns out to miss a requirement. A choice by the held-out starts would look
  // better on them than it is. The study itself is always there to fall back on.
  void keep_first() {
    std::vector<DesignCandidate>& front = result_.front;
    if (std::none_of(front.begin(), front.end(), [](const DesignCandidate& c) { return c.as_it_is; })) {
      front.push_back(own_);
      front.back().held_out = result_.before;
    }
    std::stable_sort(front.begin(), front.end(), [&](const DesignCandidate& a, const DesignCandidate& b) {
      return standing_.violation(*a.held_out, Side::worst) < standing_.violation(*b.held_out, Side::worst);
    });
    front.resize(1);
    result_.chosen = 0;
  }

  // Judges the front on starts that the search did not see, next to the original study.
  void check() {
    if (result_.front.empty()) return;
    judge_front(each(part(for_check), result_.front.size() + 1));
    tell(nullptr);
    if (one_objective())
      keep_first();
    else
      take_front(std::vector<DesignCandidate>(result_.front), false);
  }

  void move() {
    if (!result_.chosen) return;
    const std::uint64_t starts = each(part(for_margins), margin_points(problem_));
    result_.margins =
        design_margins(problem_, standing_, *ensembles_, result_.front[*result_.chosen], starts, result_.held_out_seed);
  }

  void tell(const DesignCandidate* best) {
    if (!options_.progress) return;
    const DesignFigure& first = result_.figures[result_.objectives.front()];
    Progress progress{ensembles_->trajectories(), std::max(result_.budget, ensembles_->trajectories()), "trajectories",
                      std::nullopt};
    if (best && !best->search.figures.empty()) {
      const double value = best->search.figures[result_.objectives.front()].value;
      const bool kept = standing_.violation(best->search, Side::worst) == 0.0;
      best_words_ = fmt::format("; best so far {} {:.4g}{}{}", first.name, value,
                                first.unit.empty() ? "" : " " + first.unit, kept ? "" : ", requirements not met");
    }
    progress.what += best_words_;
    options_.progress(progress);
  }

  const DesignProblem& problem_;
  const DesignOptions& options_;
  DesignStanding standing_;
  DesignCandidate own_;  // the study itself, as the search knows it
  DesignResult result_;
  std::unique_ptr<io::CellFile> file_;
  std::unique_ptr<DesignEnsembles> ensembles_;
  std::string best_words_;
};

}  // namespace

DesignResult design(const DesignProblem& problem, const DesignOptions& options) {
  return long_call(options, [&](const DesignOptions& o) { return DesignRun(problem, o).run(); });
}

}  // namespace equipoise
