// Ensembles: bit-identical however they are cut, outcomes that mean what they say, files that can be resumed.
#include <unistd.h>

#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "../support/refusals.hpp"
#include "../support/files.hpp"
#include "../support/sizes.hpp"
#include "../support/studies.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/ensembles/stored_ensemble.hpp"
#include "equipoise/analyses/one_study/comparison.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"

namespace equipoise {
namespace basin_test {

Study paper_row(const std::string& name, std::uint64_t starts) {
  Study study = read_study(std::string(EQUIPOISE_SOURCE_DIR) + "/studies/paper/" + name + ".toml");
  study.sampling.starts = starts;
  return study;
}

std::uint64_t balanced_count(const BasinResult& r) { return r.attractors.front().share.count; }

void expect_same_shares(const BasinResult& a, const BasinResult& b) {
  ASSERT_EQ(a.attractors.size(), b.attractors.size());
  for (std::size_t k = 0; k < a.attractors.size(); ++k) {
    EXPECT_EQ(a.attractors[k].id, b.attractors[k].id);
    EXPECT_EQ(a.attractors[k].name, b.attractors[k].name);
    EXPECT_EQ(a.attractors[k].share.count, b.attractors[k].share.count);
  }
  EXPECT_EQ(a.undecided.count, b.undecided.count);
}

void expect_same(const std::vector<Outcome>& a, const std::vector<Outcome>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].kind, b[i].kind) << "start " << i;
    ASSERT_EQ(a[i].attractor, b[i].attractor) << "start " << i;
    ASSERT_EQ(a[i].by, b[i].by) << "start " << i;
    ASSERT_EQ(a[i].time, b[i].time) << "start " << i;  // every bit: one instruction set has one arithmetic
  }
}

std::vector<Outcome> outcomes_in(const BasinFile& file, std::size_t count) {
  const StartArrays starts = file.read(0, count);
  std::vector<Outcome> outcomes;
  for (std::size_t i = 0; i < count; ++i) outcomes.push_back(*outcome_of(starts, i));
  return outcomes;
}

class SameBits : public testing::TestWithParam<const char*> {};

TEST_P(SameBits, HoweverTheStartsAreCut) {
  const Session runner(paper_row(GetParam(), 600), {.threads = 2});
  Decided whole, part;
  std::vector<Outcome> joined;
  ASSERT_TRUE(runner.decide(0, 600, whole));
  std::uint64_t first = 0;
  for (std::size_t size : {1, 2, 5, 23, 24, 25, 120, 400}) {
    ASSERT_TRUE(runner.decide(first, size, part));
    joined.insert(joined.end(), part.outcomes.begin(), part.outcomes.end());
    first += size;
  }
  expect_same(whole.outcomes, joined);
}

TEST_P(SameBits, ForOneThreadAndTwoAndForAStartAlone) {
  const Study study = paper_row(GetParam(), sized(2000, 600));
  BasinOptions one, two;
  one.threads = 1;
  two.threads = 2;
  one.output = scratch_file("one.nc");
  two.output = scratch_file("two.nc");
  const BasinResult a = basin(study, one), b = basin(study, two);
  expect_same_shares(a, b);
  const BasinFileHeader header = basin_file_header(study, true);
  const std::vector<Outcome> from_one = outcomes_in(BasinFile(one.output, header), study.sampling.starts);
  expect_same(from_one, outcomes_in(BasinFile(two.output, header), study.sampling.starts));
  for (std::uint64_t index : {0u, sized(777u, 77u), sized(1999u, 599u)}) {
    const StartReplay alone = replay_start(study, index);
    EXPECT_EQ(alone.outcome.attractor, from_one[index].attractor);
    EXPECT_EQ(alone.outcome.time, from_one[index].time);
  }
}

// A smooth row, a row with a fractal boundary, a ramp with a release on the way (two pieces with free balls).
INSTANTIATE_TEST_SUITE_P(Rows, SameBits,
                         testing::Values("table-2-omega-2.4", "table-1-beta-0.01-omega-4.0", "table-5-t0-300"));

// A start alone is decided with all that its ensemble was: trapping regions that a neighbour's search found are others,
// and their starts enter them at other times.
TEST(Basin, AReplayedStartKnowsTheRegionsThatItsEnsembleKnew) {
  const auto at_speed = [](double speed) {
    Study study = paper_row("table-2-omega-2.4", 300);
    study.speed.speed = speed;
    return study;
  };
  Catalogue catalogue;
  WarmStartLevels warm_start_levels;
  basin(at_speed(2.6), {}, &catalogue, &warm_start_levels);
  BasinOptions hinted, plain;
  hinted.warm_start_levels = &warm_start_levels;
  AttractorSearchCache searched;  // one search for all that follow
  hinted.searches = &searched;
  hinted.keep_starts = plain.keep_starts = true;
  const Study study = at_speed(2.4);
  const std::vector<double> times = basin(study, hinted).every_start->decision_time;
  EXPECT_NE(times, basin(study, plain).every_start->decision_time) << "hints decide nothing here";
  for (std::uint64_t i = 0; i < times.size(); i += 30) EXPECT_EQ(replay_start(study, i, hinted).outcome.time, times[i]);
}

