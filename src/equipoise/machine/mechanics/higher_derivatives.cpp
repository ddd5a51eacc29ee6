// The equations on dual numbers, one inside the other: each level differentiates along one direction.
#include "equipoise/machine/mechanics/higher_derivatives.hpp"

#include "equipoise/core/math/gradient.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/equations-inl.hpp"
#include "equipoise/machine/model/flow-inl.hpp"

namespace equipoise::model {

namespace {
using Once = Gradient<double, 1>;
using Twice = Gradient<Once, 1>;
using Thrice = Gradient<Twice, 1>;

template <class T>
using PlainFlow = HWY_NAMESPACE::FreeFlow<T, any_count, HWY_NAMESPACE::Terms{false, false, false}>;

Segment at_constant_speed(const System& system) { return {0.0, 0.0, 0.0, system.speed(), 0.0, false}; }

// The largest state of a tilting rotor at a prescribed speed.
constexpr int most_tilting = dimension(max_balls) + 4;

// dy/dt at `state`, both of most_tilting components.
template <class T>
void nested_rate(const System& system, const T* state, T* rate) {
  namespace kernels = HWY_NAMESPACE;
  if (!system.tilts()) return PlainFlow<T>(system.parameters(), at_constant_speed(system))(T(0.0), state, rate);
  const kernels::BallBalancer<T, any_count, kernels::body_terms(true)> balancer(system.parameters(),
                                                                                system.layout().tilt);
  const kernels::RotorMotion<T> rotor{T(system.speed()), T(0.0), T(0.0), T(1.0)};
  balancer.body_derivative(rotor, nullptr, state, rate);
}
}  // namespace

Eigen::VectorXd third_derivative(const System& system, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
                                 const Eigen::VectorXd& v, const Eigen::VectorXd& w) {
  Thrice state[most_tilting], rate[most_tilting];
  const int size = system.dimension();
  for (int i = 0; i < size; ++i) {
    state[i].value.value.value = y[i];
    state[i].value.value.slope[0] = u[i];
    state[i].value.slope[0].value = v[i];
    state[i].slope[0].value.value = w[i];
  }
  nested_rate(system, state, rate);
  Eigen::VectorXd result(size);
  for (int i = 0; i < size; ++i) result[i] = rate[i].slope[0].slope[0].slope[0];
  return result;
}

Eigen::VectorXd second_derivative(const System& system, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& v) {
  Twice state[most_tilting], rate[most_tilting];
  const int size = system.dimension();
  for (int i = 0; i < size; ++i) {
    state[i].value.value = y[i];
    state[i].value.slope[0] = u[i];
    state[i].slope[0].value = v[i];
  }
  nested_rate(system, state, rate);
  Eigen::VectorXd result(size);
  for (int i = 0; i < size; ++i) result[i] = rate[i].slope[0].slope[0];
  return result;
}

}  // namespace equipoise::model
