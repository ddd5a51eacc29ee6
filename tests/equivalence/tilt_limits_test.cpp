// Ensembles of a tilting rotor, with transients: next to trajectories in fixed axes and next to a rotor that cannot
// tilt; what is said of them, and the page for such a machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/analyses/design/design.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/machine/balance/tilt_balance.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/report/shown/machine_page.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "tilt_dense.hpp"

namespace equipoise {
namespace tilt_limits_test {

using namespace tilting;

// k12 = 0, no couple and all balls at the centre of mass: nothing tilts, wherever its bearings are.
TEST(TiltTransientsOfNoTilt, AreThoseOfTheRotorThatCannotTilt) {
  const std::string plane = R"(
[rotor]
eccentricity = 0.005
damping = 0.2
gravity = 0.01
[balancer]
balls = 2
mass = 0.006
drag = 0.1
[speed]
profile = "ramp"
final = 3.0
duration = 30.0
[limits]
displacement = 0.01
velocity = 0.01
settled = 0.004
[sampling]
starts = 24
[numerics]
tolerance = 1e-10
)";
  BasinOptions options;
  options.transients = true;
  const BasinResult without = basin(parse_study(plane, "plane"), options),
                    with =
                        basin(parse_study(plane, "tilting",
                                          {"rotor.tilt={ transverse_inertia = 3.25, polar_inertia = 0.5, stiffness = "
                                           "[0, 9], damping = [0, 1.8], bearings_at = [2, -3] }",
                                           "balancer.plane=0"}),
                              options);
  ASSERT_TRUE(without.transients && with.transients);
  const TransientGroup &a = without.transients->groups.front(), &b = with.transients->groups.front();
  ASSERT_EQ(a.starts, b.starts);
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    if (transient_figures[k].value == &TransientRow::followed_until) continue;
    if (transient_figures[k].value == &TransientRow::energy) continue;  // the plane rotor states no inertia
    const SampleSummary &one = a.figures[k], &two = b.figures[k];
    EXPECT_EQ(one.open, two.open) << transient_figures[k].name;
    // Held balls of the plane rotor are looked at 64 times a turn, those of the other at every step. What is left of
    // the way to balance has errors of 1e-10 a step.
    // A peak is flat: its place is known to the root of what its height is.
    const bool place = transient_figures[k].value == &TransientRow::peak_time ||
                       transient_figures[k].value == &TransientRow::peak_speed;
    const double part = place ? std::sqrt(3e-4) : 3e-4;
    EXPECT_NEAR(one.mean, two.mean, part * one.mean + 1e-8) << transient_figures[k].name;
    EXPECT_NEAR(one.largest, two.largest, part * one.largest + 1e-8) << transient_figures[k].name;
  }
  for (std::size_t k = 0; k < transient_limits.size(); ++k) {
    ASSERT_EQ(a.exceeded[k].has_value(), b.exceeded[k].has_value());
    if (!a.exceeded[k]) continue;
    EXPECT_EQ(a.exceeded[k]->count, b.exceeded[k]->count) << transient_limits[k].name;
  }
  const TransientGroup &c = without.without_balls->bare.figures, &d = with.without_balls->bare.figures;
  for (const auto figure : {&TransientRow::peak_radial, &TransientRow::rms_velocity, &TransientRow::peak_force,
                            &TransientRow::rms_force, &TransientRow::peak_radial_at_end})
    EXPECT_NEAR(c.figure(figure).mean, d.figure(figure).mean, 1e-5 * c.figure(figure).mean);
}

Study limited(double displacement, double velocity, const std::string& bearings) {
  return long_rotor_with(damped({"speed={ profile = \"ramp\", final = 3.5, duration = 40 }", bearings,
                                 "limits.displacement=" + std::to_string(displacement),
                                 "limits.velocity=" + std::to_string(velocity), "sampling.starts=120"}));
}

TEST(TiltBasinTransients, DoNotDependOnThreads) {
  BasinOptions options;
  options.transients = true;
  const Study study = limited(0.1, 0.01, "rotor.tilt.bearings_at=[2, -2]");
  std::vector<std::string> told;
  for (const int threads : {1, 3}) {
    options.threads = threads;
    options.keep_starts = true;
    const BasinResult r = basin(study, options);
    std::string text;
    for (const std::vector<float>& column : r.every_start->transients)
      text.append(reinterpret_cast<const char*>(column.data()), column.size() * sizeof(float));
    told.push_back(text);
  }
  EXPECT_GT(told[0].size(), 120u * sizeof(float));
  EXPECT_EQ(told[0], told[1]);
}

