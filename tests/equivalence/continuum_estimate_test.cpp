// V estimated from nearby members, against V of the member that a state comes to.
#include "equipoise/trapping_regions/continuum_estimate.hpp"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/model/parameters.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/trapping_regions/trials.hpp"

namespace equipoise {
namespace {

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
  const ContinuumSurvey survey = continuum.survey();
  ASSERT_EQ(survey.stable, survey.drawn);
  std::vector<ContinuumMember> known, others;
  for (std::size_t k = 0; k < survey.members.size(); ++k)
    if (auto m = continuum.member(survey.members[k].data())) (k % 2 == 0 ? known : others).push_back(*std::move(m));
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

}  // namespace
}  // namespace equipoise
