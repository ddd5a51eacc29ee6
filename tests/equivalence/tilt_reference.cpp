// A tilting rotor in fixed axes: equations, trajectories, eigenvalues and transients by dense samples. Compiled once
// for all tests, and optimised: most of their time is spent here.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/core/math/dense.hpp"
#include "tilt_dense.hpp"

namespace equipoise::tilting {

Fixed fixed_of(const model::Parameters& p, const model::System& system, const VectorXd& y, double psi, double w) {
  Fixed f;
  f.psi = psi;
  f.w = w;
  const Complex turn = std::polar(1.0, psi);
  const int t = system.layout().tilt;
  f.q1 = Complex(y[0], y[1]) * turn;
  f.v1 = Complex(y[2], y[3]) * turn;
  f.q2 = Complex(y[t], y[t + 1]) * turn;
  f.v2 = Complex(y[t + 2], y[t + 3]) * turn;
  f.theta = y.segment(4, p.balls).array() + psi;
  f.rate = y.segment(4 + p.balls, p.balls).array() + w;
  return f;
}

namespace {

Complex axis_wise(double x, double y, Complex v) { return {x * v.real(), y * v.imag()}; }

}  // namespace

std::array<Complex, 2> supports(const model::Parameters& p, const Fixed& f) {
  const auto& k = p.tilt.stiffness;
  const auto& c = p.tilt.damping;
  return {axis_wise(p.stiffness[0], p.stiffness[1], f.q1) + axis_wise(k[0][0], k[1][0], f.q2) +
              axis_wise(p.damping[0], p.damping[1], f.v1) + axis_wise(c[0][0], c[1][0], f.v2),
          axis_wise(k[0][0], k[1][0], f.q1) + axis_wise(k[0][1], k[1][1], f.q2) + axis_wise(c[0][0], c[1][0], f.v1) +
              axis_wise(c[0][1], c[1][1], f.v2)};
}

Accelerations accelerations(const model::Parameters& p, const Fixed& f, const double* torque, double given) {
  const int n = p.balls, size = 5 + n;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_accelerations, most_accelerations> m;
  m.setZero(size, size);
  Accelerations force = Accelerations::Zero(size);
  const double w = f.w, couple = p.tilt.misalignment * (p.tilt.transverse_inertia - p.tilt.polar_inertia);
  const auto put = [&](int row, Complex v) {
    force[row] += v.real();
    force[row + 1] += v.imag();
  };
  m.topLeftCorner(2, 2).setIdentity();
  m.block(2, 2, 2, 2) = p.tilt.transverse_inertia * Eigen::Matrix2d::Identity();
  const auto link = [&](int row, int column, Complex v) {
    m(row, column) += v.real();
    m(row + 1, column) += v.imag();
    m(column, row) += v.real();
    m(column, row + 1) += v.imag();
  };
  const Complex unbalance = std::polar(p.eccentricity, f.psi + p.eccentricity_angle),
                across = couple * std::polar(1.0, f.psi);
  link(0, size - 1, i1 * unbalance);
  link(2, size - 1, i1 * across);
  m(size - 1, size - 1) = p.inertia + p.eccentricity * p.eccentricity;
  put(0, w * w * unbalance - i1 * p.gravity);
  put(2, w * w * across + i1 * w * p.tilt.polar_inertia * f.v2);
  force[size - 1] -= p.gravity * unbalance.real();
  for (int i = 0; i < n; ++i) {
    const double mu = p.mass[i], z = p.tilt.plane[i];
    const Complex e = std::polar(1.0, f.theta[i]);
    for (int k = 0; k < 2; ++k) {
      m(k, k) += mu;
      m(2 + k, 2 + k) += mu * z * z;
      m(k, 2 + k) += mu * z;
      m(2 + k, k) += mu * z;
    }
    link(0, 4 + i, mu * i1 * e);
    link(2, 4 + i, mu * z * i1 * e);
    m(4 + i, 4 + i) = mu;
    const Complex pull = mu * (f.rate[i] * f.rate[i] * e - i1 * p.gravity);
    put(0, pull);
    put(2, z * pull);
    const double drag = mu * p.drag[i] * (f.rate[i] - w);
    force[4 + i] -= drag + mu * p.gravity * e.real();
    force[size - 1] += drag;
  }
  const auto s = supports(p, f);
  put(0, -s[0]);
  put(2, -s[1]);
  if (torque) {
    force[size - 1] += *torque;
  } else {
    m.row(size - 1).setZero();
    m(size - 1, size - 1) = 1.0;
    force[size - 1] = given;
  }
  return m.partialPivLu().solve(force);
}

Fixed FixedFlow::state(const double* y) const {
  const int n = p.balls, h = half();
  Fixed f;
  f.q1 = {y[0], y[1]};
  f.q2 = {y[2], y[3]};
  f.v1 = {y[h], y[h + 1]};
  f.v2 = {y[h + 2], y[h + 3]};
  f.psi = y[4 + n];
  f.w = y[h + 4 + n];
  f.theta = Eigen::Map<const VectorXd>(y + 4, n);
  f.rate = Eigen::Map<const VectorXd>(y + h + 4, n);
  return f;
}

Accelerations FixedFlow::as_one(const Fixed& f) const {
  double mass = 1.0, first = 0.0, second = p.tilt.transverse_inertia;
  Complex unbalance = std::polar(p.eccentricity, f.psi + p.eccentricity_angle),
          couple = p.tilt.couple() * std::polar(1.0, f.psi);
  for (int i = 0; i < p.balls; ++i) {
    const Complex one = std::polar(p.mass[i], f.theta[i]);
    mass += p.mass[i];
    first += p.mass[i] * p.tilt.plane[i];
    second += p.mass[i] * p.tilt.plane[i] * p.tilt.plane[i];
    unbalance += one;
    couple += p.tilt.plane[i] * one;
  }
  const auto s = supports(p, f);
  const Complex turning = f.w * f.w - i1 * acceleration, force = turning * unbalance - s[0] - i1 * p.gravity * mass,
                moment = turning * couple - s[1] + i1 * f.w * p.tilt.polar_inertia * f.v2 - i1 * p.gravity * first;
  const double determinant = mass * second - first * first;
  const Complex a = (force * second - moment * first) / determinant, b = (moment * mass - force * first) / determinant;
  Accelerations result = Accelerations::Constant(half(), acceleration);
  result.head(4) << a.real(), a.imag(), b.real(), b.imag();
  return result;
}

void FixedFlow::operator()(double, const double* y, double* dy) const {
  const Fixed f = state(y);
  const double torque = constant + slope * f.w;
  const Accelerations a = held ? as_one(f) : accelerations(p, f, driven ? &torque : nullptr, acceleration);
  for (int k = 0; k < half(); ++k) {
    dy[k] = y[half() + k];
    dy[half() + k] = a[k];
  }
}

bool advance(const FixedFlow& flow, double begin, double end, std::array<double, most>& y, double tolerance) {
  if (!(begin < end)) return true;
  HWY_NAMESPACE::ErrorScale<most> scale;
  scale.tolerance = tolerance;
  scale.floor.fill(1e-3);
  HWY_NAMESPACE::AdaptiveIntegrator<FixedFlow, most> integrator(flow, scale, 2 * flow.half());
  return integrator.advance(begin, end, y.data(), [](double, double, auto&&) {}) == IntegrationStatus::done;
}

std::array<double, most> first_state(const Study& s, double speed) {
  const model::Parameters& p = s.parameters;
  const int n = p.balls, h = 5 + n;
  std::array<double, most> y{};
  const InitialState& i = s.initial;
  const Complex turn = std::polar(1.0, i.psi), z(i.x, i.y), slope(i.tilt_x, i.tilt_y);
  const auto put = [&](int k, Complex v) {
    y[static_cast<std::size_t>(k)] = v.real();
    y[static_cast<std::size_t>(k) + 1] = v.imag();
  };
  put(0, z * turn);
  put(2, slope * turn);
  put(h, (Complex(i.x_dot, i.y_dot) + i1 * speed * z) * turn);
  put(h + 2, (Complex(i.tilt_x_dot, i.tilt_y_dot) + i1 * speed * slope) * turn);
  for (int k = 0; k < n; ++k) {
    y[static_cast<std::size_t>(4 + k)] = i.psi + i.phi[static_cast<std::size_t>(k)];
    y[static_cast<std::size_t>(h + 4 + k)] = speed + i.phi_dot[static_cast<std::size_t>(k)];
  }
  y[static_cast<std::size_t>(4 + n)] = i.psi;
  y[static_cast<std::size_t>(h + 4 + n)] = speed;
  return y;
}

VectorXd fixed_rate(const model::System& system, const VectorXd& y) {
  const model::Parameters& p = system.parameters();
  const int n = p.balls, t = system.layout().tilt;
  const double w = system.speed();
  const VectorXd a = accelerations(p, fixed_of(p, system, y, 0.0, w), nullptr, 0.0);
  VectorXd rate(y.size());
  const auto put = [&](int place, int of) {
    rate[place] = y[place + 2] + w * y[place + 1];
    rate[place + 1] = y[place + 3] - w * y[place];
    rate[place + 2] = a[of] + w * y[place + 3];
    rate[place + 3] = a[of + 1] - w * y[place + 2];
  };
  put(0, 0);
  put(t, 2);
  for (int i = 0; i < n; ++i) {
    rate[model::index::phi(i)] = y[model::index::q(i, n)];
    rate[model::index::q(i, n)] = a[4 + i];
  }
  return rate;
}

Eigen::VectorXcd fixed_eigenvalues(const model::System& system, const VectorXd& y) {
  constexpr double step = 1e-5;
  MatrixXd jacobian(y.size(), y.size());
  for (int k = 0; k < y.size(); ++k) {
    VectorXd more = y, less = y;
    more[k] += step;
    less[k] -= step;
    jacobian.col(k) = (fixed_rate(system, more) - fixed_rate(system, less)) / (2.0 * step);
  }
  return equipoise::dense::eigenvalues(jacobian);
}

int drifting_by(const std::string& name) {
  if (name.starts_with("locked") || name.starts_with("balanced")) return 0;
  const std::size_t comma = name.find(", ");
  if (name.find("captured") == std::string::npos) return 4;
  return comma == std::string::npos ? -1 : std::stoi(name.substr(comma + 2));
}

int drifting_in_fixed_axes(const Study& own, double tolerance, std::array<double, most>* end) {
  constexpr double until = 1500.0, watched = 60.0;
  FixedFlow flow{own.parameters, false, 0.0};
  if (own.speed.driven()) {
    flow.driven = true;
    flow.constant = own.speed.torque.constant;
    flow.slope = own.speed.torque.slope;
  }
  const double release = own.release_time();
  std::array<double, most> y =
      first_state(own, own.speed.profile == Profile::constant ? own.speed.speed : own.speed.initial);
  if (release > 0.0) {
    const FixedFlow held{own.parameters, true, (own.speed.final - own.speed.initial) / release};
    EXPECT_TRUE(advance(held, 0.0, release, y, tolerance));
  }
  EXPECT_TRUE(advance(flow, release, until, y, tolerance));
  const std::array<double, most> before = y;
  EXPECT_TRUE(advance(flow, 0.0, watched, y, tolerance));
  if (end) *end = y;
  int drifting = 0;
  for (std::size_t k = 4; k < 8; ++k) drifting += (y[k] - before[k] - (y[8] - before[8])) / watched < -0.5;
  return drifting;
}

std::array<double, 2> rest_of(const model::Parameters& p) {
  double mass = 1.0, first = 0.0;
  for (int i = 0; i < p.balls; ++i) {
    mass += p.mass[i];
    first += p.mass[i] * p.tilt.plane[i];
  }
  const double a = p.stiffness[1], b = p.tilt.stiffness[1][0], c = p.tilt.stiffness[1][1], d = a * c - b * b;
  return {-p.gravity * (mass * c - first * b) / d, -p.gravity * (first * a - mass * b) / d};
}

// What ISO 21940-11 judges: two unbalances in the outermost planes with the sum and the moment of all, each over the
// share of the plane by the lever rule.
std::array<Complex, 2> judged(const model::Parameters& p, const std::vector<double>& places, const Fixed& f) {
  Complex sum = std::polar(p.eccentricity, f.psi + p.eccentricity_angle),
          moment = std::polar(p.tilt.misalignment * (p.tilt.transverse_inertia - p.tilt.polar_inertia), f.psi);
  for (int i = 0; i < p.balls; ++i) {
    sum += std::polar(p.mass[i], f.theta[i]);
    moment += std::polar(p.tilt.plane[i] * p.mass[i], f.theta[i]);
  }
  const double a = *std::min_element(places.begin(), places.end()), b = *std::max_element(places.begin(), places.end());
  if (a == b) return {sum, sum};
  const Complex at_b = (moment - a * sum) / (b - a), at_a = sum - at_b;
  const double most = a < 0.0 && b > 0.0 ? 0.7 : 1.3;
  const auto share = [&](double far) { return std::min(most, std::max(0.3, std::abs(far) / (b - a))); };
  return {at_a / share(b), at_b / share(a)};
}

Seen seen(const model::Parameters& p, const std::vector<double>& places, const FixedFlow& flow, double t,
          const double* y, const std::vector<StatedBearing>& bearings) {
  const Fixed f = flow.state(y);
  const std::array<double, 2> rest = rest_of(p);
  Seen s;
  s.t = t;
  for (const double z : places) {
    s.radial = std::max(s.radial, std::abs(f.q1 - i1 * rest[0] + z * (f.q2 - i1 * rest[1])));
    s.velocity2.push_back(std::norm(f.v1 + z * f.v2));
    s.velocity2_x.push_back(std::pow((f.v1 + z * f.v2).real(), 2));
  }
  s.power = (flow.constant + flow.slope * f.w) * f.w;
  if (bearings.empty()) {
    s.force.push_back(std::abs(supports(p, f)[0]));
    s.dynamic.push_back(std::abs(supports(p, f)[0] + i1 * p.gravity * (1.0 + p.total_mass())));
  }
  for (const StatedBearing& b : bearings) {
    const Complex place = f.q1 + b.at * f.q2, rate = f.v1 + b.at * f.v2;
    s.force.push_back(std::hypot(b.stiffness[0] * place.real() + b.damping[0] * rate.real(),
                                 b.stiffness[1] * place.imag() + b.damping[1] * rate.imag()));
    s.dynamic.push_back(
        std::hypot(b.stiffness[0] * place.real() + b.damping[0] * rate.real(),
                   b.stiffness[1] * (place.imag() - rest[0] - b.at * rest[1]) + b.damping[1] * rate.imag()));
  }
  s.turning = judged(p, places, f);
  for (Complex& plane : s.turning) plane *= std::polar(1.0, -f.psi);
  s.unbalance = std::max(std::abs(s.turning[0]), std::abs(s.turning[1]));
  return s;
}

std::vector<Stretch> stretches(const Study& s, double until) {
  if (s.speed.profile == Profile::constant || s.speed.driven()) return {{0.0, until, false, 0.0}};
  const double release = s.release_time(), ramp = s.speed.duration, rate = (s.speed.final - s.speed.initial) / ramp;
  const double first = std::min(release, ramp);
  return {{0.0, first, true, rate}, {first, ramp, false, rate}, {ramp, until, false, 0.0}};
}

std::vector<Seen> dense(const Study& s, const std::vector<Stretch>& over, const std::vector<double>& places,
                        const std::vector<StatedBearing>& bearings) {
  constexpr double step = 1.0 / 200.0;
  std::vector<Seen> all;
  std::array<double, most> y = first_state(s, s.speed.profile == Profile::constant ? s.speed.speed : s.speed.initial);
  HWY_NAMESPACE::ErrorScale<most> scale;
  scale.tolerance = 1e-11;
  scale.floor.fill(1e-3);
  for (const Stretch& one : over) {
    if (!(one.begin < one.end)) continue;
    FixedFlow flow{s.parameters, one.held, one.acceleration};
    if (s.speed.driven()) {
      flow.driven = true;
      flow.constant = s.speed.torque.constant;
      flow.slope = s.speed.torque.slope;
    }
    const auto count = static_cast<std::size_t>(std::ceil((one.end - one.begin) / step));
    std::size_t next = 0;
    HWY_NAMESPACE::AdaptiveIntegrator<FixedFlow, most> integrator(flow, scale, 2 * flow.half());
    const auto at = [&](std::size_t k) { return one.begin + (one.end - one.begin) * static_cast<double>(k) / count; };
    const IntegrationStatus status =
        integrator.advance(one.begin, one.end, y.data(), [&](double, double to, auto&& state) {
          for (; next <= count && at(next) <= to; ++next) {
            std::array<double, most> z{};
            state(at(next), z.data());
            all.push_back(seen(s.parameters, places, flow, at(next), z.data(), bearings));
          }
        });
    EXPECT_EQ(status, IntegrationStatus::done);
  }
  return all;
}

TransientRow figures(const TransientSettings& asked, const std::vector<Seen>& all, double window_begin) {
  TransientRow row;
  double before = 0.0, after = 0.0, end = 0.0, force = 0.0, dynamic = 0.0, above = 0.0, last = 0.0, length = 0.0;
  double work = 0.0;
  std::array<Complex, 2> unbalance{};
  std::vector<double> velocity2(all.front().velocity2.size()), force2(all.front().force.size());
  std::vector<double> velocity2_x(velocity2.size()), dynamic2(force2.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Seen& s = all[k];
    double& peak = s.t < asked.release ? before : after;
    peak = std::max(peak, s.radial);
    force = std::max(force, *std::max_element(s.force.begin(), s.force.end()));
    dynamic = std::max(dynamic, *std::max_element(s.dynamic.begin(), s.dynamic.end()));
    if (s.t >= asked.release && s.radial > asked.settled) last = s.t;
    if (k == 0) continue;
    const double h = s.t - all[k - 1].t;
    work += 0.5 * h * (all[k - 1].power + s.power);
    if (s.radial > asked.displacement) above += h;
    if (all[k - 1].t < window_begin) continue;
    end = std::max(end, s.radial);
    length += h;
    for (std::size_t i = 0; i < force2.size(); ++i)
      force2[i] += 0.5 * h * (all[k - 1].force[i] * all[k - 1].force[i] + s.force[i] * s.force[i]);
    for (std::size_t i = 0; i < force2.size(); ++i)
      dynamic2[i] += 0.5 * h * (std::pow(all[k - 1].dynamic[i], 2) + std::pow(s.dynamic[i], 2));
    for (std::size_t i = 0; i < velocity2.size(); ++i)
      velocity2_x[i] += 0.5 * h * (all[k - 1].velocity2_x[i] + s.velocity2_x[i]);
    for (std::size_t i = 0; i < 2; ++i) unbalance[i] += 0.5 * h * (all[k - 1].turning[i] + s.turning[i]);
    for (std::size_t i = 0; i < velocity2.size(); ++i)
      velocity2[i] += 0.5 * h * (all[k - 1].velocity2[i] + s.velocity2[i]);
  }
  const auto number = [](double v) { return static_cast<float>(v); };
  row.peak_radial = number(std::max(before, after));
  row.peak_radial_after_release = number(after);
  row.peak_radial_at_end = number(end);
  row.peak_force = number(force);
  row.rms_force = number(std::sqrt(*std::max_element(force2.begin(), force2.end()) / length));
  row.rms_velocity = number(std::sqrt(*std::max_element(velocity2.begin(), velocity2.end()) / length));
  row.peak_dynamic_force = number(dynamic);
  row.rms_dynamic_force = number(std::sqrt(*std::max_element(dynamic2.begin(), dynamic2.end()) / length));
  double one = 0.0;
  for (std::size_t i = 0; i < velocity2.size(); ++i)
    one = std::max({one, velocity2_x[i], velocity2[i] - velocity2_x[i]});
  row.rms_velocity_one_direction = number(std::sqrt(one / length));
  row.residual_unbalance = number(std::max(std::abs(unbalance[0]), std::abs(unbalance[1])) / length);
  row.energy = number(work);
  constexpr float endless = std::numeric_limits<float>::infinity();
  row.time_above = end <= asked.displacement ? number(above) : endless;
  row.settling_time = end <= asked.settled ? number(std::max(0.0, last - asked.release)) : endless;
  row.followed_until = number(all.back().t);
  return row;
}

}  // namespace equipoise::tilting
