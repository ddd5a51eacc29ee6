// The reference's equations and its drive of SUNDIALS ARKODE (explicit Runge-Kutta, Fehlberg 7(8)).
//
// Lengths in units of the race radius R, masses of the rotor's mass M, times of 1/omega_c; psi(t) is imposed.
// Centre of the shaft O = (X, Y), rotor's centre of mass C = O + lambda (cos psi, sin psi),
// ball i at B_i = O + (cos theta_i, sin theta_i). With N the sum of mu_i and iota the moment of inertia about C:
//
//   2 T = iota psi'^2 + |C'|^2 + sum mu_i |B_i'|^2
//       = iota psi'^2 + (X' - lambda psi' sin psi)^2 + (Y' + lambda psi' cos psi)^2
//         + sum mu_i [(X' - theta_i' sin theta_i)^2 + (Y' + theta_i' cos theta_i)^2]
//   2 V = kappa_X X^2 + kappa_Y Y^2 + 2 G [(1 + N) Y + lambda sin psi + sum mu_i sin theta_i]
//   2 D = zeta_X X'^2 + zeta_Y Y'^2 + sum mu_i beta_i (theta_i' - psi')^2          (Rayleigh's function)
//
// d/dt dT/dX' - dT/dX + dV/dX + dD/dX' = 0 and so on:
//
//   X:       (1 + N) X'' - sum mu_i sin theta_i theta_i'' = lambda (psi'^2 cos psi + psi'' sin psi)
//                + sum mu_i theta_i'^2 cos theta_i - zeta_X X' - kappa_X X
//   Y:       (1 + N) Y'' + sum mu_i cos theta_i theta_i'' = lambda (psi'^2 sin psi - psi'' cos psi)
//                + sum mu_i theta_i'^2 sin theta_i - zeta_Y Y' - kappa_Y Y - (1 + N) G
//   theta_i: mu_i (-sin theta_i X'' + cos theta_i Y'' + theta_i'')
//                = -mu_i beta_i (theta_i' - psi') - mu_i G cos theta_i
//            (the terms theta_i' (X' cos theta_i + Y' sin theta_i) of d/dt dT/dtheta_i' and of dT/dtheta_i cancel)
//   psi:     (iota + lambda^2) psi'' + lambda (-X'' sin psi + Y'' cos psi) + lambda G cos psi
//                = torque + sum mu_i beta_i (theta_i' - psi')
//
// The last gives the torque of the motor. Balls held in the race: theta_i = psi + const and theta_i'' = psi'' are
// known, the theta_i rows give the forces that hold them, and the motor has to supply these too.
//
// A ball that rolls, of radius r_i, is a solid sphere that touches the race at O + (1 + r_i) (cos theta_i, sin
// theta_i). There the race pulls it along by a force F_i: Newton's equations with F_i in them, not reduced by any
// Lagrangian. With s_i the speed of the ball's rim seen from its centre, r_i times its spin,
//
//   spin:    (2/5) mu_i r_i s_i' = r_i F_i
//   no slip: theta_i' + s_i = (1 + r_i) psi'
//   theta_i: + F_i on the right;    psi: - sum (1 + r_i) F_i on the right;    2 T: + (2/5) sum mu_i s_i^2
//
// A ball that is held spins with the rotor: what holds it supplies the moment (2/5) mu_i r_i^2 psi'' besides.
#include "lagrangian.hpp"

#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace lagrangian {

// Of a solid sphere: moment of inertia over mass and radius squared.
constexpr double solid = 0.4;

using equipoise::Profile;
using equipoise::Study;
using equipoise::model::Parameters;

PrescribedRotation::PrescribedRotation(const Study& study)
    : initial_angle_(study.initial.psi), published_(study.speed.law == equipoise::model::SpeedLaw::published) {
  const auto& s = study.speed;
  const auto add = [&](double time, double speed) { corners_.push_back({time, speed, 0.0, 0.0}); };
  if (s.profile == Profile::constant) {
    add(0.0, s.speed);
  } else if (s.profile == Profile::ramp) {
    add(0.0, s.initial);
    add(s.duration, s.final);
  } else if (s.profile == Profile::trapezoid) {
    add(0.0, s.initial);
    add(s.rise_until, s.peak);
    add(s.hold_until, s.peak);
    add(s.fall_until, s.final);
  } else if (s.profile == Profile::hill) {
    hill_ = {s.final, s.half_time, s.exponent};
    const double until = s.until.value();
    add(0.0, 0.0);
    add(until, on_hill(until).rate);
    add(until + (s.final - on_hill(until).rate) / on_hill(until).acceleration, s.final);
  } else {
    for (std::size_t i = 0; i < s.times.size(); ++i) add(s.times[i], s.speeds[i]);
  }
  for (std::size_t i = 0; i + 1 < corners_.size(); ++i) {
    const Corner& from = corners_[i];
    Corner& to = corners_[i + 1];
    const double span = to.time - from.time;
    corners_[i].slope = (to.speed - from.speed) / span;
    to.angle = from.angle + 0.5 * (from.speed + to.speed) * span;
    if (hill_ && i == 0) to.angle = on_hill(to.time).angle;
  }
}

