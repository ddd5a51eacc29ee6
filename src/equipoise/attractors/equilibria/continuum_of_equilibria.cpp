// Members of a continuum of balanced states, whether they attract, and to which one nearby states come.
#include "equipoise/attractors/equilibria/continuum_of_equilibria.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "equipoise/attractors/equilibria/continuum_draws.hpp"
#include "equipoise/attractors/motions/motion_description.hpp"
#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/core/math/lyapunov.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"

namespace equipoise {

namespace {

using Angles = std::array<double, model::max_balls>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Fraction of the slowest rate that the form's decay must reach: closer to 1 it would be all slow directions.
constexpr double share_of_rate = 0.8;
// Slower rates cannot be distinguished from a continuum's zeros, which double precision leaves at 1e-8.
constexpr double least_rate = 1e-6;
// For the map over one period of the section, of which only level sets are needed.
constexpr double map_tolerance = 1e-9;
// Level sets stay this close to balance, in System::scale(), for V is |s|^2 or more.
constexpr double widest = 0.7;

model::System without_gravity(const model::System& system) {
  model::Parameters p = system.parameters();
  p.gravity = 0.0;
  return {p, system.drive()};
}

model::System without_contact(const model::System& system) {
  model::Parameters p = system.parameters();
  p.contact_angle = 0.0;
  return {p, system.drive()};
}

}  // namespace

double slowest_of(const Eigen::VectorXcd& eigenvalues, Index zeros, double section_period) {
  std::vector<std::complex<double>> values(eigenvalues.begin(), eigenvalues.end());
  const double none = section_period > 0.0 ? 1.0 : 0.0;
  std::sort(values.begin(), values.end(),
            [&](const auto& a, const auto& b) { return std::abs(a - none) < std::abs(b - none); });
  double largest = -1e300;
  for (std::size_t k = static_cast<std::size_t>(zeros); k < values.size(); ++k)
    largest = std::max(largest, section_period > 0.0 ? std::log(std::max(1e-300, std::abs(values[k]))) / section_period
                                                     : values[k].real());
  return largest;
}

ContinuumOfEquilibria::ContinuumOfEquilibria(const model::System& system)
    : system_(without_contact(system)),
      balanced_(without_gravity(system_)),
      twin_(model::centred_twin(system.parameters(), model::balanced_speed(system).value_or(0.0))),
      speed_(model::balanced_speed(system).value_or(0.0)),
      section_period_(system.autonomous() ? 0.0 : system.section_period()),
      rests_(model::balanced_freedom(system) > 0),
      dimension_(model::cancelling_freedom(twin_.parameters)),
      scale_(system.scale()) {}

// Fills everything except `phi` and the form. Gravity moves the centre off the balanced state. Newton's method across
// the continuum, with the derivative at a guess, finds the state that one period of the section moves only along it.
// The guess is the balanced state, moved by the offset of a neighbouring member if known.
bool ContinuumOfEquilibria::settle(ContinuumMember& m, const VectorXd& offset) const {
  m.centre = model::balanced_state(system_, speed_, m.phi.data());
  if (offset.size() > 0) m.centre += offset;
  const Index size = scale_.size(), across = size - dimension_;
  const auto scaled = [&](const MatrixXd& a) {
    return MatrixXd(scale_.cwiseInverse().asDiagonal() * a * scale_.asDiagonal());
  };
  MatrixXd change;  // the flow's derivative, or the map's minus one
  VectorXd miss = VectorXd::Zero(size);
  if (section_period_ > 0.0) {
    const auto flight = follow_derivative(system_, m.centre, section_period_, map_tolerance);
    if (!flight) return false;
    change = scaled(flight->tangents) - MatrixXd::Identity(size, size);
    miss = (flight->end - m.centre).cwiseQuotient(scale_);
  } else {
    change = scaled(model::jacobian(system_, m.centre));
  }
  // Range and kernel, also of the transpose, by rank-revealing QR: at an attracting member the zeros are semisimple.
  const MatrixXd q = dense::pivoted_orthogonal_factor(change);
  const MatrixXd kernel = dense::pivoted_orthogonal_factor(change.transpose());
  m.range = q.leftCols(across);
  m.along = kernel.rightCols(dimension_);
  const MatrixXd left = q.rightCols(dimension_).transpose();
  m.left = dense::LinearSolver(left * m.along).solve(left);
  m.across = m.range.transpose() * change * m.range;
  const MatrixXd one = MatrixXd::Identity(across, across);
  if (!rests_) {
    constexpr int most = 8;
    constexpr double converged = 1e-8;  // in units of the rotor's deflections
    const dense::LinearSolver solver(m.across);
    for (int k = 0;; ++k) {
      const VectorXd part = m.range.transpose() * (miss - m.along * (m.left * miss));
      if (part.norm() < converged) break;
      if (k == most) return false;
      m.centre -= scale_.cwiseProduct(m.range * solver.solve(part));
      if (is_astray(m)) return false;
      const auto end = advance_state(system_, m.centre, section_period_);
      if (!end) return false;
      miss = (*end - m.centre).cwiseQuotient(scale_);
    }
  }
  if (!rests_) m.creep = m.along * (m.left * miss) / section_period_;
  m.rate =
      slowest_of(dense::eigenvalues(section_period_ > 0.0 ? MatrixXd(m.across + one) : m.across), 0, section_period_);
  return m.left.allFinite() && std::isfinite(m.rate);
}

// Without enough damping Newton's steps may lead anywhere, even to balls too fast to be followed for one period.
bool ContinuumOfEquilibria::is_astray(const ContinuumMember& m) const {
  const int n = system_.balls();
  const VectorXd moved = (m.centre - model::balanced_state(system_, speed_, m.phi.data())).cwiseQuotient(scale_);
  const auto farthest = [&](int first) { return moved.segment(first, n).lpNorm<Eigen::Infinity>(); };
  return !(farthest(model::index::phi(0)) < pi && farthest(model::index::q(0, n)) < pi);
}

bool ContinuumOfEquilibria::shape(ContinuumMember& m) const {
  if (!(m.rate < -least_rate)) return true;
  const Index across = scale_.size() - dimension_;
  const MatrixXd one = MatrixXd::Identity(across, across);
  const double decay = -share_of_rate * m.rate;
  std::optional<MatrixXd> form;
  if (section_period_ > 0.0)
    form = solve_stein(std::exp(decay * section_period_) * (m.across + one), one);
  else
    form = solve_lyapunov(m.across + decay * one, one);
  if (!form) return false;
  const VectorXd spectrum = dense::symmetric_eigenvalues(*form);
  const double least = spectrum.minCoeff();
  if (!(least > 0.0)) return false;
  m.form = *form / least;
  m.unit = m.rate * m.rate * least / spectrum.maxCoeff();
  return true;
}

std::optional<ContinuumMember> ContinuumOfEquilibria::member(const double* phi) const {
  ContinuumMember m;
  std::copy(phi, phi + system_.balls(), m.phi.begin());
  if (!balance(m.phi.data()) || !settle(m) || !shape(m)) return std::nullopt;
  return m;
}

std::optional<Angles> ContinuumOfEquilibria::moved(Angles phi, const VectorXd& along) const {
  for (int i = 0; i < system_.balls(); ++i) phi[i] += along[model::index::phi(i)];
  if (!balance(phi.data())) return std::nullopt;
  return phi;
}

std::optional<ContinuumMember> ContinuumOfEquilibria::destination(const VectorXd& state) const {
  constexpr int most = 5;
  // What may be left along the continuum: a share of the deviation (which V counts), and the accuracy of centres. A
  // state that has long end in the continuum deviates by no more than that.
  constexpr double across = 0.01, unknown = 1e-7;
  Angles phi{};
  for (int i = 0; i < system_.balls(); ++i) phi[i] = state[model::index::phi(i)];
  // Only the last member needs the form, the most costly part.
  ContinuumMember m;
  m.phi = phi;
  if (!balance(m.phi.data())) return std::nullopt;
  VectorXd offset;
  for (int k = 0; k < most; ++k) {
    if (!settle(m, offset)) return std::nullopt;
    offset = m.centre - model::balanced_state(system_, speed_, m.phi.data());
    const VectorXd d = deviation(m, state);
    const VectorXd part = m.left * d;
    if (!(m.rate < -least_rate) || part.norm() <= across * d.norm() + unknown) {
      if (!shape(m)) return std::nullopt;
      return m;
    }
    const auto next = moved(m.phi, m.along * part);
    if (!next) return std::nullopt;
    m.phi = *next;
  }
  return std::nullopt;
}

VectorXd ContinuumOfEquilibria::deviation(const ContinuumMember& m, const VectorXd& state) const {
  VectorXd d = state - m.centre;
  for (int i = 0; i < system_.balls(); ++i) d[model::index::phi(i)] = wrapped(d[model::index::phi(i)]);
  return d.cwiseQuotient(scale_);
}

double ContinuumOfEquilibria::value(const ContinuumMember& m, const VectorXd& state) const {
  const VectorXd d = deviation(m, state);
  const VectorXd along = m.left * d;
  const VectorXd s = m.range.transpose() * (d - m.along * along);
  return s.dot(m.form * s) + along.squaredNorm();
}

VectorXd ContinuumOfEquilibria::state_at(const ContinuumMember& m, double value, const VectorXd& direction) const {
  const VectorXd s = std::sqrt(value) * dense::Cholesky(m.form).solve_upper(VectorXd(direction.normalized()));
  return m.centre + scale_.cwiseProduct(m.range * s);
}

double ContinuumOfEquilibria::level(const ContinuumMember& m, double factor) {
  return std::min(factor * m.unit, widest * widest);
}

bool ContinuumOfEquilibria::holds(const VectorXd& state, double factor, double slowest_rate, double slow_factor) const {
  const auto m = destination(state);
  if (!m || m->form.size() == 0) return false;
  if (m->rate <= slowest_rate) return value(*m, state) < level(*m, factor) && (rests_ || stays(*m, slowest_rate));
  return rests_ && value(*m, state) < level(*m, slow_factor);
}

// A member that creeps further than a radian may end on an orbit, which is then listed and has its own trapping region.
bool ContinuumOfEquilibria::stays(ContinuumMember m, double slowest_rate) const {
  constexpr double time = 2e4, step = 0.1;
  constexpr int most = 10;
  double left = time;
  for (int k = 0; k < most; ++k) {
    const double speed = m.creep.norm();
    if (speed * left < step) return true;
    const auto next = moved(m.phi, m.creep * (step / speed));
    const auto there = next ? member(next->data()) : std::nullopt;
    if (!there || !(there->rate <= slowest_rate)) return false;
    left -= step / speed;
    m = *there;
  }
  return false;
}

// Only the rate across at a balanced state.
double ContinuumOfEquilibria::rate_at(const double* phi) const {
  const VectorXd centre = model::balanced_state(balanced_, speed_, phi);
  if (section_period_ == 0.0) return slowest_of(dense::eigenvalues(model::jacobian(balanced_, centre)), dimension_);
  const auto flight = follow_derivative(balanced_, centre, section_period_, map_tolerance);
  return flight ? slowest_of(dense::eigenvalues(flight->tangents), dimension_, section_period_) : 1e300;
}

ContinuumSample ContinuumOfEquilibria::sample(const StopFlag* stop) const {
  // Enough draws for the share to 1.6 % (a map costs a hundred Jacobians: to 4 %), and enough members to try.
  const int draws = section_period_ > 0.0 ? 128 : 1024;
  constexpr int enough = 32, seek = 256;
  ContinuumSample result;
  ContinuumDraws source(twin_.parameters);
  const auto turned = [&](Angles angles, double by) {
    for (int i = 0; i < system_.balls(); ++i) angles[i] += by;
    return angles;
  };
  std::vector<std::pair<double, Angles>> found;
  Angles phi{};
  const auto going_on = [&] { return !is_set(stop); };
  for (int k = 0; k < draws && going_on() && source.next(phi); ++k) {
    const Angles here = turned(phi, twin_.turn);
    found.emplace_back(rate_at(here.data()), here);
  }
  if (found.empty()) return result;
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  const auto stable = [](const auto& member) { return member.first < -least_rate; };
  result.drawn = static_cast<int>(found.size());
  result.stable = static_cast<int>(std::count_if(found.begin(), found.end(), stable));
  result.typical = found.front().second;
  if (!stable(found.back())) {
    result.least_growth = std::max(0.0, found[static_cast<std::size_t>(result.stable)].first);
    result.most_growth = found.back().first;
  }
  // Searches next to the most attracting ones, ever closer to the best: for more if few are stable, for one if none is.
  for (int k = 0; k < seek && result.stable < enough && going_on(); ++k) {
    const std::size_t from = static_cast<std::size_t>(k) % std::min<std::size_t>(8, found.size());
    phi = turned(found[from].second, -twin_.turn);
    const int round = 1 + k / 64;
    if (!source.beside(phi, 0.3 / round)) continue;
    phi = turned(phi, twin_.turn);
    const double rate = rate_at(phi.data());
    if (rate < found[from].first && !stable(found[from]))
      found[from] = {rate, phi};
    else if (rate < -least_rate)
      found.emplace_back(rate, phi);
  }
  found.erase(std::remove_if(found.begin(), found.end(), [&](const auto& member) { return !stable(member); }),
              found.end());
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [rate, angles] : found) {
    result.members.push_back(angles);
    result.rates.push_back(rate);
  }
  if (found.empty()) return result;
  result.slowest_rate = found.front().first;
  result.fastest_rate = found.back().first;
  result.typical = found[found.size() / 2].second;
  return result;
}

