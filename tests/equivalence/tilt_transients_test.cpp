// Figures of transients of a tilting rotor, next to trajectories in fixed axes that are sampled densely.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/attractors/motions/motion_figures.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/whirl.hpp"
#include "equipoise/simulation/spin_up/held_run.hpp"
#include "equipoise/study/sampling/starts.hpp"
#include "tilt_dense.hpp"
#include "transient_lanes.hpp"

namespace equipoise {
namespace tilt_transients_test {

using namespace tilting;

constexpr double no_window_ends = 1e6;

struct Case {
  const char* name;
  std::vector<std::string> overrides;
  std::vector<double> places;  // of bearings, or the centre of mass
  double displacement, settled;
  std::vector<StatedBearing> bearings{};  // if forces are told of each
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class TiltTransients : public testing::TestWithParam<Case> {};

TEST_P(TiltTransients, AreThoseOfFixedAxes) {
  const Case& c = GetParam();
  std::vector<std::string> overrides = damped({});
  overrides.insert(overrides.end(), c.overrides.begin(), c.overrides.end());  // the case's own come last
  Study study = long_rotor_with(overrides);
  study.limits.displacement = c.displacement;
  study.limits.settled = c.settled;
  TransientSettings asked = transient_settings(study);
  EXPECT_EQ(asked.shaft.bearings.size(), c.bearings.size());
  asked.window = no_window_ends;
  const double horizon = 60.0;
  const double last_begin = std::max(study.speed_profile().settled_time(), study.release_time());
  const std::vector<TransientRow> rows = gathered(study, asked, 4, horizon);
  bool differs = false;  // lanes see more than the centre
  for (std::size_t i = 0; i < rows.size(); ++i) {
    start_angles(study.sampling.seed, i, study.parameters.balls, study.initial.phi.data());
    const auto run = stretches(study, last_begin + horizon);
    expect_same_figures(rows[i], figures(asked, tilting::dense(study, run, c.places, c.bearings), last_begin),
                        std::string(c.name) + ", start " + std::to_string(i), 0.0, asked.by_direction);
    const TransientRow centre = figures(asked, tilting::dense(study, run, {0.0}), last_begin);
    differs = differs || rows[i].peak_radial > 1.1f * centre.peak_radial;
  }
  EXPECT_EQ(differs, c.places != std::vector<double>{0.0}) << c.name;
}

const std::string ramp = "speed={ profile = \"ramp\", initial = 0.0, final = 3.5, duration = 40 }";
const std::vector<std::string> skew{"rotor.gravity=0.02",
                                    "rotor.stiffness=[1, 1.3]",
                                    "rotor.tilt.stiffness={ x = [0.3, 9], y = [0.4, 10] }",
                                    "rotor.tilt.damping={ x = [0.05, 1.8], y = [0.03, 1.6] }",
                                    "balancer.mass=[0.005, 0.006, 0.007, 0.004]",
                                    "rotor.tilt.bearings_at=[3, -2, 0.5]",
                                    ramp,
                                    "release.speed=2.5"};

// Supports that two unlike bearings make: sums of stiffness and damping, and their moments.
const std::vector<StatedBearing> unlike{{3.0, {0.6, 0.7}, {0.12, 0.1}}, {-2.0, {0.4, 0.6}, {0.08, 0.1}}};
const std::vector<std::string> on_unlike{"rotor.gravity=0.02",
                                         "rotor.stiffness=[1, 1.3]",
                                         "rotor.damping=[0.2, 0.2]",
                                         "rotor.tilt.stiffness={ x = [1, 7], y = [0.9, 8.7] }",
                                         "rotor.tilt.damping={ x = [0.2, 1.4], y = [0.1, 1.3] }",
                                         "rotor.tilt.bearings_at=[3, -2]",
                                         "balancer.drag=0.3",
                                         ramp,
                                         "release.speed=2.5"};

// Three, of which that in the middle takes most: the weight rests on it.
const std::vector<StatedBearing> three{
    {-2.0, {0.1, 0.1}, {0.05, 0.05}}, {0.5, {0.7, 0.9}, {0.1, 0.12}}, {3.0, {0.2, 0.3}, {0.05, 0.03}}};
const std::vector<std::string> on_three{"rotor.gravity=0.02",
                                        "rotor.stiffness=[1, 1.3]",
                                        "rotor.damping=[0.2, 0.2]",
                                        "rotor.tilt.stiffness={ x = [0.75, 2.375], y = [1.15, 3.325] }",
                                        "rotor.tilt.damping={ x = [0.1, 0.675], y = [0.05, 0.5] }",
                                        "rotor.tilt.bearings_at=[-2, 0.5, 3]",
                                        "rotor.tilt.bearings_stiffness=[0.1, 0.1, 0.7, 0.9, 0.2, 0.3]",
                                        "rotor.tilt.bearings_damping=[0.05, 0.05, 0.1, 0.12, 0.05, 0.03]",
                                        "balancer.drag=0.3",
                                        ramp,
                                        "release.speed=2.5"};

INSTANTIATE_TEST_SUITE_P(
    All, TiltTransients,
    testing::Values(Case{"constant speed", {"rotor.tilt.bearings_at=[2.5, -1.5]"}, {2.5, -1.5}, 0.03, 0.01},
                    Case{"no bearings stated", {}, {0.0}, 0.008, 0.004},
                    Case{
                        "ramp, held to its end", {"rotor.tilt.bearings_at=[2.5, -2.5]", ramp}, {2.5, -2.5}, 0.03, 0.02},
                    Case{"gravity and unequal supports, let go on the way", skew, {3.0, -2.0, 0.5}, 0.05, 0.02},
                    Case{"two like bearings, each by itself",
                         {"rotor.tilt.bearings_at=[3, -3]"},
                         {3.0, -3.0},
                         0.03,
                         0.01,
                         {{3.0, {0.5, 0.5}, {0.1, 0.1}}, {-3.0, {0.5, 0.5}, {0.1, 0.1}}}},
                    Case{"two unlike bearings under gravity", on_unlike, {3.0, -2.0}, 0.05, 0.02, unlike},
                    Case{"three bearings, each by itself", on_three, {3.0, -2.0}, 0.05, 0.02, three}),
    [](const auto& param) { return std::to_string(param.index); });

// The same drive's work by the torque that fixed axes ask for.
TEST(TiltDriveWork, IsThatOfTheTorqueInFixedAxes) {
  for (const std::vector<std::string>& overrides : {std::vector<std::string>{}, skew}) {
    Study study = long_rotor_with(damped(overrides));
    const TransientSettings asked = transient_settings(study);
    ASSERT_EQ(asked.work, WorkSource::balance);
    const double horizon = 20.0, begin = std::max(study.speed_profile().settled_time(), study.release_time());
    const TransientRow row = gathered(study, asked, 1, horizon).front();
    start_angles(study.sampling.seed, 0, study.parameters.balls, study.initial.phi.data());
    std::array<double, most> y =
        first_state(study, study.speed.profile == Profile::constant ? study.speed.speed : study.speed.initial);
    double work = 0.0;
    double piece = 0.0, last_rate = 0.0;
    for (const Stretch& one : stretches(study, begin + horizon)) {
      if (one.acceleration != last_rate) {
        work += std::max(piece, 0.0);
        piece = 0.0;
      }
      last_rate = one.acceleration;
      const FixedFlow flow{study.parameters, one.held, one.acceleration};
      // psi'' is linear in the torque. Of held balls the torque is that which gives them the rotor's acceleration.
      const auto power = [&](const double* at) {
        const Fixed f = flow.state(at);
        const model::Parameters& p = study.parameters;
        double torque = 0.0;
        if (one.held) {
          const VectorXd a = flow.as_one(f);
          const Complex c(a[0], a[1]), s(a[2], a[3]);
          const Complex own = std::polar(p.eccentricity, f.psi + p.eccentricity_angle);
          const auto about = [](Complex arm, Complex of) { return (std::conj(arm) * of).imag(); };
          torque = (p.inertia + p.eccentricity * p.eccentricity) * one.acceleration + about(own, c + i1 * p.gravity) +
                   about(p.tilt.couple() * std::polar(1.0, f.psi), s);
          for (int i = 0; i < p.balls; ++i) {
            const Complex arm = std::polar(1.0, f.theta[i]);
            torque += p.mass[i] * (about(arm, c + p.tilt.plane[i] * s + i1 * p.gravity) + one.acceleration);
          }
        } else {
          const double none = 0.0, some = 1.0;
          const int last = 4 + p.balls;
          const double a0 = accelerations(p, f, &none, 0.0)[last], a1 = accelerations(p, f, &some, 0.0)[last];
          torque = (one.acceleration - a0) / (a1 - a0);
        }
        return torque * f.w;
      };
      const int count = static_cast<int>(std::ceil((one.end - one.begin) * 100.0));
      double before = power(y.data());
      for (int k = 0; k < count; ++k) {
        const double h = (one.end - one.begin) / count, t = one.begin + h * k;
        ASSERT_TRUE(advance(flow, t, t + h, y, 1e-11));
        const double now = power(y.data());
        piece += 0.5 * h * (before + now);
        before = now;
      }
    }
    work += std::max(piece, 0.0);
    EXPECT_NEAR(row.energy, work, 5e-4 * work);
  }
}

// With balls held, and without: peaks on the way as in fixed axes, and at the end forced vibration.
void is_that_of_fixed_axes(const std::vector<std::string>& overrides, const std::vector<double>& places,
                           const std::vector<StatedBearing>& bearings) {
  for (const bool balls : {true, false}) {
    Study study = with_horizon(long_rotor_with(overrides));
    start_angles(7, 1, study.parameters.balls, study.initial.phi.data());
    InitialState start = study.initial;
    if (!balls) take_balls_off(study, start);
    study.initial = start;
    const TransientSettings asked = transient_settings(study);
    const HeldRun run = follow_held(study, start, asked);
    ASSERT_TRUE(run.steady && run.end && !run.lost);
    const double ramped = study.speed.duration, until = ramped + 150.0;
    const double rate = study.speed.final / ramped;
    std::vector<Seen> all =
        tilting::dense(study, {{0.0, ramped, true, rate}, {ramped, until, true, 0.0}}, places, bearings);
    const TransientRow told = transient_row(asked, run.sums, false, run.end),
                       expected = figures(asked, all, until - 60.0);
    for (const auto peak : {&TransientRow::peak_radial, &TransientRow::peak_radial_at_end, &TransientRow::peak_force})
      EXPECT_NEAR(told.*peak, expected.*peak, 0.001f * expected.*peak) << balls;
    // The mean over 60 units of time is not over whole turns.
    for (const auto mean : {&TransientRow::rms_force, &TransientRow::rms_velocity})
      EXPECT_NEAR(told.*mean, expected.*mean, 0.01f * expected.*mean) << balls;
    EXPECT_NEAR(told.residual_unbalance, expected.residual_unbalance, 1e-6f) << balls;
  }
}

TEST(TiltHeldRun, IsThatOfFixedAxes) {
  std::vector<std::string> overrides = damped(skew);
  overrides.push_back("rotor.tilt.bearings_at=[2.5, -1.5]");
  is_that_of_fixed_axes(overrides, {2.5, -1.5}, {});
}

TEST(TiltHeldRun, LoadsEachBearingAsInFixedAxes) { is_that_of_fixed_axes(on_unlike, {3.0, -2.0}, unlike); }

// The slowest of the rates with which fixed axes die out, by the eigenvalues of one body.
TEST(TiltHeldRun, KnowsHowSlowlyVibrationDiesOut) {
  const Study study = long_rotor_with(damped({"rotor.tilt.damping=[0.02, 1.8]"}));
  const model::Parameters& p = study.parameters;
  const double w = 3.5, step = 1e-6;
  model::Parameters balanced = p;
  balanced.eccentricity = balanced.tilt.misalignment = 0.0;
  for (int i = 0; i < p.balls; i += 2) balanced.mass[i] = balanced.mass[i + 1];
  const FixedFlow flow{balanced, true, 0.0};
  const std::vector<int> kept{0, 1, 2, 3, 9, 10, 11, 12};  // X, Y, SX, SY and their rates
  MatrixXd jacobian(8, 8);
  std::array<double, most> rest{}, dy{}, moved{};
  for (int i = 0; i < 4; ++i) rest[4 + i] = i % 2 ? 0.0 : 3.14159265358979323846;  // opposite balls in each plane
  for (int i = 0; i < 5; ++i) rest[9 + 4 + i] = w;
  flow(0.0, rest.data(), dy.data());
  for (int k = 0; k < 8; ++k) {
    std::array<double, most> y = rest;
    y[kept[k]] += step;
    flow(0.0, y.data(), moved.data());
    for (int r = 0; r < 8; ++r) jacobian(r, k) = (moved[kept[r]] - dy[kept[r]]) / step;
  }
  const double slowest = -equipoise::dense::largest_real_part(jacobian);
  EXPECT_GT(slowest, 0.01);
  EXPECT_NEAR(model::slowest_decay(p, w), slowest, 1e-6);
}

// In exact balance nothing moves; locked, both bearings do, as the equilibrium in fixed axes says.
TEST(TiltMotionFigures, AreThoseOfTheMotion) {
  Study study = long_rotor_with(damped({"speed.speed=3", "balancer.mass=0.002", "rotor.tilt.bearings_at=[2.5, -1.5]"}));
  study.sampling.starts = 40;
  BasinOptions options;
  options.transients = true;
  Catalogue catalogue;
  const BasinResult result = basin(study, options, &catalogue);
  const TransientSettings asked = transient_settings(study);
  int checked = 0;
  for (const Attractor& a : catalogue.attractors()) {
    if (a.motion.kind != MotionKind::equilibrium || a.motion.state.size() == 0) continue;
    const int tilt = study.system().layout().tilt;
    double radial = 0.0;
    for (const double z : {2.5, -1.5})
      radial = std::max(radial, std::hypot(a.motion.state[0] + z * a.motion.state[tilt],
                                           a.motion.state[1] + z * a.motion.state[tilt + 1]));
    const MotionFigures told = motion_figures(study.parameters, a.motion, asked.shaft);
    EXPECT_NEAR(told.radial, radial, 1e-9) << a.name;
    EXPECT_NEAR(told.rms_velocity, 3.0 * radial, 1e-8) << a.name;
    for (const TransientGroup& g : result.transients->groups)
      if (g.id == a.id && g.starts > 0) {
        EXPECT_NEAR(g.figure(&TransientRow::peak_radial_at_end).largest, radial, 1e-6 * radial + 1e-9) << a.name;
        ++checked;
      }
  }
  EXPECT_GE(checked, 1);
}

}  // namespace tilt_transients_test
}  // namespace equipoise
