// V estimated from nearby members, against V of the member that a state comes to; states that are refused without it.
#include "equipoise/classification/trapping_regions/continuum_region.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/classification/trapping_regions/trials.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {
namespace continuum_estimate_test {

// Four balls under gravity, far above the critical speed: their whole continuum attracts.
model::System grinder() {
  Study study = read_study(EQUIPOISE_SOURCE_DIR "/studies/examples/angle-grinder.toml", {"balancer.contact=false"});
  study.release = {};
  study.speed.speed = study.speed_profile().final_speed();
  study.speed.profile = Profile::constant;
  return study.system();
}

TEST(ContinuumEstimate, NeverErrsByTwiceWhatItSays) {
  const model::System system = grinder();
  const ContinuumOfEquilibria continuum(system);
  const ContinuumSample sample = continuum.sample();
  ASSERT_EQ(sample.stable, sample.drawn);
  std::vector<ContinuumMember> known, others;
  for (std::size_t k = 0; k < sample.members.size(); ++k)
    if (auto m = continuum.member(sample.members[k].data())) (k % 2 == 0 ? known : others).push_back(*std::move(m));
  ASSERT_GT(known.size(), 32u);
  const ContinuumEstimate estimate(system, known);
  const double factor = 0.01 / known.front().unit;
  const auto errors = estimate.errors(continuum, factor);
  ASSERT_GT(errors.shortfall, 0.0);
  Directions draw(continuum.directions());
  int seen = 0;
  for (const ContinuumMember& m : others) {
    const double level = ContinuumOfEquilibria::level(m, factor);
    const Eigen::VectorXd state = continuum.state_at(m, level, draw.next());
    const auto depth = estimate.depth(state, factor);
    if (!depth) continue;
    ++seen;
    EXPECT_GT(*depth * 2.0 * errors.shortfall, 1.0);
    // Equal balls, renumbered.
    Eigen::VectorXd renamed = state;
    std::swap(renamed[model::index::phi(0)], renamed[model::index::phi(3)]);
    std::swap(renamed[model::index::q(0, 4)], renamed[model::index::q(3, 4)]);
    const auto same = estimate.depth(renamed, factor);
    ASSERT_TRUE(same);
    EXPECT_NEAR(*same, *depth, 1e-9 * *depth);  // rounding of the projection onto balance
  }
  EXPECT_GT(seen, 20);
}

// Four balls in one plane of a rotor, which may tilt or have its race off its centre.
model::System four_in_a_plane(const std::vector<std::string>& overrides) {
  return parse_study(R"(
[rotor]
eccentricity = 0.01
damping = 0.02
[balancer]
balls = 4
mass = 0.005
drag = 0.01
[speed]
profile = "constant"
speed = 4.5
)",
                     "plane", overrides)
      .system();
}

// A state that is refused without its V has a V above its level, and states far off are refused.
TEST(OffContinuum, RefusesOnlyWhatIsOutside) {
  const std::vector<std::vector<std::string>> rotors{
      {},
      {"rotor.tilt={ transverse_inertia = 3.25, polar_inertia = 0.5, stiffness = [0, 9], damping = [0, 0.18] }",
       "balancer.plane=0"},
      {"balancer.race_offset=[2e-3, 1e-3]"}};
  for (const auto& overrides : rotors) {
    const model::System system = four_in_a_plane(overrides);
    const auto continuum = std::make_shared<const ContinuumOfEquilibria>(system);
    const ContinuumSample sample = continuum->sample();
    const auto typical = continuum->member(sample.typical.data());
    ASSERT_TRUE(typical && typical->form.size() > 0);
    ContinuumRegion region{continuum, 0.04 / typical->unit, 0.1 * sample.fastest_rate, typical->centre.head(4), 0.2,
                           nullptr};
    region.off = std::make_shared<const OffContinuum>(system);
    ContinuumRegion by_v = region;
    by_v.off.reset();
    Directions draw(continuum->directions());
    const std::size_t count = sample.members.size(), step = count / 24;
    int inside = 0, refused = 0, far = 0;
    for (std::size_t k = 0; k < count; k += step) {
      const auto m = continuum->member(sample.members[k].data());
      if (!m || m->form.size() == 0) continue;
      const double level = ContinuumOfEquilibria::level(*m, region.factor);
      for (const double share : {0.25, 0.9, 4.0, 64.0, 1000.0}) {
        const Eigen::VectorXd state = continuum->state_at(*m, share * level, draw.next());
        EXPECT_LE(region.off->least(state), std::sqrt(share * level) * (1.0 + 1e-6));  // 1e-6: rounding of forms
        const bool holds = by_v.holds(state);
        EXPECT_EQ(region.holds(state), holds) << share << " " << m->rate;
        inside += holds;
      }
      Eigen::VectorXd off = m->centre;
      off[0] += 2.0 * system.parameters().all_unbalances();
      off[model::index::phi(0)] += 1.0;
      ++far;
      refused += region.off->least(off) > 1.0;
    }
    EXPECT_GT(inside, 20);
    EXPECT_EQ(refused, far);
  }
  EXPECT_EQ(OffContinuum(grinder()).least(Eigen::VectorXd::Ones(grinder().dimension())), 0.0);  // balls rock in balance
}

}  // namespace continuum_estimate_test
}  // namespace equipoise