namespace {

BalancedMember equilibrium_member(const model::System& system, const VectorXd& centre) {
  const int freedom = model::balanced_freedom(system);
  Equilibrium balanced;
  balanced.state = centre;
  balanced.eigenvalues = dense::eigenvalues(model::jacobian(system, centre));
  std::sort(balanced.eigenvalues.begin(), balanced.eigenvalues.end(),
            [](const auto& a, const auto& b) { return a.real() > b.real(); });
  balanced.residual = model::rate(system, centre).cwiseAbs().maxCoeff();
  BalancedMember member{centre, balanced, -1.0, attracts(balanced.eigenvalues, freedom)};
  for (const auto& value : balanced.eigenvalues)
    if (std::abs(value) >= zero_eigenvalue) member.rate = std::max(member.rate, value.real());
  return member;
}

BalancedMember orbit_member(const model::System& system, const PeriodicOrbit& orbit) {
  const int freedom = model::balanced_freedom(system);
  const Eigen::VectorXcd decays = orbit.decays();
  const double rate = std::log(std::max(1e-300, std::abs(decays[freedom]))) / orbit.period;
  return {orbit.nodes[0], orbit, rate, contracts(decays, freedom)};
}

std::optional<BalancedMember> member_on_section(const model::System& system, const VectorXd& centre, double reach) {
  const auto orbit = refine_orbit(system, std::vector{centre}, system.section_period(), reach);
  return orbit ? std::optional(orbit_member(system, *orbit)) : std::nullopt;
}

// Under a motor: only the rotor's angle changes. Exact without gravity and with a centred race.
std::optional<BalancedMember> turning_member(const model::System& system, const VectorXd& centre) {
  const double speed = system.speed(centre);
  PeriodicOrbit orbit;
  orbit.period = system.section_angle() / std::fabs(speed);
  orbit.winding[static_cast<std::size_t>(system.balls())] = speed > 0.0 ? 1 : -1;
  orbit.nodes = {centre};
  constexpr double tolerance = 1e-12;
  const auto arcs = follow_arcs(system, orbit.nodes, orbit.period, tolerance);
  if (arcs.empty()) return std::nullopt;
  orbit.multipliers = floquet_multipliers(system, orbit.nodes, arcs);
  return orbit_member(system, orbit);
}

}  // namespace

std::optional<BalancedMember> nearest_balanced(const model::System& system, const VectorXd& state, double reach) {
  const auto speed = system.coasts() ? std::optional(system.speed(state)) : model::balanced_speed(system);
  if (!speed || (*speed == 0.0 && !system.prescribed())) return std::nullopt;
  double phi[model::max_balls];
  for (int i = 0; i < system.balls(); ++i) phi[i] = state[model::index::phi(i)];
  if (!model::project_to_balanced(system, *speed, phi)) return std::nullopt;
  VectorXd centre = model::balanced_state(system, *speed, phi);
  if (system.layout().psi >= 0) centre[system.layout().psi] = state[system.layout().psi];
  switch (system.section()) {
    case model::Section::stroboscopic:
      return member_on_section(system, centre, reach);
    case model::Section::turn:
      return turning_member(system, centre);
    default:
      return equilibrium_member(system, centre);
  }
}

Motion describe(const model::System& system, const BalancedMember& member) {
  const auto* orbit = std::get_if<PeriodicOrbit>(&member.refined);
  return orbit ? describe_orbit(system, *orbit) : describe_equilibrium(system, std::get<Equilibrium>(member.refined));
}

}  // namespace equipoise
