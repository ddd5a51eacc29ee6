// Fits forms by least squares over drawn rotors.
#include "equipoise/classification/balanced_regions/family_regions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "equipoise/attractors/motions/motion_symmetry.hpp"
#include "equipoise/classification/balanced_regions/balanced_region.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/core/math/lyapunov.hpp"
#include "equipoise/core/math/polynomial_terms.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

namespace {

constexpr int rays = 300;
constexpr double margin = 0.5;

Eigen::VectorXd terms_at(const OwnRotor& rotor, int degree) { return polynomial_terms(rotor.coordinates, degree); }

// As high a degree as a few hundred rotors can determine.
int degree_for(std::size_t values) { return values <= 1 ? 8 : values == 2 ? 5 : values == 3 ? 3 : 2; }

std::vector<Eigen::VectorXd> balanced_places(const model::System& system) {
  std::vector<Eigen::VectorXd> places;
  const std::optional<double> speed = model::balanced_speed(system);
  const model::BalancedStates states = model::balanced_states(system);
  if (!speed || states.kind != model::BalancedStates::Kind::isolated) return places;
  for (const auto& phi : states.angles) places.push_back(model::balanced_state(system, *speed, phi.data()));
  return places;
}

std::optional<Eigen::VectorXd> balanced_place(const model::System& system, int number) {
  std::vector<Eigen::VectorXd> places = balanced_places(system);
  if (static_cast<std::size_t>(number) >= places.size()) return std::nullopt;
  return std::move(places[static_cast<std::size_t>(number)]);
}

}  // namespace

FamilyRegions::FamilyRegions(std::vector<BalancedRegion>& regions, std::span<const OwnRotor> rotors,
                             std::span<const OwnRotor> tried, const std::vector<ModeWeight>& weights) {
  if (regions.empty() || rotors.empty()) return;
  size_ = rotors.front().system.dimension();
  degree_ = degree_for(rotors.front().coordinates.size());
  // Lyapunov's form for Q = 1 is better if modes come too close to each other.
  double best = 0.0;
  Eigen::MatrixXd chosen;
  for (const bool modal : {true, false}) {
    if (!fit(regions, rotors, weights, modal)) continue;
    const double found = level(regions, tried);
    const double volume = found > 0.0 ? std::pow(found, 0.5 * static_cast<double>(size_)) /
                                            std::sqrt(dense::determinant(form(rotors.front())))
                                      : 0.0;
    if (!(volume > best)) continue;
    best = volume;
    chosen = coefficients_;
  }
  if (!(best > 0.0)) {
    regions.clear();
    return;
  }
  coefficients_ = chosen;
  const double found = margin * level(regions, tried);
  OwnRotor middle = rotors.front();
  place(regions, middle);
  for (std::size_t k = 0; k < regions.size(); ++k) {
    const auto square = static_cast<std::size_t>(size_ * size_);
    regions[k].factor.assign(&middle.factors[k * square], &middle.factors[k * square] + square);
    regions[k].level = found;
    regions[k].reach.fill(0.0);
  }
  // As far as the widest of them reaches.
  for (const OwnRotor& rotor : tried) {
    OwnRotor placed = rotor;
    place(regions, placed);
    for (std::size_t k = 0; k < regions.size(); ++k) {
      const FactorView f(&placed.factors[k * static_cast<std::size_t>(size_ * size_)], size_, size_);
      const Eigen::MatrixXd inverse = dense::inverse(Eigen::MatrixXd(f.transpose() * f));
      for (Eigen::Index i = 0; i < size_; ++i)
        regions[k].reach[static_cast<std::size_t>(i)] =
            std::max(regions[k].reach[static_cast<std::size_t>(i)], std::sqrt(found * inverse(i, i)));
    }
  }
}

bool FamilyRegions::fit(const std::vector<BalancedRegion>& regions, std::span<const OwnRotor> rotors,
                        const std::vector<ModeWeight>& weights, bool modal) {
  std::vector<Eigen::VectorXd> rows, values;
  for (const OwnRotor& rotor : rotors) {
    const auto place = balanced_place(rotor.system, regions.front().state);
    if (!place) return false;
    const Eigen::MatrixXd a = model::jacobian(rotor.system, *place);
    if (!(dense::largest_real_part(a) < 0.0)) return false;
    const Eigen::MatrixXd p =
        modal ? weighted_form(a, weights) : solve_lyapunov(a, Eigen::MatrixXd::Identity(a.rows(), a.cols()));
    Eigen::VectorXd upper(size_ * (size_ + 1) / 2);
    for (Eigen::Index i = 0, at = 0; i < size_; ++i)
      for (Eigen::Index j = i; j < size_; ++j) upper[at++] = p(i, j);
    if (!upper.allFinite()) return false;
    rows.push_back(terms_at(rotor, degree_));
    values.push_back(std::move(upper));
  }
  coefficients_ = polynomial_fit(rows, values);
  return coefficients_.allFinite();
}