Rotation PrescribedRotation::on_hill(double t) const {
  const auto [limit, half, n] = *hill_;
  const auto speed = [&](double at) { return limit * std::pow(at, n) / (std::pow(half, n) + std::pow(at, n)); };
  const double below = std::pow(half, n) + std::pow(t, n);
  const double slope = limit * n * std::pow(t, n - 1.0) * std::pow(half, n) / (below * below);
  // Over the root of time, in which a half power is smooth.
  const auto by_root = [&](double root) { return 2.0 * root * speed(root * root); };
  constexpr unsigned halvings = 6;
  const double angle =
      boost::math::quadrature::gauss_kronrod<double, 61>::integrate(by_root, 0.0, std::sqrt(t), halvings, 1e-14);
  return {angle, speed(t), slope};
}

int PrescribedRotation::branch_at(double t) const {
  int branch = 0;
  while (branch + 1 < branches() && corners_[branch + 1].time <= t) ++branch;
  return branch;
}

Rotation PrescribedRotation::on_branch(int branch, double t) const {
  if (hill_ && branch == 0) {
    Rotation rotation = on_hill(t);
    rotation.angle += initial_angle_;
    return rotation;
  }
  const Corner& c = corners_[branch];
  const double since = t - c.time;
  const double omega = c.speed + c.slope * since;
  if (published_) return {initial_angle_ + t * omega, omega + t * c.slope, 2.0 * c.slope};
  return {initial_angle_ + c.angle + 0.5 * (c.speed + omega) * since, omega, c.slope};
}

Accelerations accelerations(const Parameters& p, double inertia, const FixedState& s, bool clamped) {
  const int n = p.balls;
  const double w = s.rotor.rate, a = s.rotor.acceleration, lambda = p.eccentricity;
  const double sin_psi = std::sin(s.rotor.angle), cos_psi = std::cos(s.rotor.angle);

  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(2 + n, 2 + n);
  Eigen::VectorXd force(2 + n);
  mass(0, 0) = mass(1, 1) = 1.0;
  force[0] = lambda * (w * w * cos_psi + a * sin_psi) - p.damping[0] * s.X_dot - p.stiffness[0] * s.X;
  force[1] = lambda * (w * w * sin_psi - a * cos_psi) - p.damping[1] * s.Y_dot - p.stiffness[1] * s.Y - p.gravity;
  double drag_torque = 0.0;
  for (int i = 0; i < n; ++i) {
    const double mu = p.mass[i], sine = std::sin(s.theta[i]), cosine = std::cos(s.theta[i]), rate = s.theta_dot[i];
    mass(0, 0) += mu;
    mass(1, 1) += mu;
    mass(0, 2 + i) = mass(2 + i, 0) = -mu * sine;
    mass(1, 2 + i) = mass(2 + i, 1) = mu * cosine;
    mass(2 + i, 2 + i) = mu;
    force[0] += mu * rate * rate * cosine;
    force[1] += mu * rate * rate * sine - mu * p.gravity;
    force[2 + i] = -mu * p.drag[i] * (rate - w) - mu * p.gravity * cosine;
    drag_torque += mu * p.drag[i] * (rate - w);
    if (p.rolls) {
      mass(2 + i, 2 + i) += solid * mu;
      force[2 + i] += solid * mu * (1.0 + p.ball_radius[i]) * a;
    }
  }

  Eigen::VectorXd result(2 + n);
  double held_torque = 0.0;  // what the balls' rows demand from whatever holds them
  if (clamped) {
    result.tail(n).setConstant(a);
    result.head(2) = mass.topLeftCorner(2, 2).ldlt().solve(force.head(2) - mass.topRightCorner(2, n) * result.tail(n));
    held_torque = (mass.bottomRows(n) * result - force.tail(n)).sum();
  } else {
    result = mass.ldlt().solve(force);
  }
  Accelerations out{result[0], result[1], 0.0, std::vector<double>(result.data() + 2, result.data() + 2 + n)};
  out.torque = (inertia + lambda * lambda) * a + lambda * (-out.X * sin_psi + out.Y * cos_psi) +
               lambda * p.gravity * cos_psi - drag_torque + held_torque;
  for (int i = 0; i < n && p.rolls; ++i) {
    const double r = p.ball_radius[i], grip = solid * p.mass[i] * ((1.0 + r) * a - out.theta[i]);  // F_i
    out.torque += (1.0 + r) * grip;
  }
  return out;
}

