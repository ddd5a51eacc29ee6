// The ensemble's pipeline: chunks of starts computed on all threads, taken in by index order, counted and stored.
#include "equipoise/run/basin.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include "equipoise/run/initial_state.hpp"
#include "equipoise/run/lane_kernels.hpp"
#include "equipoise/run/start_runner.hpp"
#include "equipoise/store/basin_file.hpp"

namespace equipoise {

namespace {

constexpr std::uint64_t open_ended_limit = 1'000'000'000;
// A half-width is looked at after every so many starts, whatever the chunks: where sampling ends is part of the result.
constexpr std::uint64_t checkpoint = 1024;
// Fewest starts before sampling may end: with less, an interval of a rare outcome is narrow by luck.
constexpr std::uint64_t fewest_starts = 4096;

struct Chunk {
  std::uint64_t first = 0;
  std::size_t count = 0;
  bool complete = false;
  std::vector<double> phi;
  std::vector<Fate> fates;
  std::vector<UnlistedStart> unlisted;
};

// Counts in index order, and says when enough is known.
class Tally {
 public:
  Tally(double half_width, double settled) : half_width_(half_width), settled_(settled) {}

  // Takes in the next fate; true if sampling may end after it.
  bool add(const Fate& fate) {
    Line& line = lines_[key(fate.outcome, fate.attractor)];
    ++line.count;
    line.time += fate.time - settled_;
    ++line.by[static_cast<std::size_t>(fate.by)];
    ++total_;
    return half_width_ > 0.0 && total_ % checkpoint == 0 && total_ >= fewest_starts && narrow();
  }

  std::uint64_t total() const { return total_; }
  Share share(Outcome outcome, int attractor = 0) const {
    const auto at = lines_.find(key(outcome, attractor));
    return wilson_share(at == lines_.end() ? 0 : at->second.count, total_);
  }
  AttractorShare share(const Attractor& a) const {
    AttractorShare result{a.id, a.name, a.alias, name_of(a.motion.kind), share(Outcome::attracted, a.id), 0.0, {}};
    if (const auto at = lines_.find(key(Outcome::attracted, a.id)); at != lines_.end()) {
      result.mean_time = at->second.time / static_cast<double>(at->second.count);
      result.decided_by = at->second.by;
    }
    return result;
  }

 private:
  struct Line {
    std::uint64_t count = 0;
    double time = 0.0;
    std::array<std::uint64_t, decided_by_count> by{};
  };
  static std::pair<int, int> key(Outcome outcome, int attractor) {
    return {static_cast<int>(outcome), outcome == Outcome::attracted ? attractor : 0};
  }

  // Every outcome that was met, and one that was not.
  bool narrow() const {
    bool narrow = wilson_share(0, total_).half_width() <= half_width_;
    for (const auto& [key, line] : lines_)
      narrow = narrow && wilson_share(line.count, total_).half_width() <= half_width_;
    return narrow;
  }

  double half_width_, settled_;
  std::map<std::pair<int, int>, Line> lines_;
  std::uint64_t total_ = 0;
};

// Large enough that lanes seldom wait for a chunk's last trajectory, small enough that every thread gets many.
std::size_t chunk_size(std::uint64_t starts, int threads) {
  return static_cast<std::size_t>(
      std::clamp<std::uint64_t>(starts / (16 * static_cast<std::uint64_t>(threads)), 256, 8192));
}

double cpu_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

DiscoverySettings settings_for(const BasinOptions& options, int threads) {
  return {threads, options.stop, options.seeds, options.discoveries};
}

// What an unlisted start turned out to have come to; 0: to nothing steady.
void settle(Fate& fate, int attractor) {
  fate.attractor = static_cast<short>(attractor);
  if (attractor > 0) return;
  fate.outcome = Outcome::undecided;
  fate.by = DecidedBy::nothing;
}

class BasinRun {
 public:
  BasinRun(const Study& study, const BasinOptions& options)
      : options_(options),
        limit_(options.half_width > 0.0 && !options.limit_given ? open_ended_limit : study.sampling.starts),
        threads_(thread_count(options.threads)) {
    result_.study = study;
    result_.threads = threads_;
    result_.cpu_target = cpu_target();
  }