// Of starts with rotors of their own, each has the figures of its own rotor in fixed axes.
TEST(TiltBasinTransients, OfRotorsThatDifferAreThoseOfEach) {
  Study study = long_rotor_with(damped(
      {"rotor.eccentricity={ values = [0.004, 0.006] }", "rotor.tilt.bearings_at=[2, -3]", "sampling.starts=6"}));
  BasinOptions options;
  options.transients = options.keep_starts = true;
  const BasinResult r = basin(study, options);
  const Sampler sampler = sampler_of(r.study);
  int checked = 0;
  for (std::uint64_t i = 0; i < r.every_start->starts; ++i) {
    const float until = (*r.every_start->transient("followed_until"))[i];
    if (!(until < 400.0f)) continue;
    Study own = drawn_study(r.study, drawn_values(r.study, sampler, r.study.sampling.seed, i));
    own.initial = start_of(r.study, i);
    const std::vector<Seen> all = tilting::dense(own, {{0.0, until, false, 0.0}}, {2.0, -3.0});
    double peak = 0.0;
    for (const Seen& s : all) peak = std::max(peak, s.radial);
    EXPECT_NEAR((*r.every_start->transient("peak_radial"))[i], peak, 0.001 * peak) << i;
    ++checked;
  }
  EXPECT_GE(checked, 3);
}

// The verdict each way: limits that every start keeps, that the bare rotor keeps too, and that few starts keep; and
// where figures are told.
TEST(TiltBasinTransients, AreJudgedAtTheBearings) {
  AttractorSearchCache searched;  // one search for all: limits and bearings change no motion
  BasinOptions options;
  options.searches = &searched;
  options.transients = true;
  const auto text = [&](double displacement, double velocity, const char* bearings) {
    std::string told = basin_text(basin(limited(displacement, velocity, bearings), options));
    std::replace(told.begin(), told.end(), '\n', ' ');
    return told;
  };
  const auto says = [](const std::string& told, const char* what) { return told.find(what) != std::string::npos; };
  const char* far = "rotor.tilt.bearings_at=[2, -2]";
  const std::string fit = text(0.2, 0.03, far), loose = text(0.2, 0.1, far), tight = text(0.012, 0.1, far),
                    centre = text(0.012, 0.03, "rotor.eccentricity_angle=1");
  EXPECT_TRUE(says(fit, "Fit it: ")) << fit;
  EXPECT_TRUE(says(loose, "You don't need a balancer: ")) << loose;
  EXPECT_FALSE(says(tight, "Fit it: ") || says(tight, "You don't need a balancer: ")) << tight;
  EXPECT_TRUE(says(loose, "Displacements and velocities are those of the outermost bearing that has more of them"));
  EXPECT_TRUE(says(loose, "the residual unbalance is that in the plane of the outermost bearing that has more"));
  EXPECT_TRUE(says(centre, "the residual unbalance is the static one alone"));
  EXPECT_FALSE(says(loose, "No bearings are stated"));
  EXPECT_TRUE(says(centre, "No bearings are stated")) << centre;
  EXPECT_FALSE(says(centre, "outermost bearing"));
}

// Two opposite unbalances are a couple alone: the static one, which is 0, says nothing of it.
TEST(TiltBasinTransients, HaveNoGradeThatLeavesOutTheCouple) {
  BasinOptions options;
  options.transients = true;
  Study study = limited(0.1, 0.01, "rotor.eccentricity=0");
  study.sampling.starts = 20;
  study.scales = model::Scales{.mass = 10.0, .length = 0.1, .frequency = 100.0};
  const BasinResult r = basin(study, options);
  ASSERT_FALSE(r.transients->groups.empty());
  EXPECT_FALSE(left_grade(r.transients->groups.front(), r.study));
  const std::string told = basin_text(r);
  EXPECT_EQ(told.find("e omega"), std::string::npos) << told;
  EXPECT_EQ(told.find("G 0"), std::string::npos) << told;
}

