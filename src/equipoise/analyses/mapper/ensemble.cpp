// A session whose starts can be requested in any order.
#include "equipoise/analyses/mapper/ensemble.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "equipoise/analyses/ensembles/ensemble_runner.hpp"
#include "equipoise/attractors/periodic_orbits/return_map.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/reporting.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

namespace {

void check_angles(const Study& study, const std::vector<double>& phi) {
  const auto balls = static_cast<std::size_t>(study.parameters.balls);
  if (phi.size() % balls != 0)
    throw InputError("ball angles", "", fmt::format("{} numbers", phi.size()),
                     fmt::format("must be {} a start", balls));
  for (const double angle : phi)
    if (!std::isfinite(angle)) throw InputError("ball angles", "", fmt::format("{}", angle), "must be finite numbers");
}

Session searched(const Study& study, const EnsembleOptions& options) {
  const ChosenCpuTarget chosen(options.cpu_target);
  AttractorSearchCache own;
  return reported(static_cast<const RunOptions&>(options), [&](const RunOptions& o) {
    return lasting_session(study, o, options.transients, options.searches ? *options.searches : own, options.search);
  });
}

Study checked(const Study& study, bool transients) {
  check_runnable(study, transients);
  return as_sampled(study);
}

}  // namespace

Ensemble::Ensemble(const Study& study, const EnsembleOptions& options)
    : study_(checked(study, options.transients)),
      gathers_(options.transients),
      session_(searched(study_, options)),
      catalogue_(session_) {}

Ensemble::Ended Ensemble::starts(std::uint64_t first, std::size_t count) {
  const Sampler sampler = sampler_of(study_);
  if (sampler.grid() && (first > sampler.grid()->starts() || count > sampler.grid()->starts() - first))
    throw InputError(study_.name, "start index", fmt::format("{}", first + count),
                     fmt::format("must be at most {}, the starts of this grid", sampler.grid()->starts()));
  Ended ended;
  if (!session_.decide(first, count, ended)) throw RunError("stopped before the starts were decided");
  catalogue_.settle(ended);
  return ended;
}

Ensemble::Ended Ensemble::at_angles(const std::vector<double>& phi) {
  check_takes_starts(study_);
  check_angles(study_, phi);
  const auto balls = static_cast<std::size_t>(study_.parameters.balls);
  const std::size_t count = phi.size() / balls;
  std::vector<InitialState> given;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < count; ++i) {
    InitialState start = study_.initial;
    std::copy_n(&phi[i * balls], balls, start.phi.begin());
    if (study_.parameters.balls_collide() && overlap(study_.parameters, start.phi.data())) continue;
    given.push_back(start);
    places.push_back(i);
  }
  Decided those;
  if (!given.empty()) session_.decide(given, those);
  catalogue_.settle(those);
  Fate none;
  none.outcome = Outcome::failed;
  none.time = std::numeric_limits<double>::quiet_NaN();
  Ended ended{phi, std::vector<Fate>(count, none), {}, std::vector<TransientRow>(gathers_ ? count : 0)};
  for (std::size_t k = 0; k < places.size(); ++k) {
    ended.fates[places[k]] = those.fates[k];
    if (gathers_) ended.transients[places[k]] = those.transients[k];
  }
  return ended;
}

}  // namespace equipoise
