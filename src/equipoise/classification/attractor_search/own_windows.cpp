// Follows motions on lanes.
#include "equipoise/classification/attractor_search/own_windows.hpp"

#include "equipoise/simulation/batch/batch_task.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"

namespace equipoise {

namespace {

// Rotors that all run over the same stretch of time.
struct Rotors {
  Rotors(const std::vector<const OwnRotor*>& own, const BatchTask& task) {
    for (const OwnRotor* given : own) {
      rotors.push_back(*given);
      rotors.back().segment = own_rotor(given->system).segment;
      rotors.back().end = task.end;
    }
    pointers = pointers_to(rotors);
  }
  std::vector<OwnRotor> rotors;
  std::vector<const OwnRotor*> pointers;
};

BatchTask task_from(const model::System& system, std::vector<double>& states, const ClassificationRule& rule,
                    double longest, double tolerance, const StopFlag* stop) {
  BatchTask task = batch_task(system);                        // from psi = 0, as on a stroboscopic section
  task.end = longest * rule.first_long_window + rule.window;  // windows end with a step, a little late
  task.tolerance = tolerance;
  task.count = states.size() / static_cast<std::size_t>(system.dimension());
  task.states = states.data();
  task.stop = stop;
  return task;
}

}  // namespace

std::vector<PilotRecord> own_windows(const model::System& system, const std::vector<const Motion*>& motions,
                                     std::vector<const OwnRotor*> own, const ClassificationRule& rule, double longest,
                                     double tolerance, const StopFlag* stop) {
  std::vector<double> states;
  for (const Motion* motion : motions) states.insert(states.end(), motion->state.begin(), motion->state.end());
  std::vector<PilotRecord> records(motions.size());
  if (motions.empty()) return records;
  ClassificationRule windows_only;
  windows_only.balls = rule.balls;
  windows_only.interchangeable = rule.interchangeable;
  windows_only.blind = true;
  windows_only.sag = rule.sag;
  windows_only.window = rule.window;
  windows_only.first_long_window = rule.first_long_window;
  windows_only.sameness = rule.sameness;
  BatchTask task = task_from(system, states, windows_only, longest, tolerance, stop);
  const Rotors rotors(own, task);
  if (!own.empty()) task.own = rotors.pointers.data();
  std::vector<Fate> fates(motions.size());
  if (!classify_batch(task, windows_only, fates, &records)) return std::vector<PilotRecord>(motions.size());
  return records;
}

std::vector<Fate> fates_by_windows(const model::System& system, std::vector<double> states,
                                   std::vector<const OwnRotor*> own, ClassificationRule rule, double longest,
                                   double tolerance, const StopFlag* stop) {
  rule.blind = false;
  BatchTask task = task_from(system, states, rule, longest, tolerance, stop);
  const Rotors rotors(own, task);
  if (!own.empty()) task.own = rotors.pointers.data();
  std::vector<Fate> fates(task.count);
  if (task.count > 0 && !classify_batch(task, rule, fates, nullptr)) fates.assign(task.count, Fate{});
  return fates;
}

}  // namespace equipoise
