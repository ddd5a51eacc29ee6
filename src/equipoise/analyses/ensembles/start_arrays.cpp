// Fills the arrays start by start, column by column as in a file.
#include "equipoise/analyses/ensembles/start_arrays.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

bool balls_may_stick(const Study& study) {
  const auto drawn = [](const UncertainValue& v) {
    return v.key == "balancer.rolling" || v.key == "balancer.stiction";
  };
  const auto& values = study.uncertain.values;
  return study.parameters.balls_stick() || std::any_of(values.begin(), values.end(), drawn);
}

void add_start(const Study& study, const Sampler& sampler, std::uint64_t index, const InitialState& s, bool own,
               const Outcome& outcome, const TransientRow* row, StartArrays& arrays) {
  ++arrays.starts;
  const int balls = arrays.balls = study.parameters.balls;
  arrays.phi.insert(arrays.phi.end(), s.phi.begin(), s.phi.begin() + balls);
  if (own) arrays.psi.push_back(s.psi);
  if (own || !study.sampling.box.empty()) {
    arrays.rotor_state.insert(arrays.rotor_state.end(), {s.x, s.y, s.x_dot, s.y_dot});
    arrays.phi_dot.insert(arrays.phi_dot.end(), s.phi_dot.begin(), s.phi_dot.begin() + balls);
  }
  const std::vector<double> drawn = drawn_values(study, sampler, study.sampling.seed, index);
  arrays.drawn.insert(arrays.drawn.end(), drawn.begin(), drawn.end());
  if (sampler.grid()) arrays.weight.push_back(sampler.weight(study.sampling.seed, index));
  arrays.outcome.push_back(code_of(outcome));
  arrays.decision_time.push_back(outcome.time);
  arrays.decided_by.push_back(static_cast<signed char>(outcome.by));
  if (study.speed.driven()) arrays.mean_speed.push_back(outcome.mean_speed);
  if (balls_may_stick(study)) arrays.left_unbalance.push_back(outcome.unbalance);
  if (study.parameters.balls_collide()) arrays.balls_met.push_back(outcome.met);
  if (row)
    for (std::size_t k = 0; k < transient_figures.size(); ++k)
      arrays.transients[k].push_back(row->*transient_figures[k].value);
}

InitialState start_of(const Study& study, std::uint64_t index) {
  check(study);
  const Sampler sampler = sampler_of(study);
  if (sampler.grid() && index >= sampler.grid()->starts())
    throw InputError(study.name, "start index", fmt::format("{}", index),
                     fmt::format("must be below {}, the starts of this grid", sampler.grid()->starts()));
  return drawn_start_of(study, sampler, study.sampling.seed, index);
}

}  // namespace equipoise
