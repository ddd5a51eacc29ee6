// What bindings need of every long call: callbacks on the caller's thread, stops, a CPU target for one call, starts in
// arrays as in the file, and the program's policy without the program.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/analyses/basin_slices/basin_slice.hpp"
#include "equipoise/analyses/continuation/continuation.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/analyses/one_study/observation.hpp"
#include "equipoise/extras/proof/certify.hpp"
#include "equipoise/extras/reproduction/reproduction.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/result_files/start_columns.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "../support/refusals.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace library_face_test {

Study rotor(std::uint64_t starts, const std::vector<std::string>& overrides = {}) {
  Study study = parse_study(constant_speed, "rotor", overrides);
  study.sampling.starts = starts;
  study.initial.phi = {1.0, 4.0};
  return study;
}

// Every long call in a quick form, with the options that all of them share.
std::map<std::string, std::function<void(const RunOptions&)>> long_calls() {
  const auto with = [](auto options, const RunOptions& shared) {
    static_cast<RunOptions&>(options) = shared;
    return options;
  };
  return {{"basin", [=](const RunOptions& o) { basin(rotor(600), with(BasinOptions{}, o)); }},
          {"attractors",
           [=](const RunOptions& o) {
             AttractorsOptions options = with(AttractorsOptions{}, o);
             options.starts = 300;
             attractors(rotor(1), options);
           }},
          {"observe",
           [=](const RunOptions& o) {
             ObservationSettings settings = with(ObservationSettings{}, o);
             settings.starts = 1100;
             settings.until = 20.0;
             observe(rotor(1), settings);
           }},
          {"plane_map",
           [=](const RunOptions& o) {
             BasinSliceSettings settings = with(BasinSliceSettings{}, o);
             settings.x = {"rotor.eccentricity", 0.0, 0.02, 2};
             settings.y = {"initial.phi_1", 0.0, 6.0, 2};
             basin_slice(rotor(1), settings);
           }},
          {"follow_attractors",
           [=](const RunOptions& o) {
             const Study study = rotor(1, {"speed.speed=3.0"});
             follow_attractors(study, ParameterLine(study, "speed.final=3.0:3.05:0.05"),
                               with(ContinuationOptions{}, o));
           }},
          {"certify", [=](const RunOptions& o) { certify(rotor(1), o); }},
          {"simulate", [=](const RunOptions& o) {
             simulate(rotor(1), {0.0, 10.0, 20.0}, o);
           }}};
}

TEST(Callbacks, AreCalledOnTheCallersThreadAlone) {
  for (const auto& [name, call] : long_calls()) {
    SCOPED_TRACE(name);
    RunOptions options;
    options.threads = 2;
    int reports = 0;
    std::uint64_t last = 0;
    bool elsewhere = false, backwards = false;
    std::string what;
    options.progress = [&, here = std::this_thread::get_id()](const Progress& p) {
      ++reports;
      elsewhere = elsewhere || std::this_thread::get_id() != here;
      backwards = backwards || (p.what == what && p.done < last);
      last = p.done;
      what = p.what;
    };
    call(options);
    EXPECT_GT(reports, 0);
    EXPECT_FALSE(elsewhere);
    EXPECT_FALSE(backwards);
    EXPECT_NE(what, "");
  }
}

// Nobody waits without news: stages of the attractor search are reported before the first start is counted.
TEST(Callbacks, HearOfTheSearchBeforeTheStarts) {
  std::vector<std::string> stages;
  bool counting = false, late = false;
  BasinOptions options;
  options.progress = [&](const Progress& p) {
    counting = counting || !p.preparing;
    late = late || (counting && p.preparing);
    if (stages.empty() || stages.back() != p.what) stages.push_back(p.what);
  };
  basin(rotor(300), options);
  EXPECT_FALSE(late);
  ASSERT_GE(stages.size(), 5u);
  EXPECT_EQ(stages.back(), "starts");
  for (const char* stage : {"balanced states", "pilot trajectories", "motions followed until they are steady",
                            "states tried on level sets"}) {
    const std::string what = std::string("looking for attractors: ") + stage;
    EXPECT_NE(std::find(stages.begin(), stages.end(), what), stages.end()) << what;
  }
}

// A search stopped at any of its stages is abandoned, and so is the ensemble.
TEST(Callbacks, StopTheSearchAtEveryStage) {
  for (const char* stage : {"balanced states", "pilot trajectories", "motions", "level sets"}) {
    SCOPED_TRACE(stage);
    StopFlag stop{false};
    BasinOptions options;
    options.stop = &stop;
    int after = 0;
    options.progress = [&](const Progress& p) {
      after += stop && !p.preparing;
      if (p.what.find(stage) != std::string::npos) stop = true;
    };
    const BasinResult result = basin(rotor(300), options);
    EXPECT_TRUE(stop && result.partial);
    EXPECT_EQ(result.starts, 0u);
    EXPECT_EQ(after, 0);
  }
}

