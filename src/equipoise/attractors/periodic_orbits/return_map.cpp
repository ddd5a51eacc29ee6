// Newton's method in the coordinates of a ball mode.
#include "equipoise/attractors/periodic_orbits/return_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "equipoise/core/math/dense.hpp"
#include "equipoise/attractors/periodic_orbits/event_run-inl.hpp"
#include "equipoise/attractors/periodic_orbits/recurrence.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of the flow, relative.
constexpr double return_tolerance = 1e-12;
constexpr int most_iterations = 12;

// A state by what is free in a mode. The first of joined balls stands for all; held ones stay where they are in
// `state`.
class ModeCoordinates {
 public:
  ModeCoordinates(const model::System& system, const VectorXd& state, const model::BallMode& mode)
      : n_(system.balls()), state_(state) {
    for (int i = 0; i < n_; ++i) leader_[i] = mode.held[i] ? held : i;
    join(mode);
    for (int i = 0; i < 4; ++i) places_.push_back(i);
    for (int first : {model::index::phi(0), model::index::q(0, n_)})
      for (int i = 0; i < n_; ++i)
        if (leader_[i] == i) places_.push_back(first + i);
    for (int i = model::dimension(n_); i < system.dimension(); ++i) places_.push_back(i);
    for (const auto& angle : system.angles()) {
      const auto at = std::find(places_.begin(), places_.end(), angle.place);
      if (at != places_.end()) angles_.push_back({static_cast<int>(at - places_.begin()), angle.turn});
    }
  }

  Index size() const { return static_cast<Index>(places_.size()); }
  const std::vector<model::System::Angle>& angles() const { return angles_; }
  VectorXd reduced(const VectorXd& y) const { return y(places_); }
  VectorXd whole(const VectorXd& r) const {
    VectorXd y = state_;
    for (Index k = 0; k < size(); ++k) y[places_[static_cast<std::size_t>(k)]] = r[k];
    for (int i = 0; i < n_; ++i) {
      const int leader = leader_[i];
      y[model::index::q(i, n_)] = leader < 0 ? 0.0 : y[model::index::q(leader, n_)];
      if (leader >= 0)
        y[model::index::phi(i)] =
            y[model::index::phi(leader)] + state_[model::index::phi(i)] - state_[model::index::phi(leader)];
    }
    return y;
  }

 private:
  static constexpr int held = -1;

  // Balls that press on a held one are held with it.
  void join(const model::BallMode& mode) {
    for (int round = 0; round < n_; ++round)
      for (int k = 0; k < n_; ++k) {
        if (!mode.joined[k]) continue;
        int& a = leader_[mode.order[k]];
        int& b = leader_[mode.order[(k + 1) % n_]];
        a = b = std::min(a, b);
      }
  }

  const int n_;
  const VectorXd state_;
  std::array<int, model::max_balls> leader_{};
  std::vector<int> places_;
  std::vector<model::System::Angle> angles_;
};

// Central differences of fourth order of a smooth function.
template <class Function>
MatrixXd derivative_of(const Function& f, const VectorXd& r, const VectorXd& steps) {
  MatrixXd result(r.size(), r.size());
  for (Index k = 0; k < r.size(); ++k) {
    const auto at = [&](double shift) -> VectorXd {
      VectorXd moved = r;
      moved[k] += shift * steps[k];
      return f(moved);
    };
    result.col(k) = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * steps[k]);
  }
  return result;
}

Eigen::VectorXcd sorted(const Eigen::VectorXcd& values, const auto& before) {
  std::vector<std::complex<double>> list(values.begin(), values.end());
  std::stable_sort(list.begin(), list.end(), before);
  return Eigen::Map<Eigen::VectorXcd>(list.data(), static_cast<Index>(list.size()));
}

// A state after a time, and its rate of change there.
struct Arrival {
  VectorXd state, rate;
};

