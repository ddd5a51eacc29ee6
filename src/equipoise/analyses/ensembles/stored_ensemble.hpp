// An ensemble's file: its header, its starts as they are decided, and all of a result that is in memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/result_files/start_columns.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {

struct Chunk;

/// Describes a run of basin() for its output file. `given_starts`: checksum_of() the caller's starts, empty if starts
/// are drawn. `target`: the CPU target of the run.
BasinFileHeader basin_file_header(const Study& study, bool angles, bool transients = false,
                                  const std::string& given_starts = {}, const std::string& target = cpu_target());

/// Adds start `index`, which began as `start` and has `outcome`. `own`: the caller gave it. `row`: its transients, or
/// null. Its other draws are made again: they are functions of its index.
void add_start(const Study& study, const Sampler& sampler, std::uint64_t index, const InitialState& start, bool own,
               const Outcome& outcome, const TransientRow* row, StartArrays& arrays);

/// Calls visit(outcome, row) for starts begin .. end - 1 of a file; `row` is null if it holds no transients.
template <class Visit>
void for_each_stored(const BasinFile& file, std::uint64_t begin, std::uint64_t end, const Visit& visit) {
  constexpr std::size_t block = 65536;
  for (std::uint64_t first = begin; first < end; first += block) {
    const std::size_t count = std::min<std::uint64_t>(block, end - first);
    const StartArrays starts = file.read(first, count);
    for (std::size_t i = 0; i < count; ++i) {
      const TransientRow row = row_of(starts, i);
      visit(*outcome_of(starts, i), starts.transients.front().empty() ? nullptr : &row);
    }
  }
}

/// Decides a few of the first `stored` starts again before any is added. A different build or instruction set may give
/// other bits, and the file would then mix two kinds. Throws InputError if an Outcome differs. `decide` decides and
/// settles a chunk, and returns false if stopped.
void check_stored(const BasinFile& file, const std::string& path, std::uint64_t stored, const std::string& target,
                  const std::function<bool(Chunk&)>& decide);

/// Appends the chunk's starts at places part.first .. part.second - 1. `start_of`: a start's initial values by its
/// index. `own`: the caller gave them.
void append_starts(BasinFile& file, const Study& study, const Sampler& sampler, const Chunk& chunk,
                   std::pair<std::size_t, std::size_t> part, bool own,
                   const std::function<InitialState(std::uint64_t)>& start_of, const RunTime& so_far);

/// Replaces `path` by the file that basin() with this output and study would have left, so that basin() can read or
/// resume it (BasinFile). `result` must hold every start (BasinOptions::keep_starts). Throws InputError if it does not,
/// or if another run's unfinished results stand next to `path`. Throws RunError if the disk cannot take the file; an
/// old file then stays as it was.
void write_basin_file(const std::string& path, const BasinResult& result);

/// What that file keeps of every start.
std::vector<io::StartColumn> start_columns(const BasinResult& result);

/// The outcomes of an ensemble as its file lists them.
std::vector<OutcomeShare> outcome_summary(const BasinResult& result);

}  // namespace equipoise
