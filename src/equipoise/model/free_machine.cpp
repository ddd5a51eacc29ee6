// The machine's equations on plain and on dual numbers, in the last piece of its drive.
#include "equipoise/model/free_machine.hpp"

#include <cmath>

#include "equipoise/math/dual.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/equations-inl.hpp"

namespace equipoise::model {

namespace {
namespace kernels = HWY_NAMESPACE;
constexpr kernels::Terms machine_terms{true, true, true, true};

// The motor's torque and the rate of the integral of its speed error, with their slopes in psi' and that integral.
template <class T>
struct MotorState {
  T torque, error_rate;
};

MotorState<double> motor_state(const DriveSegment& motor, const double& speed, const double& error) {
  return {motor.torque(motor.begin, speed, error), motor.error_rate(motor.begin, speed, error)};
}

template <int slopes>
MotorState<Dual<slopes>> motor_state(const DriveSegment& motor, const Dual<slopes>& speed, const Dual<slopes>& error) {
  MotorState<Dual<slopes>> result;
  result.torque = motor.torque(motor.begin, speed.value, error.value);
  result.error_rate = motor.error_rate(motor.begin, speed.value, error.value);
  const bool cut = std::fabs(result.torque.value) >= motor.limit;
  for (int k = 0; k < slopes; ++k) {
    if (!cut) result.torque.slope[k] = motor.slope * speed.slope[k] + motor.integral * error.slope[k];
    if (!cut && motor.integral != 0.0) result.error_rate.slope[k] = -speed.slope[k];
  }
  return result;
}

// Rates of the state of machine.hpp without psi: n balls' state, psi', integral of the error.
template <class T, int n>
void rates(const Parameters& p, const DrivePiece& piece, double psi, const T* z, T* dz) {
  const kernels::BallBalancer<T, n, machine_terms> balancer(p);
  const T speed = z[dimension(n)];
  const kernels::RotorMotion<T> rotor{speed, T(0.0), T(std::sin(psi)), T(std::cos(psi))};
  MotorState<T> motor{};
  if (piece.driven()) motor = motor_state(piece.motor, speed, z[dimension(n) + 1]);
  const auto result =
      balancer.machine_derivative(rotor, kernels::BallActions<T, n>{}, piece.driven(), motor.torque, z, dz);
  dz[dimension(n)] = result.acceleration;
  dz[dimension(n) + 1] = motor.error_rate;
}
}  // namespace

FreeMachine::FreeMachine(const Parameters& p, const DrivePiece& last) : p_(p), piece_(last) {
  size_ = dimension(p.balls);
  if (last.driven()) size_ += last.motor.integral != 0.0 ? 2 : 1;
}

Eigen::VectorXd FreeMachine::reduced(const double* z) const {
  const int balls = dimension(p_.balls);
  Eigen::VectorXd y(size_);
  for (int i = 0; i < balls; ++i) y[i] = z[i];
  for (int i = balls; i < size_; ++i) y[i] = z[i + 1];  // psi is left out
  return y;
}

double FreeMachine::speed(const Eigen::VectorXd& y) const { return driven() ? y[speed_place()] : piece_.speed; }

Eigen::VectorXd FreeMachine::rate(const Eigen::VectorXd& y, double psi) const {
  return with_ball_count(p_.balls, [&](auto n) -> Eigen::VectorXd {
    double z[dimension(n) + 2] = {}, dz[dimension(n) + 2];
    z[dimension(n)] = piece_.speed;
    for (int i = 0; i < size_; ++i) z[i] = y[i];
    rates<double, n>(p_, piece_, psi, z, dz);
    return Eigen::Map<Eigen::VectorXd>(dz, size_);
  });
}

Eigen::MatrixXd FreeMachine::jacobian(const Eigen::VectorXd& y, double psi) const {
  return with_ball_count(p_.balls, [&](auto n) -> Eigen::MatrixXd {
    constexpr int most = dimension(n) + 2;
    Dual<most> z[most], dz[most];
    z[dimension(n)] = piece_.speed;
    for (int i = 0; i < size_; ++i) {
      z[i] = y[i];
      z[i].slope[i] = 1.0;
    }
    rates<Dual<most>, n>(p_, piece_, psi, z, dz);
    Eigen::MatrixXd a(size_, size_);
    for (int i = 0; i < size_; ++i)
      for (int k = 0; k < size_; ++k) a(i, k) = dz[i].slope[k];
    return a;
  });
}

bool FreeMachine::coasts() const {
  const DriveSegment& m = piece_.motor;
  return driven() && m.constant == 0.0 && m.slope == 0.0 && m.integral == 0.0;
}

bool FreeMachine::holds_speed() const { return !driven() || piece_.motor.slope < 0.0 || piece_.motor.integral != 0.0; }

std::optional<double> FreeMachine::balanced_speed() const {
  if (!driven()) return piece_.speed;
  const DriveSegment& m = piece_.motor;
  if (m.integral != 0.0) return m.aim;
  if (m.slope == 0.0) return std::nullopt;
  return -m.constant / m.slope;
}

Eigen::VectorXd FreeMachine::balanced_state(const double* phi, double speed) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size_);
  for (int i = 0; i < p_.balls; ++i) y[index::phi(i)] = phi[i];
  if (driven()) y[speed_place()] = speed;
  // With an integral part, E holds the torque that gain alone would leave: constant + slope psi' + integral E = 0.
  const DriveSegment& m = piece_.motor;
  if (driven() && m.integral != 0.0) y[size_ - 1] = -(m.constant + m.slope * speed) / m.integral;
  return y;
}

}  // namespace equipoise::model
