// Reference solutions: Fehlberg 7(8) in long double, checked by this repository's scalar DOP853 in double.
#include "reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <boost/numeric/odeint.hpp>

#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/machine/model/flow-inl.hpp"

namespace equipoise::bench {

// long double as a number type of the equations. A class, because functions on built-in types are not found by the
// types of their arguments and the template would quietly take those for double.
struct Extended {
  long double v = 0.0L;

  Extended() = default;
  Extended(double a) : v(a) {}
  static Extended of(long double a) {
    Extended e;
    e.v = a;
    return e;
  }

  friend Extended operator+(Extended a, Extended b) { return of(a.v + b.v); }
  friend Extended operator-(Extended a, Extended b) { return of(a.v - b.v); }
  friend Extended operator*(Extended a, Extended b) { return of(a.v * b.v); }
  friend Extended operator/(Extended a, Extended b) { return of(a.v / b.v); }
  friend Extended operator-(Extended a) { return of(-a.v); }
  friend Extended multiply_add(Extended a, Extended b, Extended c) { return of(a.v * b.v + c.v); }
  friend void sin_cos(Extended a, Extended& sine, Extended& cosine) {
    sine = of(std::sin(a.v));
    cosine = of(std::cos(a.v));
  }
};

namespace {

namespace odeint = boost::numeric::odeint;
namespace kernels = HWY_NAMESPACE;

using LongState = std::array<long double, 8>;
constexpr kernels::Terms terms = kernels::paper_terms(true);

void follow_long(const Problem& problem, double* row) {
  const kernels::FreeFlow<Extended, 2, terms> flow(problem.parameters, problem.segment);
  const auto system = [&](const LongState& z, LongState& dz, long double t) {
    Extended in[8], out[8];
    for (int i = 0; i < 8; ++i) in[i] = Extended::of(z[i]);
    flow(Extended::of(t), in, out);
    for (int i = 0; i < 8; ++i) dz[i] = out[i].v;
  };
  LongState z;
  std::copy_n(row, 8, z.begin());
  using Stepper = odeint::runge_kutta_fehlberg78<LongState, long double>;
  odeint::integrate_adaptive(odeint::make_controlled<Stepper>(1e-16L, 0.0L), system, z,
                             static_cast<long double>(problem.segment.begin), static_cast<long double>(problem.end),
                             1e-3L);
  std::copy(z.begin(), z.end(), row);
}

void follow_double(const Problem& problem, double* row) {
  using Flow = kernels::FreeFlow<double, 2, terms>;
  const Flow flow(problem.parameters, problem.segment);
  const auto scale = kernels::error_scale<Flow::dimension>(problem.parameters, 1e-14);
  kernels::AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale);
  if (integrator.advance(problem.segment.begin, problem.end, row, [](double, double, const auto&) {}) !=
      IntegrationStatus::done)
    row[0] = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

const char* const reference_method =
    "Fehlberg 7(8) of Boost.Odeint in long double (80 bits on x86) at absolute tolerance 1e-16, checked by the scalar "
    "DOP853 of this repository in double at 1e-14";

Reference make_reference(const Problem& problem, const std::vector<double>& starts, int threads) {
  Reference reference;
  reference.states = starts;
  std::vector<double> second = starts;
  in_parallel(starts.size() / 8, threads, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      follow_long(problem, &reference.states[8 * i]);
      follow_double(problem, &second[8 * i]);
    }
    return 0;
  });
  const std::vector<double> difference = errors(second, reference.states);
  reference.median = quantile(difference, 0.5);
  reference.most = quantile(difference, 1.0);
  return reference;
}

std::vector<double> errors(const std::vector<double>& states, const std::vector<double>& reference) {
  std::vector<double> distance(states.size() / 8);
  for (std::size_t i = 0; i < distance.size(); ++i) {
    distance[i] = std::hypot(states[8 * i] - reference[8 * i], states[8 * i + 1] - reference[8 * i + 1]);
    if (!std::isfinite(distance[i])) distance[i] = std::numeric_limits<double>::infinity();
  }
  return distance;
}

}  // namespace equipoise::bench
