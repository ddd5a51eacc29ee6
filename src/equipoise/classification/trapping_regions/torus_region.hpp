// Trapping regions around attracting tori: the distance of a state from a cloud of states on the torus.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/classification/trapping_regions/window_region.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/fate.hpp"

namespace equipoise {

/// States along one trajectory that winds densely around a torus, sorted into cells by the angles of the first two
/// balls (with one ball: by its angle). One of them stands for each cell, or one for each sheet of the torus above it.
/// V of a state is the square of its distance, in System::scale(), from the nearest tangent plane there.
class TorusRegion final : public WindowRegion {
 public:
  /// Empty if the trajectory is lost, or a fresh one does not lie on the cloud: it winds around no torus, or the cloud
  /// is too thin; or if alike balls have too many places to compare every state with all.
  static std::shared_ptr<TorusRegion> around(const model::System& system, const Motion& motion, int attractor,
                                             const StopFlag* stop);

  /// Beside state `which` of the cloud.
  Eigen::VectorXd state_on_level(std::size_t which, double level, const Eigen::VectorXd& direction,
                                 const OwnRotor* own = nullptr) const override;
  std::size_t size() const { return static_cast<std::size_t>(states_.cols()); }

 private:
  TorusRegion(const model::System& system, int attractor) : WindowRegion(system, attractor) {}
  void sort_into_cells();
  // Both take long if the states crowd in few cells; once `stop` is set they leave off.
  void find_tangents(const model::System& system, const StopFlag* stop);
  void make_patches(const StopFlag* stop);
  bool find_images(const model::System& system, const Motion& motion);
  int cell_of(double first, double second) const;
  bool lies_on(int patch, int other) const;
  double value_in_place(const double* state, const OwnRotor* own) const override;
  // Calls f(number) for all states of the cells around a pair of angles.
  template <class F>
  void around_angles(double first, double second, F&& f) const;

  int cells_ = 1;
  Eigen::MatrixXd states_;          // columns, in units of the scale, angles within a turn
  Eigen::MatrixXd tangents_;        // at each: along the flow, then across it; orthonormal, in the same units
  std::vector<int> first_in_cell_;  // and one more than there are cells
  // What stands for the cells, one after the other: a state and its two tangents, each padded to rows_ numbers. Kept
  // small, as lanes read it all over the torus.
  std::vector<float> patches_;
  std::vector<int> first_patch_;  // of each cell, and one more than there are cells
  int rows_ = 0;
};

/// The trapping region around an attracting torus of a smooth system with section `none`, its level found by trials.
/// Null if there is none. `near`: as in highest_good_level().
std::shared_ptr<const TorusRegion> torus_region(const model::System& system, const Motion& motion, int attractor,
                                                const TrialSettings& settings, double near = 0.0);

}  // namespace equipoise