double energy(const Parameters& p, double inertia, const FixedState& s) {
  const double w = s.rotor.rate, sin_psi = std::sin(s.rotor.angle), cos_psi = std::cos(s.rotor.angle);
  const double C_x = s.X_dot - p.eccentricity * w * sin_psi, C_y = s.Y_dot + p.eccentricity * w * cos_psi;
  double twice = inertia * w * w + C_x * C_x + C_y * C_y + p.stiffness[0] * s.X * s.X + p.stiffness[1] * s.Y * s.Y +
                 2.0 * p.gravity * (s.Y + p.eccentricity * sin_psi);
  for (int i = 0; i < p.balls; ++i) {
    const double sine = std::sin(s.theta[i]), cosine = std::cos(s.theta[i]);
    const double B_x = s.X_dot - s.theta_dot[i] * sine, B_y = s.Y_dot + s.theta_dot[i] * cosine;
    twice += p.mass[i] * (B_x * B_x + B_y * B_y + 2.0 * p.gravity * (s.Y + sine));
    if (p.rolls) twice += solid * p.mass[i] * std::pow((1.0 + p.ball_radius[i]) * w - s.theta_dot[i], 2);
  }
  return 0.5 * twice;
}

// X = x cos psi - y sin psi and so on, differentiated with x' and y' kept: dX' = -dw Y, dY' = dw X, dtheta_i' = dw.
void apply_speed_jump(double jump, FixedState& s) {
  s.X_dot -= jump * s.Y;
  s.Y_dot += jump * s.X;
  for (double& rate : s.theta_dot) rate += jump;
}

void unpack(const double* y, int n, FixedState& s) {
  s.X = y[0];
  s.Y = y[1];
  s.theta.assign(y + 2, y + 2 + n);
  s.X_dot = y[2 + n];
  s.Y_dot = y[3 + n];
  s.theta_dot.assign(y + 4 + n, y + 4 + 2 * n);
}

void rates(const Parameters& p, const FixedState& s, bool clamped, const double* y, double* dy) {
  const int n = p.balls;
  const Accelerations a = accelerations(p, 0.0, s, clamped);
  std::copy_n(y + 2 + n, 2 + n, dy);
  dy[2 + n] = a.X;
  dy[3 + n] = a.Y;
  std::copy(a.theta.begin(), a.theta.end(), dy + 4 + n);
}

namespace {

void check(int flag, const char* what) {
  if (flag < 0) throw std::runtime_error(std::string("SUNDIALS: ") + what + " returned " + std::to_string(flag));
}

// What the right-hand side needs in addition to the state.
struct Problem {
  const Parameters* parameters;
  const PrescribedRotation* rotation;
  int branch;
  bool clamped;
};

void pack(const FixedState& s, int n, double* y) {
  y[0] = s.X;
  y[1] = s.Y;
  std::copy(s.theta.begin(), s.theta.end(), y + 2);
  y[2 + n] = s.X_dot;
  y[3 + n] = s.Y_dot;
  std::copy(s.theta_dot.begin(), s.theta_dot.end(), y + 4 + n);
}

int right_hand_side(double t, N_Vector y, N_Vector y_dot, void* user_data) {
  const auto& problem = *static_cast<const Problem*>(user_data);
  const int n = problem.parameters->balls;
  FixedState s;
  s.rotor = problem.rotation->on_branch(problem.branch, t);
  unpack(N_VGetArrayPointer(y), n, s);
  rates(*problem.parameters, s, problem.clamped, N_VGetArrayPointer(y), N_VGetArrayPointer(y_dot));
  return 0;
}

// Owns what ARKODE requires.
class Integrator {
 public:
  Integrator(Problem& problem, double t, const FixedState& start, double absolute_tolerance)
      : n_(problem.parameters->balls) {
    check(SUNContext_Create(nullptr, &context_), "SUNContext_Create");
    y_ = N_VNew_Serial(4 + 2 * n_, context_);
    tolerances_ = N_VNew_Serial(4 + 2 * n_, context_);
    pack(start, n_, N_VGetArrayPointer(y_));
    N_VConst(absolute_tolerance, tolerances_);
    // Angles reach hundreds of radians, where double precision itself is no finer.
    for (int i = 0; i < n_; ++i) N_VGetArrayPointer(tolerances_)[2 + i] = 10.0 * absolute_tolerance;
    memory_ = ERKStepCreate(right_hand_side, t, y_, context_);
    check(ERKStepSetTableNum(memory_, ARKODE_FEHLBERG_13_7_8), "ERKStepSetTableNum");
    check(ERKStepSVtolerances(memory_, 0.0, tolerances_), "ERKStepSVtolerances");
    check(ERKStepSetUserData(memory_, &problem), "ERKStepSetUserData");
    check(ERKStepSetMaxNumSteps(memory_, 10'000'000), "ERKStepSetMaxNumSteps");
  }
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  ~Integrator() {
    ERKStepFree(&memory_);
    N_VDestroy(tolerances_);
    N_VDestroy(y_);
    SUNContext_Free(&context_);
  }

