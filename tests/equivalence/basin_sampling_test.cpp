// Ensembles of scrambled Sobol starts and on grids: bit-identical results, files, the choice for a half-width, known
// shares.
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/files.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/ensembles/stored_ensemble.hpp"
#include "equipoise/analyses/ensembles/tally.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {
namespace basin_sampling_test {

Study row(std::optional<SamplingMethod> method, std::uint64_t starts) {
  Study study = read_study(std::string(EQUIPOISE_SOURCE_DIR) + "/studies/paper/table-2-omega-2.4.toml");
  study.sampling.method = method;
  study.sampling.starts = starts;
  return study;
}

void expect_same(const Share& a, const Share& b) {
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.share, b.share);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  EXPECT_EQ(a.by, b.by);
}

void expect_same(const BasinResult& a, const BasinResult& b) {
  EXPECT_EQ(a.starts, b.starts);
  ASSERT_EQ(a.attractors.size(), b.attractors.size());
  for (std::size_t k = 0; k < a.attractors.size(); ++k) {
    EXPECT_EQ(a.attractors[k].id, b.attractors[k].id);
    EXPECT_EQ(a.attractors[k].mean_time, b.attractors[k].mean_time);
    expect_same(a.attractors[k].share, b.attractors[k].share);
  }
}

class EvenSampling : public testing::TestWithParam<SamplingMethod> {};

TEST_P(EvenSampling, ThreadsFilesAndSingleStartsGiveTheSameBits) {
  const Study study = row(GetParam(), 5000);
  BasinOptions one, two;
  one.threads = 1;
  two.threads = 2;
  one.output = scratch_file("even_one.nc");
  std::vector<Outcome> outcomes;
  two.outcome = [&](const Outcome& outcome) { outcomes.push_back(outcome); };
  const BasinResult a = basin(study, one), b = basin(study, two);
  expect_same(a, b);
  const BasinFile file(one.output, basin_file_header(study, true));
  ASSERT_EQ(file.stored(), outcomes.size());
  const StartArrays stored = file.read(0, outcomes.size());
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    ASSERT_EQ(outcome_of(stored, i)->attractor, outcomes[i].attractor);
    ASSERT_EQ(stored.decision_time[i], outcomes[i].time);
  }
  expect_same(file.summary().front().share, a.attractors.front().share);
  for (const std::uint64_t index : {0u, 777u, 4711u}) {
    const StartReplay alone = replay_start(study, index);
    EXPECT_EQ(alone.outcome.attractor, outcomes[index].attractor);
    EXPECT_EQ(alone.outcome.time, outcomes[index].time);
  }
}

TEST_P(EvenSampling, InterruptedRunsResumeToTheSameResult) {
  const Study study = row(GetParam(), 12000);
  BasinOptions options;
  options.output = scratch_file("even_resumed.nc");
  StopFlag stop{false};
  options.stop = &stop;
  options.progress = [&](const Progress& p) { stop = !p.preparing && p.done > 3000; };
  const BasinResult first = basin(study, options);
  EXPECT_TRUE(first.partial);
  stop = false;
  options.progress = {};
  const BasinResult second = basin(study, options);
  EXPECT_EQ(second.resumed_from, first.starts);
  EXPECT_FALSE(second.partial);
  expect_same(second, basin(study));

  Study other = study;  // another method is another study
  other.sampling.method = SamplingMethod::random;
  EXPECT_THROW(basin(other, options), InputError);
  Study longer = study;
  longer.sampling.starts = 13000;
  if (GetParam() == SamplingMethod::sobol)
    EXPECT_EQ(basin(longer, options).resumed_from, 12000u);
  else
    EXPECT_THROW(basin(longer, options), InputError);  // a larger grid has other cells
}

// Reference: 60.495 +- 0.005 % balanced, 3.908 +- 0.003 % V1 (docs/explanation/sampling.md). Five claimed standard
// errors, which are themselves known to 18 %.
TEST_P(EvenSampling, FindsTheKnownShares) {
  const BasinResult r = basin(row(GetParam(), 16384));
  const Share &balanced = r.attractors[0].share, &v1 = r.attractors[1].share;
  EXPECT_NE(balanced.by, IntervalBy::wilson);
  EXPECT_NEAR(balanced.share, 0.60495, 5 * balanced.standard_error);
  EXPECT_NEAR(v1.share, 0.03908, 5 * v1.standard_error);
  EXPECT_GT(balanced.effective_starts, 1.5 * static_cast<double>(r.starts));
}

INSTANTIATE_TEST_SUITE_P(Methods, EvenSampling, testing::Values(SamplingMethod::sobol, SamplingMethod::grid));

TEST(Grid, UsesExchangeOnlyOfBallsThatAreAlike) {
  Study study = row(SamplingMethod::grid, 1000);
  EXPECT_TRUE(balls_exchange(study));
  EXPECT_EQ(basin(study).grid->side(), 31u);  // 31 * 32 / 2 = 496 pairs of 1000 starts
  study.parameters.mass[1] = 0.051;
  EXPECT_FALSE(balls_exchange(study));
  const BasinResult r = basin(study);
  EXPECT_EQ(r.grid->side(), 22u);
  EXPECT_EQ(r.starts, 968u);
  study = row(SamplingMethod::grid, 1000);
  study.parameters.drag[0] = 0.06;
  EXPECT_FALSE(balls_exchange(study));
  study = row(SamplingMethod::grid, 1000);
  study.initial.phi_dot = {0.0, 0.1};
  EXPECT_FALSE(balls_exchange(study));
  study.sampling.box.phi_dot = {-1.0, 1.0};  // the same distribution for both
  EXPECT_TRUE(balls_exchange(study));
}

