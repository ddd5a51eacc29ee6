// Newton's equations of mass points under constraints, by Jacobians:
//
//   coordinates Q = (X, Y, psi, theta_1..n); mass points P_k(Q) with P_k' = J_k Q', P_k'' = J_k Q'' + b_k
//   (sum m_k J_k^T J_k + diag(0, 0, iota, 0..)) Q'' = sum m_k J_k^T ((0, -G) - b_k) + generalised forces
//
// Points: the rotor's centre of mass O + lambda e(psi), mass 1; ball i at O + E(psi) + e(theta_i), mass mu_i, where E
// is the race's offset turned by psi. A ball that rolls is a solid sphere of radius r_i besides, whose rim moves with
// (1 + r_i) psi' - theta_i' about its centre, so that it does not slip: with the mass (2/5) mu_i, one more row of J. A
// constraint (held ball, imposed psi') is a column condition on Q'. Normal forces for rolling resistance are found by
// repeating the solution until it agrees with itself.
#include "machine_reference.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace machine_reference {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using equipoise::Study;
using equipoise::model::Parameters;
constexpr double pi = 3.14159265358979323846;

Vector2d unit(double a) { return {std::cos(a), std::sin(a)}; }
Vector2d across(double a) { return {-std::sin(a), std::cos(a)}; }

class Machine {
 public:
  explicit Machine(const Study& study)
      : study_(study), p_(study.parameters), n_(p_.balls), held_(n_, false), sense_(n_, 0) {}

  // y: Q, Q', error integral, work, supports, balls.
  int size() const { return 2 * (3 + n_) + 4; }

  VectorXd start() const {
    VectorXd y = VectorXd::Zero(size());
    const auto& s = study_.initial;
    const bool driven = study_.speed.driven();
    const double w = driven ? study_.speed.initial : study_.speed.speed, c = std::cos(s.psi), d = std::sin(s.psi);
    y[0] = s.x * c - s.y * d;
    y[1] = s.x * d + s.y * c;
    y[2] = s.psi;
    double* rate = y.data() + 3 + n_;
    rate[0] = s.x_dot * c - s.y_dot * d - w * y[1];
    rate[1] = s.x_dot * d + s.y_dot * c + w * y[0];
    rate[2] = w;
    for (int i = 0; i < n_; ++i) {
      y[3 + i] = s.psi + s.phi[i];
      rate[3 + i] = w + s.phi_dot[i];
    }
    return y;
  }

  double torque(double t, const VectorXd& y) const { return given(t, y) - taken(y[3 + n_ + 2]); }

  // By the load, against the rotation.
  double taken(double w) const {
    const auto& load = study_.speed.load;
    const double share = load.at ? std::fabs(w) / *load.at : 0.0;
    const double size =
        load.constant * std::min(1.0, std::fabs(w) / 0.01) + load.linear * share + load.quadratic * share * share;
    return std::copysign(size, w);
  }

  // By the motor.
  double given(double t, const VectorXd& y) const {
    const auto& s = study_.speed.torque;
    const double w = y[3 + n_ + 2];
    using Kind = equipoise::model::MotorLaw::Kind;
    if (s.by_stall) return s.stall * (1.0 - w / s.no_load_speed);
    if (s.kind == Kind::linear) return s.until && began >= *s.until ? 0.0 : s.constant + s.slope * w;
    if (s.kind == Kind::curve) {
      if (w <= s.speeds.front()) return s.values.front();
      std::size_t i = 1;
      while (i + 1 < s.speeds.size() && w > s.speeds[i]) ++i;
      const double part = (w - s.speeds[i - 1]) / (s.speeds[i] - s.speeds[i - 1]);
      return s.values[i - 1] + (s.values[i] - s.values[i - 1]) * part;
    }
    if (s.kind == Kind::table) {
      if (t <= s.times.front()) return s.values.front();
      for (std::size_t i = 1; i < s.times.size(); ++i)
        if (t < s.times[i])
          return s.values[i - 1] +
                 (s.values[i] - s.values[i - 1]) * (t - s.times[i - 1]) / (s.times[i] - s.times[i - 1]);
      return s.values.back();
    }
    const double tau = s.gain * (aim(t) - w) + s.integral * y[2 * (3 + n_)];
    return s.limit ? std::clamp(tau, -*s.limit, *s.limit) : tau;
  }

  // For a control whose target is a ramp.
  double aim(double t) const {
    const auto& r = study_.speed.torque.target;
    return r.initial + (r.final - r.initial) * std::min(1.0, t / r.duration);
  }

