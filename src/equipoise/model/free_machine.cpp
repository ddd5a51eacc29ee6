// The machine's equations at a given angle of its rotor, from those of its system.
#include "equipoise/model/free_machine.hpp"

#include "equipoise/model/linearisation.hpp"

namespace equipoise::model {

namespace {
// All but the component at `place`, or all if that is -1.
std::vector<int> all_but(int place, int size) {
  std::vector<int> kept;
  for (int i = 0; i < size; ++i)
    if (i != place) kept.push_back(i);
  return kept;
}
}  // namespace

FreeMachine::FreeMachine(const Parameters& p, const DrivePiece& last)
    : system_(p, last), kept_(all_but(system_.psi_place(), system_.dimension())) {}

Eigen::VectorXd FreeMachine::reduced(const double* z) const {
  const int balls = dimension(parameters().balls);
  Eigen::VectorXd y(size());
  for (int i = 0; i < balls; ++i) y[i] = z[i];
  for (int i = balls; i < size(); ++i) y[i] = z[i + 1];  // psi is left out
  return y;
}

double FreeMachine::speed(const Eigen::VectorXd& y) const { return driven() ? y[speed_place()] : drive().speed; }

Eigen::VectorXd FreeMachine::at_angle(const Eigen::VectorXd& y, double psi) const {
  Eigen::VectorXd whole = Eigen::VectorXd::Constant(system_.dimension(), psi);
  whole(kept_) = y;
  return whole;
}

Eigen::VectorXd FreeMachine::rate(const Eigen::VectorXd& y, double psi) const {
  return model::rate(system_, at_angle(y, psi), psi)(kept_);
}

Eigen::MatrixXd FreeMachine::jacobian(const Eigen::VectorXd& y, double psi) const {
  return model::jacobian(system_, at_angle(y, psi), psi)(kept_, kept_);
}

bool FreeMachine::holds_speed() const {
  return !driven() || drive().motor.slope < 0.0 || drive().motor.integral != 0.0;
}

std::optional<double> FreeMachine::balanced_speed() const {
  return driven() ? system_.no_load_speed() : std::optional(drive().speed);
}

Eigen::VectorXd FreeMachine::balanced_state(const double* phi, double speed) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
  for (int i = 0; i < parameters().balls; ++i) y[index::phi(i)] = phi[i];
  if (driven()) y[speed_place()] = speed;
  // With an integral part, E holds the torque that gain alone would leave: constant + slope psi' + integral E = 0.
  const DriveSegment& m = drive().motor;
  if (driven() && m.integral != 0.0) y[size() - 1] = -(m.constant + m.slope * speed) / m.integral;
  return y;
}

}  // namespace equipoise::model
