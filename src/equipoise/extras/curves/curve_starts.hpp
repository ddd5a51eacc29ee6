// The parts of a chart: where curves begin to be followed, each curve once; regions; proofs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/extras/stability/plane_studies.hpp"
#include "equipoise/extras/curves/followed_curve.hpp"
#include "equipoise/extras/planes/bifurcation_chart.hpp"

namespace equipoise {

/// What searches for a chart's curves share.
class ChartSearch {
 protected:
  ChartSearch(const PlaneStudies& plane, const StopFlag* stop, BifurcationChart& chart)
      : plane_(plane), stop_(stop), chart_(chart), grid_(chart.plane) {}

  /// Whether a curve of this kind and state runs through the place. Two Hopf curves that cross, and two curves of
  /// cycles, have different frequencies.
  bool is_known(CurveKind kind, const std::string& of, const Eigen::VectorXd& at, double frequency) const;
  /// The same of a place of a curve that is being followed.
  FollowedCurve::Known known(CurveKind kind, const std::string& of) const {
    return [=, this](const CurvePlace& p) { return is_known(kind, of, p.at.head(2), p.point.frequency); };
  }
  /// With its special points, of which two curves may each have the same.
  void add_curve(CurveKind kind, const std::string& of, const FollowedCurve& curve);
  /// look(column, row, next column, next row) for all neighbours of the grid, until it is stopped.
  template <class Look>
  void look_at_neighbours(const Look& look) const {
    for (int row = 0; row < grid_.y.pixels; ++row)
      for (int column = 0; column < grid_.x.pixels; ++column) {
        if (is_set(stop_)) return;
        if (column + 1 < grid_.x.pixels) look(column, row, column + 1, row);
        if (row + 1 < grid_.y.pixels) look(column, row, column, row + 1);
      }
  }
  Eigen::VectorXd place(int column, int row) const { return plane_.place(grid_.x.centre(column), grid_.y.centre(row)); }

  const PlaneStudies& plane_;
  const StopFlag* stop_;
  BifurcationChart& chart_;
  const StabilityPlane& grid_;
};

/// Curves of balance between neighbours of the chart's grid, and where it changes along a parameter from the study's
/// own values on; with their special points.
void add_curves(const PlaneStudies& plane, const StopFlag* stop, BifurcationChart& chart);
/// Those that are not known yet, between boxes that are proved to be stable and unstable.
void add_curves_between_boxes(const PlaneStudies& plane, const StopFlag* stop, BifurcationChart& chart);

/// From places on every Hopf curve cycles are followed across it; where they fold, double their period or become tori a
/// curve begins, unless it is known. For a chart that has all other curves. Curves are followed as soon as the cycles
/// before theirs are: a run that is stopped has those that it got to.
void add_cycles(const PlaneStudies& plane, const RunOptions& run, BifurcationChart& chart);

/// Curves of locked states and the chart's regions. If a rotor's locked states are not known, regions show only
/// balance, and chart.no_locked says why. The result does not depend on the number of threads.
void add_locked_states(const PlaneStudies& plane, int threads, const StopFlag* stop, BifurcationChart& chart);

/// What exists at a point.
struct RegionPattern {
  BalanceKind balance = BalanceKind::not_computed;
  std::vector<std::vector<int>> unstable;  ///< by kind of locked state, of each such state: unstable eigenvalues

  bool operator<(const RegionPattern& other) const {
    return balance != other.balance ? balance < other.balance : unstable < other.unstable;
  }
};
/// `pattern_of`: by point of the grid. Sets chart.regions, the largest first, and chart.region_of.
void add_regions(const std::vector<RegionPattern>& patterns, const std::vector<int>& pattern_of,
                 BifurcationChart& chart);

/// Halves boxes, the largest first, until at most `undecided` of the plane is open or `most` boxes were judged. Leaves
/// chart.not_proved where nothing can be proved of this rotor or of these keys.
void add_proof_boxes(const PlaneStudies& studies, std::uint64_t most, double undecided, const StopFlag* stop,
                     BifurcationChart& chart);

}  // namespace equipoise
