// Which runner follows a study's starts.
#include "equipoise/fates/runner.hpp"

#include "equipoise/fates/machine_runner.hpp"
#include "equipoise/fates/start_runner.hpp"

namespace equipoise {

void check_runnable(const Study& study) {
  if (study.needs_machine())
    check_machine(study);
  else
    check_decidable(study);
}

std::unique_ptr<Runner> make_runner(const Study& study, const DiscoverySettings& settings, bool transients) {
  if (study.needs_machine()) return std::make_unique<MachineRunner>(study, settings.stop);
  return std::make_unique<StartRunner>(study, settings, transients);
}

}  // namespace equipoise
