// equipoise simulate: one trajectory, or those of many starts, at stated times.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "equipoise/analyses/one_study/trajectories.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/results/result_files/trajectory_file.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "options.hpp"
#include "streams.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

struct SimulateArguments : CommonArguments {
  std::vector<std::string> at;
  std::optional<std::string> every, until, tolerance;
};

double time_option(const char* option, const std::string& text, const Study& study) {
  return option_time(option, text, study, 0.0, last_output_time, "a number from 0 to 1e9");
}

// --at, or the grid of --every and --until; by default a hundred intervals until 100 after the last piece begins.
std::vector<double> output_times(const SimulateArguments& a, const Study& study) {
  if (!a.at.empty()) {
    std::vector<double> times;
    if (a.every || a.until) throw InputError("--at", "", "", "give either --at or --every and --until, not both");
    for (const std::string& text : a.at)
      for (const std::string& time : parts_of(text, ',')) times.push_back(time_option("--at", time, study));
    for (std::size_t i = 1; i < times.size(); ++i)
      if (!(times[i] > times[i - 1]))
        throw InputError("--at", "", fmt::format("{}", times[i]),
                         fmt::format("times out of order: must be later than {}", times[i - 1]));
    return times;
  }
  std::optional<double> until, every;
  if (a.until) until = time_option("--until", *a.until, study);
  if (a.every)
    every = option_time("--every", *a.every, study, 1e-300, last_output_time, "a number greater than 0, at most 1e9");
  try {
    return equipoise::output_times(study, until, every);
  } catch (const InputError& e) {
    throw InputError(e.key() == "until" ? "--until" : "--every", "", e.value(), e.problem());
  }
}

// By the time reached: at constant speed all of it costs the same.
WorkLeft rows_left(const Trajectory& trajectory, const std::vector<double>& times,
                   std::chrono::steady_clock::time_point begin) {
  WorkLeft left{trajectory.t.size(), times.size(), "rows"};
  const double reached = trajectory.t.empty() ? 0.0 : trajectory.t.back();
  const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (reached > 0.0) left.seconds = taken * (times.back() / reached - 1.0);
  return left;
}

template <class Runs>
void put_or_write(const std::string& output, const Runs& runs, const Study& study) {
  if (output.empty())
    put(trajectory_csv(runs, study));
  else if (output.ends_with(".csv"))
    write_file(output, trajectory_csv(runs, study));
  else
    write_netcdf(output, runs, to_toml(study));
}

void say_conventions(const Study& study) {
  for (const std::string& note : {release_text(study), coincident_text(study)})
    if (!note.empty()) say(note);
  if (study.speed.law == model::SpeedLaw::published) say("published speed law, psi = t Omega(t)");
}

int run_one(const SimulateArguments& a, const Study& study, const std::vector<double>& times) {
  const auto begin = std::chrono::steady_clock::now();
  RunOptions options;
  options.stop = &stop_flag();
  const Trajectory trajectory = simulate(study, times, options);
  put_or_write(a.output, trajectory, study);
  say_conventions(study);
  const double last = trajectory.t.empty() ? 0.0 : trajectory.t.back();
  if (trajectory.stopped) {
    say("stopped after t = {}; the rows so far are kept", last);
    return ended_early(rows_left(trajectory, times, begin), nullptr, "");
  }
  if (trajectory.status != IntegrationStatus::done) {
    if (trajectory.status == IntegrationStatus::diverged)
      say("the trajectory diverged after t = {}; the rows so far are kept", last);
    else
      say("the trajectory could not be integrated further after t = {}; the rows so far are kept", last);
    return failed;
  }
  return done;
}

// A file of an interrupted run holds the trajectories that were done; later ones have no rows.
int run_many(const SimulateArguments& a, const Study& study, const std::vector<double>& times) {
  const std::uint64_t count = study.sampling.starts;
  const double rows = static_cast<double>(count) * static_cast<double>(times.size());
  if (rows > most_output_rows)
    throw InputError(
        "--starts", "", *a.starts,
        fmt::format("makes {:.0f} rows at {} times; must make at most {:.0f}", rows, times.size(), most_output_rows));
  RunOptions options;
  options.stop = &stop_flag();
  const Trajectories all = simulate(study, drawn_starts(study), times, options);
  put_or_write(a.output, all, study);
  say_conventions(study);
  const auto whole = static_cast<std::size_t>(
      std::count_if(all.runs.begin(), all.runs.end(), [&](const Trajectory& r) { return r.t.size() == times.size(); }));
  const auto lost = static_cast<std::size_t>(std::count_if(
      all.runs.begin(), all.runs.end(), [](const Trajectory& r) { return r.status != IntegrationStatus::done; }));
  if (all.stopped) {
    say("stopped with {} of {} trajectories whole; the rows so far are kept", whole, count);
    return ended_early(WorkLeft{whole, count, "trajectories"}, nullptr, "");
  }
  if (lost > 0)
    say("{} of {} trajectories diverged or could not be integrated further; their rows so far are kept", lost, count);
  return lost == count ? failed : done;
}

int run_simulate(const SimulateArguments& a) {
  begin_time(a.within);
  std::vector<std::string> overrides = overrides_of(a);
  if (a.tolerance)
    overrides.push_back(
        fmt::format("numerics.tolerance={}",
                    option_number<double>("--tolerance", *a.tolerance, 1e-14, 1e-2, "a number from 1e-14 to 1e-2")));
  if (a.seed && !a.starts) throw InputError("--seed", "", *a.seed, "needs --starts");
  const Study study = at_medians(read_study(a.study, overrides));
  const std::vector<double> times = output_times(a, study);
  if (!a.output.empty() && !a.output.ends_with(".csv") && !a.output.ends_with(".nc"))
    throw InputError("--output", "", a.output, "must be a file name ending in .csv or .nc");
  require_writable("--output", a.output);

  return a.starts ? run_many(a, study, times) : run_one(a, study, times);
}

}  // namespace

Command add_simulate(CLI::App& app) {
  const auto a = std::make_shared<SimulateArguments>();
  add_study(app, *a);
  app.add_option("--at", a->at, "times, separated by commas, in 1/omega_c or with units, e.g. 2 s")
      ->take_all()
      ->type_name("T,T,...");
  app.add_option("--every", a->every, "time between rows, in 1/omega_c or with units")->type_name("DT");
  app.add_option("--until", a->until, "last time, in 1/omega_c or with units")->type_name("T");
  add_starts(app, *a, "follow this many starts, those of basin, in place of [initial]", "seed of the starts");
  app.add_option("--tolerance", a->tolerance, "relative error allowed per step (default 1e-12)")->type_name("E");
  app.add_option("-o,--output", a->output, "write to this file (.csv or .nc) instead of CSV to standard output")
      ->type_name("FILE");
  add_within(app, a->within);
  app.add_option("--set", a->overrides, "override a study key, e.g. initial.phi=[1.0,4.0]; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all();
  return [a] { return run_simulate(*a); };
}

}  // namespace equipoise::app
