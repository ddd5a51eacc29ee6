// A call of the library that takes long, on the instruction set and threads that its options name.
#pragma once

#include "equipoise/core/running/parallel.hpp"
#include "equipoise/core/running/reporting.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"

namespace equipoise {

/// What `work` makes with these options on their instruction set, reporting to this thread (reported()).
template <class Options, class Work>
auto long_call(const Options& options, const Work& work) {
  const ChosenCpuTarget chosen(options.cpu_target);
  return reported(options, work);
}

/// Says in a result on how many threads and on which instruction set it is computed.
inline void note_machine(RunInfo& result, const RunOptions& options) {
  result.threads = thread_count(options.threads);
  result.cpu_target = cpu_target();
}

}  // namespace equipoise