  struct Solution {
    VectorXd acceleration;
    VectorXd normal, tangential;  // on each ball: radial force, and the force along the race that holds a held one
    double motor = 0.0;           // torque that moves the rotor as it does
  };

  MatrixXd mass(const VectorXd& y) const {
    MatrixXd m = MatrixXd::Zero(3 + n_, 3 + n_);
    m(2, 2) = p_.inertia;
    for (int k = -1; k < n_; ++k) m += weight(k) * jacobian(k, y).transpose() * jacobian(k, y);
    for (int i = 0; i < n_ && p_.rolls; ++i) {
      VectorXd rim = VectorXd::Zero(3 + n_);
      rim[2] = 1.0 + p_.ball_radius[i];
      rim[3 + i] = -1.0;
      m += 2.0 / 5.0 * p_.mass[i] * rim * rim.transpose();
    }
    return m;
  }

  Solution solve(double t, const VectorXd& y) const {
    const double* rate = y.data() + 3 + n_;
    VectorXd force = VectorXd::Zero(3 + n_);
    force[0] = -p_.damping[0] * rate[0] - p_.stiffness[0] * y[0];
    force[1] = -p_.damping[1] * rate[1] - p_.stiffness[1] * y[1];
    for (int k = -1; k < n_; ++k)
      force += weight(k) * jacobian(k, y).transpose() * (Vector2d(0.0, -p_.gravity) - bias(k, y));
    const double motor = study_.speed.driven() ? torque(t, y) : 0.0;
    force[2] += motor;
    for (int i = 0; i < n_; ++i)
      if (!held_[i]) {
        const double drag = p_.mass[i] * p_.drag[i] * (rate[3 + i] - rate[2]);
        force[3 + i] -= drag;
        force[2] += drag;
      }
    const MatrixXd m = mass(y), free = freedom();
    Solution s;
    s.normal = VectorXd::Zero(n_);
    for (int repeat = 0; repeat < 60; ++repeat) {
      VectorXd all = force;
      for (int i = 0; i < n_; ++i)
        if (!held_[i] && sense_[i] != 0) {
          const double resistance = sense_[i] * p_.rolling[i] * std::fabs(s.normal[i]);
          all[3 + i] -= resistance;
          all[2] += resistance;
        }
      const VectorXd reduced = (free.transpose() * m * free).ldlt().solve(free.transpose() * all);
      s.acceleration = free * reduced;
      const VectorXd missing = m * s.acceleration - all;  // forces of constraint
      s.tangential = missing.tail(n_);
      s.motor = study_.speed.driven() ? motor : missing[2] + missing.tail(n_).sum();
      const VectorXd before = s.normal;
      for (int i = 0; i < n_; ++i) {
        const Vector2d push = weight(i) * (jacobian(i, y) * s.acceleration + bias(i, y) + Vector2d(0.0, p_.gravity));
        s.normal[i] = -push.dot(unit(y[3 + i]));
      }
      if ((s.normal - before).cwiseAbs().maxCoeff() < 1e-16) break;
    }
    return s;
  }

  VectorXd derivative(double t, const VectorXd& y) const {
    const Solution s = solve(t, y);
    const double* rate = y.data() + 3 + n_;
    VectorXd dy = VectorXd::Zero(size());
    dy.head(3 + n_) = y.segment(3 + n_, 3 + n_);
    dy.segment(3 + n_, 3 + n_) = s.acceleration;
    double* more = dy.data() + 2 * (3 + n_);
    const auto& control = study_.speed.torque;
    if (control.integral != 0.0) {
      const double raw = control.gain * (aim(t) - rate[2]) + control.integral * y[2 * (3 + n_)];
      const double error = aim(t) - rate[2];
      more[0] = control.limit && std::fabs(raw) > *control.limit && raw * error > 0.0 ? 0.0 : error;
    }
    more[1] = s.motor * rate[2];
    more[2] = p_.damping[0] * rate[0] * rate[0] + p_.damping[1] * rate[1] * rate[1];
    for (int i = 0; i < n_; ++i) {
      const double q = rate[3 + i] - rate[2];
      if (!held_[i])
        more[3] += p_.mass[i] * p_.drag[i] * q * q + sense_[i] * p_.rolling[i] * std::fabs(s.normal[i]) * q;
    }
    return dy;
  }

