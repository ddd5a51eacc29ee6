// Polygons of one or two planes; Newton's method for more.
#include "equipoise/machine/balance/tilt_balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/random.hpp"
#include "equipoise/core/math/dense.hpp"

namespace equipoise::model {

std::vector<double> planes_of(const Parameters& p) {
  std::vector<double> planes(p.tilt.plane.begin(), p.tilt.plane.begin() + p.balls);
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  return planes;
}

namespace {

using Complex = std::complex<double>;
using Angles = std::array<double, max_balls>;

// What is smaller than this, relative to all unbalances, is rounding.
constexpr double nothing = 1e-12;

Complex static_unbalance(const Parameters& p) { return std::polar(p.eccentricity, p.eccentricity_angle); }

struct Race : BallPlane {
  void to_own(const double* phi, double* own) const {
    for (std::size_t k = 0; k < balls.size(); ++k) own[k] = phi[balls[k]] - turn;
  }
  void from_own(const double* own, double* phi) const {
    for (std::size_t k = 0; k < balls.size(); ++k) phi[balls[k]] = own[k] + turn;
  }
};

Race race_at(const Parameters& p, double plane, Complex unbalance) {
  Race race;
  race.at = plane;
  race.rotor.balls = 0;
  for (int i = 0; i < p.balls; ++i) {
    if (p.tilt.plane[i] != plane) continue;
    race.balls.push_back(i);
    race.rotor.mass[race.rotor.balls++] = p.mass[i];
  }
  const double size = std::abs(unbalance);
  race.rotor.eccentricity = size > nothing * p.all_unbalances() ? size : 0.0;
  race.turn = race.rotor.eccentricity > 0.0 ? std::arg(unbalance) : 0.0;
  return race;
}

// Of a rotor whose balls run in one plane or two. Empty for more planes, and where those of one plane leave a couple.
std::vector<Race> races_of(const Parameters& p) {
  const std::vector<double> z = planes_of(p);
  const Complex f1 = static_unbalance(p), f2 = p.tilt.couple();
  if (z.size() == 1) {
    if (std::abs(f2 - z[0] * f1) > nothing * p.all_unbalances()) return {};
    return {race_at(p, z[0], f1)};
  }
  if (z.size() != 2) return {};
  return {race_at(p, z[0], (f2 - z[1] * f1) / (z[0] - z[1])), race_at(p, z[1], (z[0] * f1 - f2) / (z[0] - z[1]))};
}

// Both sums, in units of all unbalances.
Eigen::Vector4d left_over(const Parameters& p, const double* phi) {
  Complex f1 = static_unbalance(p), f2 = p.tilt.couple();
  for (int i = 0; i < p.balls; ++i) {
    const Complex one = std::polar(p.mass[i], phi[i]);
    f1 += one;
    f2 += p.tilt.plane[i] * one;
  }
  return Eigen::Vector4d(f1.real(), f1.imag(), f2.real(), f2.imag()) / p.all_unbalances();
}

// Newton's method with the least change of angles, for balls in three planes or more.
bool project_by_newton(const Parameters& p, double* phi) {
  constexpr int most = 60;
  constexpr double converged = 4e-15;
  for (int k = 0; k < most; ++k) {
    const Eigen::Vector4d left = left_over(p, phi);
    if (left.norm() <= converged) return true;
    Eigen::MatrixXd slope(4, p.balls);
    for (int i = 0; i < p.balls; ++i) {
      const double x = -p.mass[i] * std::sin(phi[i]), y = p.mass[i] * std::cos(phi[i]), z = p.tilt.plane[i];
      slope.col(i) = Eigen::Vector4d(x, y, z * x, z * y) / p.all_unbalances();
    }
    Eigen::MatrixXd square = slope * slope.transpose();
    square.diagonal().array() += std::min(left.squaredNorm(), 1e-3 * square.trace());
    const Eigen::VectorXd change = slope.transpose() * dense::solve_semidefinite(square, left);
    for (int i = 0; i < p.balls; ++i) phi[i] -= change[i];
  }
  return false;
}

// Angles found from random ones.
BalancedStates searched(const Parameters& p) {
  constexpr int starts = 400;
  constexpr double apart = 1e-6;
  BalancedStates result;
  RandomStream random;
  for (int k = 0; k < starts; ++k) {
    Angles phi{};
    for (int i = 0; i < p.balls; ++i) phi[i] = two_pi * random.uniform();
    if (!project_by_newton(p, phi.data())) continue;
    for (int i = 0; i < p.balls; ++i) phi[i] = wrapped(phi[i]);
    const auto same = [&](const Angles& other) {
      for (int i = 0; i < p.balls; ++i)
        if (std::fabs(wrapped(phi[i] - other[i])) > apart) return false;
      return true;
    };
    if (tilt_cancelling_freedom(p) > 0) {
      result.kind = BalancedStates::Kind::continuum;
      return result;
    }
    result.kind = BalancedStates::Kind::isolated;
    if (std::none_of(result.angles.begin(), result.angles.end(), same)) result.angles.push_back(phi);
  }
  if (result.kind == BalancedStates::Kind::none)
    result.reason = "no angles of the balls were found that cancel the static and the couple unbalance together";
  return result;
}

}  // namespace

BalancedStates tilt_balanced_states(const Parameters& p) {
  using Kind = BalancedStates::Kind;
  const std::vector<Race> races = races_of(p);
  if (races.empty() && planes_of(p).size() > 1) return searched(p);
  BalancedStates result;
  if (races.empty()) {
    result.reason = "the balls run in one plane, and not all of the unbalance lies in it: a couple stays";
    return result;
  }
  result.kind = Kind::isolated;
  result.angles.emplace_back();
  for (const Race& race : races) {
    const BalancedStates own = balanced_states(race.rotor);
    if (own.kind == Kind::none) {
      result = {};
      result.reason = races.size() > 1 ? "of the share of one plane, " + own.reason : own.reason;
      return result;
    }
    if (own.kind == Kind::continuum) result.kind = Kind::continuum;
    std::vector<Angles> all;
    for (const Angles& before : result.angles)
      for (const Angles& angles : own.angles) {
        all.push_back(before);
        race.from_own(angles.data(), all.back().data());
      }
    if (!all.empty()) result.angles = std::move(all);
  }
  if (result.kind == Kind::continuum) result.angles.clear();
  return result;
}

std::vector<BallPlane> planes_of_balls(const Parameters& p) {
  const std::vector<Race> races = races_of(p);
  return {races.begin(), races.end()};
}

bool project_to_tilt_balanced(const Parameters& p, double* phi) {
  const std::vector<Race> races = races_of(p);
  if (races.empty()) return planes_of(p).size() > 1 && project_by_newton(p, phi);
  bool balanced = true;
  for (const Race& race : races) {
    Angles own{};
    race.to_own(phi, own.data());
    balanced = project_to_balanced(race.rotor, own.data()) && balanced;
    race.from_own(own.data(), phi);
  }
  return balanced;
}

double tilt_balance_margin(const Parameters& p) {
  const std::vector<Race> races = races_of(p);
  const std::vector<double> z = planes_of(p);
  if (races.empty() && z.size() == 1) return -std::abs(p.tilt.couple() - z[0] * static_unbalance(p));
  double least = std::numeric_limits<double>::quiet_NaN();
  for (const Race& race : races) {
    const Parameters& r = race.rotor;
    const double largest = std::max(r.eccentricity, *std::max_element(r.mass.begin(), r.mass.begin() + r.balls));
    least = std::fmin(least, r.all_unbalances() - 2.0 * largest);
  }
  return least;
}

int tilt_cancelling_freedom(const Parameters& p) {
  const std::vector<Race> races = races_of(p);
  if (races.empty()) return std::max(p.balls - 4, 0);
  int freedom = 0;
  for (const Race& race : races) {
    const bool opposed = race.rotor.balls == 2 && race.rotor.eccentricity == 0.0;
    freedom += opposed ? 1 : std::max(race.rotor.balls - 2, 0);
  }
  return freedom;
}

}  // namespace equipoise::model
