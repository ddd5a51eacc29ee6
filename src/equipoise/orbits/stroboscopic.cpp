// Periodic points of the stroboscopic map by condensed multiple shooting; continuation in gravity and anisotropy.
#include "equipoise/orbits/stroboscopic.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <utility>

#include "equipoise/base/angles.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/orbits/variational.hpp"

namespace equipoise {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Step error of every integration here, as for the orbits of isotropic rotors.
constexpr double tolerance = 1e-12;
// Largest mismatch of a converged orbit: what a hundred steps at that tolerance leave, times the growth of an unstable
// one.
constexpr double largest_residual = 1e-10;
// States this close, in state_scale(), are the same: far above the residual, far below any motion's size.
constexpr double same_state = 1e-7;
// A singular value of (derivative of the map minus one) below this share of the largest belongs to a continuum.
constexpr double singular = 1e-8;
// Multipliers of a continuum are 1 to integration errors; the slowest others seen differ from it by 1e-4.
constexpr double on_circle = 1e-7;

// Shooting over strobes that last `step` each: the period is imposed, and kept while gravity and anisotropy change.
class StrobeProblem {
 public:
  StrobeProblem(const model::Parameters& p, double speed, double step)
      : p_(p), speed_(speed), step_(step), unit_(state_scale(p)) {}

  std::optional<PeriodicOrbit> solve(std::vector<VectorXd> nodes, double reach) {
    constexpr int most_iterations = 30;
    constexpr double converged = 1e-9;
    const std::vector<VectorXd> guess = nodes;
    if (!evaluate(nodes, true)) return std::nullopt;
    double previous = reach;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const std::vector<VectorXd> changes = newton_changes();
      double length = 0.0;
      for (const VectorXd& change : changes) length = std::max(length, change.norm());
      if (!(length <= reach) || (iteration > 2 && length > previous && length > converged)) return std::nullopt;
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        nodes[k] += unit_.cwiseProduct(changes[k]);
        if ((nodes[k] - guess[k]).cwiseQuotient(unit_).norm() > 2.0 * reach) return std::nullopt;
      }
      if (!evaluate(nodes, false)) return std::nullopt;
      if (length < converged && residual() < largest_residual) return orbit_of(nodes);
      previous = length;
    }
    return std::nullopt;
  }

 private:
  // Arcs from all nodes, and by how much their ends miss the next node.
  bool evaluate(const std::vector<VectorXd>& nodes, bool count_turns) {
    arcs_.clear();
    miss_.clear();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      auto arc = follow_derivative(p_, speed_, nodes[k], step_, tolerance);
      if (!arc) return false;
      VectorXd miss = arc->end - nodes[(k + 1) % nodes.size()];
      if (k + 1 == nodes.size())
        for (int i = 0; i < p_.balls; ++i) {
          double& turned = miss[model::index::phi(i)];
          if (count_turns) winding_[i] = static_cast<int>(std::lround(turned / two_pi));
          turned -= two_pi * winding_[i];
        }
      if (!miss.allFinite()) return false;
      miss_.push_back(miss.cwiseQuotient(unit_));
      arcs_.push_back(unit_.cwiseInverse().asDiagonal() * arc->tangents * unit_.asDiagonal());
    }
    return true;
  }

  double residual() const {
    double largest = 0.0;
    for (const VectorXd& miss : miss_) largest = std::max(largest, miss.lpNorm<Eigen::Infinity>());
    return largest;
  }

  // d_{k+1} = A_k d_k + miss_k; around the loop (M - 1) d_0 = -(what the misses have grown to).
  std::vector<VectorXd> newton_changes() const {
    const Index size = unit_.size();
    MatrixXd all = MatrixXd::Identity(size, size);
    VectorXd carried = VectorXd::Zero(size);
    for (std::size_t k = 0; k < arcs_.size(); ++k) {
      all = arcs_[k] * all;
      carried = arcs_[k] * carried + miss_[k];
    }
    std::vector<VectorXd> changes{-dense::least_norm_solution(all - MatrixXd::Identity(size, size), carried, singular)};
    for (std::size_t k = 0; k + 1 < arcs_.size(); ++k) changes.push_back(arcs_[k] * changes[k] + miss_[k]);
    return changes;
  }

  PeriodicOrbit orbit_of(std::vector<VectorXd> nodes) const {
    MatrixXd all = MatrixXd::Identity(unit_.size(), unit_.size());
    for (const MatrixXd& arc : arcs_) all = arc * all;
    PeriodicOrbit orbit;
    orbit.period = step_ * static_cast<double>(nodes.size());
    orbit.winding = winding_;
    orbit.multipliers = dense::eigenvalues(all);
    std::sort(orbit.multipliers.begin(), orbit.multipliers.end(), [](const auto& a, const auto& b) {
      return std::abs(a) != std::abs(b) ? std::abs(a) > std::abs(b) : a.imag() > b.imag();
    });
    orbit.residual = residual();
    for (int i = 0; i < p_.balls; ++i) {  // whole turns off
      const int phi = model::index::phi(i);
      const double turns = two_pi * std::floor(nodes.front()[phi] / two_pi);
      for (VectorXd& z : nodes) z[phi] -= turns;
    }
    orbit.nodes = std::move(nodes);
    return orbit;
  }

  const model::Parameters& p_;
  double speed_, step_;
  VectorXd unit_;
  std::array<int, model::max_balls> winding_{};
  std::vector<MatrixXd> arcs_;  // in state_scale()
  std::vector<VectorXd> miss_;
};

