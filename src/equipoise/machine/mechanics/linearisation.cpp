// Jacobians from the equations of motion, run on dual numbers.
#include "equipoise/machine/mechanics/linearisation.hpp"

#include <type_traits>

#include "equipoise/core/math/gradient.hpp"
#include "equipoise/machine/model/ball_count.hpp"
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

Eigen::VectorXd centred_state(const Parameters& p, const double* phi) {
  Eigen::VectorXd z = Eigen::VectorXd::Zero(dimension(p.balls));
  for (int i = 0; i < p.balls; ++i) z[index::phi(i)] = phi[i];
  return z;
}

}  // namespace equipoise::model
