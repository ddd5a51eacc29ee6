// Second and third derivatives of the equations of motion along directions.
#pragma once

#include <Eigen/Core>

#include "equipoise/machine/model/system.hpp"

namespace equipoise::model {

/// d2/da db of dy/dt at y + a u + b v, at a = b = 0, for an autonomous system, plain or at a prescribed speed with a
/// tilt. Exact: the equations run on dual numbers of dual numbers.
Eigen::VectorXd second_derivative(const System& system, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& v);
/// d3/da db dc at y + a u + b v + c w.
Eigen::VectorXd third_derivative(const System& system, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
                                 const Eigen::VectorXd& v, const Eigen::VectorXd& w);

}  // namespace equipoise::model
