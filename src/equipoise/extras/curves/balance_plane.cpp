// Studies of the plane, one at a time.
#include "equipoise/extras/curves/balance_plane.hpp"

#include "equipoise/analyses/basin_slices/start_pixels.hpp"
#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

std::optional<Study> BalancePlane::study_at(const Eigen::VectorXd& at) const {
  try {
    return studies_.at(x(at), y(at));
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::optional<model::System> BalancePlane::system(const Eigen::VectorXd& at) const {
  const auto study = study_at(at);
  std::optional<model::System> found;
  if (study) found.emplace(study->system());
  if (found && found->prescribed() && found->speed() == 0.0) return std::nullopt;
  return found;
}

std::optional<BalanceSpectrum> BalancePlane::spectrum(const Eigen::VectorXd& at) const {
  const auto study = study_at(at);
  return study ? balance_spectrum(*study) : std::nullopt;
}

std::optional<double> BalancePlane::margin(const Eigen::VectorXd& at) const {
  const auto study = study_at(at);
  return study ? std::optional(balance_margin(study->parameters)) : std::nullopt;
}

std::optional<BalanceSpectrum> BalancePlane::in_line(const Eigen::VectorXd& at) const {
  const auto study = study_at(at);
  if (!study || !study->system().prescribed() || study->parameters.tilts()) return std::nullopt;
  const model::System system(study->parameters, study->system().speed());
  const model::Parameters& p = study->parameters;
  double phi[model::max_balls];
  int heaviest = 0;
  for (int i = 0; i < p.balls; ++i) {
    if (p.mass[static_cast<std::size_t>(i)] > p.mass[static_cast<std::size_t>(heaviest)]) heaviest = i;
    phi[i] = pi;
  }
  const bool ball_outweighs = p.mass[static_cast<std::size_t>(heaviest)] > p.eccentricity;
  for (int i = 0; i < p.balls; ++i)
    if (ball_outweighs && i != heaviest) phi[i] = 0.0;
  BalanceSpectrum found{system, model::centred_state(p, phi), {}, {}, false};
  found.jacobian = model::jacobian(p, system.speed(), found.state.data());
  found.rates = without_continuum(dense::eigenvalues(found.jacobian), 0, 0.0);
  return found;
}

}  // namespace equipoise
