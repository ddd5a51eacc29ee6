// Figures of transients from lanes, and how close they are to those of dense samples.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/start_source.hpp"

namespace equipoise {

// Figures from lanes for starts 0 to count - 1, followed for `horizon` after the last piece begins.
inline std::vector<TransientRow> gathered(const Study& study, const TransientSettings& asked, std::size_t count,
                                          double horizon) {
  StartSource source(study, nullptr);
  source.watch(asked);
  TransientTable table{asked, {}, {}};
  SpunUp starts;
  EXPECT_TRUE(source.make(study.sampling.seed, 0, count, starts, &table));
  BatchTask task = source.task(source.segments().size() - 1, starts.states);
  task.end = task.segment.begin + horizon;
  task.transients = &table;
  ClassificationRule rule;
  rule.balls = study.parameters.balls;
  rule.at_horizon = true;
  EXPECT_TRUE(classify_batch(task, rule, starts.outcomes, nullptr));
  std::vector<TransientRow> rows;
  for (const TransientSums& sums : table.rows) rows.push_back(transient_row(asked, sums, false));
  return rows;
}

// What is missed within a step is below 1e-4 of a peak, 1e-5 of a mean, and 0.2 % of the unbalance, which is known only
// at the ends of steps. A limit's crossing is accurate to 0.02 time units (docs/evidence/measurements.md). Trajectories
// of tolerance 1e-6 differ from those of 1e-12 by less than that.
// The unbalance is a mean of vectors, which cancel: also 0.1 % of `all` that take part.
inline void expect_same_figures(const TransientRow& seen, const TransientRow& expected, const std::string& what,
                                double all = 0.0, bool by_direction = true) {
  for (const auto peak :
       {&TransientRow::peak_radial, &TransientRow::peak_radial_after_release, &TransientRow::peak_radial_at_end,
        &TransientRow::peak_force, &TransientRow::peak_dynamic_force})
    EXPECT_NEAR(seen.*peak, expected.*peak, 0.001f * expected.*peak) << what;
  for (const auto mean : {&TransientRow::rms_force, &TransientRow::rms_velocity, &TransientRow::rms_dynamic_force})
    EXPECT_NEAR(seen.*mean, expected.*mean, 0.0005f * expected.*mean) << what;
  // Without weight on like supports it is half of the square; a window that ends within a turn of a slow beat has more
  // in one direction.
  const double one = seen.rms_velocity_one_direction;
  if (by_direction) {
    EXPECT_NEAR(one, expected.rms_velocity_one_direction, 0.0005f * expected.rms_velocity_one_direction) << what;
  } else {
    EXPECT_NEAR(one, std::sqrt(0.5) * expected.rms_velocity, 0.0005 * expected.rms_velocity) << what;
    EXPECT_LT(one, 1.0005 * expected.rms_velocity_one_direction) << what;
  }
  EXPECT_NEAR(seen.residual_unbalance, expected.residual_unbalance,
              std::max(0.003 * expected.residual_unbalance, 0.001 * all))
      << what;
  if (std::isinf(expected.time_above))
    EXPECT_EQ(seen.time_above, expected.time_above) << what;
  else
    EXPECT_NEAR(seen.time_above, expected.time_above, 0.1f) << what;  // up to five crossings
  if (std::isinf(expected.settling_time))
    EXPECT_EQ(seen.settling_time, expected.settling_time) << what;
  else
    EXPECT_NEAR(seen.settling_time, expected.settling_time, 0.05f) << what;
  EXPECT_FLOAT_EQ(seen.followed_until, expected.followed_until) << what;
}

}  // namespace equipoise
