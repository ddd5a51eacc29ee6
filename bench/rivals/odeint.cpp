// Boost.Odeint as its manual has it: std::array<double, 8>, controlled steppers, one trajectory after another.
#include <array>
#include <cstdint>

#include <boost/numeric/odeint.hpp>

#include "equipoise/machine/model/flow-inl.hpp"
#include "rival.hpp"

namespace equipoise::bench {

namespace {

namespace odeint = boost::numeric::odeint;
namespace kernels = HWY_NAMESPACE;

using State = std::array<double, 8>;

template <class Stepper, bool accelerating>
std::uint64_t follow(const Problem& problem, double* states, std::size_t count) {
  const kernels::FreeFlow<double, 2, kernels::paper_terms(accelerating)> flow(problem.parameters, problem.segment);
  std::uint64_t evaluations = 0;
  const auto system = [&](const State& z, State& dz, double t) {
    ++evaluations;
    flow(t, z.data(), dz.data());
  };
  for (std::size_t i = 0; i < count; ++i) {
    State z;
    std::copy_n(states + 8 * i, 8, z.begin());
    odeint::integrate_adaptive(odeint::make_controlled<Stepper>(absolute_tolerance, relative_tolerance), system, z,
                               problem.segment.begin, problem.end, first_step);
    std::copy(z.begin(), z.end(), states + 8 * i);
  }
  return evaluations;
}

template <class Stepper>
class Odeint : public Rival {
 public:
  Odeint(const char* stepper, const char* method) {
    name = std::string("Odeint ") + stepper;
    settings = std::string("Boost.Odeint, ") + method + ", controlled, one trajectory after another";
  }

  Cost run(const Problem& problem, std::vector<double>& states, int threads) override {
    return in_parallel(states.size() / 8, threads, [&](std::size_t first, std::size_t count) {
      double* rows = states.data() + 8 * first;
      return problem.segment.acceleration == 0.0 ? follow<Stepper, false>(problem, rows, count)
                                                 : follow<Stepper, true>(problem, rows, count);
    });
  }
};

}  // namespace

RivalPointer odeint_dopri5() {
  return std::make_unique<Odeint<odeint::runge_kutta_dopri5<State>>>("dopri5", "Dormand-Prince 5(4)");
}

RivalPointer odeint_fehlberg78() {
  return std::make_unique<Odeint<odeint::runge_kutta_fehlberg78<State>>>("fehlberg78", "Fehlberg 7(8)");
}

}  // namespace equipoise::bench