Eigen::MatrixXd FamilyRegions::form(const OwnRotor& rotor) const {
  const Eigen::VectorXd upper = coefficients_.transpose() * terms_at(rotor, degree_);
  Eigen::MatrixXd p(size_, size_);
  for (Eigen::Index i = 0, at = 0; i < size_; ++i)
    for (Eigen::Index j = i; j < size_; ++j) p(i, j) = p(j, i) = upper[at++];
  return p;
}

// The least level at which V was seen to grow; 0: at once, or there is no such state.
double FamilyRegions::level(const std::vector<BalancedRegion>& regions, std::span<const OwnRotor> tried) const {
  Directions vectors(size_);
  double least = std::numeric_limits<double>::infinity();
  for (const OwnRotor& rotor : tried) {
    const auto place = balanced_place(rotor.system, regions.front().state);
    if (!place) return 0.0;
    least = std::min(least, critical_level(rotor.system, *place, form(rotor), rays, vectors, false));
    if (!(least > 0.0)) return 0.0;
  }
  return least;
}

void FamilyRegions::place(const std::vector<BalancedRegion>& regions, OwnRotor& rotor) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto size = static_cast<std::size_t>(size_), square = size * size;
  rotor.places.assign(regions.size() * size, none);
  rotor.factors.assign(regions.size() * square, 0.0);
  // Outside the part of the family that they were fitted to, the forms do not hold.
  const auto outside = [](double c) { return !(c >= -1e-9 && c <= 1.0 + 1e-9); };
  if (regions.empty() || std::any_of(rotor.coordinates.begin(), rotor.coordinates.end(), outside)) return;
  const Eigen::MatrixXd first = form(rotor);
  const std::vector<Eigen::VectorXd> places = balanced_places(rotor.system);
  for (std::size_t k = 0; k < regions.size(); ++k) {
    const auto number = static_cast<std::size_t>(regions[k].state);
    if (number >= places.size()) continue;
    std::copy(places[number].begin(), places[number].end(), &rotor.places[k * size]);
    Eigen::MatrixXd p = first;
    if (regions[k].state != regions.front().state) {
      const Eigen::VectorXi from = exchanged_components(2, {1, 0}, size_);
      p = first(from, from);
    }
    const Eigen::MatrixXd factor = dense::Cholesky(p).upper();
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = i; j < size; ++j)
        rotor.factors[k * square + i * size + j] = factor(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
}

std::vector<Eigen::VectorXd> balanced_shifts(const model::System& other, const model::System& system) {
  const std::vector<Eigen::VectorXd> places = balanced_places(system);
  std::vector<Eigen::VectorXd> shifts = balanced_places(other);
  shifts.resize(std::min(shifts.size(), places.size()));
  for (std::size_t number = 0; number < shifts.size(); ++number) shifts[number] -= places[number];
  return shifts;
}

Eigen::VectorXd balanced_shift(const model::System& other, const model::System& system, const Eigen::VectorXd& state) {
  const std::vector<Eigen::VectorXd> places = balanced_places(system), shifts = balanced_shifts(other, system);
  Eigen::VectorXd nearest = Eigen::VectorXd::Zero(system.dimension());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t number = 0; number < shifts.size(); ++number) {
    double away = 0.0;
    for (int i = 0; i < system.balls(); ++i)
      away += std::fabs(wrapped(state[model::index::phi(i)] - places[number][model::index::phi(i)]));
    if (away < least) nearest = shifts[number];
    least = std::min(least, away);
  }
  return nearest;
}

Eigen::VectorXd state_on_level(const OwnRotor& rotor, std::size_t number, double level,
                               const Eigen::VectorXd& direction) {
  const auto size = static_cast<std::size_t>(direction.size()), at = number * size;
  return state_on_level(&rotor.places[at], &rotor.factors[at * size], level, direction);
}

}  // namespace equipoise