  VectorXd step(double t, const VectorXd& y, double h) {
    began = t;
    const VectorXd k1 = derivative(t, y), k2 = derivative(t + h / 2, y + h / 2 * k1),
                   k3 = derivative(t + h / 2, y + h / 2 * k2), k4 = derivative(t + h, y + h * k3);
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }

  double energy(const VectorXd& y) const {
    const VectorXd rate = y.segment(3 + n_, 3 + n_);
    double e = 0.5 * rate.dot(mass(y) * rate) + 0.5 * (p_.stiffness[0] * y[0] * y[0] + p_.stiffness[1] * y[1] * y[1]);
    e += p_.gravity * (y[1] + p_.eccentricity * std::sin(y[2]));
    for (int i = 0; i < n_; ++i) e += p_.mass[i] * p_.gravity * place(i, y).y();
    return e;
  }

  // Signs that tell the next event: release, gap of neighbours, rate of a sliding ball, hold of a resting one. Positive
  // until it happens.
  VectorXd margins(double t, const VectorXd& y) const {
    VectorXd m = VectorXd::Ones(1 + 2 * n_ * n_);
    if (clamped) {
      if (study_.release.speed) m[0] = *study_.release.speed - y[3 + n_ + 2];
      return m;
    }
    if (p_.contact_angle > 0.0)
      for (int i = 0; i < n_; ++i)
        for (int j = 0; j < i; ++j)
          m[1 + i * n_ + j] = std::fabs(std::remainder(y[3 + i] - y[3 + j], 2 * pi)) - p_.contact_angle;
    if (p_.balls_stick()) {
      const Solution s = solve(t, y);
      for (int i = 0; i < n_; ++i)
        m[1 + n_ * n_ + i] = held_[i] ? p_.stiction[i] * std::fabs(s.normal[i]) - std::fabs(s.tangential[i])
                                      : sense_[i] * (y[3 + n_ + 3 + i] - y[3 + n_ + 2]);
    }
    return m;
  }

  void hold_all() { std::fill(held_.begin(), held_.end(), true); }

  void let_go(double t, VectorXd& y) {
    clamped = false;
    std::fill(held_.begin(), held_.end(), false);
    if (p_.balls_stick())
      for (int i = 0; i < n_; ++i) settle(i, t, y);
  }

  // A ball without speed rests if it can be held; else it starts in the direction in which the holding force gives way.
  void settle(int i, double t, VectorXd& y) {
    const double q = y[3 + n_ + 3 + i] - y[3 + n_ + 2];
    sense_[i] = q > 0.0 ? 1 : q < 0.0 ? -1 : 0;
    if (sense_[i] != 0) return;
    held_[i] = true;
    const Solution s = solve(t, y);
    if (std::fabs(s.tangential[i]) <= p_.stiction[i] * std::fabs(s.normal[i])) return;
    held_[i] = false;
    sense_[i] = s.tangential[i] < 0.0 ? 1 : -1;  // the holding force points against the coming motion
  }

  // Handles event number `which` of margins(); adds the loss at impacts to `lost`.
  void pass(int which, double t, VectorXd& y, double& lost) {
    if (which == 0) return let_go(t, y);
    if (which > n_ * n_) {
      const int i = which - 1 - n_ * n_;
      if (held_[i]) {
        sense_[i] = solve(t, y).tangential[i] < 0.0 ? 1 : -1;
        held_[i] = false;
      } else {
        y[3 + n_ + 3 + i] = y[3 + n_ + 2];
        settle(i, t, y);
      }
      return;
    }
    const int i = (which - 1) / n_, j = (which - 1) % n_;
    VectorXd direction = VectorXd::Zero(3 + n_);
    direction[3 + i] = 1.0;
    direction[3 + j] = -1.0;
    const MatrixXd free = freedom();
    const VectorXd response = free * (free.transpose() * mass(y) * free).ldlt().solve(free.transpose() * direction);
    const double before = energy(y);
    y.segment(3 + n_, 3 + n_) -=
        (1.0 + p_.restitution) * direction.dot(y.segment(3 + n_, 3 + n_)) / direction.dot(response) * response;
    lost += before - energy(y);
  }

  bool clamped = false;
  double began = 0.0;  // start of the current step: selects the piece of the motor's law

 private:
  double weight(int k) const { return k < 0 ? 1.0 : p_.mass[k]; }

  Vector2d offset(const VectorXd& y) const { return p_.race_offset[0] * unit(y[2]) + p_.race_offset[1] * across(y[2]); }

