// Reads a sweep's settings from a file's identity; puts the cells of several files into one.
#include "equipoise/analyses/sweeps/sweep.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/analyses/sweeps/attractor_labels.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"
#include "equipoise/results/cell_files/sweep_file.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"

namespace equipoise {

namespace {

constexpr char no_sweep[] = "does not say which sweep it is of";

// The inverse of SweepPlan::identity(), as far as results need it.
SweepResult asked_for(const std::string& identity, const std::string& path) {
  SweepResult result;
  const io::IdentityLines lines(identity);
  const std::vector<std::string> over = lines.over();
  const std::size_t axes = std::strtoul(lines.value("sweep.axes").c_str(), nullptr, 10);
  if (over.empty() || axes == 0) throw InputError(path, "", "", no_sweep);
  result.half_width = number_in(lines.value("sweep.half_width"));
  result.transients = lines.value("transients") != "none";
  result.study = parse_kept_study(lines.study, path);
  result.axes = sweep_axes(over, axes < over.size(), path);
  std::size_t cells = 1;
  for (const SweepAxis& axis : result.axes) cells *= axis.size();
  if (cells != lines.cells()) throw InputError(path, "", "", no_sweep);
  result.identity = identity;
  result.cells.resize(cells);
  result.cpu_target = cpu_target();
  return result;
}

}  // namespace

SweepResult stored_sweep(const std::string& path, const RunOptions& options) {
  const StoredSweep stored = read_sweep(path);
  give_notice(options, stored.loss);
  SweepResult result = asked_for(stored.identity, path);
  for (const auto& [k, cell] : stored.cells) result.cells[k] = cell;
  for (const auto& cell : result.cells) result.resumed_cells += cell != nullptr;
  label_attractors(result.axes, result.cells);
  return result;
}

SweepResult merge_sweeps(const std::vector<std::string>& files, const std::string& output, const RunOptions& options) {
  if (files.empty()) throw InputError("merge", "", "", "must be at least one file of a sweep");
  const std::string identity = read_sweep(files.front()).identity;
  SweepResult result = asked_for(identity, files.front());
  const auto into = io::open_sweep_file(output, identity, result.cells);
  give_notice(options, into->loss());
  for (const std::string& path : files) {
    const StoredSweep part = read_sweep(path);
    give_notice(options, part.loss);
    if (const std::string how = io::difference(part.identity, identity); !how.empty())
      throw InputError(path, "", "", fmt::format("is of another sweep than {}: {}", files.front(), how));
    for (const auto& [k, cell] : part.cells) {
      if (result.cells[k]) continue;
      into->append(k, io::bytes_of(*cell));
      result.cells[k] = cell;
    }
  }
  label_attractors(result.axes, result.cells);
  io::finish_sweep_file(*into, result);
  return result;
}

}  // namespace equipoise