std::optional<Arrival> arrive(const model::System& system, const VectorXd& state, double duration) {
  kernels::EventRun run(system, state.data(), 0.0, kernels::event_scale(system, return_tolerance));
  const auto status = run.advance(duration, [](double, double, auto&) { return false; });
  if (status != IntegrationStatus::done) return std::nullopt;
  Arrival result{VectorXd(system.dimension()), VectorXd(system.dimension())};
  run.state(result.state.data());
  run(duration, result.state.data(), result.rate.data());
  return result;
}

// The return map of one mode.
class ReturnMap {
 public:
  ReturnMap(const model::System& system, const VectorXd& state)
      : system_(system),
        coordinates_(system, state, mode_at(system, state)),
        imposed_(system.section() == model::Section::stroboscopic),
        scale_(coordinates_.reduced(system.scale())),
        winding_(coordinates_.angles().size(), 0) {}

  std::optional<PeriodicOrbit> refine(const VectorXd& state, double period, double reach) {
    const StateDifference difference(system_);
    VectorXd r = coordinates_.reduced(state);
    double last = std::numeric_limits<double>::infinity();
    for (int k = 0; k < most_iterations; ++k) {
      auto here = step_from(r, period, k == 0);
      if (!here || !(here->mismatch < 4.0 * last)) return std::nullopt;
      // Differences make the map's derivative wrong by a millionth, and each step by that share of the mismatch.
      constexpr double converged = 1e-10;
      if (here->mismatch < converged) return orbit(r, period, *here);
      last = here->mismatch;
      r += here->change;
      period += here->later;
      if (difference.distance(coordinates_.whole(r), state) > reach || !(period > 0.0)) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  struct Step {
    MatrixXd derivative;
    VectorXd change;
    double later = 0.0, mismatch = 0.0;
  };

  std::optional<MatrixXd> derivative(const VectorXd& r, double period) const {
    constexpr double share = 1e-6;  // of a component's size; small, as impacts move kinks about
    MatrixXd result(r.size(), r.size());
    for (Index k = 0; k < r.size(); ++k) {
      VectorXd ends[2];
      for (int side : {0, 1}) {
        VectorXd moved = r;
        moved[k] += (side == 0 ? -share : share) * scale_[k];
        const auto end = arrive(system_, coordinates_.whole(moved), period);
        if (!end) return std::nullopt;
        ends[side] = coordinates_.reduced(end->state);
      }
      result.col(k) = (ends[1] - ends[0]) / (2.0 * share * scale_[k]);
    }
    return result;
  }

  std::optional<Step> step_from(const VectorXd& r, double period, bool first) {
    const auto end = arrive(system_, coordinates_.whole(r), period);
    if (!end) return std::nullopt;
    VectorXd gone = coordinates_.reduced(end->state) - r;
    const auto& angles = coordinates_.angles();
    for (std::size_t i = 0; i < angles.size(); ++i) {
      if (first) winding_[i] = static_cast<int>(std::lround(gone[angles[i].place] / angles[i].turn));
      gone[angles[i].place] -= angles[i].turn * winding_[i];
    }
    Step step;
    step.mismatch = gone.cwiseQuotient(scale_).lpNorm<Eigen::Infinity>();
    const auto map = derivative(r, period);
    if (!map) return std::nullopt;
    step.derivative = *map;
    const Index m = r.size(), unknowns = m + (imposed_ ? 0 : 1);
    MatrixXd matrix = MatrixXd::Zero(unknowns, unknowns);
    VectorXd right = VectorXd::Zero(unknowns);
    matrix.topLeftCorner(m, m) = step.derivative - MatrixXd::Identity(m, m);
    right.head(m) = -gone;
    if (!imposed_) {
      const VectorXd rate = coordinates_.reduced(end->rate);
      matrix.col(m).head(m) = rate;
      matrix.row(m).head(m) = rate.cwiseQuotient(scale_.cwiseAbs2()).transpose();
    }
    // Sticking balls may stay anywhere, so the least change is taken.
    constexpr double singular = 1e-7;
    const VectorXd solution = dense::LeastNormSolver(matrix, singular).solve(right);
    step.change = solution.head(m);
    if (!imposed_) step.later = solution[m];
    return step;
  }

  PeriodicOrbit orbit(const VectorXd& r, double period, const Step& at) const {
    PeriodicOrbit orbit;
    orbit.period = period;
    orbit.nodes = {system_.with_angles_reduced(coordinates_.whole(r))};
    orbit.imposed = imposed_;
    orbit.residual = at.mismatch;
    const auto all = system_.angles();
    const auto whole_place = [&](int place) {
      VectorXd mark = VectorXd::Zero(r.size());
      mark[place] = 1.0;
      const VectorXd y = coordinates_.whole(r + mark) - coordinates_.whole(r);
      std::vector<std::size_t> moved;
      for (std::size_t i = 0; i < all.size(); ++i)
        if (std::fabs(y[all[i].place]) > 0.5) moved.push_back(i);
      return moved;
    };
    const auto& angles = coordinates_.angles();
    for (std::size_t i = 0; i < angles.size(); ++i)
      for (const std::size_t k : whole_place(angles[i].place)) orbit.winding[k] = winding_[i];
    const Eigen::VectorXcd values = dense::eigenvalues(at.derivative);
    orbit.multipliers = sorted(values, [](auto a, auto b) { return std::abs(a) > std::abs(b); });
    if (imposed_) return orbit;
    const auto shift = std::min_element(orbit.multipliers.begin(), orbit.multipliers.end(),
                                        [](auto a, auto b) { return std::abs(a - 1.0) < std::abs(b - 1.0); });
    std::rotate(orbit.multipliers.begin(), shift, shift + 1);
    return orbit;
  }

  const model::System& system_;
  const ModeCoordinates coordinates_;
  const bool imposed_;
  const VectorXd scale_;
  std::vector<int> winding_;
};

}  // namespace

model::BallMode mode_at(const model::System& system, const VectorXd& state) {
  return kernels::EventRun(system, state.data(), 0.0, kernels::event_scale(system, return_tolerance)).mode();
}

std::optional<VectorXd> after(const model::System& system, const VectorXd& state, double duration) {
  auto end = arrive(system, state, duration);
  return end ? std::optional(std::move(end->state)) : std::nullopt;
}

std::optional<PeriodicOrbit> refine_return(const model::System& system, const VectorXd& state, double period,
                                           double reach) {
  return ReturnMap(system, state).refine(state, period, reach);
}

std::optional<Equilibrium> refine_mode_equilibrium(const model::System& system, const VectorXd& guess) {
  kernels::EventRun run(system, guess.data(), 0.0, kernels::event_scale(system, return_tolerance));
  VectorXd snapped(system.dimension());
  run.state(snapped.data());
  const ModeCoordinates coordinates(system, snapped, run.mode());
  const kernels::ModeEquations equations(system, 0.0, run.mode());
  const auto rate = [&](const VectorXd& r) -> VectorXd {
    const VectorXd y = coordinates.whole(r);
    VectorXd dy(y.size());
    equations(0.0, y.data(), dy.data());
    return coordinates.reduced(dy);
  };
  // Steps for which differences of fourth order err by less than rounding.
  const VectorXd steps = coordinates.reduced(system.scale()) * 1e-3;
  VectorXd r = coordinates.reduced(snapped);
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most_iterations; ++k) {
    const VectorXd here = rate(r);
    const double residual = here.lpNorm<Eigen::Infinity>();
    const MatrixXd jacobian = derivative_of(rate, r, steps);
    constexpr double converged = 1e-13, singular = 1e-9;
    if (residual < converged || (residual < 1e-11 && !(residual < 0.5 * last))) {
      const auto values = sorted(dense::eigenvalues(jacobian), [](auto a, auto b) { return a.real() > b.real(); });
      return Equilibrium{coordinates.whole(r), values, residual};
    }
    last = residual;
    r -= dense::LeastNormSolver(jacobian, singular).solve(here);
    constexpr double reach = 0.5;
    if (!(StateDifference(system).distance(coordinates.whole(r), guess) < reach)) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace equipoise