// Three grounds of decision, one result: row 2.4 has a smooth boundary, on which no start changes sides.
TEST(Basin, EveryGroundOfDecisionGivesTheSameOutcomes) {
  Study study = paper_row("table-2-omega-2.4", 2000);
  study.numerics.horizon = 3000.0;  // all are decided by then, and one of three runs goes on to the end
  const BasinResult validated = basin(study);
  study.numerics.decide = ClassificationMode::proof;
  const BasinResult proof = basin(study);
  study.numerics.decide = ClassificationMode::horizon;
  const BasinResult horizon = basin(study);
  expect_same_shares(validated, proof);
  expect_same_shares(validated, horizon);
  const auto by = [](const BasinResult& r, DecidedBy ground) {
    return r.attractors.front().decided_by[static_cast<std::size_t>(ground)];
  };
  EXPECT_EQ(by(validated, DecidedBy::validated), balanced_count(validated));
  EXPECT_EQ(by(proof, DecidedBy::proof), balanced_count(proof));
  EXPECT_EQ(by(horizon, DecidedBy::horizon), balanced_count(horizon));
  EXPECT_LT(validated.attractors.front().mean_time, proof.attractors.front().mean_time);
}

TEST(Basin, EveryInstructionSetGivesTheSameShares) {
  const Study study = paper_row("table-2-omega-2.4", 2000);
  std::vector<std::uint64_t> balanced;
  for (const std::string& target : cpu_targets()) {
    ASSERT_TRUE(use_cpu_target(target));
    EXPECT_EQ(cpu_target(), target);
    balanced.push_back(balanced_count(basin(study)));
  }
  ASSERT_TRUE(use_cpu_target(""));
  // Rounding differs (fused multiply-add); on this row it moves fewer than one start in 10^5 across a boundary.
  for (std::uint64_t b : balanced) EXPECT_NEAR(double(b), double(balanced.front()), 1.0);
}

TEST(Basin, AnUnstableBalancedStateCatchesNobody) {
  // Growth rate 1.4e-4: a test on r alone would call some of these balanced.
  const BasinResult r = basin(paper_row("table-1-beta-0.01-omega-2.0", 4096));
  EXPECT_EQ(balanced_count(r), 0u);
  EXPECT_FALSE(r.balanced_stable);
  EXPECT_NE(r.note.find("unstable"), std::string::npos);
}

TEST(Basin, BallsTooLightForTheUnbalanceCatchNobody) {
  Study study = paper_row("table-2-omega-2.4", 500);
  study.parameters.eccentricity = 0.11;  // two balls of 0.05 reach 0.1
  const BasinResult r = basin(study);
  EXPECT_EQ(balanced_count(r), 0u);
  EXPECT_NE(r.note.find("no balanced state"), std::string::npos);
}

TEST(Basin, LostTrajectoriesAreCountedAsWhatTheyAre) {
  Study study = paper_row("table-2-omega-2.4", 100);
  study.initial.x = 1e8;
  EXPECT_EQ(basin(study).diverged.count, 100u);
  study.initial.x = 1e200;  // overflows within the first step, whatever its size
  EXPECT_EQ(basin(study).failed.count, 100u);
}

TEST(Basin, SamplesUntilTheIntervalIsAsNarrowAsAsked) {
  const Study study = paper_row("table-2-omega-2.4", 100000);
  BasinOptions one, two;
  one.half_width = two.half_width = 0.01;
  one.threads = 1;
  two.threads = 2;
  const BasinResult a = basin(study, one), b = basin(study, two);
  EXPECT_EQ(a.starts, b.starts);
  EXPECT_FALSE(a.partial);
  for (const OutcomeShare& s : a.attractors) EXPECT_LE(s.share.half_width(), 0.01);
  EXPECT_LT(a.starts, 11000u);  // 0.605 x 0.395 (1.96/0.01)^2 = 9180, rounded up to a checkpoint of 1024
  EXPECT_GE(a.starts, 9180u);
}

TEST(Basin, AnInterruptedRunKeepsAPrefixAndResumesToTheSameResult) {
  const Study study = paper_row("table-2-omega-2.4", 20000);
  BasinOptions options;
  options.output = scratch_file("resumed.nc");
  StopFlag stop{false};
  options.stop = &stop;
  options.progress = [&](const Progress& p) { stop = !p.preparing && p.done > 5000; };
  const BasinResult first = basin(study, options);
  EXPECT_TRUE(first.partial);
  EXPECT_GT(first.starts, 5000u);
  EXPECT_LT(first.starts, 20000u);
  stop = false;
  options.progress = {};
  const BasinResult second = basin(study, options);
  EXPECT_FALSE(second.partial);
  EXPECT_EQ(second.resumed_from, first.starts);
  const BasinResult whole = basin(study);
  expect_same_shares(second, whole);

  Study longer = study;  // more starts of the same study extend the file
  longer.sampling.starts = 21000;
  EXPECT_EQ(basin(longer, options).resumed_from, 20000u);
  Study other = study;
  other.parameters.drag = {0.06, 0.06};
  EXPECT_THROW(basin(other, options), InputError);
}