  BasinResult run() {
    const auto begin = std::chrono::steady_clock::now();
    const double cpu_begin = cpu_now();
    const Study& study = result_.study;
    check_decidable(study);
    if (!options_.output.empty())
      file_ = std::make_unique<BasinFile>(options_.output, basin_file_header(study, options_.store_angles));
    runner_.emplace(study, settings_for(options_, threads_));
    tally_.emplace(options_.half_width, runner_->settled());
    read_stored();
    if (!finished_ && !runner_->stopped()) compute();

    result_.starts = tally_->total();
    result_.partial = !finished_;
    if (!runner_->catalogue().find(balanced_id)) {
      Attractor none{balanced_id, "balanced", "", {}, false};
      result_.attractors.push_back(tally_->share(none));
    }
    for (const Attractor& a : runner_->catalogue().attractors()) result_.attractors.push_back(tally_->share(a));
    result_.undecided = tally_->share(Outcome::undecided);
    result_.diverged = tally_->share(Outcome::diverged);
    result_.failed = tally_->share(Outcome::failed);
    result_.balanced_stable = runner_->balanced().stable;
    result_.note = runner_->balanced().note;
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    result_.cpu_seconds = cpu_now() - cpu_begin;
    if (file_) file_->finish(to_toml(study), summary(), finished_, {result_.seconds, result_.cpu_seconds});
    return result_;
  }

  const Catalogue& catalogue() const { return runner_->catalogue(); }

 private:
  std::vector<OutcomeSummary> summary() const {
    std::vector<OutcomeSummary> lines;
    for (const AttractorShare& a : result_.attractors) lines.push_back({a.id, a.name, a.alias, a.share});
    lines.push_back({undecided_code, "undecided", "", result_.undecided});
    lines.push_back({diverged_code, "diverged", "", result_.diverged});
    lines.push_back({failed_code, "failed", "", result_.failed});
    return lines;
  }

  // Counts what an earlier run left in the file, once the motions that it met on its way are listed again.
  void read_stored() {
    if (file_)
      for (const std::vector<double>& state : file_->discoveries()) runner_->list(runner_->follow(state));
    const std::uint64_t stored = file_ ? std::min(file_->stored(), limit_) : 0;
    constexpr std::size_t block = 65536;
    for (std::uint64_t first = 0; first < stored && !finished_; first += block)
      for (const Fate& fate : file_->read(first, std::min<std::uint64_t>(block, stored - first))) {
        if (finished_) break;
        take(fate);
      }
    result_.resumed_from = tally_->total();
  }

  void take(const Fate& fate) {
    finished_ = tally_->add(fate) || tally_->total() == limit_;
    if (options_.fate) options_.fate(fate);
  }

  void compute() {
    const std::size_t size = chunk_size(limit_ - tally_->total(), threads_);
    std::uint64_t next = tally_->total();
    const auto stop_asked = [&] { return options_.stop && options_.stop->load(std::memory_order_relaxed); };
    tbb::task_arena arena(threads_);
    arena.execute([&] {
      tbb::parallel_pipeline(
          2 * static_cast<std::size_t>(threads_),
          tbb::make_filter<void, std::shared_ptr<Chunk>>(tbb::filter_mode::serial_in_order,
                                                         [&](tbb::flow_control& control) -> std::shared_ptr<Chunk> {
                                                           if (finished_ || lost_ || stop_asked() || next >= limit_) {
                                                             control.stop();
                                                             return nullptr;
                                                           }
                                                           auto chunk = std::make_shared<Chunk>();
                                                           chunk->first = next;
                                                           chunk->count = static_cast<std::size_t>(
                                                               std::min<std::uint64_t>(size, limit_ - next));
                                                           next += chunk->count;
                                                           return chunk;
                                                         }) &
              tbb::make_filter<std::shared_ptr<Chunk>, std::shared_ptr<Chunk>>(
                  tbb::filter_mode::parallel,
                  [&](std::shared_ptr<Chunk> chunk) {
                    chunk->complete = !finished_ && runner_->run(chunk->first, chunk->count, chunk->phi, chunk->fates,
                                                                 chunk->unlisted);
                    return chunk;
                  }) &
              tbb::make_filter<std::shared_ptr<Chunk>, void>(
                  tbb::filter_mode::serial_in_order, [&](const std::shared_ptr<Chunk>& chunk) { commit(*chunk); }));
    });
    if (file_) file_->sync();
  }

