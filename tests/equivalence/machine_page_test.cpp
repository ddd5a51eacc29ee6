// The page's content against independent knowledge: paths of motions, runs, distributions.
#include "equipoise/report/shown/machine_page.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "../support/studies.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/report/shown/motion_path.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise {
namespace machine_page_test {

constexpr std::uint64_t starts = 1200;

const MachinePage& paper_page() {
  static const MachinePage page = [] {
    Study study = parse_study(constant_speed + "[limits]\ndisplacement = 0.2\n", "paper.toml");
    study.sampling.starts = starts;
    return machine_page(study, given_machine(study));
  }();
  return page;
}

TEST(MotionPath, IsTheRefinedOrbit) {
  AttractorsOptions options;
  options.starts = 64;
  const AttractorsResult found = attractors(parse_study(constant_speed, "paper.toml"), options);
  ASSERT_EQ(found.attractors.at(1).id, 2);  // together
  const Motion& m = found.attractors.at(1).motion;
  ASSERT_EQ(m.kind, MotionKind::periodic);
  const model::System system = system_of(found.basin.study.parameters, m);
  constexpr int count = 64;
  const MotionPath path = motion_path(system, m, m.period, count);
  const auto orbit = sample_orbit(system, m.orbit, count);
  ASSERT_EQ(path.x.size(), count + 1u);
  ASSERT_EQ(path.phi.size(), 2u);
  // The path is integrated at 1e-9 per step, over hundreds of steps; deviations do not grow on a stable orbit.
  constexpr double tolerance = 1e-6;
  const double shift = orbit[0][model::index::phi(0)] - path.phi[0][0];
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_NEAR(std::hypot(path.x[k], path.y[k]), std::hypot(orbit[k][0], orbit[k][1]), tolerance);
    EXPECT_NEAR(path.phi[0][k] + shift, orbit[k][model::index::phi(0)], tolerance);
  }
  // In fixed axes: rotated by the rotor's angle.
  const double t = m.period * 10 / count, psi = m.speed * t;
  EXPECT_NEAR(path.x[10], orbit[10][0] * std::cos(psi) - orbit[10][1] * std::sin(psi), tolerance);
  EXPECT_NEAR(path.y[10], orbit[10][0] * std::sin(psi) + orbit[10][1] * std::cos(psi), tolerance);
}

TEST(MachinePage, IsOfTheEnsembleThatBasinRuns) {
  const MachinePage& page = paper_page();
  BasinOptions options;
  options.transients = true;
  const BasinResult basin = equipoise::basin(page.basin.study, options);
  ASSERT_EQ(page.basin.starts, basin.starts);
  for (std::size_t k = 0; k < basin.attractors.size(); ++k)
    EXPECT_EQ(page.basin.attractors[k].share.count, basin.attractors[k].share.count);
  EXPECT_FALSE(page.basin.every_start);
  EXPECT_EQ(page.starts_drawn, starts);
}

TEST(MachinePage, DrawsEveryMotionThatStartsEndIn) {
  const MachinePage& page = paper_page();
  ASSERT_EQ(page.motions.size(), 3u);
  EXPECT_EQ(page.motions[0].name, "balanced");  // 60 % of starts, Wright and Peng's table 2
  EXPECT_EQ(page.motions[1].name, "drifting apart");
  EXPECT_EQ(page.motions[2].name, "co-drifting");
  for (const BallOnMotion& ball : page.motions[0].balls) {
    EXPECT_EQ(ball.drift, 0.0);
    EXPECT_NEAR(std::cos(ball.place), -0.1, 1e-9);  // each cancels half of lambda: cos = -lambda / (2 mu)
  }
  for (std::size_t k = 1; k < 3; ++k) {
    const DrawnMotion& m = page.motions[k];
    EXPECT_LT(m.balls[0].drift, 0.0);  // balls that do not balance fall behind
    double reach = 0.0;
    for (std::size_t i = 0; i < m.x.size(); ++i) reach = std::max(reach, std::hypot(m.x[i], m.y[i]));
    // Never beyond; 48 samples per turn come within 0.2 % of a maximum, but a torus shows it rarely.
    EXPECT_LT(reach, m.r_max * (1.0 + 1e-6));
    EXPECT_GT(reach, m.r_max * (m.kind == "periodic" ? 0.998 : 0.95));
  }
}