// A share of the strobes after which the orbit has already come back: the whole of them if there is none.
std::size_t smallest_period(const model::Parameters& p, const PeriodicOrbit& orbit) {
  const VectorXd unit = state_scale(p);
  const std::size_t strobes = orbit.nodes.size();
  for (std::size_t k = 1; k < strobes; ++k) {
    if (strobes % k != 0) continue;
    const int repeats = static_cast<int>(strobes / k);
    VectorXd miss = orbit.nodes[k] - orbit.nodes[0];
    bool whole = true;
    for (int i = 0; i < p.balls; ++i) {
      whole = whole && orbit.winding[i] % repeats == 0;
      miss[model::index::phi(i)] = wrapped(miss[model::index::phi(i)]);
    }
    if (whole && miss.cwiseQuotient(unit).lpNorm<Eigen::Infinity>() < same_state) return k;
  }
  return strobes;
}

// Gravity and anisotropy at a share of what they are; the means of damping and stiffness stay.
model::Parameters weakened(model::Parameters p, double share) {
  for (auto* pair : {&p.damping, &p.stiffness}) {
    const double mean = 0.5 * ((*pair)[0] + (*pair)[1]), half = 0.5 * ((*pair)[0] - (*pair)[1]);
    *pair = {mean + share * half, mean - share * half};
  }
  p.gravity *= share;
  return p;
}

// Follows an orbit of one strobe from `orbit` at share `from` to share `to`, in steps that are halved where they fail.
std::optional<PeriodicOrbit> continued(const model::Parameters& p, double speed, PeriodicOrbit orbit, double from,
                                       double to) {
  constexpr double first_step = 0.25, smallest_step = 1.0 / 512;
  // A branch moves less than this, in state_scale(), over one step; what moves more may be another branch.
  constexpr double farthest = 0.25;
  const double step_time = model::strobe_period(p, speed), direction = to > from ? 1.0 : -1.0;
  double at = from, step = first_step;
  const std::array<int, model::max_balls> still{};
  while (at != to) {
    const double next = std::fabs(to - at) <= step * (1.0 + 1e-9) ? to : at + direction * step;
    const model::Parameters there = weakened(p, next);
    const auto found = StrobeProblem(there, speed, step_time).solve(orbit.nodes, farthest);
    if (!found || found->winding != still) {
      step *= 0.5;
      if (step < smallest_step) return std::nullopt;
      continue;
    }
    orbit = *found;
    at = next;
    step = std::min(1.5 * step, first_step);
  }
  return orbit;
}

}  // namespace

std::optional<VectorXd> at_next_strobe(const model::Parameters& p, double speed, const VectorXd& state, double psi) {
  const double angle = model::strobe_angle(p), sense = speed < 0.0 ? -1.0 : 1.0;
  double ahead = std::fmod(-sense * psi, angle);
  if (ahead < 0.0) ahead += angle;
  // Rounding of psi after 10^4 turns must not cost a whole one; what is this near a strobe is at it.
  if (ahead < 1e-9 || angle - ahead < 1e-9) return state;
  return advance_state(p, speed, state, ahead / std::fabs(speed), psi);
}

