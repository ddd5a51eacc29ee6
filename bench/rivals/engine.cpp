// This engine, through the same call by which the program follows ensembles.
#include <limits>

#include <fmt/format.h>

#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/batch/batch_task.hpp"
#include "rival.hpp"

namespace equipoise::bench {

namespace {

class Engine : public Rival {
 public:
  explicit Engine(double tolerance) : tolerance_(tolerance) {
    name = "Equipoise";
    settings = fmt::format(
        "DOP853, one trajectory and step size a lane, lanes refilled, angles' errors absolute; tolerance {:g} in units "
        "of batch_error_scale(): lambda + sum mu for x, y, u, v and 1 for angles and their rates",
        tolerance);
    least_starts = 256;
  }

  Cost run(const Problem& problem, std::vector<double>& states, int threads) override {
    const std::size_t size = model::dimension(problem.parameters.balls);
    return in_parallel(states.size() / size, threads, [&](std::size_t first, std::size_t count) {
      BatchWork work;
      BatchTask task;
      task.parameters = &problem.parameters;
      task.segment = problem.segment;
      task.end = problem.end;
      task.tolerance = tolerance_;
      task.count = count;
      task.states = states.data() + first * size;
      task.work = &work;
      std::vector<Outcome> outcomes(count);
      advance_batch(task, outcomes);
      for (std::size_t i = 0; i < count; ++i)
        if (outcomes[i].kind != OutcomeKind::undecided)
          task.states[i * size] = std::numeric_limits<double>::quiet_NaN();
      return work.evaluations(count);
    });
  }

 private:
  double tolerance_;
};

}  // namespace

RivalPointer engine(double tolerance) { return std::make_unique<Engine>(tolerance); }

}  // namespace equipoise::bench
