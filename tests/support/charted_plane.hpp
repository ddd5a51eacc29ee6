// The paper's rotor, the chart of a rotor over a plane, and branches of cycles that are born on its Hopf curves.
#pragma once

#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/extras/stability/plane_studies.hpp"
#include "equipoise/extras/curves/bifurcation_chart.hpp"
#include "equipoise/extras/cycles/cycle_branch.hpp"
#include "studies.hpp"

namespace equipoise {

inline Study charted_rotor() {
  Study study = parse_study(constant_speed, "rotor");
  study.parameters.drag = {0.05, 0.05};
  return study;
}

inline model::System charted_system(double speed, double drag) {
  Study study = charted_rotor();
  study.speed.speed = speed;
  study.parameters.drag = {drag, drag};
  return study.system();
}

// Eigenvalues of the map over one period, by differences of whole trajectories: without variational equations.
inline Eigen::VectorXcd multipliers_by_differences(const model::System& system, const Eigen::VectorXd& z, double period,
                                                   double step = 1e-5) {
  const Eigen::Index size = z.size();
  Eigen::MatrixXd map(size, size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const Eigen::VectorXd along = step * Eigen::VectorXd::Unit(size, k);
    map.col(k) = (*advance_state(system, z + along, period, 0.0, 1e-13) -
                  *advance_state(system, z - along, period, 0.0, 1e-13)) /
                 (2.0 * step);
  }
  return dense::eigenvalues(map);
}

// Without boxes, and without curves of cycles.
struct ChartedPlane {
  ChartedPlane(const SliceAxis& x, const SliceAxis& y, const Study& study = charted_rotor())
      : chart(bifurcation_chart(study, settings(x, y))), plane(study, chart.plane.x, chart.plane.y) {}
  ChartedPlane(const ChartedPlane&) = delete;
  ChartedPlane& operator=(const ChartedPlane&) = delete;

  // `across`: direction in the unit square in which cycles grow.
  CycleBranch born_at(const CurvePoint& p, const Eigen::Vector2d& across) const {
    const CycleStart start{plane.place(p.x, p.y), across, Eigen::Map<const Eigen::VectorXd>(p.state.data(), 8),
                           p.frequency};
    return cycle_branch([&](const Eigen::VectorXd& at) { return plane.system(at); }, start, nullptr);
  }

  static ChartSettings settings(const SliceAxis& x, const SliceAxis& y) {
    ChartSettings settings;
    settings.x = x;
    settings.y = y;
    settings.boxes = 0;
    return settings;
  }

  const BifurcationChart chart;
  const PlaneStudies plane;
};

}  // namespace equipoise
