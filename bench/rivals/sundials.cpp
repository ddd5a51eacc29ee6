// SUNDIALS: CVODE (Adams, fixed-point iteration) and ARKODE (explicit Dormand-Prince 5(4)), one solver a thread that is
// reinitialised for every trajectory.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
#include "rival.hpp"

namespace equipoise::bench {

namespace {

namespace kernels = HWY_NAMESPACE;

constexpr long most_steps = 100'000'000;

void check(int flag, const char* what) {
  if (flag < 0) throw RunError(std::string("SUNDIALS: ") + what + " returned " + std::to_string(flag));
}

template <bool accelerating>
struct Equations {
  kernels::FreeFlow<double, 2, kernels::paper_terms(accelerating)> flow;
  std::uint64_t evaluations = 0;

  static int evaluate(double t, N_Vector z, N_Vector dz, void* self) {
    auto& equations = *static_cast<Equations*>(self);
    ++equations.evaluations;
    equations.flow(t, N_VGetArrayPointer(z), N_VGetArrayPointer(dz));
    return 0;
  }
};

// What both solvers need.
class Context {
 public:
  Context() {
    check(SUNContext_Create(nullptr, &context_), "SUNContext_Create");
    z_ = N_VNew_Serial(8, context_);
    N_VConst(0.0, z_);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() {
    N_VDestroy(z_);
    SUNContext_Free(&context_);
  }
  double* state() { return N_VGetArrayPointer(z_); }

 protected:
  SUNContext context_ = nullptr;
  N_Vector z_ = nullptr;
};

class Cvode : public Context {
 public:
  Cvode(CVRhsFn f, void* user) {
    memory_ = CVodeCreate(CV_ADAMS, context_);
    check(CVodeInit(memory_, f, 0.0, z_), "CVodeInit");
    check(CVodeSStolerances(memory_, relative_tolerance, absolute_tolerance), "CVodeSStolerances");
    iteration_ = SUNNonlinSol_FixedPoint(z_, 0, context_);
    check(CVodeSetNonlinearSolver(memory_, iteration_), "CVodeSetNonlinearSolver");
    check(CVodeSetUserData(memory_, user), "CVodeSetUserData");
    check(CVodeSetMaxNumSteps(memory_, most_steps), "CVodeSetMaxNumSteps");
  }
  ~Cvode() {
    CVodeFree(&memory_);
    SUNNonlinSolFree(iteration_);
  }
  bool advance(double begin, double end) {
    check(CVodeReInit(memory_, begin, z_), "CVodeReInit");
    check(CVodeSetStopTime(memory_, end), "CVodeSetStopTime");
    double reached = begin;
    return CVode(memory_, end, z_, &reached, CV_NORMAL) >= 0;
  }

 private:
  void* memory_ = nullptr;
  SUNNonlinearSolver iteration_ = nullptr;
};

class Arkode : public Context {
 public:
  Arkode(ARKRhsFn f, void* user) : f_(f) {
    memory_ = ERKStepCreate(f, 0.0, z_, context_);
    check(ERKStepSetTableNum(memory_, ARKODE_DORMAND_PRINCE_7_4_5), "ERKStepSetTableNum");
    check(ERKStepSStolerances(memory_, relative_tolerance, absolute_tolerance), "ERKStepSStolerances");
    check(ERKStepSetUserData(memory_, user), "ERKStepSetUserData");
    check(ERKStepSetMaxNumSteps(memory_, most_steps), "ERKStepSetMaxNumSteps");
  }
  ~Arkode() { ERKStepFree(&memory_); }
  // The last step ends at `end`: interpolation is of lower order than the steps.
  bool advance(double begin, double end) {
    check(ERKStepReInit(memory_, f_, begin, z_), "ERKStepReInit");
    check(ERKStepSetStopTime(memory_, end), "ERKStepSetStopTime");
    double reached = begin;
    return ERKStepEvolve(memory_, end, z_, &reached, ARK_NORMAL) >= 0;
  }

 private:
  ARKRhsFn f_;
  void* memory_ = nullptr;
};

template <class Solver, bool accelerating>
std::uint64_t follow(const Problem& problem, double* states, std::size_t count) {
  using System = Equations<accelerating>;
  System equations{{problem.parameters, problem.segment}};
  Solver solver(System::evaluate, &equations);
  for (std::size_t i = 0; i < count; ++i) {
    double* row = states + 8 * i;
    std::copy_n(row, 8, solver.state());
    const bool done = solver.advance(problem.segment.begin, problem.end);
    std::copy_n(solver.state(), 8, row);
    if (!done) row[0] = std::numeric_limits<double>::quiet_NaN();
  }
  return equations.evaluations;
}

template <class Solver>
class Sundials : public Rival {
 public:
  Sundials(const char* solver, const char* how) {
    name = std::string("SUNDIALS ") + solver;
    settings = std::string(how) + ", one solver a thread, reinitialised for every trajectory";
  }

  Cost run(const Problem& problem, std::vector<double>& states, int threads) override {
    return in_parallel(states.size() / 8, threads, [&](std::size_t first, std::size_t count) {
      double* rows = states.data() + 8 * first;
      return problem.segment.acceleration == 0.0 ? follow<Solver, false>(problem, rows, count)
                                                 : follow<Solver, true>(problem, rows, count);
    });
  }
};

}  // namespace

RivalPointer cvode_adams() {
  return std::make_unique<Sundials<Cvode>>("CVODE Adams", "orders 1 to 12, fixed-point iteration without Newton");
}

RivalPointer arkode_dopri5() {
  return std::make_unique<Sundials<Arkode>>("ARKODE ERK", "Dormand-Prince 5(4), default step control");
}

}  // namespace equipoise::bench
