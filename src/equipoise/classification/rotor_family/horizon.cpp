// Turns the rates of the linearised equations into a time.
#include "equipoise/classification/rotor_family/horizon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "equipoise/attractors/equilibria/continuum_draws.hpp"
#include "equipoise/attractors/motions/motion_description.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

namespace {

// A deviation that changes by e^10 has come from anywhere into a trapping region, or from a ten thousandth of anything
// out of reach.
constexpr double e_foldings = 10.0;
// The rates of chaotic transients and slow tori are not known beforehand. With three balls, beta = 0.05, Omega = 2.4
// and gravity 0.01, 12 % take more than 20 000 and 1 % more than 50 000. Only undecided starts run that long, so the
// cost is small.
constexpr double shortest = 50000.0;
// If every start runs to the horizon, it is no longer than the rates require, or than chaos commonly lasts.
constexpr double shortest_for_all = 3000.0;
// With events: touching balls take longer to end in a motion.
constexpr double shortest_with_events = 24000.0;
// A limit to patience: 100 000 starts that are never decided then take a quarter of an hour.
constexpr double longest = 100000.0;
// Rounding moves an eigenvalue by about 1e-15; near the zeros of a continuum by the square root of that.
constexpr double zero = 1e-13, zero_in_continuum = 1e-7;
constexpr int tried_members = 32;

// Largest real part of the eigenvalues at a balanced state, without the `free` ones that belong to its continuum.
double largest_rate(const model::Parameters& p, double speed, const double* phi, int free) {
  const model::System system(p, speed);
  const Eigen::VectorXcd all =
      dense::eigenvalues(p.tilts() ? model::jacobian(system, model::balanced_state(system, speed, phi))
                                   : model::jacobian(p, speed, model::centred_state(p, phi).data()));
  std::vector<std::complex<double>> values(all.begin(), all.end());
  std::sort(values.begin(), values.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
  double largest = -1e300;
  for (std::size_t k = static_cast<std::size_t>(free); k < values.size(); ++k)
    largest = std::max(largest, values[k].real());
  return largest;
}

std::vector<double> rates_along_continuum(const model::Parameters& p, double speed) {
  const int free = model::balanced_freedom({p, speed});
  ContinuumDraws draws(p);
  std::array<double, model::max_balls> phi{};
  std::vector<double> rates;
  for (int k = 0; k < tried_members && draws.next(phi); ++k) rates.push_back(largest_rate(p, speed, phi.data(), free));
  return rates;
}

// Rounds up to two digits. A result can then be read, and does not depend on the last bit of an eigenvalue.
double rounded_up(double time) {
  const double unit = std::pow(10.0, std::floor(std::log10(time)) - 1.0);
  return std::ceil(time / unit - 1e-6) * unit;
}

// The rate that three quarters of these (all above 0) exceed.
double slow_quartile(std::vector<double> rates) {
  if (rates.empty()) return 0.0;
  std::sort(rates.begin(), rates.end());
  return rates[rates.size() / 4];
}

// For the isotropic, horizontal rotor with `p`'s mean stiffness and damping and a centred race. Gravity, anisotropy and
// a motor change these rates, but seldom their order of magnitude. For a continuum of balanced states: sampled at its
// members; a quarter of them may be slower.
SettlingRates settling_rates(const model::Parameters& parameters, double speed) {
  using Kind = model::BalancedStates::Kind;
  const model::Parameters p = model::weakened(parameters, 0.0);
  const model::BalancedStates states = model::balanced_states(p);
  std::vector<double> found, approach, growth;
  const double least = states.kind == Kind::continuum ? zero_in_continuum : zero;
  if (states.kind == Kind::continuum) found = rates_along_continuum(p, speed);
  if (states.kind == Kind::isolated)
    for (const auto& phi : states.angles) found.push_back(largest_rate(p, speed, phi.data(), 0));
  for (const double rate : found) {
    if (rate < -least) approach.push_back(-rate);
    if (rate > least) growth.push_back(rate);
  }
  const double drag = *std::min_element(p.drag.begin(), p.drag.begin() + p.balls) / p.inertia_along_race();
  return {slow_quartile(approach), slow_quartile(growth), 0.5 * drag};
}

}  // namespace

double SettlingRates::slowest() const {
  double least = drag;
  for (const double rate : {approach, growth})
    if (rate > 0.0) least = std::min(least, rate);
  return least;
}

Horizon choose_horizon(const Study& study) {
  Horizon horizon;
  horizon.given = study.numerics.horizon.has_value();
  if (study.parameters.balls == 0) {  // a rotor alone is followed until it is steady
    horizon.time = study.numerics.horizon.value_or(shortest);
    return horizon;
  }
  horizon.rates = settling_rates(study.parameters, study.speed_profile().final_speed());
  horizon.asked = e_foldings / horizon.rates.slowest();
  // If not even one e-folding fits, the longest horizon would decide nothing more.
  const bool hopeless = horizon.rates.slowest() * longest < 1.0;
  const double for_all = study.system().smooth() ? shortest_for_all : shortest_with_events;
  const double least = study.numerics.decide == ClassificationMode::horizon ? for_all : shortest;
  horizon.time = hopeless ? least : std::clamp(rounded_up(horizon.asked), least, longest);
  if (horizon.given) horizon.time = *study.numerics.horizon;
  return horizon;
}

Study with_horizon(Study study) {
  if (!study.numerics.horizon) study.numerics.horizon = choose_horizon(study).time;
  return study;
}

}  // namespace equipoise
