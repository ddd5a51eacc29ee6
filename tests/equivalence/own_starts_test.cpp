// The caller's own starts: the same outcomes as drawn starts, on any thread and in chunks of any size; invalid
// starts; and ensembles written from memory.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/ensembles/stored_ensemble.hpp"
#include "equipoise/analyses/mapper/mapper.hpp"
#include "equipoise/analyses/one_study/comparison.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/result_files/basin_outcomes.hpp"
#include "../support/refusals.hpp"
#include "../support/files.hpp"
#include "../support/studies.hpp"
#include "../support/sizes.hpp"

namespace equipoise {
namespace own_starts_test {

const std::string driven_rotor = R"([rotor]
eccentricity = 0.02
damping = 0.4
inertia = 4.0
gravity = 0.02
[balancer]
balls = 2
mass = 0.03
drag = 0.2
[initial]
psi = 0.7
[speed]
profile = "torque"
torque = { gain = 2.0, target = { profile = "ramp", final = 2.4, duration = 20.0 } }
)";
const std::string ramp = rotor_and_balancer + "[speed]\nprofile = \"ramp\"\nfinal = 2.4\nduration = 40.0\n";

// One of each kind whose starts are prepared in a different way.
const std::vector<std::pair<std::string, std::string>>& kinds() {
  static const std::vector<std::pair<std::string, std::string>> all{
      {"prescribed", constant_speed},
      {"boxed", constant_speed + "[sampling.box]\nx = [-0.2, 0.2]\ny_dot = [-0.5, 0.5]\nphi_dot = [-2.4, 2.4]\n"},
      {"held", ramp + "[initial]\nx = 0.01\n[release]\nspeed = 2.2\n[limits]\ndisplacement = 0.05\n"},
      {"released_early", ramp + "[release]\ntime = 10.0\n"},
      {"motor", driven_rotor + "[limits]\ndisplacement = 0.05\n"},
      {"motor_that_holds", driven_rotor + "[release]\nspeed = 1.8\n"},
      {"gravity", rotor_and_balancer + "[speed]\nprofile = \"constant\"\nspeed = 2.4\n[initial]\npsi = 0.4\n"},
      {"contact", rotor_and_balancer + "contact_angle = 0.3\n[speed]\nprofile = \"constant\"\nspeed = 2.4\n"},
      {"coasting", driven_rotor}};
  return all;
}

Study study_of(const std::string& kind, std::uint64_t starts) {
  for (const auto& [name, text] : kinds()) {
    if (name != kind) continue;
    std::vector<std::string> overrides{"sampling.starts=" + std::to_string(starts)};
    if (kind == "gravity") overrides.emplace_back("rotor.gravity=0.02");
    if (kind == "coasting") {
      overrides.emplace_back("speed.torque={constant=0.4,until=20.0}");
      overrides.emplace_back("numerics.horizon=60");
    }
    return parse_study(text, kind, overrides);
  }
  throw InputError("kind", "", kind, "must be one of those above");
}

std::vector<InitialState> drawn(const Study& study) {
  std::vector<InitialState> starts;
  for (std::uint64_t i = 0; i < study.sampling.starts; ++i) starts.push_back(start_of(study, i));
  return starts;
}

// The attractors of one rotor are searched once.
AttractorSearchCache searches;

BasinResult with_starts(const Study& study, std::vector<InitialState> starts, int threads = 2) {
  BasinOptions options;
  options.searches = &searches;
  options.initial = std::move(starts);
  options.keep_starts = true;
  options.threads = threads;
  return basin(study, options);
}

// Every bit; NaN equals NaN.
template <class T>
std::string bits(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

void expect_same_outcomes(const StartArrays& a, const StartArrays& b) {
  ASSERT_EQ(a.starts, b.starts);
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(bits(a.phi), bits(b.phi));
  EXPECT_EQ(bits(a.decision_time), bits(b.decision_time));
  EXPECT_EQ(a.decided_by, b.decided_by);
  EXPECT_EQ(bits(a.mean_speed), bits(b.mean_speed));
  for (std::size_t k = 0; k < a.transients.size(); ++k) EXPECT_EQ(bits(a.transients[k]), bits(b.transients[k])) << k;
}

std::uint64_t few(const std::string& kind) {
  return kind == "coasting" ? sized(12, 4) : kind == "contact" ? sized(120, 20) : sized(300, 40);
}

class OwnStarts : public testing::TestWithParam<std::string> {};

TEST_P(OwnStarts, HaveTheOutcomesOfDrawnOnesThatAreTheSame) {
  const Study study = study_of(GetParam(), few(GetParam()));
  BasinOptions options;
  options.keep_starts = true;
  options.searches = &searches;
  const BasinResult sampled = basin(study, options), own = with_starts(study, drawn(study));
  expect_same_outcomes(*sampled.every_start, *own.every_start);
  ASSERT_EQ(sampled.attractors.size(), own.attractors.size());
  for (std::size_t k = 0; k < own.attractors.size(); ++k) {
    EXPECT_EQ(own.attractors[k].name, sampled.attractors[k].name);
    EXPECT_EQ(own.attractors[k].share.low, sampled.attractors[k].share.low);
  }
  EXPECT_EQ(own.note, sampled.note);
  EXPECT_TRUE(own.own_starts);
  EXPECT_EQ(own.every_start->psi.front(), study.initial.psi);
  EXPECT_EQ(own.every_start->phi_dot.size(), own.every_start->phi.size());
}

TEST_P(OwnStarts, AreMappedAsTheEnsembleDecidesThem) {
  const Study study = study_of(GetParam(), few(GetParam()));
  const std::vector<InitialState> starts = drawn(study);
  const BasinResult own = with_starts(study, starts);
  const Mapper mapper(study);
  RunOptions three;
  three.threads = 3;
  const std::vector<Outcome> together = mapper(starts, three);
  ASSERT_EQ(together.size(), starts.size());
  const auto expect_one = [&](std::size_t i, const Outcome& outcome) {
    EXPECT_EQ(outcome.kind == OutcomeKind::attracted ? outcome.attractor : 0,
              std::max<short>(own.every_start->outcome[i], 0));
    EXPECT_EQ(outcome.time, own.every_start->decision_time[i]) << i;
  };
  for (std::size_t i = 0; i < starts.size(); ++i) expect_one(i, together[i]);
  for (const std::size_t i : {starts.size() - 1, starts.size() / 2}) expect_one(i, mapper(starts[i]));
  for (const OutcomeShare& a : own.attractors)
    if (a.share.count > 0) {
      EXPECT_EQ(mapper.name(a.id), a.name);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, OwnStarts,
                         testing::Values("prescribed", "boxed", "held", "released_early", "motor", "motor_that_holds",
                                         "gravity", "contact", "coasting"),
                         [](const auto& kind) { return kind.param; });

TEST(OwnStartsAlone, KnowNoThreadsAndNoNeighbours) {
  const Study study = study_of("boxed", sized(2000, 200));
  std::vector<InitialState> starts = drawn(study);
  const BasinResult one = with_starts(study, starts, 1), three = with_starts(study, starts, 3);
  expect_same_outcomes(*one.every_start, *three.every_start);
  BasinOptions options;
  options.initial = starts;
  const StartReplay last = replay_start(study, starts.size() - 1, options);
  EXPECT_EQ(last.outcome.time, one.every_start->decision_time.back());
  EXPECT_THROW(replay_start(study, starts.size(), options), InputError);
  starts.erase(starts.begin(), starts.begin() + 77);
  const BasinResult rest = with_starts(study, starts, 2);
  EXPECT_EQ(rest.every_start->outcome,
            std::vector<short>(one.every_start->outcome.begin() + 77, one.every_start->outcome.end()));
}

// A driven rotor begins at any given angle, where gravity acts on it differently.
TEST(OwnStartsAlone, OfADrivenRotorHaveAnAngleOfTheirOwn) {
  for (const char* kind : {"motor", "coasting"}) {
    const Study study = study_of(kind, 4);
    Study turned = study;
    turned.initial.psi += 1.0;
    std::vector<InitialState> starts = drawn(study);
    for (InitialState& s : starts) s.psi = turned.initial.psi;
    const BasinResult own = with_starts(study, starts), there = with_starts(turned, starts);
    EXPECT_EQ(own.every_start->outcome, there.every_start->outcome) << kind;
    EXPECT_EQ(bits(own.every_start->mean_speed), bits(there.every_start->mean_speed)) << kind;
    const BasinResult unturned = with_starts(study, drawn(study));
    const auto told = [](const StartArrays& a) { return bits(a.mean_speed) + bits(a.decision_time); };
    EXPECT_NE(told(*own.every_start), told(*unturned.every_start)) << kind;
  }
}

struct Refusal {
  std::string kind, key;
  std::function<void(Study&, BasinOptions&)> spoil;
};

TEST(OwnStartsAlone, ThatAreNoneAreRefusedBeforeAnyWork) {
  const double endless = std::numeric_limits<double>::infinity();
  const std::vector<Refusal> refusals{
      {"prescribed", "half_width", [](Study&, BasinOptions& o) { o.half_width = 0.1; }},
      {"prescribed", "sampling.method", [](Study& s, BasinOptions&) { s.sampling.method = SamplingMethod::grid; }},
      {"prescribed", "sampling.method", [](Study& s, BasinOptions&) { s.sampling.method = SamplingMethod::sobol; }},
      {"prescribed", "initial.x", [=](Study&, BasinOptions& o) { o.initial[1].x = endless; }},
      {"prescribed", "initial.phi_dot[1]", [=](Study&, BasinOptions& o) { o.initial[1].phi_dot[1] = -endless; }},
      {"prescribed", "initial.phi[2]", [](Study&, BasinOptions& o) { o.initial[1].phi[2] = 1.0; }},
      {"held", "initial.x", [](Study&, BasinOptions& o) { o.initial[1].x = 0.02; }},
      {"held", "initial.y_dot", [](Study&, BasinOptions& o) { o.initial[1].y_dot = 0.1; }},
      {"held", "initial.phi_dot[0]", [](Study&, BasinOptions& o) { o.initial[1].phi_dot[0] = 0.1; }},
      {"motor_that_holds", "initial.phi_dot[1]", [](Study&, BasinOptions& o) { o.initial[1].phi_dot[1] = 0.1; }},
      {"gravity", "initial.psi", [](Study&, BasinOptions& o) { o.initial[1].psi = 0.5; }},
      {"contact", "initial.phi", [](Study&, BasinOptions& o) {
         o.initial[1].phi = {1.0, 1.1};
       }}};
  for (const Refusal& r : refusals) {
    Study study = study_of(r.kind, 3);
    BasinOptions options;
    options.initial = drawn(study);
    bool worked = false;
    options.progress = [&](const Progress&) { worked = true; };
    r.spoil(study, options);
    EXPECT_EQ(refused_key([&] { basin(study, options); }), r.key) << r.kind;
    EXPECT_FALSE(worked);
  }
  BasinOptions one;
  one.initial.resize(1);
  const Study uncertain = parse_study(constant_speed, "uncertain", {"rotor.eccentricity={values=[0.01]}"});
  EXPECT_THROW(basin(uncertain, one), InputError);
  EXPECT_THROW(Mapper{uncertain}(InitialState{}), InputError);
  const Mapper mapper(study_of("prescribed", 1));
  InitialState nowhere;
  nowhere.y = endless;
  EXPECT_THROW(mapper(nowhere), InputError);
}

TEST(OwnStartsInAFile, AreResumedAndToldFromOthers) {
  const Study study = study_of("boxed", sized(600, 80));
  BasinOptions options;
  options.initial = drawn(study);
  options.output = scratch_file("own.nc");
  options.searches = &searches;
  options.keep_starts = true;
  StopFlag stop{false};
  options.stop = &stop;
  options.outcome = [&](const Outcome&) { stop = true; };  // after the first chunk
  const BasinResult begun = basin(study, options);
  stop = false;
  options.outcome = nullptr;
  const BasinResult whole = basin(study, options), again = basin(study, options);
  EXPECT_EQ(whole.resumed_from, begun.starts);
  EXPECT_EQ(again.resumed_from, options.initial.size());
  expect_same_outcomes(*whole.every_start, *with_starts(study, options.initial).every_start);
  const BasinOutcomes kept = read_basin_outcomes(options.output);
  EXPECT_EQ(kept.outcome, whole.every_start->outcome);
  EXPECT_NE(kept.own_starts, "");
  EXPECT_FALSE(compare(kept, basin_outcomes(study, {})).common);
  BasinOptions others = options;
  others.initial.back().x += 1e-9;
  EXPECT_THROW(basin(study, others), InputError);
  others.initial.clear();
  EXPECT_THROW(basin(study, others), InputError);
  std::filesystem::remove(options.output);
}

// Byte for byte what `output` leaves; kinds of starts have different columns.
TEST(WriteBasin, MakesTheFileThatTheRunWouldHaveMade) {
  const auto expect_same_file = [](const Study& study, const BasinOptions& asked) {
    BasinOptions options = asked;
    options.keep_starts = true;
    options.searches = &searches;
    options.output = scratch_file("direct.nc");
    const BasinResult result = basin(study, options);
    const std::string path = scratch_file("memory.nc");
    write_basin_file(path, result);
    EXPECT_EQ(content(path), content(options.output));
    options.output = path;
    EXPECT_EQ(basin(study, options).resumed_from, result.starts);
    std::filesystem::remove(path);
  };
  for (const char* kind : {"boxed", "held", "motor"}) {
    SCOPED_TRACE(kind);
    expect_same_file(study_of(kind, 60), {});
  }
  const Study plain = study_of("prescribed", 100);
  BasinOptions own;
  own.initial = drawn(plain);
  expect_same_file(plain, own);
  BasinOptions narrow;
  narrow.half_width = 0.1;
  expect_same_file(plain, narrow);
  Study grid = plain;
  grid.sampling.method = SamplingMethod::grid;
  expect_same_file(grid, {});
  expect_same_file(
      parse_study(constant_speed, "uncertain", {"rotor.eccentricity={values=[0.01,0.02]}", "sampling.starts=6"}), {});
}

TEST(WriteBasin, RefusesWhatItCannotWrite) {
  const Study study = study_of("prescribed", 20);
  BasinOptions options;
  EXPECT_THROW(write_basin_file(scratch_file("none.nc"), basin(study, options)), InputError);
  options.keep_starts = true;
  options.keep_at_most = 19;
  EXPECT_THROW(write_basin_file(scratch_file("none.nc"), basin(study, options)), InputError);
  options.keep_at_most = 20;
  const BasinResult all = basin(study, options);
  const std::string path = scratch_file("busy.nc");
  std::ofstream(path + ".part") << "begun";
  EXPECT_THROW(write_basin_file(path, all), InputError);
  std::filesystem::remove(path + ".part");
  EXPECT_THROW(write_basin_file(scratch_file("") + "/no/such/folder.nc", all), InputError);
}

TEST(MapperOfManyThreads, AnswersAsOfOne) {
  const Study study = study_of("boxed", sized(64, 16));
  const std::vector<InitialState> starts = drawn(study);
  const Mapper mapper(study);
  std::vector<Outcome> alone(starts.size()), together(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) alone[i] = mapper(starts[i]);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < 3; ++k)
    threads.emplace_back([&, k] {
      for (std::size_t i = k; i < starts.size(); i += 3) together[i] = mapper(starts[i]);
    });
  for (std::thread& t : threads) t.join();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_EQ(alone[i].time, together[i].time);
    EXPECT_EQ(mapper.name(alone[i]), mapper.name(together[i]));
  }
  EXPECT_EQ(mapper.name(4711), "");
  EXPECT_EQ(mapper.name(Outcome{}), "undecided");
  EXPECT_EQ(mapper.attractors().attractors().front().name, "balanced");
}

TEST(MapperOfManyThreads, EndsEarlyWhenAskedTo) {
  StopFlag stop{true};
  MapperOptions options;
  options.stop = &stop;
  EXPECT_THROW(Mapper(study_of("prescribed", 1), options), RunError);
  const Mapper mapper(study_of("prescribed", 1));
  EXPECT_TRUE(mapper(std::vector<InitialState>(9), options).empty());
}

}  // namespace own_starts_test
}  // namespace equipoise
