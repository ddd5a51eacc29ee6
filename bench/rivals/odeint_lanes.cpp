// Boost.Odeint on a state of SIMD registers: the usual way to make a scalar library use the whole register. One
// trajectory a lane, one step size for all lanes, the error of a step that of the worst lane.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include <boost/numeric/odeint.hpp>

#include "equipoise/machine/model/flow-inl.hpp"
#include "rival.hpp"

namespace equipoise::bench {

namespace {

namespace odeint = boost::numeric::odeint;
namespace kernels = HWY_NAMESPACE;

using kernels::Pack;
using State = std::array<Pack, 8>;
constexpr std::size_t lanes = kernels::pack_lanes;

// Odeint's own error norm, max |error_i|/(absolute + relative (|z_i| + |dt z_i'|)), over lanes as well.
class WorstLane {
 public:
  using value_type = double;
  using algebra_type = odeint::array_algebra;
  using operations_type = odeint::default_operations;

  template <class Algebra, class Time>
  double error(Algebra&, const State& old, const State& rate, State& error, Time dt) const {
    Pack worst(0.0);
    for (std::size_t i = 0; i < old.size(); ++i) {
      const Pack size = absolute(old[i]) + absolute(Pack(dt) * rate[i]);
      const Pack allowed = Pack(absolute_tolerance) + Pack(relative_tolerance) * size;
      worst = maximum(worst, absolute(error[i]) / allowed);
    }
    alignas(64) double each[8] = {};
    worst.store(each);
    return *std::max_element(each, each + lanes);
  }
};

using Stepper = odeint::runge_kutta_dopri5<State, double, State, double, odeint::array_algebra>;
using Controlled = odeint::controlled_runge_kutta<Stepper, WorstLane>;

template <bool accelerating>
std::uint64_t follow(const Problem& problem, double* states, std::size_t count) {
  const kernels::FreeFlow<Pack, 2, kernels::paper_terms(accelerating)> flow(problem.parameters, problem.segment);
  std::uint64_t calls = 0, evaluations = 0;
  const auto system = [&](const State& z, State& dz, double t) {
    ++calls;
    flow(Pack(t), z.data(), dz.data());
  };
  for (std::size_t i = 0; i < count; i += lanes) {
    const std::size_t filled = std::min(lanes, count - i);
    alignas(64) double column[8] = {};
    State z;
    for (std::size_t k = 0; k < 8; ++k) {
      for (std::size_t lane = 0; lane < lanes; ++lane) column[lane] = states[8 * (i + std::min(lane, filled - 1)) + k];
      z[k] = Pack::load(column);
    }
    calls = 0;
    odeint::integrate_adaptive(Controlled(), system, z, problem.segment.begin, problem.end, first_step);
    evaluations += calls * filled;
    for (std::size_t k = 0; k < 8; ++k) {
      z[k].store(column);
      for (std::size_t lane = 0; lane < filled; ++lane) states[8 * (i + lane) + k] = column[lane];
    }
  }
  return evaluations;
}

class OdeintLanes : public Rival {
 public:
  OdeintLanes() {
    name = "Odeint dopri5, " + std::to_string(lanes) + " lanes";
    settings =
        "Boost.Odeint, Dormand-Prince 5(4), controlled, on a state of SIMD registers: one trajectory a lane, a common "
        "step, the "
        "error "
        "of the worst lane; vector sine and cosine of this engine";
    least_starts = 64;
  }

  Cost run(const Problem& problem, std::vector<double>& states, int threads) override {
    return in_parallel(states.size() / 8, threads, [&](std::size_t first, std::size_t count) {
      double* rows = states.data() + 8 * first;
      return problem.segment.acceleration == 0.0 ? follow<false>(problem, rows, count)
                                                 : follow<true>(problem, rows, count);
    });
  }
};

}  // namespace

RivalPointer odeint_dopri5_lanes() { return std::make_unique<OdeintLanes>(); }

}  // namespace equipoise::bench
