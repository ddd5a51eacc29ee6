// Anisotropic supports and gravity: the stroboscopic map against the linearisation and simulate(), motions and shares
// against the isotropic rotor as their limit, decisions against longer integration.
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "../support/sizes.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/start_source.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise {
namespace stroboscopic_test {

// The paper's rotor at Omega = 2.4.
Study paper_rotor(double gravity, std::array<double, 2> stiffness) {
  Study study;
  study.name = "rotor";
  study.parameters.mass = {0.05, 0.05};
  study.parameters.drag = {0.05, 0.05};
  study.parameters.gravity = gravity;
  study.parameters.stiffness = stiffness;
  study.speed.profile = Profile::constant;
  study.speed.speed = 2.4;
  return study;
}

std::vector<Outcome> outcomes_of(const Session& runner, RunCatalogue& catalogue, std::size_t count) {
  Decided decided;
  EXPECT_TRUE(runner.decide(0, count, decided));
  catalogue.settle(decided);
  return decided.outcomes;
}

// Names without what distinguishes a modulated motion from its plain form: gravity turns "co-drifting" into
// "co-drifting, quasi-periodic".
std::string plain_name(const Catalogue& catalogue, const Outcome& outcome) {
  const Attractor* a = catalogue.find(outcome.attractor);
  return a ? a->name.substr(0, a->name.find(',')) : "";
}

// Simulates from psi = 0 for whole strobes; returns the distance from the orbit's own state at the end.
double closure(const Study& study, const Motion& motion) {
  const model::Parameters& p = study.parameters;
  Study alone = study;
  double z[model::dimension(model::max_balls)];
  std::copy(motion.state.begin(), motion.state.end(), z);
  const double w = study.speed.speed;
  alone.initial.x = z[0];
  alone.initial.y = z[1];
  alone.initial.x_dot = z[2] + w * z[1];
  alone.initial.y_dot = z[3] - w * z[0];
  for (int i = 0; i < p.balls; ++i) {
    alone.initial.phi[i] = z[model::index::phi(i)];
    alone.initial.phi_dot[i] = z[model::index::q(i, p.balls)];
  }
  const Trajectory path = simulate(alone, {0.0, motion.period});
  double miss = std::max(std::fabs(path.x.back() - z[0]), std::fabs(path.y.back() - z[1]));
  for (int i = 0; i < p.balls; ++i)
    miss = std::max({miss, std::fabs(wrapped(path.phi[i].back() - z[model::index::phi(i)])),
                     std::fabs(path.phi_dot[i].back() - z[model::index::q(i, p.balls)])});
  return miss;
}

TEST(Stroboscopic, MultipliersOfTheBalancedStateAreThoseOfItsEigenvalues) {
  // Isotropic supports up to rounding: the general equations, for a motion whose multipliers are known.
  model::Parameters p = paper_rotor(0.0, {1.0, 1.0 + 1e-13}).parameters;
  ASSERT_TRUE(model::depends_on_rotor_angle(p));
  model::Parameters isotropic = p;
  isotropic.stiffness = {1.0, 1.0};
  const auto phi = model::balanced_states(isotropic).angles.front();
  const auto orbit = balanced_orbit({p, 2.4}, phi.data());
  ASSERT_TRUE(orbit);
  const Eigen::VectorXcd rates = equipoise::dense::eigenvalues(
      model::jacobian(isotropic, 2.4, model::centred_state(isotropic, phi.data()).data()));
  ASSERT_EQ(orbit->multipliers.size(), rates.size());
  for (const std::complex<double>& rate : rates) {
    const std::complex<double> expected = std::exp(rate * model::section_period(p, 2.4));
    double nearest = 1e300;
    for (const auto& m : orbit->multipliers) nearest = std::min(nearest, std::abs(m - expected));
    EXPECT_LT(nearest, 1e-9);  // integration at 1e-12 a step, some twenty steps
  }
}

TEST(Stroboscopic, OrbitsCloseUnderSimulate) {
  const Study study = paper_rotor(0.01, {1.0, 1.3});
  const auto phi = model::balanced_states(paper_rotor(0.0, {1.0, 1.0}).parameters).angles.front();
  const auto orbit = balanced_orbit({study.parameters, 2.4}, phi.data());
  ASSERT_TRUE(orbit);
  EXPECT_LE(orbit->residual, 1e-9);
  const Motion motion = describe_orbit({study.parameters, 2.4}, *orbit);
  EXPECT_TRUE(motion.balanced);
  EXPECT_EQ(motion_name(study.parameters, motion).name, "balanced");
  EXPECT_EQ(motion.kind, MotionKind::periodic);
  EXPECT_NEAR(motion.period, two_pi / 2.4, 1e-12);
  EXPECT_GT(motion.r_max, 1e-5);  // gravity rocks the balls, and the rotor vibrates
  // The residual of Newton's method, and what simulate() adds over a revolution.
  EXPECT_LT(closure(study, motion), 1e-9);
}

TEST(Stroboscopic, WeakGravityAndAnisotropyChangeNextToNothing) {
  constexpr std::size_t count = 500;
  Session plain(paper_rotor(0.0, {1.0, 1.0}), {.threads = 2}),
      weak(paper_rotor(1e-6, {1.0, 1.0 + 1e-6}), {.threads = 2});
  RunCatalogue of_plain(plain), of_weak(weak);
  const auto before = outcomes_of(plain, of_plain, count), after = outcomes_of(weak, of_weak, count);
  std::size_t other = 0, undecided = 0;
  for (std::size_t i = 0; i < count; ++i) {
    undecided += after[i].attractor == 0;
    other += plain_name(of_plain, before[i]) != plain_name(of_weak, after[i]);
  }
  EXPECT_EQ(undecided, 0u);
  // Starts may differ only within about 1e-6 of a boundary, or if a chaotic transient is so long that rounding decides.
  EXPECT_LE(other, 5u);
}

TEST(Stroboscopic, ADriftingMotionIsModulatedByGravity) {
  const Study study = paper_rotor(1e-3, {1.0, 1.0});
  Eigen::VectorXd state = Eigen::VectorXd::Zero(8);
  state[4] = state[5] = 1.0;  // balls together: they co-drift
  const auto motion = motion_from({study.parameters, 2.4}, state, 8000.0);
  ASSERT_TRUE(motion);
  EXPECT_TRUE(motion->depends_on_angle);
  EXPECT_EQ(motion->kind, MotionKind::quasi_periodic);
  EXPECT_EQ(motion_name(study.parameters, *motion).name.rfind("co-drifting", 0), 0u);
  EXPECT_NEAR(motion->exponents[0], 0.0, 2e-3);  // 8 / duration, as classified
  EXPECT_LT(motion->exponents[1], 0.0);
}

TEST(Stroboscopic, DecisionsHoldMuchLater) {
  for (const Study& study : {paper_rotor(0.01, {1.0, 1.0}), paper_rotor(0.0, {1.0, 1.3})}) {
    constexpr std::size_t count = 128;
    Session runner(study, {.threads = 2});
    const Attractor* balanced = runner.catalogue().find(balanced_id);
    ASSERT_TRUE(balanced);
    EXPECT_TRUE(balanced->motion.stable);
    EXPECT_EQ(balanced->motion.kind, study.parameters.gravity == 0.0 ? MotionKind::equilibrium : MotionKind::periodic);
    RunCatalogue catalogue(runner);
    const auto early = outcomes_of(runner, catalogue, count);
    StartSource source(study, nullptr);
    SpunUp starts;
    ASSERT_TRUE(source.make(study.sampling.seed, 0, count, starts));
    std::vector<Outcome>& late = starts.outcomes;
    ClassificationRule rule = runner.rule();
    rule.at_horizon = true;
    BatchTask task = source.task(0, starts.states);
    task.end = 2000.0;
    ASSERT_TRUE(classify_batch(task, rule, late, nullptr));
    std::size_t decided = 0, confirmed = 0, contradicted = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (early[i].attractor == 0) continue;
      ++decided;
      confirmed += late[i].attractor == early[i].attractor;
      contradicted += late[i].attractor != 0 && late[i].attractor != early[i].attractor;
    }
    EXPECT_GE(decided, count - 4);
    EXPECT_EQ(contradicted, 0u);
    EXPECT_GE(confirmed, decided - 4);  // random windows of a torus fit no box
  }
}

