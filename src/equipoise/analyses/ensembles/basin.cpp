// Runs an ensemble: takes chunks of starts in by index order, counts and stores them; chooses sampling, resumes, ends.
#include "equipoise/analyses/ensembles/basin.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "equipoise/analyses/ensembles/stored_ensemble.hpp"
#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/analyses/ensembles/ensemble_runner.hpp"
#include "equipoise/analyses/ensembles/tally.hpp"
#include "equipoise/analyses/ensembles/without_balls.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/result_files/basin_outcomes.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

namespace {

constexpr std::uint64_t open_ended_limit = 1'000'000'000;

class BasinRun {
 public:
  BasinRun(const Study& study, const BasinOptions& options)
      : options_(options),
        gathers_(gathers_transients(study, options)),
        threads_(thread_count(options.threads)),
        searches_(options.searches ? *options.searches : own_searches_) {
    result_.study = study;
    if (study.speed.driven()) passed_speed_ = study.passed_speed();
    note_machine(result_, options);
    result_.half_width = options.half_width;
    if (options.keep_starts) result_.every_start.emplace();
    result_.own_starts = !options.initial.empty();
  }

  BasinResult run() {
    check_runnable(result_.study, gathers_);
    if (result_.own_starts) take_given_starts(options_, result_.study);
    horizon_ = choose_horizon(result_.study);
    result_.study.numerics.horizon = horizon_.time;
    sample();
    result_.starts = tally_->total();
    result_.asked = limit_ < open_ended_limit || options_.limit_given ? limit_ : 0;
    result_.partial = !finished_;
    result_.grid = sampler_->grid();
    count_all();
    const BalanceNote balance = session_->balance();
    result_.balanced_stable = balance.stable;
    result_.note = balance.note;
    if (const std::optional<EscapeRate> chaos = tally_->chaos(catalogue())) note_chaos(result_, *chaos);
    note_open_starts(result_, horizon_, look_at_these(undecided_), look_at_these(stalled_));
    if (gathers_ && options_.without_balls && result_.starts > 0 && !is_set(options_.stop))
      // As many starts as the file has, so that it says the same to every reader.
      result_.without_balls =
          without_balls({result_.study, *sampler_, std::max(result_.starts, file_ ? file_->stored() : 0),
                         options_.initial, threads_, options_.stop});
    result_.took(clock_.time());
    if (file_) finish_file(result_);
    return result_;
  }

  const Catalogue& catalogue() const { return *catalogue_; }
  WarmStartLevels warm_start_levels() const { return session_->warm_start_levels(); }

 private:
  InitialState start(std::uint64_t index) const {
    if (result_.own_starts) return options_.initial[index];
    return drawn_start_of(result_.study, *sampler_, result_.study.sampling.seed, index);
  }
  // How these starts go on at the end. The work is done only when the result is called.
  LookAt look_at_these(const std::vector<std::uint64_t>& indices) const {
    return [&] {
      if (session_->stopped() || is_set(options_.stop)) return std::vector<UndecidedEnd>{};
      std::vector<InitialState> starts;
      for (const std::uint64_t index : indices) starts.push_back(start(index));
      return session_->look_at(starts);
    };
  }

  // Thread-safe.
  bool decide(Chunk& c) const {
    if (!result_.own_starts) return session_->decide(c.first, c.count, c);
    const std::span<const InitialState> given(&options_.initial[c.first], c.count);
    c.phi.clear();
    for (const InitialState& s : given)
      c.phi.insert(c.phi.end(), s.phi.begin(), s.phi.begin() + result_.study.parameters.balls);
    return session_->decide(given, c);
  }

  void sample() {
    const std::optional<SamplingMethod> given = result_.study.sampling.method;
    if (!given && options_.half_width > 0.0)
      choose_method();
    else
      set_method(given.value_or(SamplingMethod::random));
    if (lost_) {  // interrupted before a method was chosen: begin no file, report what the pilot counted
      for (Chunk& chunk : pilot_) commit(chunk);
      return;
    }
    open_file();
    if (!session_) begin_session();
    read_stored();
    for (Chunk& chunk : pilot_) commit(chunk);
    pilot_.clear();
    if (finished_ || unread_ || session_->stopped()) return;
    report(*tally_);  // the search is over, which a first batch of slow starts would not show for long
    // Damage may have left gaps in the file.
    while (!finished_ && !lost_)
      lost_ = !compute(tally_->total(), file_ ? std::min(limit_, file_->stored_next()) : limit_, [&](Chunk& chunk) {
        commit(chunk);
        return !finished_;
      });
  }

