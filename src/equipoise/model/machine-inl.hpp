// The equations of a machine as one system (t, z) -> dz/dt: the rotor's angle and speed are states, moved by a motor or
// as prescribed, and balls may be held, resist rolling or push each other. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_MACHINE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_MACHINE_INL
#undef EQUIPOISE_MODEL_MACHINE_INL
#else
#define EQUIPOISE_MODEL_MACHINE_INL
#endif

#include <cmath>

#include "equipoise/model/equations-inl.hpp"
#include "equipoise/model/machine.hpp"
#include "equipoise/model/strobe.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// State: that of model/parameters.hpp, then psi, psi' and the integral of the speed error (model/machine.hpp). What
// changes between events is set from outside: the drive's segment and what each ball does.
template <int room>
class MachineFlow {
 public:
  static constexpr int dimension = model::machine_dimension(room);  // the largest size

  explicit MachineFlow(const model::Parameters& p)
      : n(p.balls), balancer_(p), parameters_(p), needs_angle_(model::is_strobed(p)) {}

  int size() const { return model::machine_dimension(n); }

  void operator()(double t, const double* z, double* dz) const { evaluate(t, z, dz); }

  // The same, and what else the equations were solved for.
  BodyResult<double> evaluate(double t, const double* z, double* dz) const {
    const auto at = rotor(z);
    BallActions<double, room> actions = own_actions();
    const double* drive_state = z + model::dimension(n);
    const double motor = drive.driven() ? drive.motor.torque(t, drive_state[1], drive_state[2]) : 0.0;
    const double* torque = drive.driven() ? &motor : nullptr;
    BodyResult<double> result = balancer_.machine_derivative(at, actions, torque, z, dz);
    // The sense of a normal force was taken for outward; where a ball presses on the inner wall, friction follows.
    if (turn_inward(result, z, actions)) result = balancer_.machine_derivative(at, actions, torque, z, dz);
    if (any_joined()) {
      hold_together(at, torque, z, dz, actions);
      result = balancer_.machine_derivative(at, actions, torque, z, dz);
    }
    double* rate = dz + model::dimension(n);
    rate[0] = drive_state[1];
    rate[1] = result.acceleration;
    rate[2] = drive.driven() ? drive.motor.error_rate(t, drive_state[1], drive_state[2]) : 0.0;
    return result;
  }

  // Normal force on ball i over its mass, outward positive, and the tangential force that would keep it at rest.
  struct BallForces {
    double normal, tangential;
  };
  BallForces forces_on(int i, const double* z, const BodyResult<double>& result) const {
    const double s = std::sin(z[4 + i]), c = std::cos(z[4 + i]);
    const double total = z[model::machine_index::speed(n)] + z[4 + n + i];
    return {total * total - result.race.x * c - result.race.y * s,
            result.race.x * s - result.race.y * c - balancer_.lever(i) * result.acceleration};
  }

  // Change of the velocities u, v, q_1..q_n, psi' (as entries of `change`, shaped like a state) for a unit impulse that
  // drives balls `first` and `second` apart along the race.
  void impulse_response(const double* z, int first, int second, double* change) const {
    BallActions<double, room> actions;
    double before[dimension], after[dimension];
    const auto at = rotor(z);
    const double idle = 0.0;
    const double* torque = drive.driven() ? &idle : nullptr;
    const double a0 = balancer_.machine_derivative(at, actions, torque, z, before).acceleration;
    actions.push[first] = -1.0;
    actions.push[second] = 1.0;
    const double a1 = balancer_.machine_derivative(at, actions, torque, z, after).acceleration;
    for (int i = 0; i < size(); ++i) change[i] = 0.0;
    for (int i : {model::index::u, model::index::v}) change[i] = after[i] - before[i];
    for (int i = 0; i < n; ++i) change[4 + n + i] = after[4 + n + i] - before[4 + n + i];
    change[model::machine_index::speed(n)] = drive.driven() ? a1 - a0 : 0.0;
  }

