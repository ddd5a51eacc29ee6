// Traps around the balanced states: what stability allows, and how far a Lyapunov function reaches.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/orbits/balanced_continuum.hpp"

namespace equipoise {

/// The balanced states at the final speed and what they can catch.
struct BalancedAnalysis {
  model::BalancedStates states;
  bool stable = false;        ///< at least one balanced state exists and is linearly stable (across a continuum)
  double slowest_rate = 0.0;  ///< largest real part of an eigenvalue among the stable states (negative), 0 if none;
                              ///< and along a continuum
  double growth_rate = 0.0;   ///< largest real part among unstable ones, 0 if none
  std::vector<BalancedTrap> traps;
  std::shared_ptr<const BalancedContinuum> continuum;  ///< null: the states are isolated
  ContinuumSurvey survey;                              ///< of that
  std::string note;  ///< one sentence for the reader when no start can end balanced, else empty
};

/// What a survey of a continuum found, for BalancedAnalysis: `stable`, rates and, if none is stable, `note`.
void judge_continuum(double speed, BalancedAnalysis& analysis);

/// Analyses the balanced states at constant `speed`. For isolated states each trap's level is level_margin times the
/// smallest value of V at which dV/dt >= 0 was found by sampling rays and descending from the worst.
BalancedAnalysis analyse_balanced(const model::Parameters& p, double speed);

/// F and P = F^T F of the trap's Lyapunov function V = |F d|^2 = d^T P d. The first is a view of the trap.
Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> factor_of(
    const BalancedTrap& trap);
Eigen::MatrixXd form_of(const BalancedTrap& trap);

/// Share of the sampled critical level that is used: two independent searches agree to 1e-4 and the level enters
/// decision times only through its logarithm, so a wide margin is cheap.
inline constexpr double level_margin = 0.9;

}  // namespace equipoise