// A design's figures are those of its study, and its balls can cancel the share of their plane; lighter ones cannot.
TEST(TiltDesign, FindsBallsThatBalanceEachPlane) {
  const std::string toml = std::string(long_rotor) + R"(
[design]
objective = ["peak_radial.0.9"]
require = { balanced = { above = 0.9 } }
method = "latin"
starts = 50
trajectories = 1000
[design.vary]
"balancer.mass" = [0.001, 0.012]
)";
  const DesignResult result = design(
      DesignProblem(StudySource{toml, "study.toml", damped({"rotor.tilt.bearings_at=[2, -2]", "speed.speed=3.0"})}));
  ASSERT_TRUE(result.chosen && result.front[*result.chosen].held_out);
  const DesignSample& told = *result.front[*result.chosen].held_out;
  const Study best = parse_study(
      result.best_study, "best.toml",
      {"sampling.starts=" + std::to_string(told.starts), "sampling.seed=" + std::to_string(result.held_out_seed)});
  BasinOptions options;
  options.transients = true;
  const BasinResult basins = basin(best, options);
  EXPECT_FLOAT_EQ(
      static_cast<float>(told.figures[0].value),
      static_cast<float>(basins.transients->groups.front().figure(&TransientRow::peak_radial).quantiles[1].value));
  EXPECT_GE(basins.attractors.front().share.share, 0.9);
  double most = 0.0;
  for (const model::BallPlane& plane : model::planes_of_balls(best.parameters)) {
    EXPECT_LT(plane.rotor.eccentricity, plane.rotor.total_mass());
    most = std::max(most, plane.rotor.eccentricity);
  }
  EXPECT_GT(most, 2.0 * 0.001);  // two balls of the lightest do not
}

// The page's motions are drawn where the shaft moves more, and say where; without bearings, at the centre of mass.
TEST(TiltPages, SayWhereTheShaftIs) {
  BasinOptions options;
  const auto page_of = [&](const std::vector<std::string>& more) {
    std::vector<std::string> overrides{"speed.speed=3", "balancer.mass=0.002", "sampling.starts=30"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    const Study study = long_rotor_with(damped(overrides));
    return machine_page(study, given_machine(study), options);
  };
  const MachinePage far = page_of({"rotor.tilt.bearings_at=[2.5, -1.5]"}), centre = page_of({});
  int locked = 0;
  for (const DrawnMotion& m : far.motions) {
    ASSERT_TRUE(m.bearing);
    if (m.name.rfind("locked", 0) != 0) continue;
    ++locked;
    double radial = 0.0, at = 0.0;
    for (const double z : {2.5, -1.5}) {
      // The same start in fixed axes, long after.
      Study own = far.basin.study;
      own.initial = start_of(own, 0);
      const std::vector<Seen> all = tilting::dense(own, {{0.0, 400.0, false, 0.0}}, {z});
      if (all.back().radial > radial) at = z;
      radial = std::max(radial, all.back().radial);
    }
    EXPECT_EQ(*m.bearing, at);
    EXPECT_NEAR(m.r_max, radial, 1e-5);
    EXPECT_NEAR(m.r_min, radial, 1e-5);
  }
  EXPECT_EQ(locked, 1);
  const std::string told = machine_html(far, {}), plain = machine_html(centre, {});
  EXPECT_NE(told.find(" the shaft is "), std::string::npos);
  EXPECT_NE(told.find("at the outermost bearing that moves more"), std::string::npos);
  EXPECT_NE(told.find("at the bearing where it is largest"), std::string::npos);
  EXPECT_NE(told.find("forward whirl: "), std::string::npos);
  EXPECT_NE(told.find("static unbalance "), std::string::npos);
  EXPECT_NE(told.find("The model: a rigid tilting rotor"), std::string::npos);
  EXPECT_EQ(told.find("a rotor in a plane"), std::string::npos);
  EXPECT_EQ(told.find("The centre is "), std::string::npos);
  EXPECT_NE(plain.find("The centre is "), std::string::npos);
  EXPECT_NE(plain.find("the path of the shaft at the centre of mass"), std::string::npos);
  EXPECT_EQ(plain.find("outermost bearing"), std::string::npos);
}

}  // namespace tilt_limits_test
}  // namespace equipoise
