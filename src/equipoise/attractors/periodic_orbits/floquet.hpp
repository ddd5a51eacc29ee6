// Floquet multipliers of a periodic orbit from the derivatives along its arcs.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// `arcs[k]`: derivative of the state at node k + 1 with respect to that at node k. First comes the multiplier of the
/// shift in time, 1 up to errors, then the others with falling modulus. Absolute accuracy is about 1e-12 times the norm
/// of the product of all arcs, by integration errors; a smaller multiplier is noise.
Eigen::VectorXcd floquet_multipliers(const model::System& system, const std::vector<Eigen::VectorXd>& nodes,
                                     const std::vector<Eigen::MatrixXd>& arcs);
/// The same for an imposed period: all with falling modulus, as none belongs to a shift in time.
Eigen::VectorXcd floquet_multipliers(const std::vector<Eigen::MatrixXd>& arcs);

}  // namespace equipoise
