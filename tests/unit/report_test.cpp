// Reports of results made by hand: bounds next to intervals, units, optional parts, folded parts.
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../support/snapshots.hpp"
#include "../support/studies.hpp"
#include "equipoise/analyses/ensembles/tally.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/report/text/csv.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/results/commands/attractors_result.hpp"
#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/commands/sweep_result.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {
namespace report_test {

const std::string machine = constant_machine + "[limits]\nvelocity = \"4.5 mm/s\"\n";

TEST(TransientFigures, StandInTheGuide) {
  std::string table = "| figure | JSON, NetCDF | |\n|---|---|---|\n";
  for (const TransientFigure& f : transient_figures)
    table += fmt::format("| {} | `{}` | {} |\n", f.title, f.name, f.long_name());
  expect_in_docs("reference/transients.md", {{"figures of transients", table}});
}

Outcome outcome(OutcomeKind kind, int attractor = 0) {
  return {kind, kind == OutcomeKind::attracted ? DecidedBy::validated : DecidedBy::nothing,
          static_cast<short>(attractor), 100.0};
}

// Of every ten `starts`: six balanced, one elsewhere, three undecided.
Tally tally_of(SamplingMethod method, std::uint64_t starts, bool all_balanced = false) {
  const Sampler sampler(method, 2, starts, true);
  Tally tally(sampler, 1, 0.0);
  const std::uint64_t count = sampler.grid() ? sampler.grid()->starts() : starts;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t k = i * 7 % 10;
    tally.add(k == 6                  ? outcome(OutcomeKind::attracted, 2)
              : k < 6 || all_balanced ? outcome(OutcomeKind::attracted, balanced_id)
                                      : outcome(OutcomeKind::undecided));
  }
  return tally;
}

// Six motions, three of one alias, the rarest common only in one cell. Every column has its own name, the most common
// over all cells come first, and the content of the last column is listed.
TEST(SweepText, TellsMotionsApartAndSaysWhatOthersAre) {
  SweepResult r;
  r.study = parse_study(machine, "s.toml");
  r.axes = {{{{"balancer.drag", "", {1.0, 2.0}, {"1", "2"}}}}};
  struct Came {
    int id;
    const char *name, *alias;
    std::array<std::uint64_t, 2> count;
  };
  const std::vector<Came> came{{1, "balanced", "", {500, 500}},           {3, "drifting apart", "V2", {300, 300}},
                               {8, "drifting apart (2)", "V2", {100, 0}}, {9, "drifting apart (3)", "V2", {60, 60}},
                               {2, "co-drifting", "V1", {40, 90}},        {4, "one captured", "V3", {0, 50}}};
  for (std::size_t k = 0; k < 2; ++k) {
    auto cell = std::make_shared<SweepCell>();
    cell->starts = 1000;
    for (const Came& c : came) {
      SweepOutcome o;
      o.id = c.id;
      o.name = c.name;
      o.alias = c.alias;
      o.share = wilson_share(c.count[k], 1000);
      cell->outcomes.push_back(o);
    }
    cell->undecided = cell->diverged = cell->failed = wilson_share(0, 1000);
    r.cells.push_back(cell);
  }
  const std::string text = result_text(r);
  std::size_t from = 0;
  for (const char* title : {"starts      balanced", " V2 ", " V1 ", " V2 (3) ", " V2 (2) ", "others", "undecided"}) {
    from = text.find(title, from);
    ASSERT_NE(from, std::string::npos) << title << "\n" << text;
  }
  EXPECT_NE(text.find("Others: 1 motion: V3, 5.00 % at most, in 1 cell.\n"), std::string::npos) << text;
  r.cells.pop_back();
  r.cells.push_back(nullptr);
  EXPECT_EQ(result_text(r).find("thers"), std::string::npos);
}

// Two motions of one name, which no catalogue makes, still get different columns.
TEST(SweepText, NeverHasTwoColumnsOfOneTitle) {
  SweepResult r;
  r.study = parse_study(machine, "s.toml");
  r.axes = {{{{"balancer.drag", "", {1.0}, {"1"}}}}};
  auto cell = std::make_shared<SweepCell>();
  cell->starts = 10;
  for (const int id : {1, 8, 9}) {
    SweepOutcome o;
    o.id = id;
    o.name = id == 1 ? "balanced" : "stuck";
    o.share = wilson_share(3, 10);
    cell->outcomes.push_back(o);
  }
  cell->undecided = cell->diverged = cell->failed = wilson_share(0, 10);
  r.cells = {cell};
  EXPECT_NE(result_text(r).find("stuck #8  stuck #9"), std::string::npos) << result_text(r);
}

