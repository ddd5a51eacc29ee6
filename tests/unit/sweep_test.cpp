// Sweeps: parameters as written, cells to bytes and back, identifiers across cells, blocks.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "../support/studies.hpp"
#include "../support/refusals.hpp"
#include "../support/files.hpp"
#include "equipoise/analyses/sweeps/sweep.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"
#include "equipoise/results/cell_files/sweep_file.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace sweep_test {

using namespace equipoise;

const std::string& rotor = constant_speed;

TEST(SweepAxis, StepsAreTheNumbersThatPeopleMean) {
  const SweepParameter p = sweep_parameter("speed.final=1.5:6:0.1", "--over");
  EXPECT_EQ(p.key, "speed.final");
  ASSERT_EQ(p.values.size(), 46u);
  EXPECT_EQ(p.values[9], 2.4);  // not 1.5 + 9 * 0.1
  EXPECT_EQ(p.given[9], "2.4");
  EXPECT_EQ(p.values.back(), 6.0);
  EXPECT_EQ(sweep_parameter("a.b=3:1:-1", "--over").values, (std::vector<double>{3.0, 2.0, 1.0}));
  EXPECT_EQ(sweep_parameter("a.b=1e-3:2e-3:1e-3", "--over").values, (std::vector<double>{0.001, 0.002}));
}

TEST(SweepAxis, QuantitiesKeepTheirUnit) {
  const SweepParameter p = sweep_parameter("rotor.unbalance=100 g mm:300 g mm:100 g mm", "--over");
  EXPECT_EQ(p.unit, "g mm");
  EXPECT_EQ(p.given, (std::vector<std::string>{"100 g mm", "200 g mm", "300 g mm"}));
  EXPECT_EQ(sweep_parameter("speed.final= 900 rpm , 1200 rpm", "--over").given,
            (std::vector<std::string>{"900 rpm", "1200 rpm"}));
}

TEST(SweepAxis, RefusesWhatIsNone) {
  for (const char* text : {"", "=1,2", "a.b", "a.b=", "a.b=x", "a.b=1:2", "a.b=1:2:3:4", "a.b=1:2:0", "a.b=2:1:0.5",
                           "a.b=0:1:1e-9", "a.b=1 rpm,2", "a.b=nan", "a.b=1:inf:1"})
    EXPECT_THROW(sweep_parameter(text, "--over"), InputError) << text;
  EXPECT_THROW(sweep_axes({}, false, "--over"), InputError);
  EXPECT_THROW(sweep_axes({"a=1", "b=1", "c=1", "d=1"}, false, "--over"), InputError);
  EXPECT_NO_THROW(sweep_axes({"a=1", "b=1", "c=1", "d=1"}, true, "--over"));
  EXPECT_THROW(sweep_axes({"a=1,1"}, false, "--over"), InputError);
  // Of parameters that vary together only the first identifies cells.
  EXPECT_THROW(sweep_axes({"a=1,1", "b=1,2"}, true, "--over"), InputError);
  const std::vector<SweepAxis> axes = sweep_axes({"a=1,2,3", "b=5,5,6"}, true, "--over");
  ASSERT_EQ(axes.size(), 1u);
  EXPECT_EQ(axes[0].parameters[1].values, (std::vector<double>{5, 5, 6}));
}

TEST(SweepPlan, BlocksHoldEveryCellOnceAndNeighboursInARow) {
  for (const std::vector<std::string>& over :
       {std::vector<std::string>{"speed.final=1.5:6:0.25"},
        {"balancer.drag=0.05,0.1", "speed.final=1.5:6:0.25"},
        {"speed.final=1.5:6:0.25", "balancer.drag=0.05,0.1", "balancer.mass=0.05,0.06,0.07"}}) {
    const SweepPlan plan({rotor, "study", {}}, sweep_axes(over, false, "--over"), {}, "--over");
    std::multiset<std::size_t> seen;
    for (std::size_t block = 0; block < plan.blocks(); ++block) {
      const std::vector<std::size_t> cells = plan.cells_of(block);
      ASSERT_LE(cells.size(), SweepPlan::block_length);
      seen.insert(cells.begin(), cells.end());
      for (std::size_t k = 1; k < cells.size(); ++k) {
        // One step of the speed, nothing else.
        EXPECT_NEAR(plan.study_of(cells[k]).speed.speed - plan.study_of(cells[k - 1]).speed.speed, 0.25, 1e-12);
        EXPECT_EQ(plan.study_of(cells[k]).parameters.drag, plan.study_of(cells[k - 1]).parameters.drag);
      }
    }
    ASSERT_EQ(seen.size(), plan.cells());
    EXPECT_EQ(std::set<std::size_t>(seen.begin(), seen.end()).size(), plan.cells());
  }
}

