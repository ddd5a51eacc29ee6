// The balance grade of a tilting rotor: its unbalance in the planes of two bearings, next to trajectories in fixed
// axes that are sampled densely, next to a rotor that cannot tilt, and by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/machine/balance/tolerance_planes.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/report/shown/machine_page.hpp"
#include "equipoise/results/commands/left_grade.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "../support/explained.hpp"
#include "../support/refusals.hpp"
#include "tilt_dense.hpp"

namespace equipoise {
namespace tilt_grade_test {

using namespace tilting;
using Planes = std::array<double, 2>;

// The lever rule, and its bounds.
TEST(ToleranceShares, AreThoseOfTheStandard) {
  const auto expect = [](const Planes& planes, double a, double b) {
    const Planes shares = model::tolerance_shares(planes);
    EXPECT_NEAR(shares[0], a, 1e-15) << planes[0] << ", " << planes[1];
    EXPECT_NEAR(shares[1], b, 1e-15) << planes[0] << ", " << planes[1];
  };
  expect({-2.0, 2.0}, 0.5, 0.5);
  expect({-2.0, 3.0}, 0.6, 0.4);
  expect({3.0, -2.0}, 0.4, 0.6);
  expect({-1.5, 3.5}, 0.7, 0.3);
  expect({-0.5, 4.5}, 0.7, 0.3);  // the rule gives 0.9 and 0.1
  expect({0.0, 4.0}, 0.7, 0.3);   // and here 1 and 0
  // The centre of mass overhangs the nearer plane.
  expect({1.0, 5.0}, 1.25, 0.3);
  expect({-5.0, -1.0}, 0.3, 1.25);
  expect({2.0, 5.0}, 1.3, 2.0 / 3.0);
}

TEST(TolerancePlanes, AreThoseOfTheOutermostBearings) {
  EXPECT_EQ(model::tolerance_planes({3.0, -2.0, 0.5}), (Planes{-2.0, 3.0}));
  EXPECT_FALSE(model::tolerance_planes({}));
  EXPECT_FALSE(model::tolerance_planes({1.0}));
  EXPECT_FALSE(model::tolerance_planes({1.0, 1.0}));
}

// What is in one plane shows in that alone; a couple in both alike; what is at the centre of mass is its size.
TEST(PlaneUnbalances, HoldWhatIsThere) {
  model::Parameters p = long_rotor_with().parameters;
  p.eccentricity = p.tilt.misalignment = 0.0;
  p.balls = 1;
  p.mass[0] = 0.01;
  const Planes planes{-2.0, 3.0};
  const double phi = 0.7;
  p.tilt.plane[0] = 3.0;
  auto both = model::plane_unbalances(p, planes);
  EXPECT_NEAR(both[0].ball[0], 0.0, 1e-17);
  EXPECT_NEAR(both[1].ball[0], 0.01 / 0.4, 1e-15);
  EXPECT_NEAR(model::judged_unbalance(p, planes, &phi), 0.01 / 0.4, 1e-15);
  p.tilt.plane[0] = 0.0;
  EXPECT_NEAR(model::judged_unbalance(p, planes, &phi), 0.01, 1e-16);
  EXPECT_NEAR(model::judged_unbalance(p, {-0.5, 4.5}, &phi), 0.01 * 0.9 / 0.7, 1e-16);
  EXPECT_NEAR(model::judged_unbalance(p, {1.0, 5.0}, &phi), 0.01, 1e-16);
  p.balls = 0;
  p.tilt.misalignment = 0.004;  // a couple of 0.011, 0.0022 in each plane
  EXPECT_NEAR(p.tilt.couple(), 0.011, 1e-16);
  both = model::plane_unbalances(p, planes);
  EXPECT_NEAR(std::abs(both[0].own - (-0.0022 / 0.6)), 0.0, 1e-16);
  EXPECT_NEAR(std::abs(both[1].own - 0.0022 / 0.4), 0.0, 1e-16);
}

// At bearings on either side of the centre of mass no rotor is judged by less than its static unbalance.
TEST(PlaneUnbalances, AreNoLessThanTheStaticOne) {
  const model::Parameters p = long_rotor_with({"balancer.mass=[0.005, 0.004, 0.007, 0.003]"}).parameters;
  for (int k = 0; k < 200; ++k) {
    const Planes planes{-0.1 - 0.03 * (k % 17), 0.1 + 0.05 * (k % 23)};
    std::array<double, 4> phi;
    for (int i = 0; i < 4; ++i) phi[static_cast<std::size_t>(i)] = 0.37 * k * (i + 1) + i;
    const double judged = model::judged_unbalance(p, planes, phi.data());
    EXPECT_GE(judged, std::abs(model::unbalance(p, phi.data())) * (1.0 - 1e-12)) << k;
    EXPECT_EQ(model::judged_unbalance(p, {1.0, 1.0}, phi.data()), std::abs(model::unbalance(p, phi.data()))) << k;
  }
}

BasinOptions with_starts() {
  BasinOptions options;
  options.transients = options.keep_starts = true;
  return options;
}

// Of rotors that differ in their balls, each start's figure is that of its own trajectory; so is how many starts keep a
// limit, of the unbalance and of the grade, just above and just below one of them. The static unbalance keeps all.
TEST(TiltGrade, IsThatOfTheTrajectory) {
  const std::vector<std::string> overrides =
      damped({"rotor.eccentricity=0.001", "balancer.mass=[0.0006, 0.0006, 0.0006, 0.0005]",
              "rotor.tilt.misalignment={ values = [0.004, 0.006] }", "rotor.tilt.bearings_at=[3, -2, 1]",
              "sampling.starts=8", "speed.speed=3.0"});
  AttractorSearchCache searched;  // one search for all: limits change no motion
  BasinOptions options = with_starts();
  options.searches = &searched;
  const BasinResult r = basin(long_rotor_with(overrides), options);
  const std::vector<float>& told = *r.every_start->transient("residual_unbalance");
  const Sampler sampler = sampler_of(r.study);
  std::vector<double> seen;
  for (std::uint64_t i = 0; i < r.every_start->starts; ++i) {
    Study own = drawn_study(r.study, drawn_values(r.study, sampler, r.study.sampling.seed, i));
    own.initial = start_of(r.study, i);
    // Balls too light for balance come to rest against the rotor.
    const auto at_end = [&](const std::vector<double>& places) {
      return tilting::dense(own, {{0.0, 200.0, false, 0.0}}, places).back().unbalance;
    };
    seen.push_back(at_end({3.0, -2.0, 1.0}));
    EXPECT_NEAR(told[i], seen.back(), 1e-5 * seen.back()) << i;
    if (i > 0) continue;
    EXPECT_GT(seen.back(), 1.5 * at_end({0.0}));  // the couple shows
  }
  std::sort(seen.begin(), seen.end());
  const double least = seen.front(), most = seen.back();
  ASSERT_GT(most, 1.2 * least);  // the draws show
  for (const double limit : {0.999 * least, 1.001 * least, 0.999 * most, 1.001 * most}) {
    const auto within =
        static_cast<std::uint64_t>(std::count_if(seen.begin(), seen.end(), [&](double u) { return u <= limit; }));
    for (const char* key : {"residual", "grade"}) {
      std::vector<std::string> stated = overrides;
      stated.push_back("limits." + std::string(key) + "=" + std::to_string(key[0] == 'g' ? 3.0 * limit : limit));
      const BasinResult limited = basin(long_rotor_with(stated), options);
      const TransientGroup& all = limited.transients->groups.front();
      EXPECT_EQ(all.within[static_cast<std::size_t>(Within::at_end)]->count, within) << key << " " << limit;
    }
  }
}

// A machine in a plane, and the same where nothing tilts: balls at the centre of mass, like bearings, no couple.
const std::string plane = R"(
[rotor]
mass = "12 kg"
eccentricity = "0.2 mm"
stiffness = "120 kN/m"
damping = "300 N s/m"
[balancer]
balls = 2
race_radius = "0.1 m"
mass = "8 g"
drag = "1.5 N s/m"
[speed]
speed = "3000 rpm"
[sampling]
starts = 12
[limits]
)";
const std::string tilting_too =
    "rotor.tilt={ transverse_inertia = '0.3 kg m2', polar_inertia = '0.1 kg m2', stiffness = "
    "['0 N', '4.8 kN m'], damping = ['0 N s', '12 N m s']";

std::string flat(const std::string& text) {
  std::string line = text;
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}
bool says(const std::string& text, const std::string& what) { return flat(text).find(what) != std::string::npos; }

TEST(TiltGrade, IsThatOfThePlaneRotorWhereNothingTilts) {
  // The balls, 800 g mm each, leave a third of 2400 g mm: 67 micrometres, at 314 rad/s 20.9 mm/s.
  for (const auto& [limit, kept] :
       std::vector<std::pair<const char*, bool>>{{"grade = '20.5 mm/s'", false}, {"residual = 'G 24'", true}}) {
    const BasinResult one = basin(parse_study(plane + limit, "plane"), with_starts()),
                      two = basin(
                          parse_study(plane + limit, "tilting",
                                      {tilting_too + ", bearings_at = ['0.2 m', '-0.2 m'] }", "balancer.plane=0 m"}),
                          with_starts());
    const TransientGroup &a = one.transients->groups.front(), &b = two.transients->groups.front();
    const auto grade = left_grade(a, one.study), tilting = left_grade(b, two.study);
    ASSERT_TRUE(grade && tilting);
    EXPECT_NEAR(*grade, 20.9, 2.0);
    EXPECT_NEAR(*tilting, *grade, 1e-5 * *grade);
    EXPECT_NEAR(*own_balance_grade(two.study, 3.0), *own_balance_grade(one.study, 3.0), 1e-12);
    for (const TransientGroup* g : {&a, &b})
      EXPECT_EQ(g->within[static_cast<std::size_t>(Within::at_end)]->count, kept ? g->starts : 0u) << limit;
  }
}

// What is said with two bearings, and with none, where a limit on the unbalance is refused.
TEST(TiltGrade, NeedsTwoBearings) {
  const std::string bearings = tilting_too + ", bearings_at = ['0.3 m', '-0.2 m'] }", none = tilting_too + " }",
                    one = tilting_too + ", bearings_at = ['0.3 m'] }";
  for (const std::string& rotor : {none, one})
    for (const char* limit : {"grade = '5 mm/s'", "residual = '5 g mm'", "residual = 'G 2.5'"}) {
      const InputError e = refused([&] { parse_study(plane + limit, "m", {rotor, "balancer.plane=0 m"}); });
      EXPECT_TRUE(e.key() == "limits.grade" || e.key() == "limits.residual") << e.what();
      EXPECT_TRUE(says(e.what(), "is judged in the planes of two bearings, which rotor.tilt does not state"))
          << e.what();
    }
  const auto told = [&](const std::string& rotor) {
    return basin(parse_study(plane, "m", {rotor, "balancer.plane=0.05 m"}), with_starts());
  };
  const BasinResult with = told(bearings), without = told(one);
  EXPECT_TRUE(says(basin_text(with), "the residual unbalance is that in the plane of the outermost bearing"));
  EXPECT_TRUE(says(basin_text(with), "residual unbalance at the final speed: e omega = ")) << basin_text(with);
  EXPECT_TRUE(says(basin_text(with), "Balance quality e omega [ISO 21940-11]: G "));
  EXPECT_TRUE(says(basin_text(without),
                   "the residual unbalance is the static one alone, which has no balance quality "
                   "grade: ISO 21940-11 judges a tilting rotor in the planes of two bearings"));
  EXPECT_FALSE(says(basin_text(without), "e omega"));
  EXPECT_FALSE(left_grade(without.transients->groups.front(), without.study));
  const auto page = [&](const std::string& rotor) {
    const Study study = parse_study(plane, "m", {rotor, "balancer.plane=0.05 m"});
    return machine_html(machine_page(study, given_machine(study), with_starts()), {});
  };
  const std::string graded = page(bearings);
  EXPECT_TRUE(says(graded, "grade of the unbalance that is left in the plane of the outermost bearing"));
  EXPECT_TRUE(says(graded, "(within grade G 100); in the worse of the outermost bearings"))
      << own_balance_grade(with.study, 3.14).value_or(0.0);
  EXPECT_FALSE(says(page(none), "grade of the unbalance that is left"));
}

TEST(TiltGrade, ExplainSaysWhyThereIsNone) {
  const auto text = [](const std::string& rotor) {
    return explain_text(explained(plane, {rotor, "balancer.plane=0.05 m"}));
  };
  EXPECT_TRUE(
      says(text(tilting_too + " }"), "none: ISO 21940-11 judges a tilting rotor in the planes of two bearings"));
  EXPECT_FALSE(says(text(tilting_too + ", bearings_at = ['0.3 m', '-0.2 m'] }"), "none: ISO 21940-11"));
}

}  // namespace tilt_grade_test
}  // namespace equipoise
