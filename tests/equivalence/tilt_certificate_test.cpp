// Proofs about balance of tilting rotors: proved, checked from their own data, true of the equations in fixed axes,
// and refuted once anything in them is changed.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/balanced_regions/balanced_region.hpp"
#include "equipoise/classification/proved_regions/certificate.hpp"
#include "equipoise/classification/proved_regions/level_frame.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/proof/certify.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "tilt_fixed_flow.hpp"

namespace equipoise {
namespace tilt_certificate_test {

using namespace tilting;

const std::string motor = "speed={ profile = \"torque\", torque = { stall = 0.5, no_load_speed = 4 } }";
const std::string control =
    "speed={ profile = \"torque\", torque = { gain = 2, integral = 0.5, limit = 1, target = { profile = \"constant\", "
    "speed = 4 } } }";

std::vector<std::vector<std::string>> cases() {
  return {{"speed.speed=4"}, damped({"speed.speed=4"}), damped({motor}), damped({control})};
}

// One proof of a study for all tests.
const CertifyResult& proofs(const std::vector<std::string>& overrides) {
  static std::map<std::vector<std::string>, CertifyResult> made;
  const auto at = made.find(overrides);
  return at != made.end() ? at->second : made.emplace(overrides, certify(long_rotor_with(overrides), {})).first->second;
}

TEST(TiltCertificate, IsFoundForEveryStableStateAndReadsBack) {
  for (const auto& overrides : cases()) {
    const CertifyResult& r = proofs(overrides);
    EXPECT_TRUE(r.proved()) << overrides.front() << r.note;
    ASSERT_EQ(r.states.size(), 4u);
    const CertificateFile file = checked_certificates(certificates_json(r), "file");
    ASSERT_EQ(file.states.size(), 4u);
    EXPECT_TRUE(file.proved());
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(file.states[k].certificate.form, r.states[k].certificate.form);
    EXPECT_NE(certify_text(r).find("one box"), std::string::npos);
    EXPECT_NE(check_text(file).find("4 balls"), std::string::npos);
  }
}

// On random points of the set, most of them near its edge, V decreases by the equations in fixed axes.
TEST(TiltCertificate, IsTrueInFixedAxes) {
  for (const auto& overrides : {cases()[0], cases()[1]}) {
    const CertifyResult& r = proofs(overrides);
    const Certificate& c = r.states.front().certificate;
    const model::System system = c.system();
    const Eigen::VectorXd centre = model::balanced_state(system, c.speed, c.phi.data());
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    const int size = system.dimension();
    double worst = -1e300;
    for (int i = 0; i < 4000; ++i) {
      Eigen::VectorXd y(size);
      for (double& v : y) v = normal(random);
      const Eigen::VectorXd d = c.frame * y.normalized() * std::pow(uniform(random), 1.0 / size);
      const Eigen::VectorXd rate = fixed_rate(system, centre + d);
      worst = std::max(worst, 2.0 * d.dot(c.form * rate) / d.dot(c.form * d));
    }
    EXPECT_LT(worst, 0.0);
  }
}

TEST(TiltCertificate, IsRefutedWhenChanged) {
  const Certificate good = proofs(cases()[2]).states.front().certificate;
  ASSERT_TRUE(check_certificate(good).proved);
  const std::vector<std::function<void(Certificate&)>> changes{
      [](Certificate& c) { c.level *= 10.0; },
      [](Certificate& c) { c.phi[2] += 1e-6; },
      [](Certificate& c) { c.parameters.mass[1] *= 1.001; },
      [](Certificate& c) { c.parameters.eccentricity *= 1.001; },
      [](Certificate& c) { c.parameters.eccentricity_angle += 0.001; },
      [](Certificate& c) { c.parameters.tilt.misalignment *= 1.001; },
      [](Certificate& c) { c.parameters.tilt.transverse_inertia *= 3.0; },
      [](Certificate& c) { c.parameters.tilt.plane[0] = c.parameters.tilt.plane[1] = 2.1; },
      [](Certificate& c) {
        c.parameters.tilt.damping.fill({0.0, 0.0});
        c.parameters.damping.fill(0.0);
      },
      [](Certificate& c) { c.parameters.drag.fill(0.0); },
      [](Certificate& c) { c.speed += 1e-6; },
      [](Certificate& c) { c.motor->constant *= 1.001; },
      [](Certificate& c) { c.motor->limit = 1e-9; },
      [](Certificate& c) { c.form(0, 1) += 1e-6; },
      [](Certificate& c) { c.frame(0, 0) *= 1.001; },
      [](Certificate& c) { c.parameters.gravity = 0.01; },
      [](Certificate& c) { c.parameters.tilt.stiffness[0][1] = 10.0; }};
  for (std::size_t k = 0; k < changes.size(); ++k) {
    Certificate changed = good;
    changes[k](changed);
    const CertificateResult check = check_certificate(changed);
    EXPECT_FALSE(check.proved) << k;
    EXPECT_FALSE(check.reason.empty()) << k;
  }
}

TEST(TiltCertificate, SaysWhyThereIsNone) {
  const auto reason = [](const std::vector<std::string>& overrides) {
    const Study s = long_rotor_with(overrides);
    Certificate c;
    return prove_level(s.system(), s.initial.phi.data(), Eigen::MatrixXd::Identity(16, 16), 1e-9, c).reason;
  };
  EXPECT_NE(reason({"balancer.plane=[2, 2, -2, 0]"}).find("two balls in each of two planes"), std::string::npos);
  EXPECT_NE(reason({"rotor.gravity=0.01"}).find("need gravity 0"), std::string::npos);
  EXPECT_NE(reason({"rotor.stiffness=[1, 1.1]"}).find("need equal values in x and y"), std::string::npos);
  EXPECT_NE(reason({"balancer.mass=0.001"}).find("no balanced state exists"), std::string::npos);
  EXPECT_NE(reason({"speed.speed=1"}).find("not linearly stable"), std::string::npos);
  // The reasons of one plane's continuum are not those of a tilting rotor.
  EXPECT_EQ(proofs({"balancer.plane=[2, 2, -2, -2]", "rotor.eccentricity=0", "rotor.tilt.misalignment=0"}).note,
            plane_with_nothing_to_cancel);
  EXPECT_EQ(proofs({"balancer.balls=6", "balancer.plane=[2, 2, 2, -2, -2, -2]", "initial.phi=[0, 1, 2, 3, 4, 5]"}).note,
            two_planes_of_two);
  // No form makes an unstable state one that attracts.
  const CertifyResult& unstable = proofs({"speed.speed=1"});
  EXPECT_FALSE(unstable.proved());
  EXPECT_TRUE(unstable.states.empty());
}

// Decided by proof alone, starts come to what they come to otherwise, and those that balance are proved to.
TEST(TiltCertificate, DecidesStarts) {
  const auto outcomes_of = [](const char* decide) {
    std::vector<std::pair<std::string, DecidedBy>> told;
    std::vector<Outcome> outcomes;
    BasinOptions options;
    options.outcome = [&](const Outcome& outcome) { outcomes.push_back(outcome); };
    Catalogue catalogue;
    basin(long_rotor_with(damped({"speed.speed=4", "sampling.starts=24", std::string("numerics.decide=") + decide})),
          options, &catalogue);
    for (const Outcome& outcome : outcomes) {
      const Attractor* a = catalogue.find(outcome.attractor);
      told.emplace_back(a ? a->name : "", outcome.by);
    }
    return told;
  };
  const auto validated = outcomes_of("validated"), proof = outcomes_of("proof");
  ASSERT_EQ(validated.size(), proof.size());
  int proved = 0;
  for (std::size_t i = 0; i < proof.size(); ++i) {
    EXPECT_EQ(validated[i].first, proof[i].first) << i;
    if (proof[i].first != "balanced") continue;
    EXPECT_EQ(proof[i].second, DecidedBy::proof) << i;
    ++proved;
  }
  EXPECT_GT(proved, 0);
  EXPECT_THROW(basin(long_rotor_with({"rotor.gravity=0.01", "numerics.decide=proof"}), {}), InputError);
}

}  // namespace tilt_certificate_test
}  // namespace equipoise