// RFC 4180: quotes around text that contains a comma or a quote, inner quotes doubled.
TEST(Csv, QuotesAndDoublesQuotes) {
  EXPECT_EQ(csv_text("two balls stuck"), "two balls stuck");
  EXPECT_EQ(csv_text("a, b"), "\"a, b\"");
  EXPECT_EQ(csv_text("called \"V2\""), "\"called \"\"V2\"\"\"");
  EXPECT_EQ(csv_text("one\ntwo"), "\"one\ntwo\"");
}

TEST(OpenShares, HaveBoundsThatHoldWhateverTheUndecidedAre) {
  for (const auto method : {SamplingMethod::random, SamplingMethod::sobol, SamplingMethod::grid}) {
    const Tally open = tally_of(method, 4096), closed = tally_of(method, 4096, true);
    const Share s = open.share(OutcomeKind::attracted, balanced_id),
                all = closed.share(OutcomeKind::attracted, balanced_id);
    const char* name = sampling_method_names[static_cast<std::size_t>(method)];
    EXPECT_EQ(s.least, s.low) << name;
    EXPECT_LT(s.high, 0.65) << name;
    // Its value if all undecided starts had balanced: the same starts counted so.
    EXPECT_DOUBLE_EQ(s.most, all.high) << name;
    EXPECT_GT(s.most, 0.9) << name;
    EXPECT_EQ(all.most, all.high) << name;
    // An outcome that no start had may still be that of all undecided ones.
    const Share none = open.share(OutcomeKind::diverged);
    EXPECT_EQ(none.count, 0u);
    EXPECT_LT(none.high, 0.01) << name;
    EXPECT_GT(none.most, 0.3) << name;
  }
}

TEST(OpenShares, AreBoundedByCountsOfWhatIsSureAndWhatIsPossible) {
  const Share s = open_share(30, 80, 100);
  EXPECT_EQ(s.count, 30u);
  EXPECT_EQ(s.least, wilson_share(30, 100).low);
  EXPECT_EQ(s.most, wilson_share(80, 100).high);
  EXPECT_EQ(s.high, wilson_share(30, 100).high);
}

BasinResult result_of(const std::string& text, std::uint64_t balanced, std::uint64_t undecided) {
  BasinResult r;
  r.study = parse_study(text, "m.toml");
  r.starts = balanced + undecided;
  r.seconds = 1.0;
  OutcomeShare share;
  share.id = balanced_id;
  share.name = "balanced";
  share.kind = "equilibrium";
  share.share = open_share(balanced, r.starts, r.starts);
  share.mean_time = 50.0;
  r.attractors.push_back(share);
  r.undecided = wilson_share(undecided, r.starts);
  r.diverged = r.failed = open_share(0, undecided, r.starts);
  return r;
}

TEST(BasinText, ShowsBoundsWhereStartsAreUndecided) {
  const std::string open = basin_text(result_of(constant_speed, 734, 266)),
                    closed = basin_text(result_of(constant_speed, 1000, 0));
  EXPECT_TRUE(holds(open, "bounds"));
  EXPECT_TRUE(holds(open, "No start diverged or failed while followed (each below 0.38 %).")) << open;
  EXPECT_TRUE(holds(open, "above 70.6 %")) << open;  // balanced
  EXPECT_FALSE(holds(closed, "bounds"));
  const auto json = nlohmann::json::parse(json_text(result_of(constant_speed, 734, 266)));
  EXPECT_NEAR(json["diverged"]["most"], 0.2942, 1e-4);
  EXPECT_EQ(json["diverged"]["least"], 0.0);
  EXPECT_EQ(json["outcomes"][0]["most"], 1.0);
}

// Names of motions hold commas. A narrow table loses columns, and what they would mean is not told then.
TEST(BasinText, NamesWhatNoStartCameToAndTellsOnlyOfColumnsThatAreShown) {
  BasinResult r = result_of(constant_speed, 1000, 0);
  const auto none = [&](int id, const char* name) {
    r.attractors.push_back({id, name, "", open_share(0, 0, 1000), "measured", 0.0});
  };
  none(5, "a, b");
  none(6, "c");
  const std::string wide = basin_text(r), narrow = basin_text(r, TextStyle{40, false, false});
  EXPECT_TRUE(holds(wide, "No start came to: a, b; c; and none was undecided, diverged or failed (each below"));
  EXPECT_TRUE(holds(wide, "  known after  ") && holds(wide, "Known after: mean time")) << wide;
  EXPECT_TRUE(!holds(narrow, "known after") && !holds(narrow, "Known after")) << narrow;
  EXPECT_TRUE(holds(basin_text(result_of(constant_speed, 1000, 0)), "No start was undecided, diverged or failed"));
}

