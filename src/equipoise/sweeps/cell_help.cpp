// What cells ask of their ensembles.
#include "equipoise/sweeps/cell_help.hpp"

namespace equipoise {

BasinOptions cell_options(const SweepPlan& plan, const CellStart& start) {
  BasinOptions options;
  options.half_width = plan.request().half_width;
  options.limit_given = plan.request().limit_given;
  options.transients = plan.transients();
  options.seeds = start.seeds;
  options.informed = start.informed;
  options.hints = &start.hints;
  return options;
}

EnsembleHelper helper_for(const SweepPlan& plan, const CellAtWork& at, int threads, const StopFlag* stop) {
  BasinOptions options = cell_options(plan, at.start);
  options.threads = threads;
  options.stop = stop;
  return EnsembleHelper(plan.study_of(at.cell), options, at.method);
}

}  // namespace equipoise
