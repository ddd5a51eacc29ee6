// Capacity in g mm, and against limits: each trial as the same ensemble counted start by start.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "equipoise/base/error.hpp"
#include "equipoise/ensembles/basin.hpp"
#include "equipoise/sweeps/capacity.hpp"
#include "equipoise/sweeps/sweep_axis.hpp"
#include "equipoise/sweeps/sweep_plan.hpp"

namespace equipoise {
namespace {

const std::string machine = R"([rotor]
mass = "4 kg"
stiffness = "10 kN/m"
damping_ratio = 0.25
eccentricity = "0.1 mm"
[[place]]
mass = "4 g"
radius = "100 mm"
angle = "90 degree"
[balancer]
balls = 2
race_radius = "60 mm"
mass = "20 g"
drag = "1e-4 N m s"
[speed]
speed = "1500 rpm"
[limits]
velocity = "10 mm/s"
[sampling]
starts = 50
)";

TEST(Capacity, AnUnbalanceIsOneQuantity) {
  const StudySource source{machine, "machine", {}};
  const StudySource one = with_unbalance(source, {});
  EXPECT_TRUE(one.states("rotor.unbalance"));
  EXPECT_FALSE(one.states("rotor.eccentricity"));
  EXPECT_FALSE(one.states("place"));
  // 400 g mm across and 400 g mm along.
  const Study study = one.with();
  EXPECT_NEAR(study.parameters.eccentricity * study.scales->unbalance() * 1e6, std::sqrt(2.0) * 400.0, 1e-9);
  EXPECT_NEAR(study.parameters.eccentricity, source.with().parameters.eccentricity, 1e-15);
  EXPECT_EQ(capacity_key(one, "", "of"), "rotor.unbalance");
  const std::vector<SweepAxis> over = sweep_axes({"rotor.eccentricity=0.1 mm,0.2 mm"}, false, "over");
  EXPECT_FALSE(with_unbalance(source, over).states("rotor.unbalance"));
}

TEST(Capacity, IsAgainstTheLimitThatIsAskedFor) {
  const StudySource source = with_unbalance({machine, "machine", {}}, {});
  CellRequest request;
  request.transients = true;
  const SweepPlan plan(source, {}, request, "over");
  CapacityOptions options;
  options.key = "rotor.unbalance";
  options.unit = "g mm";
  options.from = 100.0;
  options.to = 3000.0;
  options.precision = 0.05;
  options.by = "velocity";
  const CapacityResult r = capacity(plan, options);
  ASSERT_TRUE(r.cells[0]);
  for (const CapacityTrial& t : r.cells[0]->trials) {
    BasinOptions run;
    run.keep_starts = true;
    const Study study = source.with({"rotor.unbalance=" + std::to_string(t.value) + " g mm"});
    const BasinResult b = basin(study, run);
    std::uint64_t kept = 0;
    for (const float v : *b.every_start->transient("rms_velocity"))
      kept += v * study.scales->velocity() * 1000.0 <= 10.0;
    EXPECT_EQ(t.balanced.count, kept) << t.value;
  }
  EXPECT_EQ(r.asked(), "keep limits.velocity");
  options.by = "force";
  EXPECT_THROW(capacity(plan, options), InputError);
}

}  // namespace
}  // namespace equipoise
