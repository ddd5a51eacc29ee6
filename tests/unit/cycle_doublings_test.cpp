// Points at which period doublings, folds and tori of cycles meet, over speed and the balls' mass with little drag:
// against differences of plain trajectories.
#include <algorithm>
#include <complex>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "../support/charted_plane.hpp"

namespace equipoise {
namespace {

// Product of the least distances from `value`, of so many multipliers: each is a root of an error, the product is it.
double away_from(std::complex<double> value, int count, const Eigen::VectorXcd& all) {
  Eigen::VectorXd away = (all.array() - value).abs();
  std::sort(away.begin(), away.end());
  return away.head(count).prod();
}

TEST(CycleDoublings, SpecialPointsHaveTheMultipliersThatNameThem) {
  Study study = charted_rotor();
  study.parameters.drag = {0.02, 0.02};
  ChartSettings settings = ChartedPlane::settings({"speed.final", 1.0, 2.2, 24}, {"balancer.mass", 0.02, 0.12, 24});
  settings.cycles = true;
  settings.threads = 2;
  const BifurcationChart chart = bifurcation_chart(study, settings);
  std::map<SpecialKind, int> compared;
  for (const SpecialPoint& p : chart.specials) {
    if (!is_of_cycles(chart.curves[p.curve].kind)) continue;
    study.speed.speed = p.x;
    study.parameters.mass = {p.y, p.y};
    const Eigen::VectorXd z = Eigen::Map<const Eigen::VectorXd>(p.state.data(), 8);
    const double period = 2.0 * M_PI / p.frequency;
    const Eigen::VectorXcd all = multipliers_by_differences(study.system(), z, period);
    // Errors of differences grow with the largest multiplier.
    const double error = 1e-7 * std::max(1.0, all.cwiseAbs().maxCoeff());
    EXPECT_LT((*advance_state(study.system(), z, period, 0.0, 1e-13) - z).norm(), error) << p.x << " " << p.y;
    // That of the shift in time is 1, too.
    const int ones = p.kind == SpecialKind::resonance_1_1                                    ? 3
                     : p.kind == SpecialKind::resonance_1_2                                  ? 1
                     : p.kind == SpecialKind::cycle_cusp || p.kind == SpecialKind::fold_flip ? 2
                                                                                             : 0;
    const int minus_ones = p.kind == SpecialKind::resonance_1_2 ? 2 : p.kind == SpecialKind::fold_flip ? 1 : 0;
    if (ones == 0) continue;
    EXPECT_LT(away_from(1.0, ones, all), 10.0 * error) << p.x << " " << p.y << "\n" << all;
    if (minus_ones > 0) {
      EXPECT_LT(away_from(-1.0, minus_ones, all), 10.0 * error) << p.x << " " << p.y << "\n" << all;
    }
    ++compared[p.kind];
  }
  EXPECT_GE(compared[SpecialKind::resonance_1_2], 1);
  EXPECT_GE(compared[SpecialKind::fold_flip], 2);
  EXPECT_GE(compared[SpecialKind::resonance_1_1], 3);
  EXPECT_GE(compared[SpecialKind::cycle_cusp], 3);
}

}  // namespace
}  // namespace equipoise