  // Takes a chunk in, in order. After one that was not completed no later one counts: the result stays a prefix.
  void commit(Chunk& chunk) {
    if (finished_ || lost_) return;
    if (!chunk.complete) {
      lost_ = true;
      return;
    }
    std::size_t taken = 0;
    auto unlisted = chunk.unlisted.begin();
    while (taken < chunk.count && !finished_) {
      Fate& fate = chunk.fates[taken];
      if (unlisted != chunk.unlisted.end() && unlisted->place == taken) name_fate(fate, *unlisted++);
      take(fate);
      ++taken;
    }
    if (file_) store(chunk, taken);
    if (options_.progress)
      options_.progress(
          {tally_->total(), options_.half_width > 0.0 ? 0 : limit_, tally_->share(Outcome::attracted, balanced_id)});
  }

  // Starts are functions of their index, so what they drew besides angles is made again for the file alone.
  void store(const Chunk& chunk, std::size_t count) {
    const Study& study = result_.study;
    std::vector<double> rotor, phi_dot;
    for (std::size_t i = 0; i < count && !study.sampling.box.empty(); ++i) {
      const InitialState s = start_of(study, study.sampling.seed, chunk.first + i);
      rotor.insert(rotor.end(), {s.x, s.y, s.x_dot, s.y_dot});
      phi_dot.insert(phi_dot.end(), s.phi_dot.begin(), s.phi_dot.begin() + study.parameters.balls);
    }
    file_->append(count, chunk.phi.data(), chunk.fates.data(), rotor.data(), phi_dot.data());
  }

  // A stationary motion that the rule does not list: what it is decides, whenever it was first met.
  void name_fate(Fate& fate, const UnlistedStart& start) {
    const std::size_t listed = runner_->catalogue().attractors().size();
    settle(fate, runner_->list(start));
    if (file_ && runner_->catalogue().attractors().size() > listed) file_->append_discovery(start.state);
  }

  const BasinOptions& options_;
  std::uint64_t limit_;
  int threads_;
  BasinResult result_;
  std::unique_ptr<BasinFile> file_;
  std::optional<StartRunner> runner_;
  std::optional<Tally> tally_;
  std::atomic<bool> finished_{false}, lost_{false};
};

}  // namespace

int thread_count(int asked) { return asked > 0 ? asked : tbb::info::default_concurrency(); }

BasinFileHeader basin_file_header(const Study& study, bool angles) {
  Study identity = study;  // all that decides the fate of start i
  identity.sampling.starts = 1;
  return {to_toml(identity),          study.sampling.seed, study.parameters.balls, cpu_target(), angles,
          !study.sampling.box.empty()};
}

BasinResult basin(const Study& study, const BasinOptions& options, Catalogue* catalogue) {
  BasinRun run(study, options);
  BasinResult result = run.run();
  if (catalogue) *catalogue = run.catalogue();
  return result;
}

StartReplay replay_start(const Study& study, std::uint64_t index, const BasinOptions& options) {
  check_decidable(study);
  StartRunner runner(study, settings_for(options, thread_count(options.threads)));
  std::vector<double> phi;
  std::vector<Fate> fates;
  std::vector<UnlistedStart> unlisted;
  StartReplay replay;
  replay.index = index;
  if (runner.stopped() || !runner.run(index, 1, phi, fates, unlisted))
    throw RunError("stopped before the start was decided");
  replay.start = start_of(study, study.sampling.seed, index);
  replay.fate = fates.front();
  if (!unlisted.empty()) settle(replay.fate, runner.list(unlisted.front()));
  if (const Attractor* a = runner.catalogue().find(replay.fate.attractor)) replay.name = a->name;
  return replay;
}

}  // namespace equipoise