  // Force with which joined neighbours i, i + 1 press on each other, from the last evaluation.
  double pressure(int pair) const { return pressure_[pair]; }

  model::DrivePiece drive;
  bool held[room] = {};    // by the clamp or by stiction
  int rolling[room] = {};  // sense in which a free ball moves, for its rolling resistance; 0: none is asked for
  bool joined[room] = {};  // pair i: ball order[i] and the next one touch and move as one
  int order[room] = {};    // of the balls around the race

 private:
  using Balancer = BallBalancer<double, room, Terms{true, true, true, true, true}>;

  RotorMotion<double> rotor(const double* z) const {
    const double* drive_state = z + model::dimension(n);
    RotorMotion<double> at{drive_state[1], drive.acceleration, 0.0, 1.0};
    if (needs_angle_) {
      at.sin_psi = std::sin(drive_state[0]);
      at.cos_psi = std::cos(drive_state[0]);
    }
    return at;
  }

  BallActions<double, room> own_actions() const {
    BallActions<double, room> actions;
    for (int i = 0; i < n; ++i) {
      actions.held[i] = held[i];
      actions.resistance[i] = held[i] ? 0.0 : rolling[i] * parameters_.rolling[i];
    }
    return actions;
  }

  bool turn_inward(const BodyResult<double>& result, const double* z, BallActions<double, room>& actions) const {
    bool any = false;
    for (int i = 0; i < n; ++i)
      if (actions.resistance[i] != 0.0 && forces_on(i, z, result).normal < 0.0) {
        actions.resistance[i] = -actions.resistance[i];
        any = true;
      }
    return any;
  }

  bool any_joined() const {
    for (int i = 0; i < n; ++i)
      if (joined[i]) return true;
    return false;
  }

  // Pushes between joined neighbours such that their rates stay equal: a small linear system, solved by elimination
  // (symmetric positive definite, like the inverse of the mass matrix that it is made of).
  void hold_together(const RotorMotion<double>& at, const double* torque, const double* z, const double* dz,
                     BallActions<double, room>& actions) const {
    if (n == 1) return;
    int pairs = 0, pair_of[room];
    double matrix[room][room], right[room];
    const auto apart = [&](int pair, const double* rates) {
      return rates[4 + n + order[(pair + 1) % n]] - rates[4 + n + order[pair]];
    };
    for (int i = 0; i < n; ++i)
      if (joined[i]) pair_of[pairs++] = i;
    for (int k = 0; k < pairs; ++k) {
      BallActions<double, room> unit = actions;
      unit.push[order[pair_of[k]]] -= 1.0;
      unit.push[order[(pair_of[k] + 1) % n]] += 1.0;
      double rates[dimension];
      balancer_.machine_derivative(at, unit, torque, z, rates);
      for (int row = 0; row < pairs; ++row) matrix[row][k] = apart(pair_of[row], rates) - apart(pair_of[row], dz);
      right[k] = -apart(pair_of[k], dz);
    }
    for (int k = 0; k < pairs; ++k)
      for (int row = k + 1; row < pairs; ++row) {
        const double factor = matrix[row][k] / matrix[k][k];
        for (int column = k; column < pairs; ++column) matrix[row][column] -= factor * matrix[k][column];
        right[row] -= factor * right[k];
      }
    for (int k = pairs - 1; k >= 0; --k) {
      for (int column = k + 1; column < pairs; ++column) right[k] -= matrix[k][column] * right[column];
      right[k] /= matrix[k][k];
    }
    for (int i = 0; i < n; ++i) pressure_[i] = 0.0;
    for (int k = 0; k < pairs; ++k) {
      pressure_[pair_of[k]] = right[k];
      actions.push[order[pair_of[k]]] -= right[k];
      actions.push[order[(pair_of[k] + 1) % n]] += right[k];
    }
  }

  const model::BallCount<room> n;
  Balancer balancer_;
  model::Parameters parameters_;
  bool needs_angle_;
  mutable double pressure_[room] = {};
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
