// SharedRegions around attracting tori: how far a state is from a cloud of states on one.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motion.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/trapping_regions/window_region.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

/// States along one trajectory that winds densely around a torus, sorted into cells by the angles of the first two
/// balls (of one ball: by its angle). Each cell is stood for by one of them, or by one of each sheet of the torus that
/// passes over it. V of a state is the square of its distance, in System::scale(), from the nearest of the tangent
/// planes there.
class TorusRegion final : public WindowRegion {
 public:
  /// Empty if the trajectory is lost, or if a fresh one does not lie on the cloud: what it winds around is no torus, or
  /// the cloud is too thin for it.
  static std::shared_ptr<TorusRegion> around(const model::System& system, const Motion& motion, int attractor,
                                             const StopFlag* stop);

  double value(const double* state, const OwnRotor* own = nullptr) const override;
  /// Beside number `which` of the cloud.
  Eigen::VectorXd state_on_level(std::size_t which, double level, const Eigen::VectorXd& direction,
                                 const OwnRotor* own = nullptr) const override;
  std::size_t size() const { return static_cast<std::size_t>(states_.cols()); }

 private:
  TorusRegion(const model::System& system, int attractor) : WindowRegion(system, attractor) {}
  void sort_into_cells();
  void find_tangents(const model::System& system);
  void find_images(const model::System& system);
  int cell_of(double first, double second) const;
  void make_charts();
  bool lies_on(int chart, int other) const;
  double value_in_place(const double* state) const;
  // Calls f(number) for all states of the cells around a pair of angles.
  template <class F>
  void around_angles(double first, double second, F&& f) const;

  int cells_ = 1;
  Eigen::MatrixXd states_;          // columns, in units of the scale, angles within a turn
  Eigen::MatrixXd tangents_;        // at each: along the flow, and then across it; orthonormal, in the same units
  std::vector<int> first_in_cell_;  // and one more than there are cells
  // What stands for the cells, cell after cell: a state and its two tangents, each padded to rows_ numbers. Lanes ask
  // at states all over the torus, so that what they read has to be little.
  std::vector<float> charts_;
  std::vector<int> first_chart_;  // of each cell, and one more than there are cells
  int rows_ = 0;
};

/// The trapping region around an attracting torus of a smooth system of section none, its level found by tries as those
/// of other trapping regions are. Null if there is none. `near`: as of highest_good_level().
std::shared_ptr<const TorusRegion> torus_region(const model::System& system, const Motion& motion, int attractor,
                                                const TrialSettings& settings, double near = 0.0);

}  // namespace equipoise
