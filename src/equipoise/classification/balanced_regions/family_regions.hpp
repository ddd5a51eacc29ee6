// Trapping regions of balanced states as functions of a family's coordinates: their centres and their forms.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "equipoise/results/types/warm_start_levels.hpp"
#include "equipoise/simulation/batch/own_rotor.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// A balanced state has a closed form. The form P of its Lyapunov function V = d^T P d is a polynomial in
/// OwnRotor::coordinates, fitted to the modal forms of many rotors.
class FamilyRegions {
 public:
  FamilyRegions() = default;
  /// Fits the forms of `rotors`; `regions` are made for the first of them. Then gives `regions` the level that holds
  /// for all of `tried`: half the least at which V was seen to grow for one of them, by a few hundred rays each.
  /// Empties `regions` if there is no such level. `weights`: of modes, as balanced_region() found them.
  FamilyRegions(std::vector<BalancedRegion>& regions, std::span<const OwnRotor> rotors, std::span<const OwnRotor> tried,
                const std::vector<ModeWeight>& weights);

  /// Sets the rotor's places and factors for these regions.
  void place(const std::vector<BalancedRegion>& regions, OwnRotor& rotor) const;

 private:
  bool fit(const std::vector<BalancedRegion>& regions, std::span<const OwnRotor> rotors,
           const std::vector<ModeWeight>& weights, bool modal);
  Eigen::MatrixXd form(const OwnRotor& rotor) const;
  double level(const std::vector<BalancedRegion>& regions, std::span<const OwnRotor> tried) const;

  Eigen::Index size_ = 0;
  Eigen::MatrixXd coefficients_;  // a column each entry of P's upper triangle, a row each term
  int degree_ = 0;
};

/// From each balanced state of `system` to the same one of another rotor, as without gravity and with the mean of
/// anisotropic supports. To first order, motions around them move by as much. None if states are not isolated.
std::vector<Eigen::VectorXd> balanced_shifts(const model::System& other, const model::System& system);
/// The shift of the balanced state next to `state`; zero if there is none.
Eigen::VectorXd balanced_shift(const model::System& other, const model::System& system, const Eigen::VectorXd& state);

/// A state on `level` of trapping region `number` for a rotor whose places are set.
Eigen::VectorXd state_on_level(const OwnRotor& rotor, std::size_t number, double level,
                               const Eigen::VectorXd& direction);

}  // namespace equipoise
