// What balance does at one point of a plane, a study: its kind and rates, its state and eigenvalues.
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/extras/planes/stability_plane.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// By eigenvalues at the balanced state, or multipliers where the equations depend on the rotor's angle. Of several
/// isolated states the more stable one; of a continuum the member that balanced_angles() finds. A motor that holds its
/// speed takes part in the motion, unless gravity or unequal supports act. The study has balls and nothing uncertain.
/// Once `stop` is set, rates stay unknown.
BalancePoint balance_at(const Study& study, const StopFlag* stop = nullptr);

/// Of a study whose balanced states form a continuum: which part of it is stable, by members drawn evenly, as
/// ContinuumOfEquilibria samples it. Empty for other studies, and where no members were found.
std::optional<ContinuumPart> continuum_at(const Study& study, const StopFlag* stop = nullptr);

struct BalanceSpectrum {
  model::System system;
  Eigen::VectorXd state;
  Eigen::MatrixXd jacobian;
  std::vector<std::complex<double>> rates;  ///< slowest first, without a continuum's own zeros
  bool family = false;                      ///< the state is a member of a continuum

  /// Eigenvalues with a positive real part.
  int unstable() const;
};
/// Of the state that balance_at() takes. Empty if there is none. For studies that can have curves: see
/// model::ResultKind::curves.
std::optional<BalanceSpectrum> balance_spectrum(const Study& study);

/// Two eigenvalues that are both real or a complex pair, by the half of their sum and their product: both are smooth
/// where the two meet.
struct EigenPair {
  double mean = 0.0, product = 0.0;
  std::array<std::size_t, 2> places{};  ///< in the list of rates
};
/// The pair nearest to `like`. Empty if there are fewer than two rates.
std::optional<EigenPair> nearest_pair(const std::vector<std::complex<double>>& rates, const EigenPair& like);

}  // namespace equipoise
