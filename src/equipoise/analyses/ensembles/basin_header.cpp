// Which programs give the same bits, and which part of a study decides the outcomes of its starts.
#include "equipoise/analyses/ensembles/basin_header.hpp"

#include "equipoise/analyses/ensembles/start_arrays.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

BasinFileHeader basin_file_header(const Study& study, bool angles, bool transients, const std::string& given_starts,
                                  const std::string& target) {
  Study identity = with_horizon(study);  // everything that decides the outcome of start i
  const Sampler sampler = sampler_of(study);
  identity.sampling.starts = sampler.grid() ? sampler.grid()->starts() : 1;
  BasinFileHeader header;
  header.study = to_toml(identity);
  header.balls = study.parameters.balls;
  header.cpu_target = target;
  header.arithmetic = cpu_arithmetic(target);
  header.angles = angles;
  header.driven = study.speed.driven();
  header.touches = study.parameters.balls_collide();
  header.sticks = balls_may_stick(study);
  for (const model::StateVariable& v : model::state_variables(study.system().layout()))
    header.variables.push_back(v.name);
  for (const UncertainValue& value : study.uncertain.values) {
    header.drawn.push_back(value.key);
    header.drawn_units.push_back(value.unit.empty() ? "1" : value.unit);
  }
  header.full_starts = !study.sampling.box.empty() || !given_starts.empty();
  header.own_starts = given_starts;
  header.method = sampler.method();
  header.scales = study.scales;
  if (transients) header.transients = transient_settings(study);
  return header;
}

}  // namespace equipoise
