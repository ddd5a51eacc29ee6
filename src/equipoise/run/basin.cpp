// The ensemble's pipeline: chunks of starts computed on all threads, taken in by index order, counted and stored.
#include "equipoise/run/basin.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

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
};

// Counts in index order, and says when enough is known.
class Tally {
 public:
  Tally(double half_width, double settled) : half_width_(half_width), settled_(settled) {}

  // Takes in the next fate; true if sampling may end after it.
  bool add(const Fate& fate) {
    const auto k = static_cast<std::size_t>(fate.outcome);
    ++counts_[k];
    time_[k] += fate.time - settled_;
    ++total_;
    return half_width_ > 0.0 && total_ % checkpoint == 0 && total_ >= fewest_starts && narrow();
  }

  std::uint64_t total() const { return total_; }
  Share share(Outcome outcome) const { return wilson_share(counts_[static_cast<std::size_t>(outcome)], total_); }
  double mean_time(std::size_t k) const { return counts_[k] ? time_[k] / static_cast<double>(counts_[k]) : 0.0; }

 private:
  bool narrow() const {
    for (std::uint64_t count : counts_)
      if (wilson_share(count, total_).half_width() > half_width_) return false;
    return true;
  }

  double half_width_, settled_;
  std::array<std::uint64_t, outcome_count> counts_{};
  std::array<double, outcome_count> time_{};
  std::uint64_t total_ = 0;
};

// Large enough that lanes seldom wait for a chunk's last trajectory, small enough that every thread gets many.
std::size_t chunk_size(std::uint64_t starts, int threads) {
  return static_cast<std::size_t>(
      std::clamp<std::uint64_t>(starts / (16 * static_cast<std::uint64_t>(threads)), 256, 8192));
}

int thread_count(int asked) { return asked > 0 ? asked : tbb::info::default_concurrency(); }

double cpu_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// The study a file is about: all that decides the fate of start i.
std::string identity(Study study) {
  study.sampling.starts = 1;
  return to_toml(study);
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
      file_ = std::make_unique<BasinFile>(options_.output, BasinFileHeader{identity(study), study.sampling.seed,
                                                                           study.parameters.balls, result_.cpu_target});
    runner_.emplace(study, threads_, options_.stop);
    tally_.emplace(options_.half_width, runner_->settled());
    read_stored();
    if (!finished_ && !runner_->stopped()) compute();

    result_.starts = tally_->total();
    result_.partial = !finished_;
    for (std::size_t k = 0; k < outcome_count; ++k) {
      result_.shares[k] = tally_->share(static_cast<Outcome>(k));
      result_.mean_time[k] = tally_->mean_time(k);
    }
    result_.balanced_stable = runner_->balanced().stable;
    result_.note = runner_->balanced().note;
    result_.motions_found = runner_->motions_found();
    if (file_) file_->finish(to_toml(study), result_.shares, finished_);
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    result_.cpu_seconds = cpu_now() - cpu_begin;
    return result_;
  }

 private:
  // Counts what an earlier run left in the file.
  void read_stored() {
    const std::uint64_t stored = file_ ? std::min(file_->stored(), limit_) : 0;
    constexpr std::size_t block = 65536;
    for (std::uint64_t first = 0; first < stored && !finished_; first += block)
      for (const Fate& fate : file_->read(first, std::min<std::uint64_t>(block, stored - first))) {
        if (finished_) break;
        take(fate);
      }
    result_.resumed_from = tally_->total();
  }

  void take(const Fate& fate) { finished_ = tally_->add(fate) || tally_->total() == limit_; }

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
                    chunk->complete = !finished_ && runner_->run(chunk->first, chunk->count, chunk->phi, chunk->fates);
                    return chunk;
                  }) &
              tbb::make_filter<std::shared_ptr<Chunk>, void>(
                  tbb::filter_mode::serial_in_order, [&](const std::shared_ptr<Chunk>& chunk) { commit(*chunk); }));
    });
    if (file_) file_->sync();
  }

  // Takes a chunk in, in order. After one that was not completed no later one counts: the result stays a prefix.
  void commit(const Chunk& chunk) {
    if (finished_ || lost_) return;
    if (!chunk.complete) {
      lost_ = true;
      return;
    }
    std::size_t taken = 0;
    while (taken < chunk.count && !finished_) take(chunk.fates[taken++]);
    if (file_) file_->append(taken, chunk.phi.data(), chunk.fates.data());
    if (options_.progress)
      options_.progress({tally_->total(), options_.half_width > 0.0 ? 0 : limit_, tally_->share(Outcome::balanced)});
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

BasinResult basin(const Study& study, const BasinOptions& options) { return BasinRun(study, options).run(); }

StartReplay replay_start(const Study& study, std::uint64_t index, const BasinOptions& options) {
  check_decidable(study);
  const StartRunner runner(study, thread_count(options.threads), options.stop);
  std::vector<double> phi;
  std::vector<Fate> fates;
  StartReplay replay;
  replay.index = index;
  if (runner.stopped() || !runner.run(index, 1, phi, fates)) throw RunError("stopped before the start was decided");
  std::copy(phi.begin(), phi.end(), replay.phi.begin());
  replay.fate = fates.front();
  return replay;
}

}  // namespace equipoise
