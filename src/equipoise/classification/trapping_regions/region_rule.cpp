// Tables for lanes, and functions for single states.
#include "equipoise/classification/trapping_regions/region_rule.hpp"

#include <algorithm>
#include <limits>
#include <cmath>
#include <complex>
#include <vector>

#include "equipoise/attractors/equilibria/stuck.hpp"
#include "equipoise/attractors/motions/approach.hpp"
#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/classification/balanced_regions/family_regions.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/simulation/batch/own_rotor.hpp"

namespace equipoise {

namespace {

// The unbalance on the continuum: 0 except with an off-centre race.
std::complex<double> unbalance_of_rest(const model::System& system) {
  const model::Parameters& p = system.parameters();
  const model::CentredTwin twin = model::centred_twin(p, model::balanced_speed(system).value_or(0.0));
  return p.eccentricity - std::polar(twin.parameters.eccentricity, twin.turn);
}

// Whether ball velocities and unbalance are within reach of those on the continuum.
bool balls_in_reach(const model::Parameters& p, const ContinuumRegion& region, std::complex<double> rest,
                    const double* state) {
  double away = std::abs(model::unbalance(p, state + model::index::phi(0)) - rest);
  for (int i = 0; i < p.balls; ++i) away = std::max(away, std::fabs(state[model::index::q(i, p.balls)]));
  return away < region.reach;
}

bool rotor_in_reach(const ContinuumRegion& region, const Eigen::VectorXd& state) {
  return (state.head(4) - region.place).lpNorm<Eigen::Infinity>() < region.reach;
}

// For comparing states with levels known to percents, at deviations of 1e-3 and more.
constexpr double near_enough = 1e-8;

// Finding the member that a state comes to is costly, and a refused state may stay near the continuum for long. It is
// tested again once the rotor has turned by a further share of all its turning. `half`: the turning in half a window,
// after which tests are made.
bool is_due(double psi, double half) {
  constexpr double later = 0.2;
  const double before = std::fabs(psi) - half;
  if (before <= half) return true;
  const auto times = [](double turned) { return std::floor(std::log(turned) / std::log1p(later)); };
  return times(std::fabs(psi)) != times(before);
}

// If gravity leaves motion on a continuum, the state on the next section is tested.
class ContinuumOnSection {
 public:
  ContinuumOnSection(const model::System& system, const ContinuumRegion& region, double window)
      : system_(system),
        passing_(without_events(system)),
        region_(region),
        rest_(unbalance_of_rest(system)),
        half_(0.5 * window * std::fabs(system.speed())) {}

  bool holds(const double* at, double psi, const OwnRotor* own) const {
    const model::Parameters& p = (own ? own->system : system_).parameters();
    const std::complex<double> rest = own ? unbalance_of_rest(own->system) : rest_;
    if (!balls_in_reach(p, region_, rest, at) || !is_due(psi, half_)) return false;
    // This close to balance it does not matter whether balls touch on the way.
    const auto state = at_next_section(own ? without_events(own->system) : passing_,
                                       Eigen::Map<const Eigen::VectorXd>(at, passing_.dimension()), psi, near_enough);
    return state && balls_in_reach(p, region_, rest, state->data()) && rotor_in_reach(region_, *state) &&
           region_.holds(*state, own);
  }

 private:
  model::System system_, passing_;
  ContinuumRegion region_;
  std::complex<double> rest_;
  double half_;  // turning of the rotor in half a window
};

// A rotor of its own has a well of its own, equally deep for every order of its balls.
int stalled_in(const model::System& system, const StalledRegion& stalled, const double* state, const OwnRotor* own) {
  if (!own) return stalled.caught(system, state);
  const auto well = model::GravityWell::of(own->system);
  return well ? StalledRegion{*well, stalled.rests}.caught(own->system, state) : 0;
}

class SectionRegions final : public TrappingRegions {
 public:
  SectionRegions(const model::System& system, const OrbitRegions& cycles,
                 const std::optional<ContinuumRegion>& continuum, const std::optional<StalledRegion>& stalled,
                 double window)
      : system_(system), cycles_(cycles), stalled_(stalled) {
    if (continuum) continuum_.emplace(system, *continuum, window);
  }

  Caught ask(const double* state, double psi, const OwnRotor* own) const override {
    if (const int attractor = stalled_ ? stalled_in(system_, *stalled_, state, own) : 0) return {attractor};
    std::optional<Shifts> shifts;  // one for all regions: to find balanced states costs as much as to test many
    for (const auto& region : cycles_) {
      const bool moves = own && region->attractor == balanced_id;
      if (moves && !shifts) shifts = balanced_shifts(own->system, system_);
      const double v = moves ? moved_value(*region, state, psi, *shifts) : value(system_, *region, state, psi);
      if (v < region->level) return {region->attractor};
    }
    return {continuum_ && continuum_->holds(state, psi, own) ? balanced_id : 0};
  }

 private:
  using Shifts = std::vector<Eigen::VectorXd>;

  // For a rotor of its own, the region of a balanced motion moves as the balanced state does.
  double moved_value(const OrbitRegion& region, const double* state, double psi, const Shifts& shifts) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Eigen::VectorXd& shift : shifts) {
      const Eigen::VectorXd moved = Eigen::Map<const Eigen::VectorXd>(state, system_.dimension()) - shift;
      least = std::min(least, value(system_, region, moved.data(), psi));
    }
    return least;
  }

  model::System system_;
  OrbitRegions cycles_;
  std::optional<StalledRegion> stalled_;
  std::optional<ContinuumOnSection> continuum_;
};

}  // namespace

void set_regions(ClassificationRule& rule, const model::System& system, const OrbitRegions& cycles,
                 const std::optional<ContinuumRegion>& continuum, const std::optional<StalledRegion>& stalled) {
  rule.cycles.clear();
  rule.continuum = {};
  rule.section_regions = nullptr;
  if (!system.autonomous()) {
    if (!cycles.empty() || continuum || stalled)
      rule.section_regions = std::make_shared<const SectionRegions>(system, cycles, continuum, stalled, rule.window);
    return;
  }
  for (const auto& region : cycles) rule.cycles.push_back(table_of(*region, system.balls()));
  if (!continuum) return;
  // Lanes measure the way to a continuum from the centred rotor.
  if (system.parameters().race_is_centred())
    rule.continuum = {continuum->reach, regions_by([region = *continuum, size = system.dimension()](
                                                       const double* state, double, const OwnRotor* own) -> Caught {
                        return {region.holds(Eigen::Map<const Eigen::VectorXd>(state, size), own) ? balanced_id : 0};
                      })};
  else
    rule.section_regions =
        std::make_shared<const SectionRegions>(system, OrbitRegions{}, continuum, std::nullopt, rule.window);
}

SharedRegions stuck_balls(const model::System& system, const Catalogue& listed) {
  return regions_by([system, listed](const double* state, double psi, const OwnRotor* own) -> Caught {
    const model::System& rotor = own ? own->system : system;
    const Eigen::Map<const Eigen::VectorXd> y(state, system.dimension());
    const auto end = stuck_for_good(rotor, y, psi);
    return {end ? listed.find(rotor.parameters(), describe_stuck(rotor, *end)) : 0};
  });
}

}  // namespace equipoise