  void set_method(SamplingMethod method) {
    Study& study = result_.study;
    study.sampling.method = method;
    const bool open_ended = options_.half_width > 0.0 && !options_.limit_given;
    if (options_.half_width > 0.0 && method == SamplingMethod::grid)
      throw InputError(
          study.name, "sampling.method", "grid",
          "sampling until a half-width needs \"random\" or \"sobol\": a grid is as large as `starts` says");
    sampler_.emplace(sampler_of(study));
    limit_ = open_ended ? open_ended_limit : sampler_->grid() ? sampler_->grid()->starts() : study.sampling.starts;
    session_.reset();
  }

  void begin_session() {
    const Study& study = result_.study;
    AttractorSearchSettings search = search_settings(options_, &searches_);
    if (file_) search.notes = &file_->notes();
    session_.emplace(study, search, gathers_);
    catalogue_.emplace(*session_);
    tally_.emplace(*sampler_, study.sampling.seed, session_->settled());
    transients_.emplace(study, *sampler_);
    filed_.clear();
    for (const Attractor& a : catalogue_->attractors()) filed_.insert(a.id);
  }

  // Pilot starts are the first of a Sobol sample, so none is wasted if the ensemble goes on with Sobol starts.
  void choose_method() {
    SamplingChoice choice;
    choice.random_starts = most_random_starts(options_.half_width);
    const bool worth_it = choice.random_starts > static_cast<double>(pilot_starts);
    if (worth_it && (!options_.limit_given || result_.study.sampling.starts > pilot_starts)) {
      set_method(SamplingMethod::sobol);
      begin_session();
      Tally tally = *tally_;
      const bool whole = compute(0, pilot_starts, [&](Chunk& chunk) {
        catalogue_->settle(chunk);
        for (const Outcome& outcome : chunk.outcomes) tally.add(outcome);
        pilot_.push_back(std::move(chunk));
        report(tally);
        return true;
      });
      lost_ = !whole || session_->stopped();
      if (lost_) return;
      choice = choose_sampling(tally.shares(), options_.half_width);
    }
    result_.choice = choice;
    if (choice.method == SamplingMethod::sobol) return;
    pilot_.clear();
    set_method(SamplingMethod::random);
  }

  void open_file() {
    if (options_.output.empty()) return;
    const std::string given = result_.own_starts ? checksum_of(result_.study, options_.initial) : "";
    file_ = std::make_unique<BasinFile>(options_.output,
                                        basin_file_header(result_.study, options_.store_angles, gathers_, given));
    give_notice(options_, file_->loss());
  }

  void count_all() {
    tally_->count(*catalogue_, result_);
    if (result_.study.speed.driven()) {
      // A grid's starts have unequal weights, so these shares leave them out.
      if (!result_.grid) {
        result_.passed = open_share(passed_, passed_ + below_, tally_->total());
        result_.not_passed = open_share(stays_below_, stays_below_ + below_, tally_->total());
      }
    }
    if (result_.study.parameters.balls_collide() && !result_.grid)
      result_.met = open_share(met_, met_, tally_->total());
    if (gathers_) result_.transients = transients_->result(*catalogue_);
    if (result_.choice && result_.choice->method == SamplingMethod::sobol)  // a better estimate than the pilot's
      result_.choice->random_starts = random_starts_for(tally_->shares(), options_.half_width);
  }

