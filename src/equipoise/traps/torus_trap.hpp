// Traps around attracting tori: how far a state is from a cloud of states on one.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/motions/motion.hpp"
#include "equipoise/traps/trials.hpp"

namespace equipoise {

/// States along one trajectory that winds densely around a torus, sorted into cells by the angles of the first two
/// balls (of one ball: by its angle). Each cell is stood for by one of them, or by one of each sheet of the torus that
/// passes over it. V of a state is the square of its distance, in System::scale(), from the nearest of the tangent
/// planes there.
class TorusTrap {
 public:
  /// Empty if the trajectory is lost, or if a fresh one does not lie on the cloud: what it winds around is no torus, or
  /// the cloud is too thin for it.
  static std::shared_ptr<TorusTrap> around(const model::System& system, const Motion& motion, int attractor,
                                           const StopFlag* stop);

  int attractor() const { return attractor_; }
  double level() const { return level_; }
  void set_level(double level);
  /// V of states on the torus, as computed, is below this.
  double floor() const { return floor_; }

  /// V, the least over the places that like balls may take; infinite where nothing on the torus is near in the angles
  /// or where the state plainly lies above the level.
  double value(const double* state) const;
  /// How long V takes to sink from `value` to the level at the torus' own rate; 0 where that is not known.
  double time_to_level(double value) const;
  /// Makes the bounds at which lanes are asked hold this trap.
  void widen(TorusTraps& bounds) const;
  /// A state on `level` beside the one number `which` (modulo how many there are) of the cloud.
  Eigen::VectorXd state_on_level(std::size_t which, double level, const Eigen::VectorXd& direction) const;
  std::size_t size() const { return static_cast<std::size_t>(states_.cols()); }

 private:
  explicit TorusTrap(const model::System& system);
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

  int attractor_ = 0, balls_ = 0, cells_ = 1;
  double level_ = 0.0, floor_ = 0.0, rate_ = 0.0, r2_low_ = 1e300, r2_high_ = 0.0;
  Eigen::VectorXd inverse_scale_;
  Eigen::MatrixXd states_;          // columns, in units of the scale, angles within a turn
  Eigen::MatrixXd tangents_;        // at each: along the flow, and then across it; orthonormal, in the same units
  std::vector<int> first_in_cell_;  // and one more than there are cells
  // What stands for the cells, cell after cell: a state and its two tangents, each padded to rows_ numbers. Lanes ask
  // at states all over the torus, so that what they read has to be little.
  std::vector<float> charts_;
  std::vector<int> first_chart_;  // of each cell, and one more than there are cells
  int rows_ = 0;
  std::vector<Eigen::VectorXi> places_;  // of a state's components, for each exchange of like balls that is looked at
  Eigen::VectorXd low_, high_;           // of everything on the torus
};

/// The trap around an attracting torus of a smooth system of section none, its level found by tries as those of other
/// traps are. Null if there is none. `near`: as of highest_good_level().
std::shared_ptr<const TorusTrap> torus_trap(const model::System& system, const Motion& motion, int attractor,
                                            const TrialSettings& settings, double near = 0.0);

/// Makes `rule` ask these in place of those it asked before.
void set_tori(DecisionRule& rule, const std::vector<std::shared_ptr<const TorusTrap>>& tori);

}  // namespace equipoise
