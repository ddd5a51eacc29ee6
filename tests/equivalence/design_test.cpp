// Designs on ensembles: bit-identical for any threads and after any stop; a candidate's figures are those of basin();
// impossible requests are refused.
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "../support/files.hpp"
#include "../support/studies.hpp"
#include "equipoise/analyses/design/design.hpp"
#include "equipoise/analyses/design/ensembles.hpp"
#include "equipoise/analyses/design/search.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/report/answers/design_words.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/reports/reports.hpp"

namespace equipoise {
namespace design_test {

// Spin-ups to one speed share their attractor search: an ensemble costs only its starts.
const std::string small_design = rotor_and_balancer + R"([speed]
profile = "constant"
speed = 2.0
[design]
objective = ["balanced"]
method = "latin"
starts = 100
trajectories = 10_000
[design.vary]
speed = { points = 1, until = 200.0, range = [0.0, 5.0], slope = 0.05 }
"release.time" = [0.0, 150.0]
)";

DesignProblem problem_of(const std::string& toml) { return DesignProblem(StudySource{toml, "study.toml", {}}); }

std::string without_times(const DesignResult& result) {
  std::istringstream text(json_text(result));
  std::string kept;
  for (std::string line; std::getline(text, line);)
    if (line.find("seconds") == line.npos && line.find("\"threads\"") == line.npos &&
        line.find("\"resumed\"") == line.npos)
      kept += line + "\n";
  return kept;
}

class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("equipoise-design-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string file(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

TEST(Design, SameBitsForAnyThreads) {
  const DesignProblem problem = problem_of(small_design);
  DesignOptions one, three;
  one.threads = 1;
  three.threads = 3;
  const DesignResult result = design(problem, one);
  EXPECT_EQ(without_times(result), without_times(design(problem, three)));
  ASSERT_EQ(result.front.size(), 1u);
  EXPECT_GT(result.candidates, 50u);
  EXPECT_FALSE(result.margins.empty());
}

const std::string lone_machine = R"([rotor]
mass = "4 kg"
stiffness = "10 kN/m"
damping_ratio = 0.05
unbalance = "120 g mm"
[balancer]
balls = 4
race_radius = "60 mm"
ball_diameter = "8 mm"
ball_material = "steel"
oil_viscosity = "100 mPa s"
contact = false
[speed]
final = "1800 rpm"
run_up = "4 s"
[limits]
velocity = "2 mm/s"
[design]
objective = ["peak_radial.0.95"]
method = "latin"
starts = 100
trajectories = 2000
[design.vary]
)";

// Two balls cannot cancel the unbalance; the study's four can.
TEST(Design, TheStudyItselfIsACandidate) {
  const DesignProblem problem =
      problem_of(with(lone_machine, "120 g mm", "300 g mm") +
                 "\"balancer.balls\" = [1, 2]\n[design.require]\nbalanced = { above = 0.9 }\n");
  for (const bool cut : {false, true}) {
    DesignOptions options;
    if (cut) options.search_time_over = [] { return true; };  // as soon as one candidate is known
    const DesignResult result = design(problem, options);
    ASSERT_TRUE(result.chosen);
    const DesignCandidate& best = result.front[*result.chosen];
    EXPECT_TRUE(best.as_it_is && result.feasible);
    EXPECT_EQ(result.partial, cut);
    EXPECT_TRUE(best.held_out);
    EXPECT_TRUE(holds(result_text(result), "Leave it as it is: it keeps all requirements")) << result_text(result);
    EXPECT_TRUE(holds(result.best_study, "balls = 4")) << result.best_study;
  }
}

// At once: no trajectory is followed. Not so if the speed may be chosen.
TEST(Design, LeavesTheBalancerOutBelowTheCriticalSpeed) {
  const std::string slow =
      with(lone_machine, "1800 rpm", "420 rpm") + "\"balancer.oil_viscosity\" = [\"50 mPa s\", \"500 mPa s\"]\n";
  const std::string require = "[design.require]\nbalanced = { above = 0.9 }\n";
  for (const char* unbalance : {"\"120 g mm\"", "{ uniform = [\"20 g mm\", \"120 g mm\"] }"}) {
    const DesignResult result = design(problem_of(with(slow, "\"120 g mm\"", unbalance) + require));
    EXPECT_TRUE(result.leave_out && result.front.empty() && !result.chosen && !result.partial);
    EXPECT_EQ(result.trajectories, 0u);
    EXPECT_LT(result.cpu_seconds, 2.0);
    EXPECT_TRUE(result_text(result).starts_with("verdict   Leave the balancer out: the rotor runs "));
  }
  const DesignResult faster = design(problem_of(slow + "\"speed.final\" = [\"420 rpm\", \"1800 rpm\"]\n" + require));
  EXPECT_FALSE(faster.leave_out);
  EXPECT_TRUE(faster.feasible);
}

TEST(Design, StoppedAndGoneOnWithItEndsInTheSameFile) {
  const Folder folder;
  const DesignProblem problem = problem_of(small_design);
  DesignOptions options;
  options.threads = 2;
  options.output = folder.file("whole.nc");
  const DesignResult whole = design(problem, options);
  options.output = folder.file("stopped.nc");
  int stops = 0;
  for (bool partial = true; partial; ++stops) {
    StopFlag stop{false};
    options.stop = &stop;
    options.progress = [&](const Progress& p) {
      stop = stop || p.done >= 3000 * static_cast<std::uint64_t>(stops + 1);
    };
    partial = design(problem, options).partial;
    ASSERT_LT(stops, 20);
  }
  EXPECT_GT(stops, 1);
  EXPECT_EQ(content(folder.file("whole.nc")), content(folder.file("stopped.nc")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("stopped.nc.part")));
  options.progress = {};
  options.stop = nullptr;
  const DesignResult read = design(problem, options);
  EXPECT_GT(read.resumed, 0u);
  EXPECT_EQ(without_times(whole), without_times(read));
}

TEST(Design, AnotherDesignIsNotAddedToAFile) {
  const Folder folder;
  DesignOptions options;
  options.output = folder.file("one.nc");
  design(problem_of(small_design), options);
  EXPECT_THROW(design(DesignProblem(StudySource{small_design, "study.toml", {"design.seed=2"}}), options), InputError);
}

TEST(Design, FiguresOfTheChosenOneAreThoseOfItsStudy) {
  const DesignResult result = design(problem_of(small_design));
  ASSERT_TRUE(result.chosen && result.front[*result.chosen].held_out);
  const DesignSample& told = *result.front[*result.chosen].held_out;
  const Study best = parse_study(
      result.best_study, "best.toml",
      {"sampling.starts=" + std::to_string(told.starts), "sampling.seed=" + std::to_string(result.held_out_seed)});
  const BasinResult basins = basin(best);
  EXPECT_EQ(told.figures[0].value, basins.attractors.front().share.share);
  EXPECT_EQ(told.figures[0].low, basins.attractors.front().share.low);
  EXPECT_EQ(told.undecided.value, basins.undecided.share);
  EXPECT_NE(result.search_seed, result.held_out_seed);
  // At this constant speed about 45 % of starts do not balance; a spin-up can do better.
  EXPECT_GT(told.figures[0].low, result.before->figures[0].high);
}

// At constant speed 55 % of starts balance: the median start has an energy, the 90 % quantile has none. After a spin-up
// each costs at least the rotor's spin energy, iota Omega^2/2.
TEST(Design, EnergyIsThatOfStartsThatBalance) {
  std::string study = small_design;
  study.replace(study.find("damping = 0.5"), 13, "damping = 0.5\ninertia = 0.3");
  study.replace(study.find("[\"balanced\"]"), 12, "[\"energy.0.5\"]");
  const DesignResult result = design(problem_of(study + "[design.require]\n\"energy.0.9\" = { below = 1000.0 }\n"));
  ASSERT_TRUE(result.chosen && result.before);
  EXPECT_TRUE(std::isfinite(result.before->figures[0].value));
  EXPECT_TRUE(std::isinf(result.before->figures[1].value));
  EXPECT_TRUE(result.feasible);
  for (const DesignEstimate& e : result.front[*result.chosen].held_out->figures) {
    EXPECT_GT(e.low, 0.5 * 0.3 * 4.0);
    EXPECT_TRUE(std::isfinite(e.high));
  }
}

// Two balls of mass m at 50 mm cancel up to m times 100 mm. For unbalances uniform from 100 to 400 g mm that is two
// thirds with 3 g and all with 4.5 g, in a thin enough film of oil.
TEST(Design, HoldsOverWhatEachStartDraws) {
  const DesignProblem problem = problem_of(R"([rotor]
mass = "10 kg"
stiffness = "100 kN/m"
damping_ratio = 0.1
unbalance = { uniform = ["100 g mm", "400 g mm"] }
[balancer]
balls = 2
race_radius = "50 mm"
mass = "6 g"
drag = "0.0002 N m s"
[speed]
profile = "ramp"
initial = "0 rpm"
final = "3000 rpm"
duration = "5 s"
[release]
time = "0 s"
[design]
objective = ["-balancer.mass"]
method = "latin"
[design.vary]
"balancer.mass" = ["3 g", "15 g"]
[design.require]
balanced = { above = 0.95 }
"peak_radial.0.95" = { below = "0.5 mm" }
)");
  const DesignOptions defaults;
  DesignEnsembles ensembles(problem, defaults, nullptr);
  const auto with = [](const char* mass) { return std::vector<DesignSetting>{{"balancer.mass", StudyValue(mass)}}; };
  constexpr std::uint64_t starts = 60;
  const auto samples =
      ensembles.run({{with("3 g"), starts, 5}, {with("4.5 g"), starts, 5}, {with("4.5 g"), starts, 6}});
  const auto place = [&](const char* name) {
    for (std::size_t k = 0; k < problem.figures().size(); ++k)
      if (problem.figures()[k].figure.name == name) return k;
    return problem.figures().size();
  };
  const std::size_t balanced = place("balanced"), peak = place("peak_radial.0.95"), mass = place("-balancer.mass");
  EXPECT_NEAR(samples[0].figures[balanced].value, 2.0 / 3, 3.0 * std::sqrt(2.0 / 9 / starts));  // three standard errors
  EXPECT_EQ(samples[1].figures[balanced].value, 1.0);
  EXPECT_EQ(samples[0].figures[mass].value, 3.0);
  EXPECT_NE(samples[1].figures[peak].value, samples[2].figures[peak].value);  // other draws
  // A candidate's study draws like the original one.
  const Study study = problem.study_of(with("4.5 g"), starts, 5);
  EXPECT_EQ(study.uncertain.values.size(), 1u);
  BasinOptions options;
  options.transients = options.keep_starts = true;
  const BasinResult result = basin(study, options);
  EXPECT_EQ(sample_of(problem.figures(), result, study, with("4.5 g")).figures[peak].value,
            samples[1].figures[peak].value);
}

TEST(Design, WhatCannotBeMetIsSaidWithHowNearItCame) {
  const DesignResult result =
      design(problem_of(small_design + "[design.require]\nspin_up_time = { above = 1000.0 }\n"));
  EXPECT_FALSE(result.feasible);
  ASSERT_TRUE(result.chosen);
  const double nearest = result.front[*result.chosen].best_known().figures[1].value;
  EXPECT_GE(nearest, 40.0);  // to 2 at a slope of 0.05
  EXPECT_LE(nearest, 200.0);
  EXPECT_NE(design_answer(result).find("spin_up_time must be above 1000"), std::string::npos) << design_answer(result);
  ASSERT_FALSE(result.limited_by.empty());
  EXPECT_NE(result.limited_by.front().find("not met: spin_up_time"), std::string::npos);
}

// Restarts of CMA-ES double its population: counted in batches, a search that knows every choice would never end.
TEST(Design, SearchAmongAFewChoicesEnds) {
  if (!optimisers_built_in()) GTEST_SKIP() << "built without pagmo2";
  const DesignResult result = design(problem_of(rotor_and_balancer + R"([speed]
profile = "ramp"
final = 2.0
duration = 100.0
[design]
objective = ["balanced"]
starts = 100
trajectories = 10_000
[design.vary]
"release.time" = { choices = [0.0, 50.0, 100.0] }
)"));
  EXPECT_EQ(result.candidates, 4u);  // and the study itself
  EXPECT_TRUE(result.chosen && !result.partial);
}

// The time may be over before the search has followed the study itself, which is then judged all the same.
TEST(Design, IsToldOfACandidateThatTheSearchDidNotReach) {
  DesignResult result;
  result.study = parse_study(constant_speed, "study");
  result.figures = {{"balanced", "", true, true}};
  result.objectives = {0};
  DesignCandidate own;
  own.as_it_is = true;
  own.held_out = DesignSample{100, {{0.5, 0.4, 0.6}}, {}, ""};
  result.front = {own};
  result.chosen = 0;
  result.partial = true;
  const std::string json = json_text(result);
  EXPECT_NE(json.find("\"value\": 0.5"), std::string::npos);
  EXPECT_EQ(json.find("on_search_starts"), std::string::npos);
  EXPECT_NE(result_text(result, {}).find("50"), std::string::npos);
}

TEST(Design, StoppedSearchTellsWhatItHadFound) {
  StopFlag stop{false};
  DesignOptions options;
  options.stop = &stop;
  options.progress = [&](const Progress& p) { stop = p.done >= 3000; };
  const DesignResult result = design(problem_of(small_design), options);
  EXPECT_TRUE(result.partial);
  ASSERT_TRUE(result.chosen);
  EXPECT_FALSE(result.front[*result.chosen].held_out);
  EXPECT_GT(result.front[*result.chosen].search.starts, 0u);
}

// When a search of expensive candidates is interrupted, the finished ensembles in the file are all it can report.
TEST(Design, StoppedAmidItsFirstBatchTellsWhatWasDoneOfIt) {
  const Folder folder;
  const std::string file = folder.file("amid.nc");
  const std::string longer = small_design + "[design.require]\n\"peak_radial.0.95\" = { below = 1.0 }\n";
  const DesignProblem problem = DesignProblem(StudySource{longer, "study.toml", {"design.starts=400"}});
  StopFlag stop{false};
  DesignOptions options;
  options.threads = 1;
  options.stop = &stop;
  options.output = file;
  std::thread watcher([&] {  // until the first ensembles are in the file
    while (!stop && !(std::filesystem::exists(file + ".part") &&
                      content(file + ".part").find("400 starts") != std::string::npos))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    stop = true;
  });
  const DesignResult result = design(problem, options);
  stop = true;
  watcher.join();
  EXPECT_TRUE(result.partial);
  ASSERT_TRUE(result.chosen);
  EXPECT_GE(result.front[*result.chosen].search.starts, 400u);
}

TEST(Design, StoppedBeforeItsFirstBatchSaysSo) {
  StopFlag stop{true};
  DesignOptions options;
  options.stop = &stop;
  const DesignResult result = design(problem_of(small_design), options);
  EXPECT_TRUE(result.partial);
  EXPECT_FALSE(result.chosen);
  EXPECT_EQ(design_answer(result), "PARTIAL: stopped before any candidate was known.");
}

}  // namespace design_test
}  // namespace equipoise