  // A file may hold more starts than this run requested. Its summary covers all of them; a file that is already
  // complete stays as it is.
  void finish_file(const RunTime& time) {
    if (file_->complete() && file_->unfinished() == 0 && (finished_ || file_->stored() >= limit_))
      return file_->forget_notes();
    if (unread_ || session_->stopped()) return;  // the attractors that name the outcomes are not known yet
    const bool all = tally_->total() == file_->stored();
    if (file_->unfinished() == 0 && (!all || !finished_ || file_->complete())) return;
    Tally whole = *tally_;
    TransientTally figures = *transients_;
    for_each_stored(*file_, tally_->total(), file_->stored(), [&](const Outcome& outcome, const TransientRow* row) {
      whole.add(outcome);
      if (row) figures.add(outcome, *row);
    });
    Study study = result_.study;
    if (finished_ && !sampler_->grid()) study.sampling.starts = file_->stored();
    BasinResult told;
    told.study = study;
    whole.count(*catalogue_, told);
    BasinEnd end{to_toml(study), outcome_summary(told), finished_, time};
    if (gathers_) end.all = figures.result(*catalogue_).groups.front();
    end.without_balls = result_.without_balls;
    file_->finish(end);
  }

  // Counts what an earlier run left in the file. The motions that it met on the way are listed again first.
  void read_stored() {
    if (file_)
      for (const std::vector<double>& state : file_->discoveries()) {
        const std::optional<UnlistedStart> start = session_->follow(state);
        unread_ = !start;
        if (unread_) return;
        filed_.insert(catalogue_->list(*start));
        if (options_.keep_starts) result_.discoveries.push_back(state);
      }
    const std::uint64_t stored = file_ ? std::min(file_->stored(), limit_) : 0;
    take_stored();
    if (stored > 0 && !finished_ && !session_->stopped())
      check_stored(*file_, options_.output, stored, result_.cpu_target, [&](Chunk& chunk) {
        if (!decide(chunk)) return false;
        catalogue_->settle(chunk);
        return true;
      });
  }

  // What the file holds behind the starts counted so far.
  void take_stored() {
    const std::uint64_t begin = tally_->total(), end = file_ ? std::min(file_->stored(), limit_) : 0;
    if (begin >= end) return;
    for_each_stored(*file_, begin, end, [&](const Outcome& outcome, const TransientRow* row) {
      if (finished_ || unread_) return;
      if (outcome.attractor > 0 && !filed_.contains(outcome.attractor)) meet_again(tally_->total(), outcome);
      if (!unread_) take(outcome, row);
    });
    result_.resumed_from += tally_->total() - begin;
  }

  // The file names a motion by a state on it. If damage has taken that, a start that ended in the motion finds it
  // again.
  void meet_again(std::uint64_t index, const Outcome& outcome) {
    Chunk chunk;
    chunk.first = index;
    chunk.count = 1;
    unread_ = !decide(chunk);
    if (unread_) return;
    for (const UnlistedStart& start : chunk.unlisted) name_outcome(chunk.outcomes.front(), start);
    if (!filed_.contains(outcome.attractor))
      throw InputError(options_.output, "", "", fmt::format(outcome_without_name, index, outcome.attractor));
  }

  void take(const Outcome& outcome, const TransientRow* row) {
    tally_->add(outcome);
    if (result_.study.speed.driven()) count_passage(outcome);
    if (row) transients_->add(outcome, *row);
    // Pilot starts all count, even if fewer would have been narrow enough.
    const std::uint64_t least = result_.choice ? result_.choice->pilot : 0;
    const bool may_end = options_.half_width > 0.0 && tally_->at_checkpoint() &&
                         (tally_->total() >= least || sampler_->method() == SamplingMethod::random);
    const bool narrow = may_end && tally_->narrow(options_.half_width);
    finished_ = narrow || tally_->total() == limit_;
    if (outcome.kind == OutcomeKind::undecided && undecided_.size() < undecided_looked_at)
      undecided_.push_back(tally_->total() - 1);
    if (outcome.kind == OutcomeKind::stalled && stalled_.size() < undecided_looked_at)
      stalled_.push_back(tally_->total() - 1);
    if (StartArrays* kept = result_.every_start ? &*result_.every_start : nullptr;
        kept && kept->starts < options_.keep_at_most)
      add_start(result_.study, *sampler_, kept->starts, start(kept->starts), result_.own_starts, outcome, row, *kept);
    met_ += outcome.met;
    if (options_.outcome) options_.outcome(outcome);
  }

