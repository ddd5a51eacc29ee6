// Runs any study as a machine, from event to event.
#include "equipoise/simulation/trajectory/followed_run.hpp"

#include <utility>
#include <variant>

#include "equipoise/simulation/trajectory/machine_run.hpp"
#include "equipoise/simulation/trajectory/record.hpp"

namespace equipoise {

namespace kernels = HWY_NAMESPACE;

struct FollowedRun::State {
  explicit State(Study given) : study(std::move(given)) {
    if (study.parameters.tilts())
      run.emplace<kernels::MachineRunOf<true>>(study);
    else
      run.emplace<kernels::MachineRun>(study);
  }

  // Calls f with the machine.
  template <class F>
  decltype(auto) machine(F&& f) {
    if (auto* plane = std::get_if<kernels::MachineRun>(&run)) return f(plane->machine());
    return f(std::get<kernels::MachineRunOf<true>>(run).machine());
  }

  const Study study;
  std::variant<std::monostate, kernels::MachineRun, kernels::MachineRunOf<true>> run;
};

FollowedRun::FollowedRun(const Study& study) : FollowedRun(study, study.initial) {}

FollowedRun::FollowedRun(const Study& study, const InitialState& start) {
  Study own = study;
  own.initial = start;
  check(own);
  kernels::check_overlap(own);
  state_ = std::make_unique<State>(std::move(own));
}

FollowedRun::~FollowedRun() = default;

double FollowedRun::time() const {
  return state_->machine([](const auto& machine) { return machine.time(); });
}

IntegrationStatus FollowedRun::advance(double until) {
  if (!(until > time())) return IntegrationStatus::done;
  return state_->machine([&](auto& machine) {
    const IntegrationStatus status = machine.advance(until, [](double, double, auto&&) { return false; });
    if (status == IntegrationStatus::done) machine.enter();
    return status;
  });
}

void FollowedRun::record(Trajectory& out) const {
  equipoise::record(out, state_->study, time(), state_->machine([](const auto& machine) { return machine.state(); }));
}

bool FollowedRun::clamped() const {
  return state_->machine([](const auto& machine) { return machine.clamped(); });
}

const Study& FollowedRun::study() const { return state_->study; }

}  // namespace equipoise
