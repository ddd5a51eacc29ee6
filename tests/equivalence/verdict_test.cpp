// The verdict on an ensemble: each decision where its reason holds and not where it does not; changes that are tried
// are what their words say; text within its width.
#include <cmath>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../support/studies.hpp"
#include "../support/study_difference.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/report/text/motion_words.hpp"
#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/study/contents/below_resonance.hpp"

namespace equipoise {
namespace verdict_test {

const std::string machine = R"([rotor]
mass = "4 kg"
stiffness = "10 kN/m"
damping_ratio = 0.05
unbalance = "300 g mm"
[balancer]
balls = 4
race_radius = "60 mm"
ball_diameter = "8 mm"
ball_density = "7800 kg/m3"
oil_viscosity = "100 mPa s"
[speed]
final = "1800 rpm"
run_up = "4 s"
[sampling]
starts = 60
)";
const std::string limits = "[limits]\ndisplacement = \"2 mm\"\nvelocity = \"5 mm/s\"\n";

// An ensemble with everything a verdict is made of; its figures are then set by hand.
const BasinResult& ensemble(bool limited) {
  const auto run = [](const std::string& text) {
    BasinOptions options;
    options.transients = true;
    return basin(parse_study(text, "machine"), options);
  };
  static const BasinResult plain = run(machine), with_limits = run(machine + limits);
  return limited ? with_limits : plain;
}

struct Numbers {
  std::uint64_t kept = 0, total = 1000;
  bool bare_keeps = false;
  double end = 0.0, bare_end = 1.0;    // RMS velocities; with balls in every start
  double peak = 1.0, bare_peak = 1.0;  // 90 % of starts below; without balls
};

void set(TransientGroup& group, float TransientRow::*figure, double value) {
  SampleSummary& s = group.figures[figure_place(figure)];
  s.quantiles.fill({value, value, value});
  s.mean = s.mean_low = s.mean_high = value;
}

BasinResult with_numbers(bool limited, const Numbers& n) {
  BasinResult r = ensemble(limited);
  TransientGroup &with = r.transients->groups.front(), &bare = r.without_balls->bare.figures;
  set(with, &TransientRow::rms_velocity, n.end);
  with.sure_end_velocity.fill({n.end, n.end, n.end});
  set(bare, &TransientRow::rms_velocity, n.bare_end);
  set(with, &TransientRow::peak_radial, n.peak);
  set(bare, &TransientRow::peak_radial, n.bare_peak);
  if (!limited) return r;
  for (auto& share : with.within) share = wilson_share(n.kept, n.total);
  for (auto& share : bare.within) share = wilson_share(n.bare_keeps, 1);
  return r;
}

Decision decided(bool limited, const Numbers& n) { return verdict_of(with_numbers(limited, n))->decision; }

TEST(Verdict, ByLimitsIsTheShareThatKeepsThem) {
  EXPECT_EQ(decided(true, {.kept = 1000}), Decision::fit);
  EXPECT_EQ(decided(true, {.kept = 980}), Decision::fit);  // 97.0 to 98.7 %
  EXPECT_EQ(decided(true, {.kept = 955}), Decision::open);
  EXPECT_EQ(decided(true, {.kept = 900}), Decision::change);
  EXPECT_EQ(decided(true, {.kept = 1000, .bare_keeps = true}), Decision::not_needed);
  EXPECT_EQ(decided(true, {.kept = 900, .bare_keeps = true}), Decision::do_not_fit);
  EXPECT_EQ(decided(true, {.kept = 955, .bare_keeps = true}), Decision::not_needed);
  for (const std::uint64_t kept : {900, 955, 1000})
    EXPECT_EQ(verdict_of(with_numbers(true, {.kept = kept, .bare_keeps = true}))->change, "Leave the balancer out.");
  EXPECT_EQ(decided(true, {.kept = 400, .end = 2.0}), Decision::do_not_fit);
  EXPECT_EQ(decided(true, {.kept = 400, .end = 0.5}), Decision::change);
  // A limit on the way is kept: its peaks may be what they are, and are told.
  EXPECT_EQ(decided(true, {.kept = 1000, .peak = 1.2}), Decision::fit);
  EXPECT_TRUE(
      holds(verdict_of(with_numbers(true, {.kept = 1000, .peak = 1.2}))->words, "though 1 run in 10 peaks above"));
  EXPECT_FALSE(holds(verdict_of(with_numbers(true, {.kept = 1000, .peak = 1.05}))->words, "peaks above"));
  BasinResult end_only = with_numbers(true, {.kept = 1000, .peak = 1.2});
  end_only.study.limits.displacement.reset();
  EXPECT_EQ(verdict_of(end_only)->decision, Decision::caution);
}

TEST(Verdict, WithoutLimitsComparesWithTheBareRotor) {
  EXPECT_EQ(decided(false, {.end = 0.0}), Decision::fit);
  EXPECT_EQ(decided(false, {.end = 0.49}), Decision::fit);
  EXPECT_EQ(decided(false, {.end = 0.51}), Decision::change);
  EXPECT_EQ(decided(false, {.end = 1.01}), Decision::do_not_fit);
  EXPECT_EQ(decided(false, {.end = 0.1, .peak = 2.9}), Decision::caution);
}

// Rotors between 50 and 250 g mm: the loudest tenth of them is no measure for the others, nor is the median for it.
TEST(Verdict, ComparesStartsWithTheirOwnRotors) {
  BasinOptions options;
  options.transients = true;
  const BasinResult drawn = basin(
      parse_study(with(machine, "\"300 g mm\"", "{ uniform = [\"50 g mm\", \"250 g mm\"] }"), "machine"), options);
  ASSERT_FALSE(drawn.without_balls->bare.one);
  ASSERT_EQ(drawn.without_balls->bare.first.size(), drawn.starts);
  ASSERT_EQ(drawn.transients->first.size(), drawn.starts);
  const auto with_balls = [&](double velocity, double peak, bool limited = false) {  // times each rotor's own
    BasinResult r = drawn;
    TransientGroup& all = r.transients->groups.front();
    const TransientGroup& bare = r.without_balls->bare.figures;
    for (const auto& [figure, times] :
         {std::pair{&TransientRow::rms_velocity, velocity}, std::pair{&TransientRow::peak_radial, peak}}) {
      SampleSummary& s = all.figures[figure_place(figure)] = bare.figures[figure_place(figure)];
      for (QuantileEstimate& q : s.quantiles) q = {times * q.value, times * q.low, times * q.high};
    }
    all.sure_end_velocity = all.figures[figure_place(&TransientRow::rms_velocity)].quantiles;
    for (std::size_t i = 0; i < r.starts; ++i) {
      const PairedStart& own = r.without_balls->bare.first[i];
      r.transients->first[i] = {false, 1.0, static_cast<float>(peak * own.peak_radial),
                                static_cast<float>(velocity * own.rms_velocity)};
    }
    if (limited) all.within[static_cast<std::size_t>(Within::at_end)] = wilson_share(1000, 1000);
    return *verdict_of(r);
  };
  EXPECT_EQ(with_balls(0.49, 1.0).decision, Decision::fit);
  EXPECT_EQ(with_balls(0.51, 1.0).decision, Decision::change);
  EXPECT_EQ(with_balls(1.01, 1.0).decision, Decision::do_not_fit);
  EXPECT_TRUE(holds(with_balls(0.49, 1.0).because, "it is at most 0.49 times that of the same rotor without balls"));
  // The peak that one start in ten exceeds is 1.7 times the median's.
  EXPECT_EQ(with_balls(0.1, 1.03, true).decision, Decision::fit) << with_balls(0.1, 1.03, true).words;
  EXPECT_EQ(with_balls(0.1, 2.0, true).decision, Decision::caution);
  BasinResult open = drawn;
  for (PairedStart& start : open.transients->first) start.undecided = true;
  EXPECT_EQ(verdict_of(open)->decision, Decision::open);
}

// Starts that were seen for too short a time may still come to rest or to anything else, however they move by then.
TEST(Verdict, IsOpenWhileUndecidedStartsMayTurnIt) {
  const BasinResult& known = ensemble(false);
  ASSERT_EQ(known.undecided.count, 0u);
  EXPECT_NE(verdict_of(known)->decision, Decision::open);
  BasinOptions options;
  options.transients = true;
  const BasinResult brief = basin(parse_study(machine + "[numerics]\nhorizon = \"1 s\"\n", "machine"), options);
  ASSERT_EQ(brief.undecided.count, brief.starts);
  const BalancerVerdict verdict = *verdict_of(brief);
  EXPECT_EQ(verdict.decision, Decision::open) << verdict.words;
  EXPECT_TRUE(holds(verdict.because, "(0 to ?)")) << verdict.because;
  EXPECT_TRUE(holds(verdict.change, "raise the time limit, numerics.horizon")) << verdict.change;
}

// A motor with half the torque that the unbalance takes at resonance: the rotor reaches it after half a minute and
// stays, with balls or without. Until then a longer horizon may show what happens.
TEST(Verdict, AsksForTorqueWhereTheRotorStallsWithoutBalls) {
  std::string weak = machine.substr(0, machine.find("[speed]"));
  weak.insert(weak.find("[balancer]"), "inertia = \"1e-4 kg m2\"\n");
  weak +=
      "[speed]\nprofile = \"torque\"\ntorque = { stall = \"3e-4 N m\", no_load_speed = \"1800 rpm\" }\n"
      "[sampling]\nstarts = 6\n[numerics]\nhorizon = ";
  BasinOptions options;
  options.transients = true;
  for (const bool long_enough : {false, true}) {
    const BasinResult r = basin(parse_study(weak + (long_enough ? "\"120 s\"\n" : "\"15 s\"\n"), "machine"), options);
    ASSERT_EQ(r.undecided.count, long_enough ? 0u : 6u);
    ASSERT_EQ(r.without_balls->bare.stalled, long_enough ? 1u : 0u);
    const BalancerVerdict verdict = *verdict_of(r);
    ASSERT_EQ(verdict.decision, long_enough ? Decision::change : Decision::open);
    EXPECT_EQ(holds(verdict.change, "stalls even without balls: give its motor more torque"), long_enough);
    EXPECT_EQ(holds(verdict.change, "raise the time limit, numerics.horizon"), !long_enough);
    BasinResult brought_through = r;  // by its balls
    brought_through.stalled->count = brought_through.undecided.count = 0;
    EXPECT_FALSE(holds(verdict_of(brought_through)->change, "torque"));
  }
}

// Known before a start is; and trajectories shake more with balls than without, whatever the balls and supports are.
TEST(Verdict, LeavesTheBalancerOutBelowTheCriticalSpeed) {
  const std::string slow = with(machine, "1800 rpm", "420 rpm");  // of 477 rpm
  BasinResult nothing;
  nothing.study = parse_study(slow, "machine");
  nothing.transients.emplace();
  ASSERT_TRUE(verdict_of(nothing));
  EXPECT_TRUE(holds(verdict_of(nothing)->words, "below its critical speed of 476.97")) << verdict_of(nothing)->words;
  EXPECT_EQ(verdict_of(nothing)->change, "Leave the balancer out.");
  EXPECT_TRUE(usual_changes(nothing.study).empty());
  EXPECT_FALSE(below_resonance_words(nothing.study).empty());
  for (const std::vector<std::string>& overrides :
       std::vector<std::vector<std::string>>{{"balancer.balls=1"},
                                             {"balancer.balls=2", "speed.final=150 rpm", "speed.run_up=1 s"},
                                             {"balancer.balls=3", "rotor.stiffness=['10 kN/m', '14 kN/m']"},
                                             {"rotor.damping_ratio=0.3"},
                                             {"rotor.unbalance=3 g mm"}}) {
    const Study study = parse_study(slow, "machine", overrides);
    ASSERT_TRUE(runs_below_resonance(study));
    BasinOptions options;
    options.transients = true;
    const BasinResult r = basin(study, options);
    for (std::size_t q = 0; q < reported_quantiles.size(); ++q)
      EXPECT_GT(r.transients->groups.front().figure(&TransientRow::rms_velocity).quantiles[q].value,
                r.without_balls->bare.figures.figure(&TransientRow::rms_velocity).quantiles[q].value)
          << overrides.front();
    EXPECT_EQ(verdict_of(r)->decision, Decision::do_not_fit);
    EXPECT_TRUE(changes_asked_for(r).empty());
  }
}

TEST(BelowResonance, IsClaimedOnlyWhereItIsSure) {
  const auto below = [](const std::vector<std::string>& overrides) {
    return runs_below_resonance(parse_study(machine, "machine", overrides));
  };
  EXPECT_FALSE(below({}));
  EXPECT_TRUE(below({"speed.final=470 rpm"}));
  EXPECT_FALSE(below({"speed.final=480 rpm"}));
  EXPECT_TRUE(below({"speed.final=-470 rpm"}));
  EXPECT_TRUE(below({"speed.final=470 rpm", "rotor.unbalance={uniform=['0 g mm','300 g mm']}"}));
  EXPECT_TRUE(below({"speed.final={uniform=['400 rpm','470 rpm']}"}));
  EXPECT_FALSE(below({"speed.final={uniform=['400 rpm','490 rpm']}"}));
  EXPECT_TRUE(below({"speed.final=400 rpm", "rotor.stiffness={uniform=['8 kN/m','10 kN/m']}"}));
  EXPECT_FALSE(below({"speed.final=450 rpm", "rotor.stiffness={uniform=['8 kN/m','10 kN/m']}"}));
  // Each alone keeps it below, both together do not.
  EXPECT_FALSE(
      below({"speed.final={uniform=['380 rpm','440 rpm']}", "rotor.stiffness={uniform=['8 kN/m','10 kN/m']}"}));
  EXPECT_FALSE(below({"speed.final=420 rpm", "balancer.race_offset=['0.2 mm','0 mm']"}));
  EXPECT_FALSE(below({"speed.final=420 rpm", "balancer.rolling=0.01"}));
  EXPECT_FALSE(below({"speed.final=420 rpm", "balancer.balls=0"}));
}

TEST(Verdict, AsksForTheShareThatLimitsState) {
  BasinResult r = with_numbers(true, {.kept = 900});
  EXPECT_EQ(verdict_of(r)->decision, Decision::change);
  r.study.limits.share = 0.8;
  EXPECT_EQ(verdict_of(r)->decision, Decision::fit);
}

TEST(Verdict, ComesFirstInTextAndStandsInJson) {
  const BasinResult r = with_numbers(false, {.end = 0.1, .peak = 2.9});
  const std::string text = basin_text(r);
  EXPECT_TRUE(text.starts_with("verdict   Fit it if you can accept more vibration"));
  EXPECT_EQ(nlohmann::json::parse(json_text(r))["verdict"]["decision"], "caution");
  EXPECT_TRUE(holds(basin_text(r, {80, false, true}), "\x1b[33mverdict"));
  EXPECT_FALSE(holds(text, "\x1b["));
}

TEST(Verdict, IsNotGivenWithoutTransients) {
  BasinOptions options;
  options.transients = false;
  EXPECT_FALSE(verdict_of(basin(parse_study(machine, "machine"), options)));
}

TEST(Verdict, TellsTheBestChangeThatWasTried) {
  const BasinResult r = with_numbers(true, {.kept = 400});
  std::vector<TriedChange> tried{{"half the drag", r.study, 200, Decision::change, wilson_share(150, 200), {}, {}},
                                 {"twice the drag", r.study, 200, Decision::change, wilson_share(180, 200), {}, {}}};
  EXPECT_TRUE(holds(verdict_of(r, tried)->change,
                    "Twice the drag: 180 of 200 trial runs stayed within every limit (85.1 to 93.4 %). None of"));
  const std::vector<TriedChange> useless{
      {"half the drag", r.study, 200, Decision::change, wilson_share(0, 200), {}, {}}};
  EXPECT_TRUE(
      holds(verdict_of(r, useless)->change, "With none of the 1 changes tried does a run stay within every limit"));
  tried.push_back({"6 balls", r.study, 200, Decision::fit, wilson_share(200, 200), {}, {}});
  EXPECT_TRUE(verdict_of(r, tried)->change.starts_with(
      "6 balls: 200 of 200 trial runs stayed within every limit (above 98.12 %)"));
}

TEST(Verdict, ChangesAreATableWithTheBestFirst) {
  const BasinResult& r = ensemble(true);
  EXPECT_TRUE(changes_table(r, {}).rows.empty());
  std::vector<TriedChange> tried;
  for (std::uint64_t k = 1; k <= 10; ++k)
    tried.push_back({"change " + std::to_string(k),
                     r.study,
                     200,
                     k == 7 ? Decision::fit : Decision::change,
                     wilson_share(10 * k, 200),
                     {},
                     {0.1 * static_cast<double>(k), 0.0, 0.0}});
  const DocumentTable table = changes_table(r, tried);
  ASSERT_EQ(table.rows.size(), 9u);  // eight, and the balancer as it is
  EXPECT_EQ(table.rows[0][0].text, "change 7");
  EXPECT_EQ(table.rows[0][0].tone, Tone::good);
  EXPECT_EQ(table.rows[0][1].text, "35.0 % (28.7 to 41.8)");
  EXPECT_EQ(table.rows[0][2].text, "42");  // 0.7 of 60 mm
  EXPECT_EQ(table.rows[1][0].text, "change 10");
  EXPECT_EQ(table.rows[1][0].tone, Tone::plain);
  EXPECT_EQ(table.rows[8][0].text, "as it is");
  EXPECT_EQ(table.header[1], "within every limit");
  EXPECT_TRUE(table.caption.starts_with("Of 10 changes tried, each on 200 starts, best first."));
  tried.back().starts = 32;
  EXPECT_TRUE(changes_table(r, tried).caption.starts_with(
      "Of 10 changes tried, each on 200 starts, or on 32 where that was enough to see it fail, best first."));
  tried.resize(2);
  EXPECT_TRUE(changes_table(r, tried).caption.starts_with("2 changes tried"));
  EXPECT_EQ(changes_table(ensemble(false), tried).header[1], "RMS velocity at the end, mm/s");
}

TEST(Changes, AreAskedForByVerdictsOfNoUse) {
  BasinResult stopped = ensemble(true);
  stopped.partial = true;
  EXPECT_TRUE(changes_asked_for(stopped).empty());
  EXPECT_TRUE(changes_asked_for(with_numbers(true, {.kept = 1000})).empty());
  EXPECT_TRUE(changes_asked_for(with_numbers(true, {.kept = 955})).empty());  // not judged yet
  EXPECT_TRUE(changes_asked_for(with_numbers(true, {.kept = 900, .bare_keeps = true})).empty());
  // Others are tried: the first report of it ends that here.
  struct Asked {};
  RunOptions options;
  options.progress = [](const Progress&) { throw Asked(); };
  EXPECT_THROW(changes_asked_for(with_numbers(true, {.kept = 900}), options), Asked);
  EXPECT_THROW(changes_asked_for(with_numbers(false, {.end = 0.1, .peak = 1.2}), options), Asked);
}

TEST(BasinText, KeepsToEightyColumns) {
  for (const bool limited : {false, true}) {
    std::istringstream lines(basin_text(ensemble(limited), TextStyle{}));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(display_width(line), 80u) << line;
  }
  EXPECT_TRUE(holds(basin_text(ensemble(true), wide_style), "Decided by:"));
  EXPECT_FALSE(holds(basin_text(ensemble(true), TextStyle{}), "Decided by:"));
}

// Each as the same change made in the study's text.
TEST(Changes, AreWhatTheirWordsSay) {
  const Study study = parse_study(machine, "machine");
  const auto expect = [&](const std::string& words, std::vector<std::string> overrides) {
    overrides.push_back(fmt::format("sampling.starts={}", starts_of_a_change));
    for (const Change& change : usual_changes(study))
      if (change.words == words) {
        const Study same = parse_study(machine, "machine", overrides);
        EXPECT_EQ(first_difference(change.study, same, 1e-12), "") << words;
        return;
      }
    ADD_FAILURE() << words;
  };
  expect("twice the drag", {"balancer.oil_viscosity=200 mPa s"});
  expect("half the drag", {"balancer.oil_viscosity=50 mPa s"});
  expect("6 balls", {"balancer.balls=6"});
  expect("3 balls", {"balancer.balls=3"});
  expect("balls of 10 mm", {"balancer.ball_diameter=10 mm"});
  expect("balls of 6 mm", {"balancer.ball_diameter=6 mm"});
  expect("a run-up of half the time", {"speed.run_up=2 s"});
  // Halfway between sqrt(2) critical speeds and the last speed, in two digits.
  const double halfway = 0.5 * (std::sqrt(2.0) + study.speed.final) * study.scales->frequency * 30.0 / pi;
  ASSERT_GT(halfway, 100.0);
  const double latch = halfway < 1000.0 ? 10.0 * std::round(halfway / 10.0) : 100.0 * std::round(halfway / 100.0);
  expect(fmt::format("a latch that holds the balls until {:.0f} rpm", latch),
         {fmt::format("release={{speed='{:.0f} rpm'}}", latch)});
}

TEST(Changes, LeaveUncertainRotorsAlone) {
  EXPECT_TRUE(
      usual_changes(parse_study(with(machine, "\"300 g mm\"", "{ uniform = [\"100 g mm\", \"300 g mm\"] }"), "machine"))
          .empty());
}

TEST(Changes, AreTriedUntilOneFits) {
  Study study = parse_study(machine + limits, "machine");
  RunOptions one, two;
  one.threads = 1;
  two.threads = 2;
  const auto tried = try_changes(study, one), again = try_changes(study, two);
  ASSERT_FALSE(tried.empty());
  ASSERT_EQ(tried.size(), again.size());
  for (std::size_t k = 0; k < tried.size(); ++k) {
    EXPECT_EQ(tried[k].starts, again[k].starts);
    EXPECT_EQ(tried[k].kept->count, again[k].kept->count);
    EXPECT_EQ(tried[k].decision == Decision::fit, k + 1 == tried.size() && tried.size() < usual_changes(study).size());
  }
}

// On the first 32 starts a change can fail for sure, but cannot fit. The best is tried on all, and so is all that may
// yet be better.
TEST(Changes, AreTriedOnFewStartsWhereTheseTellThatTheyFail) {
  const auto tried =
      try_changes(parse_study(machine + "[limits]\nvelocity = \"5 mm/s\"\ndisplacement = \"0.7 mm\"\n", "machine"));
  ASSERT_GT(tried.size(), 2u);
  const TriedChange* best = &tried.front();
  for (const TriedChange& t : tried)
    if (serves_better(t, *best)) best = &t;
  EXPECT_EQ(best->starts, starts_of_a_change);
  std::size_t dropped = 0;
  for (const TriedChange& t : tried) {
    if (t.starts == starts_of_a_change) continue;
    ++dropped;
    EXPECT_EQ(t.starts, starts_of_a_look) << t.words;
    EXPECT_TRUE(t.decision == Decision::change || t.decision == Decision::do_not_fit) << t.words;
    EXPECT_FALSE(may_serve_better(t, *best)) << t.words;
  }
  EXPECT_GT(dropped, 0u);
}

TEST(Changes, MayServeBetterWhereIntervalsOverlap) {
  const auto kept = [](std::uint64_t count, std::uint64_t of, Decision d = Decision::change) {
    return TriedChange{"", {}, of, d, wilson_share(count, of), {}, {}};
  };
  EXPECT_TRUE(may_serve_better(kept(16, 32), kept(60, 100)));
  EXPECT_FALSE(may_serve_better(kept(10, 32), kept(90, 100)));
  EXPECT_TRUE(may_serve_better(kept(10, 32, Decision::open), kept(90, 100)));
  EXPECT_FALSE(may_serve_better(kept(32, 32), kept(90, 100, Decision::open)));
  const auto shakes = [](double low, double high) {
    return TriedChange{"", {}, 32, Decision::change, {}, {0.5 * (low + high), low, high}, {}};
  };
  EXPECT_TRUE(may_serve_better(shakes(1.0, 3.0), shakes(0.5, 2.0)));
  EXPECT_FALSE(may_serve_better(shakes(2.5, 3.0), shakes(0.5, 2.0)));
}

TEST(PlainNames, SayWhatBallsDo) {
  EXPECT_EQ(plain_name("co-drifting"), "balls circulate together");
  EXPECT_EQ(plain_name("drifting apart (2 together), quasi-periodic"),
            "balls circulate apart (2 together), quasi-periodic");
  EXPECT_EQ(plain_name("2 captured, 1 drifting"), "balls: 2 staying, 1 circulating");
  EXPECT_EQ(plain_name("balanced"), "");
}

}  // namespace verdict_test
}  // namespace equipoise