// What a file states is true of all that it holds, whatever was requested last.
void expect_consistent(const std::string& path, const Study& study, std::uint64_t starts, bool complete) {
  const BasinFile file(path, basin_file_header(study, true));
  EXPECT_EQ(file.stored(), starts);
  EXPECT_EQ(file.unfinished(), 0u);
  EXPECT_EQ(file.complete(), complete);
  std::uint64_t counted = 0;
  for (const OutcomeShare& line : file.summary()) counted += line.share.count;
  EXPECT_EQ(counted, starts);
}

TEST(Basin, FewerStartsThanAFileHoldsAreCountedAndTheFileStaysTrue) {
  Study study = paper_row("table-2-omega-2.4", 2000);
  BasinOptions options;
  options.output = scratch_file("fewer.nc");
  basin(study, options);
  expect_consistent(options.output, study, 2000, true);
  study.sampling.starts = 900;
  expect_same_shares(basin(study, options), basin(study));
  expect_consistent(options.output, study, 2000, true);
  study.sampling.starts = 2500;
  EXPECT_EQ(basin(study, options).resumed_from, 2000u);
  expect_consistent(options.output, study, 2500, true);
}

// As a killed process leaves it: starts in the journal, no results in place.
TEST(Basin, FewerStartsThanAKilledRunLeftAreCountedAndTheFileTakesAll) {
  Study study = paper_row("table-2-omega-2.4", 2000);
  BasinOptions options;
  options.output = scratch_file("killed.nc");
  options.outcome = [&, counted = 0](const Outcome&) mutable {
    if (++counted == 1500) throw RunError("killed");
  };
  EXPECT_THROW(basin(study, options), RunError);
  EXPECT_FALSE(std::filesystem::exists(options.output));
  options.outcome = {};
  const std::uint64_t left = BasinFile(options.output, basin_file_header(study, true)).stored();
  ASSERT_GT(left, 700u);
  study.sampling.starts = 600;
  expect_same_shares(basin(study, options), basin(study));
  expect_consistent(options.output, study, left, true);
  study.sampling.starts = 2000;
  EXPECT_EQ(basin(study, options).resumed_from, left);
  expect_consistent(options.output, study, 2000, true);
}

TEST(Basin, AFileOfResultsThatComeOutOtherwiseHereIsRefusedBeforeAnyAreAdded) {
  Study study = paper_row("table-2-omega-2.4", 300);
  BasinOptions options;
  options.output = scratch_file("otherwise.nc");
  {
    BasinFile file(options.output, basin_file_header(study, true));
    StartArrays starts;
    starts.starts = 300;
    starts.phi.assign(600, 1.0);
    starts.outcome.assign(300, undecided_code);
    starts.decision_time.assign(300, 1.0);
    starts.decided_by.assign(300, 0);
    file.append(starts, {});
    file.finish({"", {{undecided_code, "undecided", "", wilson_share(300, 300)}}, true, {}});
  }
  study.sampling.starts = 400;
  EXPECT_NE(refusal_text([&] { basin(study, options); }).find("start 0"), std::string::npos);
  expect_consistent(options.output, study, 300, true);
}

// Systems that depend on the rotor's angle, and machines, have no proofs.
TEST(Basin, RefusesWhatItCannotDecide) {
  Study study = paper_row("table-2-omega-2.4", 10);
  study.numerics.decide = ClassificationMode::proof;
  const auto refuses = [](const Study& s, const std::string& key) { EXPECT_EQ(refused_key([&] { basin(s); }), key); };
  Study vertical = study, uneven = study, colliding = study;
  vertical.parameters.gravity = 0.1;
  refuses(vertical, "numerics.decide");
  uneven.parameters.stiffness = {1.0, 1.1};
  refuses(uneven, "numerics.decide");
  colliding.parameters.contact_angle = 0.1;
  refuses(colliding, "numerics.decide");
  vertical.numerics.decide = ClassificationMode::validated;
  vertical.speed.speed = 0.0;  // it never completes a turn
  refuses(vertical, "speed.speed");
}

TEST(Basin, ChecksStudiesFilledInByCode) {
  Study study = paper_row("table-2-omega-2.4", 10);
  study.parameters.mass[1] = -0.05;
  EXPECT_EQ(refused_key([&] { basin(study); }), "balancer.mass");
  study.parameters.mass[1] = 0.05;
  study.parameters.balls = 17;
  EXPECT_THROW(basin(study), InputError);
}

// Counted as basin() counts.
TEST(Comparison, KeepsWhatBasinDecides) {
  Study study = parse_study(constant_speed, "rotor");
  study.sampling.starts = 3000;
  const BasinOutcomes o = basin_outcomes(study, {});
  const BasinResult r = basin(study);
  ASSERT_EQ(o.outcome.size(), r.starts);
  for (const OutcomeShare& a : r.attractors)
    EXPECT_EQ(static_cast<std::uint64_t>(std::count(o.outcome.begin(), o.outcome.end(), static_cast<short>(a.id))),
              a.share.count)
        << a.name;
}

}  // namespace basin_test
}  // namespace equipoise
