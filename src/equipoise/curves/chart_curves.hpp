// The curves of a chart as they are found: each once.
#pragma once

#include <string>

#include "equipoise/curves/followed_curve.hpp"

namespace equipoise {

/// Whether a curve of this kind and state runs through the place. Two Hopf curves that cross have different
/// frequencies.
bool is_known(const BalancePlane& plane, const BifurcationChart& chart, CurveKind kind, const std::string& of,
              const Eigen::VectorXd& at, double frequency);

/// With its special points, of which two curves may each have the same.
void add_curve(const BalancePlane& plane, CurveKind kind, const std::string& of, const FollowedCurve& curve,
               BifurcationChart& chart);

}  // namespace equipoise