  // Steps end exactly at `t`: ARKODE's interpolation is of lower order than its steps.
  void advance(double t, FixedState& s) {
    double reached = 0.0;
    check(ERKStepSetStopTime(memory_, t), "ERKStepSetStopTime");
    check(ERKStepEvolve(memory_, t, y_, &reached, ARK_NORMAL), "ERKStepEvolve");
    unpack(N_VGetArrayPointer(y_), n_, s);
  }

  void restart(double t, const FixedState& s) {
    pack(s, n_, N_VGetArrayPointer(y_));
    check(ERKStepReInit(memory_, right_hand_side, t, y_), "ERKStepReInit");
  }

 private:
  int n_;
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr, tolerances_ = nullptr;
  void* memory_ = nullptr;
};

FixedState initial_state(const Study& study, const Rotation& rotor) {
  const auto& start = study.initial;
  const double c = std::cos(rotor.angle), s = std::sin(rotor.angle), w = rotor.rate;
  FixedState out;
  out.rotor = rotor;
  out.X = start.x * c - start.y * s;
  out.Y = start.x * s + start.y * c;
  out.X_dot = start.x_dot * c - start.y_dot * s - w * out.Y;
  out.Y_dot = start.x_dot * s + start.y_dot * c + w * out.X;
  for (int i = 0; i < study.parameters.balls; ++i) {
    out.theta.push_back(rotor.angle + start.phi[i]);
    out.theta_dot.push_back(w + start.phi_dot[i]);
  }
  return out;
}

}  // namespace

FixedState in_fixed_axes(int balls, const Rotation& rotor, const double* z) {
  const double c = std::cos(rotor.angle), s = std::sin(rotor.angle);
  FixedState out;
  out.rotor = rotor;
  out.X = z[0] * c - z[1] * s;
  out.Y = z[0] * s + z[1] * c;
  out.X_dot = z[2] * c - z[3] * s;
  out.Y_dot = z[2] * s + z[3] * c;
  for (int i = 0; i < balls; ++i) {
    out.theta.push_back(rotor.angle + z[4 + i]);
    out.theta_dot.push_back(rotor.rate + z[4 + balls + i]);
  }
  return out;
}

std::vector<FixedState> integrate(const Study& study, double release, const std::vector<double>& times,
                                  double absolute_tolerance) {
  const PrescribedRotation rotation(study);
  Problem problem{&study.parameters, &rotation, 0, release > 0.0};
  FixedState s = initial_state(study, rotation.on_branch(0, 0.0));
  Integrator integrator(problem, 0.0, s, absolute_tolerance);
  std::vector<FixedState> out;
  double t = 0.0;
  for (double target : times) {
    // Stop at every corner and at the release on the way; an event exactly at `target` is included.
    for (;;) {
      double stop = target;
      if (problem.branch + 1 < rotation.branches()) stop = std::min(stop, rotation.begin_of(problem.branch + 1));
      if (problem.clamped) stop = std::min(stop, release);
      if (stop > t) integrator.advance(stop, s);
      t = stop;
      bool restart = false;
      if (problem.branch != rotation.branch_at(t)) {
        const double before = rotation.on_branch(problem.branch, t).rate;
        problem.branch = rotation.branch_at(t);
        apply_speed_jump(rotation.on_branch(problem.branch, t).rate - before, s);
        restart = true;
      }
      if (problem.clamped && t >= release) {
        problem.clamped = false;
        restart = true;
      }
      if (restart) integrator.restart(t, s);
      if (t == target && !restart) break;
    }
    s.t = t;
    s.rotor = rotation.on_branch(problem.branch, t);
    out.push_back(s);
  }
  return out;
}

}  // namespace lagrangian