TEST(Callbacks, EndTheCallWithWhatTheyThrow) {
  for (const auto& [name, call] : long_calls()) {
    SCOPED_TRACE(name);
    RunOptions options;
    options.threads = 2;
    int reports = 0;
    options.progress = [&](const Progress&) {
      ++reports;
      throw std::runtime_error("enough");
    };
    try {
      call(options);
      ADD_FAILURE() << "nothing came";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "enough");
    }
    EXPECT_EQ(reports, 1);  // it is not asked again
  }
}

TEST(Callbacks, MayStopTheWork) {
  BasinOptions options;
  options.threads = 2;
  bool asked = false;
  options.stop_asked = [&, here = std::this_thread::get_id()] { return asked = std::this_thread::get_id() == here; };
  const BasinResult result = basin(rotor(100'000'000), options);
  EXPECT_TRUE(asked);
  EXPECT_TRUE(result.partial);
  EXPECT_LT(result.starts, 100'000'000u);
}

TEST(Errors, OfTheWorkComeThroughTheCallersThread) {
  RunOptions options;
  options.progress = [](const Progress&) {};
  BasinOptions unwritable;
  unwritable.progress = options.progress;
  unwritable.output = "/nowhere/out.nc";
  EXPECT_THROW(basin(rotor(10), unwritable), InputError);
}

TEST(Certify, StopsAndSaysSo) {
  const StopFlag stop{true};
  RunOptions options;
  options.stop = &stop;
  const CertifyResult result = certify(rotor(1), options);
  EXPECT_TRUE(result.partial);
  EXPECT_FALSE(result.proved());
}

TEST(ProveLevel, StopsAmidItsBoxes) {
  const CertifyResult whole = certify(rotor(1));
  ASSERT_TRUE(whole.proved());
  EXPECT_FALSE(whole.partial);
  const StopFlag stop{true};
  const CertificateResult check = check_certificate(whole.states.front().certificate, &stop);
  EXPECT_FALSE(check.proved);
  EXPECT_NE(check.reason.find("stopped"), std::string::npos);
}

TEST(CpuTarget, MayBeChosenForOneCall) {
  const std::string before = cpu_target();
  BasinOptions options;
  options.cpu_target = cpu_targets().back();
  EXPECT_EQ(basin(rotor(50), options).cpu_target, cpu_targets().back());
  EXPECT_EQ(cpu_target(), before);
  options.cpu_target = "abacus";
  const InputError error = refused([&] { basin(rotor(50), options); });
  EXPECT_EQ(error.key(), "cpu_target");
  EXPECT_EQ(error.value(), "abacus");
  EXPECT_NE(error.allowed().find(before), std::string::npos);
  EXPECT_EQ(cpu_target(), before);
}

// Starts in arrays ----------------------------------------------------------------------------------------------------

// Figures as in a file, where values that are not finite are missing.
std::vector<float> stored_form(std::vector<float> figures) {
  for (float& figure : figures)
    if (!std::isfinite(figure)) figure = io::missing_figure;
  return figures;
}

// A column of a file.
template <class T>
std::vector<T> column(const io::NetcdfFile& file, const std::string& name, std::size_t starts, std::size_t width) {
  std::vector<T> values(starts * width);
  std::vector<std::size_t> begin{0}, count{starts};
  if (width > 1) begin.push_back(0), count.push_back(width);
  file.read(file.variable(name), begin, count, values.data());
  return values;
}

template <class T>
void expect_same(const std::vector<T>& a, const std::vector<T>& b, const char* name) {
  ASSERT_EQ(a.size(), b.size()) << name;
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(T)), 0) << name;
}

void expect_as_in_file(const StartArrays& arrays, const std::string& path, const Study& study, bool transients) {
  const io::NetcdfFile file(path, io::NetcdfFile::Mode::read);
  const std::size_t n = arrays.starts, balls = static_cast<std::size_t>(study.parameters.balls);
  ASSERT_EQ(file.length("start"), n);
  expect_same(arrays.phi, column<double>(file, "phi", n, balls), "phi");
  expect_same(arrays.outcome, column<short>(file, "outcome", n, 1), "outcome");
  expect_same(arrays.decision_time, column<double>(file, "decision_time", n, 1), "decision_time");
  expect_same(arrays.decided_by, column<signed char>(file, "decided_by", n, 1), "decided_by");
  if (!study.sampling.box.empty()) {
    expect_same(arrays.rotor_state, column<double>(file, "rotor_state", n, 4), "rotor_state");
    expect_same(arrays.phi_dot, column<double>(file, "phi_dot", n, balls), "phi_dot");
  }
  if (study.sampling.method == SamplingMethod::grid)
    expect_same(arrays.weight, column<double>(file, "weight", n, 1), "weight");
  if (study.speed.driven()) {
    expect_same(stored_form(arrays.mean_speed), column<float>(file, "mean_speed", n, 1), "mean_speed");
  }
  if (study.parameters.balls_stick()) {
    expect_same(stored_form(arrays.left_unbalance), column<float>(file, "left_unbalance", n, 1), "left_unbalance");
  }
  if (study.parameters.balls_collide())
    expect_same(arrays.balls_met, column<signed char>(file, "balls_met", n, 1), "balls_met");
  if (!transients) return;
  for (const TransientFigure& c : transient_figures)
    expect_same(stored_form(*arrays.transient(c.name)), column<float>(file, c.name, n, 1), c.name);
}