TEST(NoteText, IsInTheUnitsOfTheStudy) {
  const Study study = parse_study(constant_machine, "m.toml");
  const auto unstable = [](double speed) {
    Note note;
    return note.add("the balanced state exists but is unstable ").add_speed(speed).add(" ").add_rates(0.01, 0.01);
  };
  const Note note = unstable(study.speed.speed);
  Note drawn, plain;
  drawn.add("all 64 drawn evenly from it are unstable ").add_speed(study.speed.speed).add(" ").add_rates(0.01, 0.02);
  plain = "proofs need gravity 0";
  EXPECT_TRUE(note.ends_with(fmt::format("unstable at speed {} (growth rate 0.01)", study.speed.speed)));
  EXPECT_TRUE(drawn.ends_with("(growth rates 0.01 to 0.02)"));
  EXPECT_EQ(note_text(study, note),
            "the balanced state exists but is unstable at 2000 rpm (growth rate 0.632 1/s)");  // of machine_omega_c
  EXPECT_TRUE(holds(note_text(study, drawn), "unstable at 2000 rpm (growth rates 0.632 to 1.26 1/s)"));
  drawn.add_before("for some of the rotors drawn, ");
  EXPECT_EQ(note_text(study, drawn),
            "for some of the rotors drawn, all 64 drawn evenly from it are unstable at 2000 rpm (growth rates 0.632 to "
            "1.26 1/s)");
  EXPECT_EQ(note_text(parse_study(constant_speed, "s.toml"), unstable(2.0 / 3.0)),
            "the balanced state exists but is unstable at speed 0.6667 (growth rate 0.01)");
  EXPECT_EQ(note_text(study, plain), "proofs need gravity 0");
}

