// States asked one at a time.
#include "equipoise/discovery/machine_ends.hpp"

#include <utility>

#include <Eigen/Core>

#include "equipoise/types/fate.hpp"
#include "equipoise/lanes/own_rotor.hpp"
#include "equipoise/motions/stuck.hpp"

namespace equipoise {

namespace {

class EndsOfCoasting final : public TrapSet {
 public:
  EndsOfCoasting(std::shared_ptr<const CoastingTrap> trap, int stalled, const StopFlag* stop)
      : trap_(std::move(trap)), stalled_(stalled), stop_(stop) {}

  Caught ask(const double* state, double /*psi*/, const OwnRotor* /*own*/) const override {
    if (trap_->stalls(state)) return {stalled_};
    const CoastingTrap::Answer answer = trap_->balances(state, stop_);
    return {answer.balanced ? balanced_id : 0, answer.wait};
  }

 private:
  std::shared_ptr<const CoastingTrap> trap_;
  int stalled_;
  const StopFlag* stop_;
};

class StuckBalls final : public TrapSet {
 public:
  StuckBalls(const model::System& system, const Catalogue& listed) : system_(system), listed_(listed) {}

  Caught ask(const double* state, double psi, const OwnRotor* own) const override {
    const model::System& rotor = own ? own->system : system_;
    const Eigen::Map<const Eigen::VectorXd> y(state, system_.dimension());
    const auto end = stuck_for_good(rotor, y, psi);
    return {end ? listed_.find(rotor.parameters(), describe_stuck(rotor, *end)) : 0};
  }

 private:
  model::System system_;
  Catalogue listed_;
};

}  // namespace

Traps ends_of_coasting(std::shared_ptr<const CoastingTrap> trap, int stalled, const StopFlag* stop) {
  return std::make_shared<const EndsOfCoasting>(std::move(trap), stalled, stop);
}

Traps stuck_balls(const model::System& system, const Catalogue& listed) {
  return std::make_shared<const StuckBalls>(system, listed);
}

}  // namespace equipoise