std::vector<Outcome> outcomes_on(const Study& study, int threads) {
  std::vector<Outcome> outcomes;
  BasinOptions options;
  options.threads = threads;
  options.outcome = [&](const Outcome& outcome) { outcomes.push_back(outcome); };
  basin(study, options);
  return outcomes;
}

// Two unequal balls with gravity and anisotropic supports; three unequal balls on anisotropic supports, whose balance
// is a continuum. 600 starts are more than a chunk, so that two threads share them.
TEST(Stroboscopic, DecidedStartsHaveTheSameBitsOnAnyNumberOfThreadsAndAlone) {
  Study two = paper_rotor(0.01, {1.0, 1.2});
  two.parameters.mass = {0.05, 0.045};
  two.parameters.damping = {0.5, 0.6};
  two.sampling.starts = sized(600, 60);
  Study three = paper_rotor(0.0, {1.0, 1.2});
  three.parameters.balls = 3;
  three.parameters.mass = {0.02, 0.018, 0.022};
  three.parameters.drag = {0.25, 0.24, 0.25};
  three.speed.speed = 3.0;
  three.sampling.starts = two.sampling.starts;
  for (const Study& study : {two, three}) {
    const std::vector<Outcome> one = outcomes_on(study, 1), shared = outcomes_on(study, 2);
    ASSERT_EQ(one.size(), study.sampling.starts);
    ASSERT_EQ(shared.size(), one.size());
    std::size_t decided = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
      decided += one[i].kind == OutcomeKind::attracted;
      EXPECT_EQ(one[i].kind, shared[i].kind) << i;
      EXPECT_EQ(one[i].attractor, shared[i].attractor) << i;
      EXPECT_EQ(one[i].time, shared[i].time) << i;
      EXPECT_EQ(one[i].by, shared[i].by) << i;
    }
    EXPECT_GE(decided, one.size() * 9 / 10);     // bits of undecided starts show nothing about decisions
    const std::uint64_t index = sized(311, 31);  // in the middle: each single start costs another search
    const StartReplay alone = replay_start(study, index);
    EXPECT_EQ(alone.outcome.attractor, one[index].attractor);
    EXPECT_EQ(alone.outcome.time, one[index].time);
  }
}

}  // namespace stroboscopic_test
}  // namespace equipoise