TEST(BasinText, SaysWhichStartsCameThroughAndOfWhichThatIsOpen) {
  BasinResult r;
  r.study = parse_study(machine_rotor + R"([speed]
profile = "torque"
torque = { stall = "2 N m", no_load_speed = "3000 rpm" }
)",
                        "m.toml", {"rotor.inertia=0.02 kg m2"});
  r.starts = 100;
  r.attractors.push_back({1, "balanced", "", wilson_share(50, 100), "equilibrium", 1.0});
  r.stalled = wilson_share(20, 100);
  r.undecided = wilson_share(30, 100);
  r.diverged = r.failed = wilson_share(0, 100);
  r.passed = open_share(60, 80, 100);
  r.not_passed = open_share(20, 40, 100);
  const std::string text = basin_text(r);
  for (const char* part :
       {"Came through the resonance: 60.0 % of all starts (50.2 to 69.1 %), turning faster than ",
        " rpm in their motion or when last seen; held below: 20.0 % (13.3 to 28.9 %); not known yet: 20 %, "
        "undecided and slower when last seen; through, whatever the others do: 50.2 to 86.7 %.\n"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
  r.study.speed.initial = 100.0;
  EXPECT_NE(basin_text(r).find("Above the resonance in the end: 60.0 %"), std::string::npos);
  r.passed = open_share(100, 100, 100);
  r.not_passed = open_share(0, 0, 100);
  const std::string all = basin_text(r);
  for (const char* part : {"held below", "not known yet", "through, whatever the others do"})
    EXPECT_EQ(all.find(part), std::string::npos) << all;
}

// A table of dashes says nothing, and "0 %" of no starts is no share.
TEST(BasinText, OfNoStartHasNoShares) {
  BasinResult r;
  r.study = parse_study(machine, "m.toml");
  r.partial = true;
  r.attractors.push_back({1, "balanced", "", Share{}, "equilibrium"});
  r.passed = r.not_passed = open_share(0, 0, 0);
  const std::string text = basin_text(r);
  EXPECT_NE(text.find("PARTIAL: stopped before the first start was decided; there are no shares.\n"),
            std::string::npos);
  for (const char* word : {"probability", "balanced", " % "}) EXPECT_EQ(text.find(word), std::string::npos) << text;
}

TEST(BasinText, HasTimesInSecondsWhereThereAreUnits) {
  const BasinResult r = result_of(machine, 100, 0);
  const std::string text = basin_text(r);
  EXPECT_TRUE(holds(text, "known after, s"));
  EXPECT_TRUE(holds(text, "  0.7906  ")) << text;  // 50/omega_c
  EXPECT_FALSE(holds(text, "times below are in units of"));
  const auto json = nlohmann::json::parse(json_text(r));
  EXPECT_EQ(json["outcomes"][0]["mean_time"], 50.0);
  EXPECT_DOUBLE_EQ(json["outcomes"][0]["mean_time_si"], 50.0 / machine_omega_c);
  EXPECT_EQ(json["units"]["mean_time"], "1/omega_c");
  EXPECT_EQ(json["units"]["mean_time_si"], "s");
  EXPECT_TRUE(holds(basin_text(result_of(constant_speed, 100, 0)), "in 1/omega_c"));
}

TEST(AttractorsText, SpeaksOfDecidedStartsOnly) {
  AttractorsResult r;
  r.basin = result_of(constant_speed, 34, 966);
  const std::string text = result_text(r);
  // 1 - 1e-9^(1/34)
  EXPECT_TRUE(holds(text, "1000 starts searched, 34 decided: an attractor with a share above 0.46 of such starts"))
      << text;
  EXPECT_TRUE(holds(text, "96.6 % of all starts stayed undecided")) << text;
  const auto json = nlohmann::json::parse(json_text(r));
  EXPECT_NEAR(json["detection"]["share"], 0.4564, 1e-4);
  EXPECT_EQ(json["decided"], 34);
  EXPECT_GT(json["detection"]["missing_at_most"], 0.966);
  r.basin = result_of(constant_speed, 0, 1000);
  EXPECT_FALSE(holds(result_text(r), "missed with probability"));
  EXPECT_TRUE(nlohmann::json::parse(json_text(r))["detection"]["share"].is_null());
  r.basin = result_of(constant_speed, 1000, 0);
  EXPECT_FALSE(holds(result_text(r), "stayed undecided"));
}

// Transients of starts that end in balance, elsewhere and nowhere.
struct Counted {
  Study study;
  TransientTally tally;
  Catalogue catalogue;

  explicit Counted(const std::string& text)
      : study(parse_study(text, "m.toml")), tally(study, Sampler(SamplingMethod::random, 2, 1000, true)) {}
  void add(int count, const Outcome& f, double velocity) {
    TransientRow row;
    row.peak_radial = 0.1f;
    row.rms_velocity = static_cast<float>(velocity);
    row.followed_until = 1.0f;
    for (int i = 0; i < count; ++i) tally.add(f, row);
  }
};

std::string heading_of(const std::string& text, const std::vector<std::string>& overrides) {
  return study_heading(parse_study(text, "rotor", overrides));
}

// Said where it is true, and nowhere else.
TEST(StudyHeading, SaysHowLongBallsAreHeld) {
  const std::string ramp = "speed={profile='ramp', final=2.4, duration=40.0}";
  const auto dimensionless = [&](std::vector<std::string> overrides) { return heading_of(constant_speed, overrides); };
  EXPECT_TRUE(holds(dimensionless({ramp}), "\nballs held until t = 40, the end of the ramp\n"));
  EXPECT_TRUE(holds(dimensionless({ramp, "release.speed=2.2"}), "\nballs held until t = 36.667, at speed 2.2\n"));
  EXPECT_TRUE(holds(dimensionless({ramp, "release.time=7"}), "\nballs held until t = 7\n"));
  EXPECT_TRUE(holds(dimensionless({"speed={profile='points', times=[0.0, 5.0], speeds=[0.0, 2.0]}"}),
                    "\nballs held until t = 5, the last point of the speed\n"));
  EXPECT_TRUE(holds(dimensionless({"rotor.inertia=1", "release.speed=1.5",
                                   "speed={profile='torque', torque={stall=0.2, no_load_speed=3.0}}"}),
                    "\nballs held until the rotor comes to 1.5\n"));
  for (const auto& free : std::vector<std::vector<std::string>>{{}, {ramp, "release.time=0"}, {"release.speed=2.4"}})
    EXPECT_FALSE(holds(dimensionless(free), "held")) << dimensionless(free);
  const std::string seconds = "speed={profile='ramp', final='2000 rpm', duration='3 s'}";
  EXPECT_FALSE(holds(heading_of(machine, {seconds}), "held"));
  EXPECT_TRUE(holds(heading_of(machine, {seconds, "release.speed=1000 rpm"}),
                    "\nballs held until t = 1.5 s, at speed 1000 rpm\n"))
      << heading_of(machine, {seconds, "release.speed=1000 rpm"});
}

TEST(StudyHeading, TellsOfARunUpByAHillFunction) {
  const std::string hill = "speed={profile='hill', final=3.0, half_time=20.0, exponent=3.0, until=60.0}";
  const std::string heading = heading_of(constant_speed, {hill});
  EXPECT_TRUE(holds(heading, "run-up to 3 by a Hill function, half of it at 20, exponent 3; kinematic")) << heading;
  // The tangent at 60: 27/28 of the limit, and 9/28 of that in 60 more.
  EXPECT_TRUE(holds(heading, "\nballs held until t = 80.741, the end of the run-up\n")) << heading;
  EXPECT_FALSE(holds(heading_of(constant_speed, {}), "Hill"));
}

TEST(StartText, NamesWhatIsDrawnInsteadOfWhatTheStudyStates) {
  const auto drawn = [](const std::vector<std::string>& overrides) {
    return uncertain_text(parse_study(constant_speed, "rotor", overrides));
  };
  EXPECT_EQ(drawn({}), "");
  EXPECT_EQ(drawn({"initial.x=0.1"}), "");
  EXPECT_TRUE(holds(drawn({"initial.phi=[0, 0]"}), "initial.phi; simulate starts from there\n"));
  EXPECT_TRUE(holds(drawn({"initial.x=0.1", "sampling.box.x=[-0.2, 0.2]"}), "not taken from the study: initial.x;"));
  EXPECT_EQ(drawn({"initial.x=0.1", "sampling.box.y=[-0.2, 0.2]"}), "");
}

TEST(StartText, WarnsOfBallsInOnePlaceThatNothingParts) {
  const auto together = [](const std::vector<std::string>& overrides) {
    return coincident_text(parse_study(constant_speed, "rotor", overrides));
  };
  EXPECT_TRUE(together({"initial.phi=[1.0, 1.0]"}).starts_with("balls 1 and 2 are alike and start in one place"));
  EXPECT_NE(together({"initial.phi=[0.0, 6.28318530717958647692]"}), "");
  EXPECT_EQ(together({}), "");
  EXPECT_EQ(together({"initial.phi=[1.0, 1.0]", "balancer.mass=[0.05, 0.06]"}), "");
  EXPECT_EQ(together({"initial.phi=[1.0, 1.0]", "initial.phi_dot=[0.0, 1.0]"}), "");
}

std::string transient_text(const TransientResult& r, const Study& study) {
  Document document;
  add_transients(document, r, study);
  return document_text(document);
}

TEST(TransientText, FoldsAwayOutcomesOfTooFewStarts) {
  Counted c(machine);
  c.add(20, outcome(OutcomeKind::attracted, 1), 0.0);
  c.add(3, outcome(OutcomeKind::undecided), 0.0);
  const std::string text = transient_text(c.tally.result(c.catalogue), c.study);
  EXPECT_TRUE(holds(text, "undecided: too few starts (3) for figures\n")) << text;
  EXPECT_FALSE(holds(text, "undecided, 3 starts"));
  EXPECT_TRUE(holds(text, "all outcomes, 23 starts"));
}

TEST(TransientText, BoundsWhatUndecidedStartsMayExceed) {
  Counted c(machine);
  const double limit = *c.study.limits.velocity;
  c.add(700, outcome(OutcomeKind::attracted, 1), 0.5 * limit);
  c.add(200, outcome(OutcomeKind::undecided), 0.5 * limit);
  c.add(100, outcome(OutcomeKind::undecided), 2.0 * limit);
  const TransientResult r = c.tally.result(c.catalogue);
  const Share& all = *r.groups.front().exceeded[2];
  EXPECT_EQ(all.count, 100u);
  EXPECT_EQ(all.least, 0.0);  // the velocity at the end of an undecided start is not known
  EXPECT_EQ(all.most, wilson_share(300, 1000).high);
  EXPECT_TRUE(holds(transient_text(r, c.study), "bounds below 32.9 %")) << transient_text(r, c.study);
}

TEST(TransientText, SaysWhichFiguresHoldTheWeight) {
  std::string text = machine;
  text.insert(text.find("eccentricity"), "gravity = \"9.81 m/s2\"\n");
  Counted c(text);
  c.add(20, outcome(OutcomeKind::attracted, 1), 0.0);
  // (12 + 0.12) kg 9.81 m/s2 = 118.9 N on 48 kN/m.
  EXPECT_TRUE(holds(
      transient_text(c.tally.result(c.catalogue), c.study),
      "from where the rotor rests, 2.477 mm below its unloaded springs; bearing forces include its weight, 118.9 N"));
}

}  // namespace report_test
}  // namespace equipoise
