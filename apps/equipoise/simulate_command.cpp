// equipoise simulate: one trajectory at stated times.
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "equipoise/run/simulate.hpp"
#include "options.hpp"

namespace equipoise::app {

namespace {

struct SimulateArguments {
  std::string study, output;
  std::vector<std::string> overrides, at;
  std::optional<std::string> every, until, tolerance;
};

constexpr double most_rows = 1e8;

double number(const char* option, const std::string& text, bool zero_allowed) {
  double value = 0.0;
  if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value) || !(zero_allowed ? value >= 0.0 : value > 0.0))
    throw InputError(option, "", text,
                     fmt::format("must be a finite number {}", zero_allowed ? "0 or more" : "greater than 0"));
  return value;
}

// --at, or the grid of --every and --until; by default a hundred times until 100 after the last branch begins.
std::vector<double> output_times(const SimulateArguments& a, const Study& study) {
  std::vector<double> times;
  if (!a.at.empty()) {
    if (a.every || a.until) throw InputError("--at", "", "", "give either --at or --every and --until, not both");
    for (const std::string& text : a.at) times.push_back(number("--at", text, true));
    for (std::size_t i = 1; i < times.size(); ++i)
      if (!(times[i] > times[i - 1]))
        throw InputError("--at", "", a.at[i], fmt::format("times out of order: must be later than {}", a.at[i - 1]));
    return times;
  }
  const model::Drive drive = study.drive();
  const double settled = std::max(drive.pieces.back().begin, study.speed.driven() ? 0.0 : drive.release_time);
  const double until = a.until ? number("--until", *a.until, true) : settled + 100.0;
  const double every = a.every ? number("--every", *a.every, false) : until > 0.0 ? until / 100.0 : 1.0;
  if (until / every > most_rows)
    throw InputError("--every", "", fmt::format("{}", every),
                     fmt::format("makes more than {:.0f} rows; must be at least {}", most_rows, until / most_rows));
  const auto rows = static_cast<std::size_t>(std::floor(until / every * (1.0 + 1e-12)));
  for (std::size_t k = 0; k <= rows; ++k) times.push_back(static_cast<double>(k) * every);
  return times;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

void check_output(const std::string& path) {
  if (!path.empty() && !ends_with(path, ".csv") && !ends_with(path, ".nc"))
    throw InputError("--output", "", path, "must be a file name ending in .csv or .nc");
  require_writable("--output", path);
}

int run_simulate(const SimulateArguments& a) {
  std::vector<std::string> overrides = a.overrides;
  if (a.tolerance) overrides.push_back("numerics.tolerance=" + *a.tolerance);
  const Study study = read_study(a.study, overrides);
  const std::vector<double> times = output_times(a, study);
  check_output(a.output);

  const Trajectory trajectory = simulate(study, times, &stop_flag());
  if (a.output.empty()) {
    write_csv(std::cout, trajectory);
    if (!std::cout.flush()) throw RunError("standard output cannot be written");
  } else if (ends_with(a.output, ".csv")) {
    write_csv_file(a.output, trajectory);
  } else {
    write_netcdf(a.output, trajectory, to_toml(study));
  }
  if (study.speed.law == model::SpeedLaw::published)
    fmt::print(stderr, "equipoise: published speed law, psi = t Omega(t)\n");
  const double last = trajectory.t.empty() ? 0.0 : trajectory.t.back();
  if (trajectory.stopped) {
    fmt::print(stderr, "equipoise: interrupted after t = {}; the rows so far are kept\n", last);
    return interrupted;
  }
  if (trajectory.status != IntegrationStatus::done) {
    fmt::print(stderr, "equipoise: the trajectory {} after t = {}; the rows so far are kept\n",
               trajectory.status == IntegrationStatus::diverged ? "diverged" : "could not be integrated further", last);
    return failed;
  }
  return done;
}

}  // namespace

Command add_simulate(CLI::App& app) {
  const auto a = std::make_shared<SimulateArguments>();
  app.add_option("study", a->study, "study file (TOML)")->required()->type_name("STUDY");
  app.add_option("--at", a->at, "times, separated by commas")->delimiter(',')->type_name("T,T,...");
  app.add_option("--every", a->every, "time between rows")->type_name("DT");
  app.add_option("--until", a->until, "last time")->type_name("T");
  app.add_option("--tolerance", a->tolerance, "error allowed a step, relative (default 1e-12)")->type_name("E");
  app.add_option("-o,--output", a->output, "write here (.csv or .nc) instead of CSV on standard output")
      ->type_name("FILE");
  app.add_option("--set", a->overrides, "override a study key, e.g. initial.phi=[1.0,4.0]; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all();
  return [a] { return run_simulate(*a); };
}

}  // namespace equipoise::app