  // Judged by the speed of the motion that a start came to or, without one, by its last speed.
  void count_passage(const Outcome& outcome) {
    const bool lost = outcome.kind == OutcomeKind::diverged || outcome.kind == OutcomeKind::failed;
    const bool above = std::fabs(outcome.mean_speed) >= passed_speed_;
    if (!lost && above)
      ++passed_;
    else if (outcome.kind == OutcomeKind::undecided)
      ++below_;
    else if (!lost)
      ++stays_below_;
  }

  bool compute(std::uint64_t first, std::uint64_t limit, const TakeChunk& take) const {
    const ChunkWork work{.decide = [&](Chunk& c) { return decide(c); },
                         .threads = threads_,
                         .stop = options_.stop,
                         .help = options_.help};
    return take_chunks(work, first, limit, take);
  }

  void report(const Tally& tally) const {
    if (!options_.progress) return;
    Progress progress{tally.total(), options_.half_width > 0.0 ? 0 : limit_, "starts", std::nullopt};
    if (progress.done > 0) progress.balanced = tally.share(OutcomeKind::attracted, balanced_id).share;
    options_.progress(progress);
  }

  // Takes chunks in, in order. Starts that the file already held are skipped.
  void commit(Chunk& chunk) {
    if (finished_ || chunk.first + chunk.count <= tally_->total()) return;
    const std::size_t begin = static_cast<std::size_t>(tally_->total() - chunk.first);
    std::size_t taken = begin;
    auto unlisted = chunk.unlisted.begin();
    while (taken < chunk.count && !finished_) {
      while (unlisted != chunk.unlisted.end() && unlisted->place < taken) ++unlisted;
      Outcome& outcome = chunk.outcomes[taken];
      if (unlisted != chunk.unlisted.end() && unlisted->place == taken) name_outcome(outcome, *unlisted);
      take(outcome, chunk.row(taken));
      ++taken;
    }
    if (file_)
      append_starts(
          *file_, result_.study, *sampler_, chunk, {begin, taken}, result_.own_starts,
          [&](std::uint64_t index) { return start(index); }, clock_.time());
    take_stored();
    report(*tally_);
  }

  // Names the outcome of a start whose motion the rule does not list. The motion decides, no matter when it was first
  // met.
  void name_outcome(Outcome& outcome, const UnlistedStart& start) {
    const int id = catalogue_->settle(start, outcome);
    if (id == 0 || !filed_.insert(id).second) return;
    if (file_) file_->append_attractor_search(start.state);
    if (options_.keep_starts) result_.discoveries.push_back(start.state);
  }

  const BasinOptions& options_;
  bool gathers_;  // transients
  const RunClock clock_;
  int threads_;
  AttractorSearchCache own_searches_;
  AttractorSearchCache& searches_;
  BasinResult result_;
  std::uint64_t limit_ = 0;
  std::unique_ptr<BasinFile> file_;
  std::optional<Sampler> sampler_;
  std::optional<Session> session_;
  std::optional<RunCatalogue> catalogue_;
  std::optional<Tally> tally_;
  std::optional<TransientTally> transients_;
  std::vector<Chunk> pilot_;
  std::uint64_t passed_ = 0, stays_below_ = 0, below_ = 0;  // starts above resonance; below it for good; or when last
                                                            // seen
  std::uint64_t met_ = 0;                                   // starts whose balls touched
  double passed_speed_ = 0.0;
  std::set<int> filed_;  // motions known before the first start, or met and stored
  bool finished_ = false, lost_ = false;
  bool unread_ = false;  // stopped before the motions that the file names were listed
  Horizon horizon_;
  std::vector<std::uint64_t> undecided_, stalled_;  // indices of the first few
};

}  // namespace

BasinResult basin(const Study& study, const BasinOptions& options, Catalogue* catalogue,
                  WarmStartLevels* warm_start_levels) {
  return long_call(options, [&](const BasinOptions& o) {
    if (study.parameters.balls == 0) return bare_basin(study, o);
    BasinRun run(study, o);
    BasinResult result = run.run();
    if (catalogue) *catalogue = run.catalogue();
    if (warm_start_levels) *warm_start_levels = run.warm_start_levels();
    return result;
  });
}

}  // namespace equipoise