struct Kept {
  const char* name;
  std::vector<std::string> overrides;
  bool transients;
};

TEST(StartArrays, SayWhatTheFileSays) {
  for (const Kept& c : std::vector<Kept>{
           {"random", {}, false},
           {"box", {"sampling.box={x=[-0.1,0.1], phi_dot=[0.0,0.5]}"}, false},
           {"grid", {"sampling.method=grid"}, false},
           {"limits", {"limits={displacement=0.03, settled=0.001}"}, true},
           {"sticking", {"balancer.rolling=1e-3", "balancer.stiction=2e-3"}, false},
           {"motor",
            {"rotor.inertia=1.0", "speed={profile='torque', torque={constant=0.2, slope=-0.05}}", "sampling.starts=8"},
            false}}) {
    SCOPED_TRACE(c.name);
    Study study = rotor(1, c.overrides);
    study.sampling.starts = study.speed.driven() ? 8 : 300;
    BasinOptions options;
    options.threads = 2;
    options.keep_starts = true;
    options.output = testing::TempDir() + "equipoise_face_" + std::to_string(getpid()) + c.name + ".nc";
    std::filesystem::remove(options.output);
    const BasinResult first = basin(study, options);
    ASSERT_TRUE(first.every_start);
    EXPECT_EQ(first.every_start->starts, first.starts);
    EXPECT_EQ(first.transients.has_value(), c.transients);  // [limits] ask for them
    expect_as_in_file(*first.every_start, options.output, study, c.transients);
    const BasinResult again = basin(study, options);  // read from the file
    EXPECT_EQ(again.resumed_from, first.starts);
    expect_as_in_file(*again.every_start, options.output, study, c.transients);
    for (const std::uint64_t index : {std::uint64_t{0}, first.starts - 1}) {
      const InitialState start = start_of(study, index);
      for (int i = 0; i < study.parameters.balls; ++i)
        EXPECT_EQ(start.phi[i], first.every_start->phi[index * study.parameters.balls + i]);
    }
    std::filesystem::remove(options.output);
  }
}

TEST(StartArrays, AreKeptOnlyIfAskedFor) { EXPECT_FALSE(basin(rotor(50)).every_start); }

TEST(StartOf, IsWhatAReplayBeginsWithAndRefusesWhatAGridHasNot) {
  const Study study = rotor(100, {"sampling.box={x=[-0.1,0.1]}"});
  const StartReplay replay = replay_start(study, 77);
  EXPECT_EQ(start_of(study, 77).x, replay.start.x);
  EXPECT_EQ(start_of(study, 77).phi, replay.start.phi);
  EXPECT_THROW(start_of(rotor(64, {"sampling.method=grid"}), 1'000'000), InputError);
}

// The program's policy ------------------------------------------------------------------------------------------------

TEST(Transients, AreGatheredForLimitsUnlessToldOtherwise) {
  const Study plain = rotor(1), limited = rotor(1, {"limits.force=0.5"});
  BasinOptions options;
  EXPECT_FALSE(gathers_transients(plain, options));
  EXPECT_TRUE(gathers_transients(limited, options));
  options.transients = false;
  EXPECT_FALSE(gathers_transients(limited, options));
  options.transients = true;
  EXPECT_TRUE(gathers_transients(plain, options));
}

TEST(OutputTimes, EndAHundredAfterTheLastBranchUnlessToldOtherwise) {
  const Study ramp = parse_study(rotor_and_balancer + "[speed]\nprofile=\"ramp\"\nfinal=2.4\nduration=50\n", "ramp");
  const std::vector<double> times = output_times(ramp);
  EXPECT_EQ(times.size(), 101u);
  EXPECT_EQ(times.back(), 150.0);
  EXPECT_EQ(output_times(ramp, 10.0, 2.5), (std::vector{0.0, 2.5, 5.0, 7.5, 10.0}));
  EXPECT_EQ(output_times(ramp, 0.0), std::vector{0.0});
  EXPECT_THROW(output_times(ramp, -1.0), InputError);
  EXPECT_THROW(output_times(ramp, 1.0, std::nan("")), InputError);
  EXPECT_THROW(output_times(ramp, 1e9, 1e-3), InputError);
}

TEST(Reproduce, KnowsWhatThereIsAndStops) {
  const ReproduceOptions all = options_for({});
  EXPECT_EQ(all.tables.size(), 7u);
  EXPECT_TRUE(all.future);
  EXPECT_EQ(options_for({"table-3", "figure-release"}).tables, std::vector{3});
  EXPECT_EQ(options_for({"table-3", "figure-release"}).figures, std::vector<std::string>{"figure-release"});
  EXPECT_THROW(options_for({"table-8"}), InputError);
  ReproduceOptions options = options_for({"table-1", "future"});
  const StopFlag stop{true};
  options.stop = &stop;
  const Reproduction r = reproduce(options);
  EXPECT_TRUE(r.partial);
  EXPECT_EQ(r.starts, 0u);
  EXPECT_FALSE(r.open);
}

}  // namespace library_face_test
}  // namespace equipoise
