// equipoise simulate: one trajectory at stated times.
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
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

int run_simulate(const SimulateArguments& a) {
  begin_time(a.within);
  std::vector<std::string> overrides = a.overrides;
  if (a.tolerance)
    overrides.push_back(
        fmt::format("numerics.tolerance={}",
                    option_number<double>("--tolerance", *a.tolerance, 1e-14, 1e-2, "a number from 1e-14 to 1e-2")));
  const Study study = at_medians(read_study(a.study, overrides));
  const std::vector<double> times = output_times(a, study);
  if (!a.output.empty() && !a.output.ends_with(".csv") && !a.output.ends_with(".nc"))
    throw InputError("--output", "", a.output, "must be a file name ending in .csv or .nc");
  require_writable("--output", a.output);

  const auto begin = std::chrono::steady_clock::now();
  RunOptions options;
  options.stop = &stop_flag();
  const Trajectory trajectory = simulate(study, times, options);
  if (a.output.empty()) {
    put(trajectory_csv(trajectory, study));
  } else if (a.output.ends_with(".csv")) {
    write_file(a.output, trajectory_csv(trajectory, study));
  } else {
    write_netcdf(a.output, trajectory, to_toml(study));
  }
  for (const std::string& note : {release_text(study), coincident_text(study)})
    if (!note.empty()) say(note);
  if (study.speed.law == model::SpeedLaw::published) say("published speed law, psi = t Omega(t)");
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

}  // namespace

Command add_simulate(CLI::App& app) {
  const auto a = std::make_shared<SimulateArguments>();
  add_study(app, *a);
  app.add_option("--at", a->at, "times, separated by commas, in 1/omega_c or with units, e.g. 2 s")
      ->take_all()
      ->type_name("T,T,...");
  app.add_option("--every", a->every, "time between rows, in 1/omega_c or with units")->type_name("DT");
  app.add_option("--until", a->until, "last time, in 1/omega_c or with units")->type_name("T");
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
