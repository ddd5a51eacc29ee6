// Which runner follows a study's starts; how an unlisted one is named.
#include "equipoise/fates/runner.hpp"

#include <stdexcept>

#include "equipoise/fates/drawn_runner.hpp"
#include "equipoise/fates/machine_runner.hpp"
#include "equipoise/fates/start_runner.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/orbits/balanced_continuum.hpp"
#include "equipoise/traps/continuum_trap.hpp"

namespace equipoise {

bool balance_is_even(const model::System& system) {
  return BalancedContinuum::is_of(system) && catches_all(BalancedContinuum(system).survey());
}

bool followed_one_by_one(const model::System& system) {
  return model::lacking(system, model::Answer::listed_decision, balance_is_even).has_value();
}

bool Runner::run_from(std::span<const InitialState>, std::vector<Fate>&, std::vector<UnlistedStart>&,
                      std::vector<TransientRow>*) const {
  throw std::logic_error("starts that draw their rotors are known by their numbers alone");
}

int settle(Runner& runner, const UnlistedStart& start, Fate& fate) {
  const int attractor = runner.list(start);
  fate.attractor = static_cast<short>(attractor);
  if (attractor == 0) {
    fate.outcome = Outcome::undecided;
    fate.by = DecidedBy::nothing;
  }
  return attractor;
}

void check_runnable(const Study& study, bool transients) {
  if (!study.uncertain.empty()) return check_drawable(study, transients);
  if (followed_one_by_one(study.system())) {
    check_machine(study);
    return;
  }
  check_decidable(study);
  if (transients && !study.speed.driven()) check_watchable(study);
}

std::unique_ptr<Runner> make_runner(const Study& study, const DiscoverySettings& settings, bool transients) {
  if (!study.uncertain.empty()) return std::make_unique<DrawnRunner>(study, settings.stop);
  if (followed_one_by_one(study.system())) return std::make_unique<MachineRunner>(study, settings.stop);
  return std::make_unique<StartRunner>(study, settings, transients);
}

}  // namespace equipoise
