// Limits and the starts that keep them.
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../support/refusals.hpp"
#include "../support/studies.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {
namespace limits_kept_test {

Study with_limits(const std::string& limits) { return parse_study(constant_speed + "[limits]\n" + limits, "s"); }

TransientRow row_of_peak(float peak, float end) {
  TransientRow row{};
  row.peak_radial = peak;
  row.peak_radial_at_end = end;
  return row;
}

// Of these starts, in order: peak, displacement in the end, whether it is decided.
struct Seen {
  float peak, end;
  bool decided = true;
};
TransientGroup counted(const Study& study, std::initializer_list<Seen> starts) {
  TransientTally tally(study, sampler_of(study));
  for (const Seen& s : starts) {
    Outcome outcome;
    outcome.kind = s.decided ? OutcomeKind::attracted : OutcomeKind::undecided;
    tally.add(outcome, row_of_peak(s.peak, s.end));
  }
  return tally.result(Catalogue()).groups.front();
}

std::uint64_t count_within(const TransientGroup& group, Within when) {
  return group.within[static_cast<std::size_t>(when)]->count;
}

TEST(LimitsKept, AreToldAtTheEndOnTheWayAndBoth) {
  const Study study = with_limits("displacement = 1.0\nsettled = 0.1\n");
  const TransientGroup g = counted(study, {{0.5f, 0.0f}, {2.0f, 0.0f}, {0.5f, 0.2f}, {2.0f, 1.5f}});
  EXPECT_EQ(count_within(g, Within::at_end), 2u);
  EXPECT_EQ(count_within(g, Within::on_the_way), 2u);
  EXPECT_EQ(count_within(g, Within::both), 1u);
}

TEST(LimitsKept, UndecidedStartsLeaveOpenWhatTheyMayStillDo) {
  const Study study = with_limits("displacement = 1.0\n");
  const TransientGroup g = counted(study, {{0.5f, 0.5f, false}, {0.5f, 0.5f, false}, {2.0f, 0.5f, false}});
  const Share& end = *g.within[static_cast<std::size_t>(Within::at_end)];
  EXPECT_EQ(end.count, 3u);  // as they were last seen
  EXPECT_EQ(end.least, 0.0);
  const Share& way = *g.within[static_cast<std::size_t>(Within::on_the_way)];
  EXPECT_EQ(way.count, 2u);
  EXPECT_EQ(way.least, 0.0);
  EXPECT_EQ(way.most, way.high);  // a peak that exceeded its limit stays exceeded
}

TEST(LimitsKept, AreNotToldWithoutALimit) {
  BasinOptions options;
  options.transients = true;
  const BasinResult r = basin(parse_study(constant_speed + "[sampling]\nstarts = 20\n", "s"), options);
  for (const auto& share : r.transients->groups.front().within) EXPECT_FALSE(share);
  EXPECT_FALSE(holds(basin_text(r), "within all limits"));
  // A limit on the end alone says nothing of the way.
  const TransientGroup g = counted(with_limits("velocity = 1.0\n"), {{0.5f, 0.0f}});
  EXPECT_TRUE(g.within[static_cast<std::size_t>(Within::at_end)]);
  EXPECT_FALSE(g.within[static_cast<std::size_t>(Within::on_the_way)]);
  EXPECT_FALSE(g.within[static_cast<std::size_t>(Within::both)]);
}

TEST(LimitsKept, SharesAreThoseOfTheStartsThatAreKept) {
  const std::string text =
      constant_speed + "[sampling]\nstarts = 500\n[limits]\ndisplacement = 0.05\nvelocity = 0.02\nresidual = 0.01\n";
  BasinOptions options;
  options.keep_starts = true;
  const BasinResult r = basin(parse_study(text, "s"), options);
  const auto& columns = r.every_start->transients;
  const auto figure = [&](float TransientRow::*value, std::size_t i) { return columns[figure_place(value)][i]; };
  std::uint64_t end = 0, way = 0, both = 0, residual = 0;
  for (std::size_t i = 0; i < 500; ++i) {
    const bool left = figure(&TransientRow::residual_unbalance, i) > 0.01;
    const bool in_the_end =
        !left && figure(&TransientRow::rms_velocity, i) <= 0.02 && figure(&TransientRow::peak_radial_at_end, i) <= 0.05;
    const bool on_the_way = figure(&TransientRow::peak_radial, i) <= 0.05;
    residual += left;
    end += in_the_end;
    way += on_the_way;
    both += in_the_end && on_the_way;
  }
  const TransientGroup& all = r.transients->groups.front();
  EXPECT_EQ(count_within(all, Within::at_end), end);
  EXPECT_EQ(count_within(all, Within::on_the_way), way);
  EXPECT_EQ(count_within(all, Within::both), both);
  EXPECT_TRUE(0 < end && end < 500);
  EXPECT_TRUE(holds(basin_text(r), "within all limits at the end"));
  EXPECT_TRUE(holds(basin_text(r), "Limits: displacement 0.05 R, velocity 0.02 R omega_c, residual 0.01 R."));
  const auto json = nlohmann::json::parse(json_text(r))["transients"]["groups"][0];
  EXPECT_EQ(json["within"]["at_end"]["count"], end);
  EXPECT_EQ(json["exceeded"]["residual"]["count"], residual);
}

TEST(Clearance, HitsAreToldOnTheWayAndInTheEnd) {
  const Study study = with_limits("clearance = 1.0\n");
  const TransientGroup g =
      counted(study, {{0.5f, 0.0f}, {2.0f, 0.0f}, {2.0f, 1.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}});
  EXPECT_TRUE(holds(clearance_words(g, study), "The housing, 1 R away, is hit on the way by 33.3 % of starts"));
  EXPECT_TRUE(holds(clearance_words(g, study), "in the end by 16.7 % of starts"));
  EXPECT_TRUE(holds(clearance_words(g, study), "between walls 2 R apart"));
  EXPECT_EQ(clearance_words(g, with_limits("displacement = 1.0\n")), "");
}

// 0.2 mm at 2000 rpm: e omega = 41.9 mm/s.
TEST(ResidualLimit, AGradeIsEOmega) {
  const auto read = [](const std::string& limit) { return parse_study(constant_machine + "[limits]\n" + limit, "m"); };
  const Study grade = read("residual = \"G 6.3\"\n"), spelt = read("grade = \"6.3 mm/s\"\n");
  ASSERT_TRUE(grade.limits.grade);
  EXPECT_EQ(*grade.limits.grade, *spelt.limits.grade);
  EXPECT_FALSE(grade.limits.residual);
  EXPECT_EQ(read("residual = \"G6.3\"\n").limits.grade, grade.limits.grade);
  EXPECT_NEAR(*read("residual = \"2.4 kg mm\"\n").limits.residual, 0.2 / 30.0, 1e-12);
  EXPECT_FALSE(read("residual = \"2.4 kg mm\"\n").limits.grade);
  check(grade);
  EXPECT_EQ(to_toml(parse_study(to_toml(grade), "again")), to_toml(grade));
  for (const auto& [limit, exceeded] : std::vector<std::pair<const char*, bool>>{{"G 41", true}, {"G 43", false}}) {
    const Study study = read("residual = \"" + std::string(limit) + "\"\n");
    TransientTally tally(study, sampler_of(study));
    TransientRow row{};
    row.residual_unbalance = static_cast<float>(0.2 / 30.0);
    Outcome outcome;
    outcome.kind = OutcomeKind::attracted;
    tally.add(outcome, row);
    const TransientGroup g = tally.result(Catalogue()).groups.front();
    EXPECT_EQ(count_within(g, Within::at_end), exceeded ? 0u : 1u) << limit;
  }
}

TEST(ResidualLimit, OfAMotorIsJudgedByTheSpeedThatItCameTo) {
  Study study = with_limits("grade = 0.02\n");
  study.speed.profile = Profile::torque;
  study.speed.torque.constant = 1.0;
  study.speed.torque.slope = -0.1;
  study.parameters.inertia = 1.0;
  TransientTally tally(study, sampler_of(study));
  for (const float speed : {1.0f, 3.0f, std::numeric_limits<float>::quiet_NaN()}) {
    Outcome outcome;
    outcome.kind = OutcomeKind::attracted;
    outcome.mean_speed = speed;
    TransientRow row{};
    row.residual_unbalance = 0.01f;
    tally.add(outcome, row);
  }
  EXPECT_EQ(count_within(tally.result(Catalogue()).groups.front(), Within::at_end), 1u);  // unknown is not kept
}

std::string refusal_of(const std::string& text) {
  try {
    parse_study(text, "s.toml");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(ResidualLimit, RefusesWhatIsNoGrade) {
  const std::string machine = constant_machine + "[limits]\n";
  EXPECT_TRUE(holds(refusal_of(machine + "residual = \"G -1\"\n"), "limits.residual"));
  EXPECT_TRUE(holds(refusal_of(machine + "residual = \"G 6.3 mm\"\n"), "such as \"G 6.3\""));
  EXPECT_TRUE(holds(refusal_of(machine + "residual = \"G 6.3\"\ngrade = \"1 mm/s\"\n"), "not both"));
  EXPECT_TRUE(
      holds(refusal_of(constant_speed + "[limits]\nresidual = \"G 6.3\"\n"), "needs a study in physical units"));
}

}  // namespace limits_kept_test
}  // namespace equipoise
