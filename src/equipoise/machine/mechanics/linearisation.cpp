// Jacobians from the equations of motion, run on dual numbers; higher derivatives on dual numbers one inside the other,
// where each level differentiates along one direction.
#include "equipoise/machine/mechanics/linearisation.hpp"

#include <type_traits>

#include "equipoise/core/math/gradient.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/equations-inl.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"

namespace equipoise::model {

namespace {
namespace kernels = HWY_NAMESPACE;
constexpr kernels::Terms autonomous{false, false, false};

Segment constant_speed(double speed) { return {0.0, 0.0, 0.0, speed, 0.0, false}; }

// A dual number has a slope for each variable. Two balls in a plane have 8 variables; 16 are those of four balls on a
// tilting rotor, or of six in a plane. Slopes do not mix, so the width moves no bit of a result.
template <int most, class Use>
Eigen::MatrixXd at_width(int size, const Use& use) {
  if (size <= 8) return use(std::integral_constant<int, 8>());
  if (size <= 16) return use(std::integral_constant<int, 16>());
  return use(std::integral_constant<int, most>());
}

// `most`: the room that `flow` needs.
template <int most, class Dual, class Flow>
Eigen::MatrixXd slopes_of(const Flow& flow, const double* y, int size) {
  Dual state[most], rate[most];
  for (int i = 0; i < size; ++i) {
    state[i] = Dual(y[i]);
    state[i].slope[i] = 1.0;
  }
  flow(Dual(0.0), state, rate);
  Eigen::MatrixXd result(size, size);
  for (int i = 0; i < size; ++i)
    for (int column = 0; column < size; ++column) result(i, column) = rate[i].slope[column];
  return result;
}
}  // namespace

Eigen::MatrixXd jacobian(const Parameters& p, double speed, const double* z) {
  constexpr int most = dimension(max_balls);
  const int size = dimension(p.balls);
  return at_width<most>(size, [&](auto width) {
    using Dual = Gradient<double, width>;
    return slopes_of<most, Dual>(kernels::FreeFlow<Dual, any_count, autonomous>(p, constant_speed(speed)), z, size);
  });
}

Eigen::VectorXd derivative(const Parameters& p, double speed, const double* z, double psi) {
  Eigen::VectorXd rate(dimension(p.balls));
  if (depends_on_rotor_angle(p)) {
    constexpr kernels::Terms angle_dependent{false, true, true};
    const kernels::FreeFlow<double, any_count, angle_dependent> flow(p, {0.0, 0.0, psi, speed, 0.0, false});
    flow(0.0, z, rate.data());
    return rate;
  }
  const kernels::FreeFlow<double, any_count, autonomous> flow(p, constant_speed(speed));
  flow(0.0, z, rate.data());
  return rate;
}

Eigen::VectorXd rate(const System& system, const Eigen::VectorXd& y, double psi) {
  if (system.plain()) return derivative(system.parameters(), system.speed(), y.data(), psi);
  Eigen::VectorXd rate(system.dimension());
  kernels::with_tilt(system, [&](auto tilt) {
    kernels::SmoothFlow<double, any_count, tilt>(system, psi)(0.0, y.data(), rate.data());
  });
  return rate;
}

Eigen::MatrixXd jacobian(const System& system, const Eigen::VectorXd& y, double psi) {
  if (system.plain() && system.autonomous()) return jacobian(system.parameters(), system.speed(), y.data());
  const int size = system.dimension();
  return kernels::with_tilt(system, [&](auto tilt) {
    constexpr int most = kernels::SmoothFlow<double, any_count, tilt>::dimension;
    return at_width<most>(size, [&](auto width) {
      using Dual = Gradient<double, width>;
      return slopes_of<most, Dual>(kernels::SmoothFlow<Dual, any_count, tilt>(system, psi), y.data(), size);
    });
  });
}

namespace {
using Once = Gradient<double, 1>;
using Twice = Gradient<Once, 1>;
using Thrice = Gradient<Twice, 1>;

// The largest state of a tilting rotor at a prescribed speed.
constexpr int most_tilting = dimension(max_balls) + 4;

// dy/dt at `state`, both of most_tilting components.
template <class T>
void nested_rate(const System& system, const T* state, T* rate) {
  if (!system.tilts())
    return kernels::FreeFlow<T, any_count, autonomous>(system.parameters(), constant_speed(system.speed()))(
        T(0.0), state, rate);
  const kernels::BallBalancer<T, any_count, kernels::body_terms(true)> balancer(system.parameters(),
                                                                                system.layout().tilt);
  const kernels::RotorMotion<T> rotor{T(system.speed()), T(0.0), T(0.0), T(1.0)};
  balancer.body_derivative(rotor, nullptr, state, rate);
}

double& innermost(double& x) { return x; }
template <class T>
double& innermost(Gradient<T, 1>& x) {
  return innermost(x.value);
}
double all_slopes(double x) { return x; }
template <class T>
double all_slopes(const Gradient<T, 1>& x) {
  return all_slopes(x.slope[0]);
}

// The number y with a slope at each level, the outermost first.
void nest(double& x, double y) { x = y; }
template <class T, class... Inner>
void nest(Gradient<T, 1>& x, double y, double outer, Inner... inner) {
  nest(x.value, y, inner...);
  innermost(x.slope[0]) = outer;
}

template <class T, class... Directions>
Eigen::VectorXd derivative_along(const System& system, const Eigen::VectorXd& y, const Directions&... along) {
  T state[most_tilting], rate[most_tilting];
  const int size = system.dimension();
  for (int i = 0; i < size; ++i) nest(state[i], y[i], along[i]...);
  nested_rate(system, state, rate);
  Eigen::VectorXd result(size);
  for (int i = 0; i < size; ++i) result[i] = all_slopes(rate[i]);
  return result;
}
}  // namespace

Eigen::VectorXd second_derivative(const System& system, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& v) {
  return derivative_along<Twice>(system, y, v, u);
}

Eigen::VectorXd third_derivative(const System& system, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
                                 const Eigen::VectorXd& v, const Eigen::VectorXd& w) {
  return derivative_along<Thrice>(system, y, w, v, u);
}

Eigen::VectorXd centred_state(const Parameters& p, const double* phi) {
  Eigen::VectorXd z = Eigen::VectorXd::Zero(dimension(p.balls));
  for (int i = 0; i < p.balls; ++i) z[index::phi(i)] = phi[i];
  return z;
}

}  // namespace equipoise::model
