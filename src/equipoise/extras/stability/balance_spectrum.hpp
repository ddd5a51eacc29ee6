// The balanced state of a study and its eigenvalues, where nothing depends on the rotor's angle.
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/machine/model/system.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

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
