// Capacity in g mm, and against limits: each trial as the same ensemble counted start by start.
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/sweeps/capacity.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/core/base/error.hpp"

namespace equipoise {
namespace capacity_goals_test {

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

const std::string spindle = R"([rotor]
mass = "6 kg"
eccentricity = "10 um"
eccentricity_angle = "70 degree"
[rotor.tilt]
transverse_inertia = "0.03 kg m2"
polar_inertia = "0.045 kg m2"
misalignment = "0.01 degree"
bearings = [
  { at = "-60 mm", stiffness = "900 kN/m", damping = "900 N s/m" },
  { at = "-200 mm", stiffness = "700 kN/m", damping = "700 N s/m" },
]
unbalance = [ { at = "20 mm", size = "300 g mm", angle = "25 degree" } ]
[[place]]
mass = "2 g"
radius = "50 mm"
angle = "100 degree"
at = "-30 mm"
[balancer]
balls = 4
race_radius = "60 mm"
plane = ["20 mm", "20 mm", "-20 mm", "-20 mm"]
mass = "20 g"
drag = "0.2 N s/m"
[speed]
profile = "constant"
speed = "9000 rpm"
[sampling]
starts = 12
)";

// Static and couple unbalance of an override's rotor, from its sums by hand.
struct InPlanes {
  std::complex<double> force, couple;
};
InPlanes by_hand(double factor) {
  constexpr double degree = 3.141592653589793 / 180.0;
  const std::complex<double> own = std::polar(60.0, 70.0 * degree), plane = std::polar(300.0, 25.0 * degree),
                             place = std::polar(100.0, 100.0 * degree);  // g mm
  const double misaligned = 0.01 * degree * (0.03 - 0.045) * 1e9;        // g mm^2
  return {factor * (own + plane + place), factor * (20.0 * plane - 30.0 * place + misaligned)};
}

// Planes, places and the couple of a tilting rotor grow in proportion, and none of them counts twice.
TEST(Capacity, OfARotorThatTiltsScalesAllItsUnbalances) {
  const StudySource source{spindle, "spindle", {}}, one = with_unbalance(source, {});
  EXPECT_TRUE(one.states("rotor.unbalance"));
  EXPECT_FALSE(one.states("place"));
  const Study before = source.with(), after = one.with();
  EXPECT_NEAR(after.parameters.eccentricity, before.parameters.eccentricity, 1e-14);
  EXPECT_NEAR(after.parameters.eccentricity_angle, before.parameters.eccentricity_angle, 1e-9);
  EXPECT_NEAR(after.parameters.tilt.couple(), before.parameters.tilt.couple(), 1e-14);
  EXPECT_NEAR(after.parameters.eccentricity * after.scales->unbalance() * 1e6, std::abs(by_hand(1.0).force), 1e-9);

  CapacityOptions options;
  options.key = "rotor.unbalance";
  options.unit = "g mm";
  for (const double factor : {0.5, 3.0}) {
    const double value = factor * std::abs(by_hand(1.0).force);
    const model::Parameters p = capacity_study(SweepPlan(one, {}, {}, "over"), options, 0, value).parameters;
    const InPlanes wanted = by_hand(factor);
    const double to_force = after.scales->unbalance() * 1e6, to_couple = to_force * after.scales->length * 1e3;
    EXPECT_NEAR(p.eccentricity * to_force, value, 1e-9 * value);
    EXPECT_NEAR(std::abs(p.tilt.couple()) * to_couple, std::abs(wanted.couple), 1e-9 * std::abs(wanted.couple));
    const double between = std::arg(wanted.force / wanted.couple);
    EXPECT_NEAR(std::remainder(p.eccentricity_angle + (p.tilt.couple() < 0.0 ? 3.141592653589793 : 0.0) - between,
                               2.0 * 3.141592653589793),
                0.0, 1e-9);
  }
}

TEST(Capacity, SaysWhereNoStaticUnbalanceMeasuresIt) {
  const auto problem = [](const StudySource& source, const std::vector<SweepAxis>& axes) -> std::string {
    try {
      with_unbalance(source, axes);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  StudySource couple{spindle,
                     "spindle",
                     {R"(rotor.tilt.unbalance=[{at="20 mm", size="300 g mm", angle=0}, {at="-20 mm", size="300 g mm", )"
                      R"(angle="180 degree"}])",
                      "rotor.eccentricity=0 mm"}};
  couple.toml.erase(couple.toml.find("[[place]]"), couple.toml.find("[balancer]") - couple.toml.find("[[place]]"));
  EXPECT_NE(problem(couple, {}).find("--of rotor.tilt.unbalance.1.size"), std::string::npos);
  const StudySource source{spindle, "spindle", {}};
  EXPECT_EQ(problem(source, {}), "");
  EXPECT_NE(
      problem(source, sweep_axes({"rotor.tilt.misalignment=0.1 degree,0.2 degree"}, false, "over")).find("varied"),
      std::string::npos);
}

TEST(Capacity, IsAgainstTheLimitThatIsAskedFor) {
  const StudySource source = with_unbalance({machine, "machine", {}}, {});
  BasinOptions request;
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

}  // namespace capacity_goals_test
}  // namespace equipoise