TEST(SweepPlan, RefusesACellThatIsNoStudy) {
  const std::string text = refusal_text([] {
    SweepPlan({rotor, "study", {}}, sweep_axes({"balancer.drag=0.05,-0.1"}, false, "--over"), {}, "--over")
        .check_cells();
  });
  EXPECT_NE(text.find("balancer.drag = -0.1"), std::string::npos) << text;
}

// A hundred thousand cells, the last of which is refused: seconds of checks, none of which a stop waits for.
TEST(SweepPlan, ChecksNoMoreCellsOnceStopped) {
  const SweepPlan plan({rotor, "study", {}}, sweep_axes({"balancer.drag=0.9:-0.00001:-0.00001"}, false, "--over"), {},
                       "--over");
  SweepOptions options;
  const StopFlag stop{true};
  options.stop = &stop;
  const SweepResult result = sweep(plan, options);
  EXPECT_EQ(result.cells.size(), plan.cells());
  EXPECT_FALSE(result.complete());
}

SweepOutcome outcome(int id, const char* name, double r, double drift) {
  SweepOutcome o;
  o.id = o.own_id = id;
  o.name = name;
  o.kind = "periodic";
  o.r_min = 0.9 * r;
  o.r_mean = r;
  o.r_max = 1.1 * r;
  o.drift = {drift, -drift};
  return o;
}

SweepCells in_a_row(const std::vector<std::vector<SweepOutcome>>& cells) {
  SweepCells result;
  for (const auto& outcomes : cells) {
    result.push_back(std::make_shared<SweepCell>());
    result.back()->outcomes = outcomes;
  }
  return result;
}

std::vector<SweepAxis> axis(std::size_t size) {
  SweepParameter p{"a.b", "", {}, {}};
  for (std::size_t k = 0; k < size; ++k) p.values.push_back(static_cast<double>(k));
  return {{{p}}};
}

// Two motions of one name change places in the numbering between cells, as in catalogues that list the more frequent
// one first.
TEST(AttractorLabels, FollowMotionsThroughTheCells) {
  auto cells = in_a_row({{outcome(1, "balanced", 0.0, 0.0), outcome(8, "both captured", 0.1, 1.0),
                          outcome(9, "both captured (2)", 0.3, 2.0)},
                         {outcome(1, "balanced", 0.0, 0.0), outcome(8, "both captured", 0.28, 2.1),
                          outcome(9, "both captured (2)", 0.11, -1.05)},
                         {outcome(1, "balanced", 0.0, 0.0), outcome(8, "both captured", 0.26, 2.2)},
                         {outcome(1, "balanced", 0.0, 0.0), outcome(8, "both captured", 3.0, 9.0)}});
  label_attractors(axis(4), cells);
  const auto id = [&](std::size_t cell, std::size_t k) { return cells[cell]->outcomes[k].id; };
  EXPECT_EQ(id(0, 0), 1);
  EXPECT_EQ(id(1, 1), id(0, 2));
  EXPECT_EQ(id(1, 2), id(0, 1));  // exchanged balls drift the other way round
  EXPECT_EQ(id(2, 1), id(0, 2));
  EXPECT_NE(id(3, 1), id(0, 1));
  EXPECT_NE(id(3, 1), id(0, 2));
  EXPECT_EQ(cells[1]->outcomes[1].name, cells[0]->outcomes[2].name);
  EXPECT_EQ(cells[3]->outcomes[1].name, "both captured (3)");
  // Labelling cells that are labelled already changes nothing.
  const auto name = cells[2]->outcomes[1].name;
  label_attractors(axis(4), cells);
  EXPECT_EQ(cells[2]->outcomes[1].name, name);
  EXPECT_EQ(id(2, 1), id(0, 2));
}

