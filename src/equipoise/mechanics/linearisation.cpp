// Jacobians from the equations of motion, run on dual numbers.
#include "equipoise/mechanics/linearisation.hpp"

#include "equipoise/math/gradient.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/flow-inl.hpp"
#include "equipoise/model/smooth_flow-inl.hpp"
#include "equipoise/model/stroboscopic_section.hpp"

namespace equipoise::model {

namespace {
namespace kernels = HWY_NAMESPACE;
constexpr kernels::Terms autonomous{false, false, false};

Segment constant_speed(double speed) { return {0.0, 0.0, 0.0, speed, 0.0, false}; }
}  // namespace

Eigen::MatrixXd jacobian(const Parameters& p, double speed, const double* z) {
  constexpr int most = dimension(max_balls);
  using Dual = Gradient<double, most>;
  const int size = dimension(p.balls);
  const kernels::FreeFlow<Dual, any_count, autonomous> flow(p, constant_speed(speed));
  Dual state[most], rate[most];
  for (int i = 0; i < size; ++i) {
    state[i] = Dual(z[i]);
    state[i].slope[i] = 1.0;
  }
  flow(Dual(0.0), state, rate);
  Eigen::MatrixXd result(size, size);
  for (int i = 0; i < size; ++i)
    for (int column = 0; column < size; ++column) result(i, column) = rate[i].slope[column];
  return result;
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

namespace {
template <bool tilt>
Eigen::MatrixXd smooth_jacobian(const System& system, const Eigen::VectorXd& y, double psi) {
  constexpr int most = kernels::SmoothFlow<double, any_count, tilt>::dimension;
  using Dual = Gradient<double, most>;
  const int size = system.dimension();
  Dual z[most], dz[most];
  for (int i = 0; i < size; ++i) {
    z[i] = Dual(y[i]);
    z[i].slope[i] = 1.0;
  }
  kernels::SmoothFlow<Dual, any_count, tilt>(system, psi)(Dual(0.0), z, dz);
  Eigen::MatrixXd result(size, size);
  for (int i = 0; i < size; ++i)
    for (int column = 0; column < size; ++column) result(i, column) = dz[i].slope[column];
  return result;
}
}  // namespace

Eigen::MatrixXd jacobian(const System& system, const Eigen::VectorXd& y, double psi) {
  if (system.plain() && system.autonomous()) return jacobian(system.parameters(), system.speed(), y.data());
  return kernels::with_tilt(system, [&](auto tilt) { return smooth_jacobian<tilt>(system, y, psi); });
}

Eigen::VectorXd centred_state(const Parameters& p, const double* phi) {
  Eigen::VectorXd z = Eigen::VectorXd::Zero(dimension(p.balls));
  for (int i = 0; i < p.balls; ++i) z[index::phi(i)] = phi[i];
  return z;
}

}  // namespace equipoise::model