  Vector2d place(int k, const VectorXd& y) const {
    const Vector2d centre(y[0], y[1]);
    return k < 0 ? Vector2d(centre + p_.eccentricity * unit(y[2])) : Vector2d(centre + offset(y) + unit(y[3 + k]));
  }

  MatrixXd jacobian(int k, const VectorXd& y) const {
    MatrixXd j = MatrixXd::Zero(2, 3 + n_);
    j(0, 0) = j(1, 1) = 1.0;
    if (k < 0) {
      j.col(2) = p_.eccentricity * across(y[2]);
    } else {
      const Vector2d e = offset(y);
      j.col(2) = Vector2d(-e.y(), e.x());
      j.col(3 + k) = across(y[3 + k]);
    }
    return j;
  }

  Vector2d bias(int k, const VectorXd& y) const {
    const double w = y[3 + n_ + 2];
    if (k < 0) return -p_.eccentricity * w * w * unit(y[2]);
    const double rate = y[3 + n_ + 3 + k];
    return -w * w * offset(y) - rate * rate * unit(y[3 + k]);
  }

  // Columns: the directions in which Q'' is free. Held balls turn with psi; psi'' is free only for a driven rotor.
  MatrixXd freedom() const {
    MatrixXd all = MatrixXd::Identity(3 + n_, 3 + n_);
    std::vector<int> kept{0, 1};
    if (study_.speed.driven()) kept.push_back(2);
    for (int i = 0; i < n_; ++i) {
      if (held_[i])
        all(3 + i, 2) = 1.0;
      else
        kept.push_back(3 + i);
    }
    MatrixXd free(3 + n_, kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k) free.col(static_cast<int>(k)) = all.col(kept[k]);
    return free;
  }

  const Study& study_;
  const Parameters& p_;
  int n_;
  std::vector<bool> held_;
  std::vector<int> sense_;
};

// Times at which torque laws and targets have corners.
std::vector<double> corners(const Study& study) {
  const auto& s = study.speed.torque;
  std::vector<double> result = s.times;
  if (s.until) result.push_back(*s.until);
  if (s.target.duration > 0.0) result.push_back(s.target.duration);
  if (study.release.time) result.push_back(*study.release.time);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

std::vector<State> integrate(const Study& study, const std::vector<double>& times, double step) {
  Machine machine(study);
  const int n = study.parameters.balls;
  VectorXd y = machine.start();
  double t = 0.0, lost = 0.0;
  machine.clamped = (study.release.time && *study.release.time > 0.0) || study.release.speed;
  if (machine.clamped)
    machine.hold_all();
  else
    machine.let_go(t, y);
  const std::vector<double> stops = corners(study);
  std::vector<State> out;
  for (const double target : times) {
    while (t < target) {
      double end = std::min(target, t + step);
      for (const double stop : stops)
        if (stop > t) {
          end = std::min(end, stop);
          break;
        }
      VectorXd next = machine.step(t, y, end - t);
      const auto first = [&](double h) {
        const VectorXd m = machine.margins(t + h, machine.step(t, y, h));
        for (int k = 0; k < m.size(); ++k)
          if (m[k] < 0.0) return k;
        return -1;
      };
      int which = first(end - t);
      if (which >= 0) {
        double low = 0.0, high = end - t;
        for (int i = 0; i < 60; ++i) {
          const double middle = 0.5 * (low + high);
          const int k = first(middle);
          (k >= 0 ? high : low) = middle;
          if (k >= 0) which = k;
        }
        end = t + high;
        next = machine.step(t, y, high);
      }
      t = end;
      y = next;
      if (which >= 0) machine.pass(which, t, y, lost);
      if (machine.clamped && study.release.time && t >= *study.release.time) machine.let_go(t, y);
    }
    State s;
    s.t = t;
    s.X = y[0];
    s.Y = y[1];
    s.psi = y[2];
    s.X_dot = y[3 + n];
    s.Y_dot = y[4 + n];
    s.psi_dot = y[5 + n];
    s.theta.assign(y.data() + 3, y.data() + 3 + n);
    s.theta_dot.assign(y.data() + 6 + n, y.data() + 6 + 2 * n);
    s.error_integral = y[2 * (3 + n)];
    s.work = y[2 * (3 + n) + 1];
    s.supports = y[2 * (3 + n) + 2];
    s.balls = y[2 * (3 + n) + 3];
    s.impacts = lost;
    s.energy = machine.energy(y);
    out.push_back(s);
  }
  return out;
}

}  // namespace machine_reference