TEST(MachinePage, CountsEveryStartOfADistributionOnce) {
  const MachinePage& page = paper_page();
  ASSERT_EQ(page.peaks.size(), 1u);
  const FigureDistribution& peaks = page.peaks[0];
  double above = 0.0, all = 0.0;
  for (const auto& outcome : peaks.outcomes)
    for (std::size_t k = 0; k < outcome.bins.size(); ++k) {
      all += outcome.bins[k];
      const double width = (peaks.high - peaks.low) / static_cast<double>(outcome.bins.size());
      if (peaks.low + (static_cast<double>(k) + 0.5) * width > 0.2) above += outcome.bins[k];
    }
  EXPECT_NEAR(all, 1.0, 1e-9);
  const double exceeded = page.basin.transients->groups[0].exceeded[0]->share;
  const std::size_t bins = peaks.outcomes[0].bins.size();
  EXPECT_NEAR(above, exceeded, 4.0 / static_cast<double>(bins));  // the bin that the limit cuts
}

TEST(MachinePage, RunsHaveThePeaksThatWereGathered) {
  const MachinePage& page = paper_page();
  ASSERT_EQ(page.runs.size(), 3u);
  EXPECT_EQ(page.runs[0].of, RunOf::bare);
  EXPECT_EQ(page.runs[1].of, RunOf::median);
  EXPECT_EQ(page.runs[2].of, RunOf::worst_in_hundred);
  const SampleSummary& peak = page.basin.transients->groups[0].figures[0];
  EXPECT_FLOAT_EQ(static_cast<float>(page.runs[1].peak), static_cast<float>(peak.quantiles[0].value));
  EXPECT_FLOAT_EQ(static_cast<float>(page.runs[2].peak), static_cast<float>(peak.quantiles[2].value));
  EXPECT_EQ(page.runs[0].peak, page.basin.without_balls->bare.figures.figure(&TransientRow::peak_radial).largest);
  // The rotor without balls ends in the amplitude of the textbook.
  EXPECT_NEAR(page.runs[0].at_end, 0.01 * 5.76 / std::hypot(1.0 - 5.76, 1.2), 1e-5);
  for (const ShownRun& run : page.runs) {
    EXPECT_NEAR(run.again, run.peak, 0.02 * run.peak);  // sixteen samples per turn
    EXPECT_EQ(run.t.size(), run.r_high.size());
    EXPECT_GT(run.t.back(), 25.0);
    EXPECT_NEAR(run.speed.front(), 2.4, 1e-12);
  }
}

TEST(MachinePage, ShowsTheRotorWithoutBallsAsAStudyWithoutThemHasIt) {
  Study study = parse_study(with(ramp_machine, "10 s", "2 s"), "machine.toml");
  study.sampling.starts = 40;
  const MachinePage page = machine_page(study, given_machine(study));
  ASSERT_EQ(page.runs.size(), 3u);
  const ShownRun& bare = page.runs[0];
  Study alone = study;
  alone.parameters.balls = 0;
  std::vector<double> times;
  for (double t = 0.0; t < bare.t.back(); t += 0.02) times.push_back(t);
  const Trajectory run = simulate(alone, times);
  const double peak = *std::max_element(run.radial.begin(), run.radial.end());
  EXPECT_NEAR(bare.peak, peak, 1e-4 * peak);
  EXPECT_NEAR(bare.again, peak, 0.02 * peak);
  EXPECT_NEAR(bare.at_end, run.radial.back(), 1e-3 * peak);
  // Fewer than a hundred starts have no worst in a hundred.
  EXPECT_TRUE(run_words(page, page.runs[2]).starts_with("worst of 40 starts: peak "));
  EXPECT_TRUE(run_words(page, bare).starts_with("without balls: peak "));
  EXPECT_TRUE(run_words(paper_page(), paper_page().runs[2]).starts_with("worst in a hundred: peak "));
  EXPECT_TRUE(run_words(paper_page(), paper_page().runs[1]).starts_with("typical start, half peak lower: peak "));
  // The speed stands above the picture where there is one for all, and it changes.
  EXPECT_TRUE(holds(run_up_svg(page), ">speed, rpm<"));
  EXPECT_FALSE(holds(run_up_svg(paper_page()), ">speed"));
  EXPECT_TRUE(run_up_tells_speed(page));
  Study slower = study;  // comes down again
  slower.speed.profile = Profile::points;
  slower.speed.times = {0.0, 100.0, 150.0};
  slower.speed.speeds = {0.0, 5.0, 4.0};
  const MachinePage down = machine_page(slower, given_machine(slower));
  EXPECT_FALSE(holds(run_up_svg(down), ">speed"));
  EXPECT_FALSE(run_up_tells_speed(down));
  EXPECT_TRUE(holds(machine_html(down), "Speed over time"));
  EXPECT_FALSE(holds(machine_html(page), "Speed over time"));
}