TEST(SweepCells, ReadBackToTheSameBits) {
  SweepCell cell;
  cell.starts = 123456789012345;
  cell.outcomes = {outcome(1, "balanced", 0.0, 0.0), outcome(12, "something, else (2)", 0.1 + 0.2, -1.0 / 3.0)};
  cell.outcomes[1].share = wilson_share(7, 9);
  cell.outcomes[1].state = {1e-310, -0.0, std::nextafter(1.0, 2.0)};
  cell.outcomes[0].r_min.reset();
  cell.undecided = wilson_share(0, 9);
  cell.stalled = wilson_share(1, 9);
  TransientGroup group;
  group.name = "all";
  group.figures[3].largest = std::numeric_limits<double>::infinity();
  group.figures[3].mean = std::numeric_limits<double>::quiet_NaN();
  group.figures[3].quantiles[1] = {1.0, 0.0, std::numeric_limits<double>::infinity()};
  group.exceeded[1] = wilson_share(2, 9);
  cell.transients = std::make_shared<TransientGroup>(group);
  cell.note = "ünïcode, \"quoted\"";
  cell.warm_start_levels.levels = {{1, 64.0 / 3.0}, {3, 0.0}};
  cell.warm_start_levels.weights = {{-0.1, 1.0 / 3.0, 2.8}};
  const std::vector<std::uint8_t> bytes = io::bytes_of(cell);
  const auto back = io::cell_from(bytes);
  EXPECT_EQ(io::bytes_of(back), bytes);
  EXPECT_EQ(back.starts, cell.starts);
  EXPECT_EQ(back.outcomes[1].state, cell.outcomes[1].state);
  EXPECT_TRUE(std::signbit(back.outcomes[1].state[1]));
  EXPECT_EQ(*back.outcomes[1].r_mean, 0.1 + 0.2);
  EXPECT_FALSE(back.outcomes[0].r_min);
  EXPECT_EQ(back.outcomes[1].share.high, cell.outcomes[1].share.high);
  EXPECT_TRUE(std::isnan(back.transients->figures[3].mean));
  EXPECT_EQ(back.transients->figures[3].quantiles[1].high, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(back.passed);
  EXPECT_EQ(back.note, cell.note);
  EXPECT_EQ(back.warm_start_levels, cell.warm_start_levels);
  for (std::size_t cut : {std::size_t{0}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_THROW(io::cell_from({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(cut)}), RunError) << cut;
}

TEST(CapacityTrials, ReadBackToTheSameBits) {
  CapacityTrial made, unstable;
  made.value = 0.1 + 0.2;
  made.balanced = open_share(7, 8, 9);
  made.undecided = wilson_share(1, 9);
  made.states = {{1e-310, -0.0}, {}};
  unstable.unstable = true;
  const std::vector<std::uint8_t> bytes = io::bytes_of(std::vector{made, unstable});
  const auto back = io::trials_from(bytes);
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(io::bytes_of(back), bytes);
  EXPECT_EQ(back.front().value, made.value);
  EXPECT_EQ(back.front().states, made.states);
  EXPECT_EQ(back.front().most(), made.balanced.most);
  EXPECT_EQ(back.back().most(), 0.0);
  EXPECT_THROW(io::trials_from({bytes.begin(), bytes.end() - 1}), RunError);
}

// A record from a file is input: whatever is wrong in it is found before anything relies on it.
TEST(SweepCells, SayWhereARecordIsWrong) {
  SweepCell cell;
  cell.outcomes = {outcome(1, "balanced", 0.0, 0.0)};
  cell.transients = std::make_shared<TransientGroup>();
  using Json = nlohmann::json;
  const Json sound = Json::from_cbor(io::bytes_of(cell));
  const auto problem = [&](const char* place, const Json& value) {
    Json forged = sound;
    forged[Json::json_pointer(place)] = value;
    try {
      (void)io::cell_from(Json::to_cbor(forged));
    } catch (const RunError& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(problem("/note", "another"), "accepted");
  EXPECT_EQ(problem("/outcomes", Json::array()), "outcomes has no entries");
  EXPECT_EQ(problem("/outcomes", 3), "outcomes is no list");
  EXPECT_EQ(problem("/outcomes/0", 3), "outcomes[0] has no members");
  EXPECT_EQ(problem("/outcomes/0/name", 3), "outcomes[0].name is no text");
  EXPECT_EQ(problem("/outcomes/0/left_unbalance", {0.1}), "outcomes[0].left_unbalance has 1 entries instead of 4");
  EXPECT_EQ(problem("/outcomes/0/share/share", NAN), "outcomes[0].share.share is nan instead of a number from 0 to 1");
  EXPECT_EQ(problem("/undecided/most", 1.5), "undecided.most is 1.5 instead of a number from 0 to 1");
  EXPECT_EQ(problem("/outcomes/0/r_max", INFINITY), "outcomes[0] has a figure that is not finite");
  EXPECT_EQ(problem("/outcomes/0/share/by", 3), "outcomes[0].share.by is out of range: 3");
  EXPECT_EQ(problem("/outcomes/0/share/by", -1), "outcomes[0].share.by is out of range: -1");
  EXPECT_EQ(problem("/outcomes/0/id", 1LL << 40), "outcomes[0].id is out of range: 1099511627776");
  EXPECT_EQ(problem("/outcomes/0/id", 1e300), "outcomes[0].id is no integer");
  EXPECT_EQ(problem("/starts", -1), "starts is out of range: -1");
  EXPECT_EQ(problem("/balanced_stable", 1), "balanced_stable is neither true nor false");
  EXPECT_EQ(problem("/undecided/low", "0"), "undecided.low is no number");
  EXPECT_EQ(problem("/transients/figures", Json::array()),
            fmt::format("transients.figures has 0 entries instead of {}", transient_figures.size()));
  Json lines = sound;
  lines["note"] = "one\ntwo";
  EXPECT_EQ(io::cell_from(Json::to_cbor(lines)).note, "one\\u000Atwo");
  Json without = sound;
  without.erase("failed");
  EXPECT_THROW((void)io::cell_from(Json::to_cbor(without)), RunError);
  // A reader that calls itself for each of these would run out of stack.
  EXPECT_THROW((void)io::cell_from(std::vector<std::uint8_t>(100000, 0x81)), RunError);
  EXPECT_THROW((void)io::cell_from(std::vector<std::uint8_t>(100000, 0x9F)), RunError);
  EXPECT_THROW((void)io::cell_from(std::vector<std::uint8_t>(100000, 0xA1)), RunError);
  EXPECT_THROW((void)io::cell_from({0x9B, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}), RunError);
}

// Every byte of a record replaced by every other of some kinds: read or refused, never worse.
TEST(SweepCells, SurviveAnyByte) {
  SweepCell cell;
  cell.outcomes = {outcome(1, "balanced", 0.0, 0.0)};
  const std::vector<std::uint8_t> sound = io::bytes_of(cell);
  int refused = 0;
  for (std::size_t at = 0; at < sound.size(); ++at)
    for (const std::uint8_t byte : {0x00, 0x1B, 0x3B, 0x5F, 0x7B, 0x80, 0x9F, 0xBF, 0xC0, 0xF6, 0xFB, 0xFF}) {
      std::vector<std::uint8_t> bytes = sound;
      bytes[at] = byte;
      try {
        (void)io::cell_from(bytes);
      } catch (const RunError&) {
        ++refused;
      }
    }
  EXPECT_GT(refused, static_cast<int>(sound.size()));
}

TEST(IdentityLines, TakeApartWhatAPlanPutTogether) {
  const SweepPlan plan({rotor, "study", {}}, sweep_axes({"speed.final=2.4,2.6", "balancer.drag=0.1"}, false, "--over"),
                       {}, "--over");
  const io::IdentityLines lines(plan.identity());
  EXPECT_EQ(lines.over(), (std::vector<std::string>{"speed.final=2.4, 2.6", "balancer.drag=0.1"}));
  EXPECT_EQ(lines.value("sweep.axes"), "2");
  EXPECT_EQ(lines.cells(), std::size_t{2});
  EXPECT_EQ(lines.value("transients"), "none");
  EXPECT_EQ(lines.value("rotor.damping"), "[0.5, 0.5]");
  EXPECT_EQ(lines.value("nothing"), "");
  EXPECT_EQ(to_toml(parse_study(lines.study, "again")), to_toml(plan.study()));
}

// Byte for byte: the content of a file of results does not depend on when it was written.
TEST(SweepFile, IsTheSameFromMemory) {
  const auto axes = sweep_axes({"balancer.drag=0.05,0.1"}, false, "test");
  const SweepPlan plan({rotor, "rotor.toml", {"sampling.starts=20"}}, axes, {}, "test");
  SweepOptions options;
  options.output = scratch_file("direct.nc");
  const SweepResult direct = sweep(plan, options);
  const std::string path = scratch_file("memory.nc"), bytes = content(options.output);
  std::filesystem::remove(options.output);
  write_sweep_file(path, direct);
  EXPECT_EQ(content(path), bytes);
  EXPECT_NE(bytes, "");
  options.output = path;
  EXPECT_EQ(sweep(plan, options).resumed_cells, 2u);
  write_sweep_file(path, stored_sweep(path));
  EXPECT_EQ(content(path), bytes);
  std::filesystem::remove(path);
}

}  // namespace sweep_test
