// Jacobians by running the one set of equations on dual numbers.
#include "equipoise/model/linearisation.hpp"

#include "equipoise/math/dual.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/flow-inl.hpp"
#include "equipoise/model/strobe.hpp"

namespace equipoise::model {

namespace {
namespace kernels = HWY_NAMESPACE;
constexpr kernels::Terms autonomous{false, false, false};

Segment constant_speed(double speed) { return {0.0, 0.0, 0.0, speed, 0.0, false}; }
}  // namespace

Eigen::MatrixXd jacobian(const Parameters& p, double speed, const double* z) {
  return with_ball_count(p.balls, [&](auto n) -> Eigen::MatrixXd {
    constexpr int size = dimension(n);
    const kernels::FreeFlow<Dual<size>, n, autonomous> flow(p, constant_speed(speed));
    Dual<size> state[size], rate[size];
    for (int i = 0; i < size; ++i) {
      state[i] = Dual<size>(z[i]);
      state[i].slope[i] = 1.0;
    }
    flow(Dual<size>(0.0), state, rate);
    Eigen::MatrixXd result(size, size);
    for (int i = 0; i < size; ++i)
      for (int column = 0; column < size; ++column) result(i, column) = rate[i].slope[column];
    return result;
  });
}

Eigen::VectorXd derivative(const Parameters& p, double speed, const double* z, double psi) {
  return with_ball_count(p.balls, [&](auto n) -> Eigen::VectorXd {
    if (is_strobed(p)) {
      constexpr kernels::Terms strobed{false, true, true};
      const kernels::FreeFlow<double, n, strobed> flow(p, {0.0, 0.0, psi, speed, 0.0, false});
      Eigen::VectorXd rate(dimension(n));
      flow(0.0, z, rate.data());
      return rate;
    }
    const kernels::FreeFlow<double, n, autonomous> flow(p, constant_speed(speed));
    Eigen::VectorXd rate(dimension(n));
    flow(0.0, z, rate.data());
    return rate;
  });
}

Eigen::VectorXd centred_state(const Parameters& p, const double* phi) {
  Eigen::VectorXd z = Eigen::VectorXd::Zero(dimension(p.balls));
  for (int i = 0; i < p.balls; ++i) z[index::phi(i)] = phi[i];
  return z;
}

}  // namespace equipoise::model
