// Runs any study as a machine, from event to event.
#include "equipoise/trajectory/followed_run.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "equipoise/base/error.hpp"
#include "equipoise/mechanics/capability.hpp"
#include "equipoise/model/state_layout.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/trajectory/machine_run.hpp"
#include "equipoise/trajectory/record.hpp"

namespace equipoise {

namespace kernels = HWY_NAMESPACE;

struct FollowedRun::State {
  explicit State(Study given) : study(std::move(given)), run(study) {}
  const Study study;
  kernels::MachineRun run;
};

FollowedRun::FollowedRun(const Study& study) : FollowedRun(study, study.initial) {}

FollowedRun::FollowedRun(const Study& study, const InitialState& start) {
  Study own = study;
  own.initial = start;
  check(own);
  if (const auto lack = model::lacking(own.system(), model::ResultKind::pages))
    throw InputError(own.name, "rotor.tilt.transverse_inertia",
                     fmt::format("{}", own.parameters.tilt.transverse_inertia), lack->reason);
  kernels::check_overlap(own);
  state_ = std::make_unique<State>(std::move(own));
}

FollowedRun::~FollowedRun() = default;

double FollowedRun::time() const { return state_->run.machine().time(); }

IntegrationStatus FollowedRun::advance(double until) {
  if (!(until > time())) return IntegrationStatus::done;
  const IntegrationStatus status = state_->run.machine().advance(until, [](double, double, auto&&) { return false; });
  if (status == IntegrationStatus::done) state_->run.machine().enter();
  return status;
}

void FollowedRun::record(Trajectory& out) const {
  const model::StateLayout layout = model::machine_layout(state_->study.parameters.balls);
  const double* at = state_->run.machine().state();
  equipoise::record(out, state_->study.parameters, at[layout.psi], at[layout.speed], time(), at);
}

bool FollowedRun::held() const { return state_->run.machine().clamped(); }

const Study& FollowedRun::study() const { return state_->study; }

}  // namespace equipoise