TEST(MachinePage, BeginsWithTheVerdictInItsTone) {
  const MachinePage& page = paper_page();
  const auto verdict = verdict_of(page.basin);
  ASSERT_TRUE(verdict);
  ASSERT_EQ(verdict->decision, Decision::do_not_fit);
  EXPECT_EQ(tone_of(Decision::fit), Tone::good);
  EXPECT_EQ(tone_of(Decision::caution), Tone::open);
  const std::string html = machine_html(page);
  const std::size_t box = html.find("<div class=\"notice bad\">\n<p>" + verdict->words);
  ASSERT_NE(box, html.npos);
  EXPECT_LT(box, html.find("<p class=\"lead\">"));
  EXPECT_EQ(html.find("<h2>"), html.find("<h2>", box));
  EXPECT_TRUE(holds(html, "<span>why</span> "));
  // Changes stand in it if they were tried.
  EXPECT_FALSE(holds(html, "What to change"));
  const std::vector<TriedChange> tried{
      {"twice the drag", page.basin.study, 200, Decision::fit, wilson_share(200, 200), {}, {}}};
  const std::string changed = machine_html(page, tried);
  EXPECT_LT(changed.find("<h2>What to change</h2>"), changed.find("<h2>How it vibrates</h2>"));
  EXPECT_TRUE(holds(changed, "<td class=\"label good\">twice the drag</td>"));
  EXPECT_TRUE(holds(changed, ">as it is<"));
  // There is none for too few starts.
  Study few = page.basin.study;
  few.sampling.starts = 3;
  EXPECT_FALSE(holds(machine_html(machine_page(few, given_machine(few))), "class=\"notice"));
}

TEST(MachinePage, SaysWhatTheStudyLeavesOpen) {
  const std::string text =
      with(ramp_machine, "\"0.2 mm\"", "{ uniform = [\"0.1 mm\", \"0.2 mm\"] }") + "[sampling]\nstarts = 8\n";
  const Study study = parse_study(text, "machine.toml");
  const std::string html = machine_html(machine_page(study, given_machine(text, "machine.toml", {})));
  for (const char* words : {"<h2>What was assumed</h2>", "<li>balls free from t = 0</li>", "Most sensitive to: "})
    EXPECT_TRUE(holds(html, words)) << words;
  EXPECT_FALSE(holds(html, "at their medians"));  // its starts draw them
  // Without the study's text nobody knows.
  EXPECT_FALSE(holds(machine_html(machine_page(study, given_machine(study))), "What was assumed"));
}

TEST(MachinePage, TellsLimitsAndStandardsWhereTheyAreStated) {
  const std::string text = constant_machine + "[sampling]\nstarts = 20\n";
  const auto page = [](const std::string& toml) {
    const Study study = parse_study(toml, "machine.toml");
    return machine_html(machine_page(study, given_machine(study)));
  };
  const std::string plain = page(text), limited = page(text + "[limits]\ndisplacement = \"1 mm\"\n"),
                    held = page(text + "[standards]\nhand_held = true\n");
  EXPECT_TRUE(holds(plain, "<h2>Standards</h2>"));
  EXPECT_FALSE(holds(plain, "hand-arm vibration"));
  EXPECT_TRUE(holds(limited, "<h2>Limits and standards</h2>"));
  EXPECT_TRUE(holds(limited, "never over a limit on the way"));
  EXPECT_TRUE(holds(held, "<th>hand-arm vibration</th>"));
  EXPECT_TRUE(holds(machine_html(paper_page()), "<h2>Limits</h2>"));  // no standard speaks of a study without units
}

TEST(MachinePage, SpeaksAMachinesUnitsAndKeepsToThem) {
  Study study = parse_study(machine_rotor + R"([speed]
profile = "ramp"
initial = "0 rpm"
final = "2000 rpm"
duration = "2 s"
[limits]
displacement = "1 mm"
)",
                            "machine.toml");
  study.sampling.starts = 60;
  const std::string page = machine_html(machine_page(study, given_machine(study)));
  for (const char* words :
       {"2000 rpm", "displacement, mm", "speed, rpm", "time, s", "12 kg", "60 starts", "balance quality"})
    EXPECT_TRUE(holds(page, words)) << words;
  for (const char* words : {"<script", "http:", "https:", ">nan", " nan", ">inf", " inf "})
    EXPECT_FALSE(holds(page, words)) << words;
}

TEST(MachinePage, FollowsOneStartWhereNoMotionIsKnown) {
  // Switched off at 200: the rotor coasts, and none of its speeds belongs to a motion.
  Study study = parse_study(R"([rotor]
eccentricity = 0.01
damping = 0.5
inertia = 0.5
[balancer]
balls = 2
mass = 0.05
drag = 0.05
[speed]
profile = "torque"
torque = { constant = 0.05, slope = -0.02, until = 200.0 }
)",
                            "coasting.toml");
  study.sampling.starts = 8;
  const MachinePage page = machine_page(study, given_machine(study));
  ASSERT_FALSE(page.motions.empty());
  EXPECT_TRUE(page.motions[0].one_start);
  EXPECT_GT(page.motions[0].x.size(), 50u);
}

}  // namespace machine_page_test
}  // namespace equipoise
