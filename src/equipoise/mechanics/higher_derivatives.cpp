// The equations on dual numbers, one inside the other: each level differentiates along one direction.
#include "equipoise/mechanics/higher_derivatives.hpp"

#include "equipoise/math/gradient.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/flow-inl.hpp"

namespace equipoise::model {

namespace {
using Once = Gradient<double, 1>;
using Twice = Gradient<Once, 1>;
using Thrice = Gradient<Twice, 1>;

template <class T>
using PlainFlow = HWY_NAMESPACE::FreeFlow<T, any_count, HWY_NAMESPACE::Terms{false, false, false}>;

Segment at_constant_speed(const System& system) { return {0.0, 0.0, 0.0, system.speed(), 0.0, false}; }
}  // namespace

Eigen::VectorXd third_derivative(const System& system, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
                                 const Eigen::VectorXd& v, const Eigen::VectorXd& w) {
  using Flow = PlainFlow<Thrice>;
  Thrice state[Flow::dimension], rate[Flow::dimension];
  const int size = system.dimension();
  for (int i = 0; i < size; ++i) {
    state[i].value.value.value = y[i];
    state[i].value.value.slope[0] = u[i];
    state[i].value.slope[0].value = v[i];
    state[i].slope[0].value.value = w[i];
  }
  Flow(system.parameters(), at_constant_speed(system))(Thrice(0.0), state, rate);
  Eigen::VectorXd result(size);
  for (int i = 0; i < size; ++i) result[i] = rate[i].slope[0].slope[0].slope[0];
  return result;
}

Eigen::VectorXd second_derivative(const System& system, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& v) {
  using Flow = PlainFlow<Twice>;
  Twice state[Flow::dimension], rate[Flow::dimension];
  const int size = system.dimension();
  for (int i = 0; i < size; ++i) {
    state[i].value.value = y[i];
    state[i].value.slope[0] = u[i];
    state[i].slope[0].value = v[i];
  }
  Flow(system.parameters(), at_constant_speed(system))(Twice(0.0), state, rate);
  Eigen::VectorXd result(size);
  for (int i = 0; i < size; ++i) result[i] = rate[i].slope[0].slope[0];
  return result;
}

}  // namespace equipoise::model
