// Which runner follows a study's starts; how an unlisted one is named.
#include "equipoise/fates/runner.hpp"

#include "equipoise/fates/machine_runner.hpp"
#include "equipoise/fates/start_runner.hpp"
#include "equipoise/model/system.hpp"

namespace equipoise {

namespace {
// A rotor that no torque drives in the end is followed start by start: it may keep any speed, and lose it for as long as
// it shakes, so that there is no list of what it comes to.
bool needs_machine(const model::System& system) { return system.coasts(); }
}  // namespace

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
  if (needs_machine(study.system())) {
    check_machine(study);
    return;
  }
  check_decidable(study);
  if (transients && !study.speed.driven()) check_watchable(study);
}

std::unique_ptr<Runner> make_runner(const Study& study, const DiscoverySettings& settings, bool transients) {
  if (needs_machine(study.system())) return std::make_unique<MachineRunner>(study, settings.stop);
  return std::make_unique<StartRunner>(study, settings, transients);
}

}  // namespace equipoise
