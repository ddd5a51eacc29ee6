// Angles without pattern, those kept that nearly balance.
#include "equipoise/orbits/continuum_draws.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numeric>

#include "equipoise/base/angles.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/room_in_race.hpp"
#include "equipoise/model/unbalance.hpp"

namespace equipoise {

bool ContinuumDraws::balance(std::array<double, model::max_balls>& phi) const {
  return model::project_to_balanced(p_, phi.data()) && model::has_room(p_, phi.data());
}

bool ContinuumDraws::next(std::array<double, model::max_balls>& phi) {
  // Of balls that collide fewer: they have the walk.
  const int most = p_.balls_collide() ? 10000 : 200000;
  const double near = 0.05 * p_.all_unbalances();
  for (int k = 0; k < most && !walking_; ++k) {
    for (int i = 0; i < p_.balls; ++i) phi[i] = two_pi * random_.uniform();
    if (p_.balls_collide()) model::make_room(p_, phi.data());
    if (std::abs(model::unbalance(p_, phi.data())) < near && balance(phi)) return true;
  }
  if (!walking_ && !(p_.balls_collide() && spread_row(place_))) return false;
  walking_ = true;
  // Strides shrink to what the room allows: half of them are taken.
  constexpr int strides = 16;
  for (int k = 0; k < strides; ++k) {
    phi = place_;
    const bool taken = beside(phi, stride_);
    if (taken) place_ = phi;
    stride_ = std::clamp(taken ? 1.4 * stride_ : 0.7 * stride_, 1e-7, 1.0);
  }
  phi = place_;
  return true;
}

bool ContinuumDraws::beside(std::array<double, model::max_balls>& phi, double distance) {
  for (int i = 0; i < p_.balls; ++i) phi[i] += distance * random_.normal();
  return balance(phi);
}

// A row of balls side by side, the heaviest in its middle, cancels most; with growing gaps it cancels less and less.
bool ContinuumDraws::spread_row(std::array<double, model::max_balls>& phi) const {
  std::array<std::size_t, model::max_balls> by_mass{};
  const auto end = by_mass.begin() + p_.balls;
  std::iota(by_mass.begin(), end, std::size_t{0});
  std::stable_sort(by_mass.begin(), end, [&](auto a, auto b) { return p_.mass[a] > p_.mass[b]; });
  const auto row = [&](double spacing) {
    for (int k = 0; k < p_.balls; ++k)
      phi[by_mass[static_cast<std::size_t>(k)]] = spacing * (k % 2 ? (k + 1) / 2 : -k / 2);
    std::complex<double> sum;
    for (int i = 0; i < p_.balls; ++i) sum += std::polar(p_.mass[i], phi[i]);
    return sum;
  };
  double least = p_.contact_angle, most = two_pi / p_.balls;
  if (!(least < most && std::abs(row(least)) >= p_.eccentricity && std::abs(row(most)) <= p_.eccentricity))
    return false;
  for (int k = 0; k < 60; ++k) {  // to rounding
    const double middle = 0.5 * (least + most);
    (std::abs(row(middle)) > p_.eccentricity ? least : most) = middle;
  }
  const double turn = pi - std::arg(row(least));
  for (int i = 0; i < p_.balls; ++i) phi[i] += turn;
  return balance(phi);
}

}  // namespace equipoise