std::optional<PeriodicOrbit> refine_strobed(const model::Parameters& p, double speed,
                                            const std::vector<VectorXd>& guess, double reach) {
  if (guess.empty()) return std::nullopt;
  const double step = model::strobe_period(p, speed);
  auto orbit = StrobeProblem(p, speed, step).solve(guess, reach);
  if (!orbit) return std::nullopt;
  const std::size_t once = smallest_period(p, *orbit);
  if (once == orbit->nodes.size()) return orbit;
  orbit->nodes.resize(once);
  return StrobeProblem(p, speed, step).solve(orbit->nodes, reach);
}

bool contracts(const Eigen::VectorXcd& multipliers, int units_allowed) {
  int units = 0;
  for (const std::complex<double>& m : multipliers) {
    if (units_allowed > 0 && std::abs(m - 1.0) < on_circle)
      ++units;
    else if (!(std::abs(m) < 1.0))
      return false;
  }
  return units <= units_allowed;
}

std::optional<PeriodicOrbit> balanced_orbit(const model::Parameters& p, double speed, const double* phi) {
  PeriodicOrbit start;
  start.nodes = {model::centred_state(p, phi)};
  return continued(p, speed, start, 0.0, 1.0);
}

bool leads_to_balance(const model::Parameters& p, double speed, const PeriodicOrbit& orbit) {
  // Of lambda + sum mu_i: rounding and a small share of what continuation's Newton steps leave.
  constexpr double centred = 1e-7;
  if (orbit.nodes.size() != 1 || orbit.winding != std::array<int, model::max_balls>{}) return false;
  const auto end = continued(p, speed, orbit, 1.0, 0.0);
  return end && std::hypot(end->nodes[0][0], end->nodes[0][1]) < centred * (p.eccentricity + p.total_mass());
}

bool relaxes_to_balance(const model::Parameters& p, double speed, const VectorXd& state) {
  constexpr int fading = 400, settling = 400;
  // In state_scale(): what is left of the switching, some e^-10, against motions that are not balanced (0.01 or more).
  constexpr double centred = 1e-3;
  const double step = model::strobe_period(p, speed);
  VectorXd z = state;
  for (int k = 1; k <= fading + settling; ++k) {
    const double share = std::max(0.0, 1.0 - static_cast<double>(k) / fading);
    auto next = advance_state(weakened(p, share), speed, z, step);
    if (!next) return false;
    z = *std::move(next);
  }
  double phi[model::max_balls];
  for (int i = 0; i < p.balls; ++i) {
    phi[i] = z[model::index::phi(i)];
    if (std::fabs(phi[i] - state[model::index::phi(i)]) > 0.5 * pi) return false;
  }
  if (!model::project_to_balanced(weakened(p, 0.0), phi)) return false;
  const VectorXd away = z - model::centred_state(p, phi);
  return away.cwiseQuotient(state_scale(p)).lpNorm<Eigen::Infinity>() < centred;
}

std::vector<double> strobed_exponents(const model::Parameters& p, double speed, const VectorXd& state, long strobes,
                                      const StopFlag* stop) {
  // As accurate as exponents over so finite a time can be; see lyapunov_exponents().
  constexpr double accuracy = 1e-9;
  constexpr int count = 2;
  const double step = model::strobe_period(p, speed);
  const long alignment = std::max(10L, strobes / 5);
  const Index size = state.size();
  VectorXd z = state;
  MatrixXd vectors(size, count);
  for (Index i = 0; i < size; ++i)  // without pattern, and never parallel
    for (Index k = 0; k < count; ++k) vectors(i, k) = std::sin(1.0 + 2.3 * double(i) + 5.1 * double(k * (i + 1)));
  VectorXd sums = VectorXd::Zero(count);
  for (long done = -alignment; done < strobes; ++done) {
    if (is_set(stop)) return {};
    const auto [directions, stretches] = dense::thin_qr(vectors);
    if (done > 0) sums += stretches.cwiseAbs().array().log().matrix();
    auto flight = follow_tangents(p, speed, z, directions, step, accuracy);
    if (!flight) return {};
    z = flight->end;
    vectors = std::move(flight->tangents);
  }
  sums += dense::thin_qr(vectors).diagonal.cwiseAbs().array().log().matrix();
  std::vector<double> exponents;
  for (Index k = 0; k < count; ++k) exponents.push_back(sums[k] / (step * double(strobes)));
  std::sort(exponents.begin(), exponents.end(), std::greater<>());
  return exponents;
}

}  // namespace equipoise