TEST(Grid, RefusesAHalfWidthAndStartsBeyondItsCells) {
  BasinOptions options;
  options.half_width = 0.001;
  EXPECT_THROW(basin(row(SamplingMethod::grid, 1000), options), InputError);
  EXPECT_NO_THROW(replay_start(row(SamplingMethod::grid, 1000), 991));
  EXPECT_THROW(replay_start(row(SamplingMethod::grid, 1000), 992), InputError);
}

TEST(HalfWidth, ChoosesSobolStartsWhereTheyAreCheaper) {
  BasinOptions one, two;
  one.half_width = two.half_width = 0.004;
  one.threads = 1;
  two.threads = 2;
  two.output = scratch_file("chosen.nc");
  const Study study = row(std::nullopt, 100000);
  const BasinResult a = basin(study, one), b = basin(study, two);
  expect_same(a, b);
  ASSERT_TRUE(a.choice.has_value());
  EXPECT_EQ(a.choice->method, SamplingMethod::sobol);
  EXPECT_EQ(a.choice->pilot, pilot_starts);
  EXPECT_EQ(a.study.sampling.method, SamplingMethod::sobol);
  EXPECT_GE(a.starts, pilot_starts);
  // 0.605 x 0.395 (1.96 / 0.004)^2 = 57 370 random starts; the share itself is known to 0.4 points.
  EXPECT_NEAR(a.choice->random_starts, 57370, 500);
  EXPECT_LT(static_cast<double>(a.starts), 0.8 * a.choice->random_starts);
  for (const OutcomeShare& s : a.attractors) EXPECT_LE(s.share.half_width(), 0.004);
  // The file has Sobol starts, as if requested: the same command reads it, and more of them extend it.
  EXPECT_EQ(basin(study, two).resumed_from, b.starts);
  BasinOptions longer;
  longer.output = two.output;
  EXPECT_EQ(basin(row(SamplingMethod::sobol, 50000), longer).resumed_from, std::min<std::uint64_t>(b.starts, 50000));
}

TEST(HalfWidth, AnInterruptedPilotTellsWhatItCountedAndBeginsNoFile) {
  BasinOptions options;
  options.half_width = 0.004;
  options.output = scratch_file("pilot.nc");
  StopFlag stop{false};
  options.stop = &stop;
  options.progress = [&](const Progress& p) { stop = !p.preparing && p.done > 2000; };
  const BasinResult r = basin(row(std::nullopt, 1), options);
  EXPECT_TRUE(r.partial);
  EXPECT_FALSE(r.choice.has_value());
  EXPECT_GT(r.starts, 2000u);
  EXPECT_LT(r.starts, pilot_starts);
  EXPECT_EQ(r.study.sampling.method, SamplingMethod::sobol);
  EXPECT_FALSE(std::filesystem::exists(options.output));
}

// The same command resumes an interrupted run that continues past its pilot.
TEST(HalfWidth, ResumesWhatItChose) {
  BasinOptions options;
  options.half_width = 0.002;
  options.output = scratch_file("chosen_resumed.nc");
  StopFlag stop{false};
  options.stop = &stop;
  options.progress = [&](const Progress& p) { stop = !p.preparing && p.done > pilot_starts + 1000; };
  const BasinResult first = basin(row(std::nullopt, 1), options);
  EXPECT_TRUE(first.partial);
  EXPECT_GT(first.starts, pilot_starts);
  stop = false;
  options.progress = {};
  const BasinResult second = basin(row(std::nullopt, 1), options);
  EXPECT_EQ(second.resumed_from, first.starts);
  BasinOptions whole;
  whole.half_width = 0.002;
  expect_same(second, basin(row(SamplingMethod::sobol, 1), whole));  // and the pilot leaves no trace
}

TEST(HalfWidth, ObeysTheMethodOfTheStudy) {
  BasinOptions options;
  options.half_width = 0.007;  // random: 18 770 starts
  const BasinResult random = basin(row(SamplingMethod::random, 1), options);
  EXPECT_FALSE(random.choice.has_value());
  EXPECT_GT(random.starts, 18000u);
  const BasinResult sobol = basin(row(SamplingMethod::sobol, 1), options);
  EXPECT_FALSE(sobol.choice.has_value());
  EXPECT_LT(sobol.starts, 18000u);
  EXPECT_EQ(sobol.starts % 16, 0u);
}

TEST(HalfWidth, RunsNoPilotWhereRandomStartsNeedFewer) {
  BasinOptions options;
  options.half_width = 0.02;
  const BasinResult r = basin(row(std::nullopt, 1), options);
  ASSERT_TRUE(r.choice.has_value());
  EXPECT_EQ(r.choice->pilot, 0u);
  EXPECT_EQ(r.choice->method, SamplingMethod::random);
  EXPECT_EQ(r.starts, 4096u);
}

}  // namespace basin_sampling_test
}  // namespace equipoise
