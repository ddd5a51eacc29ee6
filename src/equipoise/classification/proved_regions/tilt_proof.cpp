// The balanced state of each plane's two balls, enclosed, and the slope of the equations around it.

#include <array>
#include <cmath>

#include "equipoise/classification/proved_regions/level_frame.hpp"
#include "equipoise/core/math/gradient.hpp"
#include "equipoise/core/math/interval.hpp"
#include "equipoise/core/math/krawczyk.hpp"
#include "equipoise/core/math/positive_definite.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/balance/tilt_balance.hpp"
#include "equipoise/machine/model/equations-inl.hpp"

namespace equipoise {

namespace {

namespace kernels = HWY_NAMESPACE;
constexpr int balls = 4;

struct ShaftPair {
  Interval x, y;
};

// The share of the rotor's unbalance that the balls at `own` cancel, the others at `other`: both together have the
// unbalance lambda e^{i beta_0}, and the couple along angle 0.
ShaftPair share_of_plane(const model::Parameters& p, double own, double other) {
  Interval sine, cosine;
  sin_cos(Interval(p.eccentricity_angle), sine, cosine);
  const Interval arm = Interval(own) - Interval(other), at(other), size(p.eccentricity);
  const Interval couple =
      Interval(p.tilt.misalignment) * (Interval(p.tilt.transverse_inertia) - Interval(p.tilt.polar_inertia));
  return {(couple - at * size * cosine) / arm, -(at * size * sine) / arm};
}

// The four angles of the exact balanced state near the certificate's.
bool enclose_angles(const Certificate& c, std::array<Interval, balls>& angles) {
  constexpr double widest = 1e-10;
  const model::Parameters& p = c.parameters;
  for (int first = 0; first < balls; ++first) {
    int second = first + 1;
    while (second < balls && p.tilt.plane[second] != p.tilt.plane[first]) ++second;
    if (second == balls) continue;  // the other one of its plane came before
    int across = 0;
    while (p.tilt.plane[across] == p.tilt.plane[first]) ++across;
    const ShaftPair share = share_of_plane(p, p.tilt.plane[first], p.tilt.plane[across]);
    const auto left = [&](const std::array<PlaneGradient, 2>& two) {
      PlaneGradient x, y;
      x.value = share.x;
      y.value = share.y;
      for (int k = 0; k < 2; ++k) {
        PlaneGradient s, cosine;
        sin_cos(two[k], s, cosine);
        const PlaneGradient mass(p.mass[k == 0 ? first : second]);
        x = x + mass * cosine;
        y = y + mass * s;
      }
      return std::array<PlaneGradient, 2>{x, y};
    };
    std::array<Interval, 2> zero{};
    if (!enclose_zero(left, {c.phi[first], c.phi[second]}, widest, zero)) return false;
    angles[first] = zero[0];
    angles[second] = zero[1];
  }
  return true;
}

// Of a motor that is linear in the speed, below its limit.
struct MotorAtBalance {
  Interval speed, error;
};
MotorAtBalance motor_at_balance(const model::DriveSegment& m) {
  if (m.integral == 0.0) return {Interval(m.constant) / -Interval(m.slope), Interval(0.0)};
  const Interval speed(m.aim);
  return {speed, -(Interval(m.constant) + Interval(m.slope) * speed) / Interval(m.integral)};
}

template <int size>
class TiltProof {
 public:
  using Row = std::array<Interval, size>;
  using Matrix = std::array<Row, size>;

  explicit TiltProof(const Certificate& c) : c_(c), system_(c.system()), layout_(system_.layout()) {}

  CertificateResult check(double spare) {
    if (!fits(c_.form) || !fits(c_.frame) || !(c_.level > 0.0) || !std::isfinite(c_.level))
      return {false, form_frame_level};
    if (const char* fault = enclose_balance()) return {false, fault};
    if (const char* fault = enclose_reach()) return {false, fault};
    if (c_.motor && !below_limit()) return {false, motor_reaches_limit};
    const Matrix moved = product<size, size, size>(product<size, size, size>(gradient_, slope()), frame_);
    Matrix fall{};
    for (int i = 0; i < size; ++i)
      for (int j = 0; j <= i; ++j) fall[i][j] = -(moved[i][j] + moved[j][i]);
    if (!certainly_positive(fall, spare)) return {false, no_decrease_in_box};
    return {true, ""};
  }

 private:
  static bool fits(const Eigen::MatrixXd& m) { return m.rows() == size && m.cols() == size && m.allFinite(); }

  // Rest but for angles and speed. Programs use these numbers in doubles. That moves sqrt V by `shift` at most,
  // relative to its largest value, and V by twice as much: less than the slack.
  const char* enclose_balance() {
    constexpr double centre_error = 1e-10, shift = 3e-10;
    std::array<Interval, balls> angles{};
    if (!enclose_angles(c_, angles)) return angles_enclose_none;
    for (int i = 0; i < balls; ++i) rest_[model::index::phi(i)] = angles[i];
    if (c_.motor) {
      const MotorAtBalance at = motor_at_balance(*c_.motor);
      rest_[layout_.speed] = at.speed;
      if (layout_.error >= 0) rest_[layout_.error] = at.error;
      if (!((at.speed - Interval(c_.speed)).magnitude() < centre_error)) return other_speed;
    }
    const Eigen::VectorXd centre = model::balanced_state(system_, c_.speed, c_.phi.data());
    Row away{};
    for (int i = 0; i < size; ++i) away[i] = Interval((rest_[i] - Interval(centre[i])).magnitude());
    return is_centred<size>(c_, away, shift) ? nullptr : angles_not_close;
  }

  const char* enclose_reach() {
    constexpr double frame_error = 1e-8;
    if (const char* fault = enclose_frame<size>(c_, frame_error, gradient_, disc_)) return fault;
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) frame_[i][j] = c_.frame(i, j);
    for (int i = 0; i < size; ++i) reach_[i] = length_of(frame_[i]);
    for (int i = 0; i < balls; ++i)
      if (!(reach_[model::index::phi(i)] < 3.1)) return reaches_around;
    return nullptr;
  }

  // The largest of a linear function of the deviation, given along the frame's columns.
  double length_of(const Row& row) const {
    Interval sum(0.0);
    for (const Interval& entry : row) sum = sum + square(entry);
    return square_root(sum * Interval(disc_)).high;
  }

  bool below_limit() const {
    const model::DriveSegment& m = *c_.motor;
    Row change = frame_[layout_.speed];
    for (int j = 0; j < size; ++j) {
      change[j] = Interval(m.slope) * change[j];
      if (layout_.error >= 0) change[j] = change[j] + Interval(m.integral) * frame_[layout_.error][j];
    }
    return length_of(change) < m.limit;  // balanced, it has nothing to do
  }

  // f(rest + d) = S d with S within these intervals for all d on V <= level.
  Matrix slope() const {
    using Slope = Gradient<Interval, size>;
    const kernels::BallBalancer<Slope, balls, kernels::body_terms(true)> balancer(c_.parameters, layout_.tilt);
    std::array<Slope, size> z, dz;
    for (int i = 0; i < size; ++i) z[i] = Slope(rest_[i] + Interval(-reach_[i], reach_[i]), i);
    // Equal supports without gravity do not ask for the rotor's angle.
    kernels::RotorMotion<Slope> rotor{Slope(c_.speed), Slope(0.0), Slope(0.0), Slope(1.0)};
    if (!c_.motor) {
      balancer.body_derivative(rotor, nullptr, z.data(), dz.data());
    } else {
      const model::DriveSegment& m = *c_.motor;
      rotor.speed = z[layout_.speed];
      Slope torque = Slope(m.constant) + Slope(m.slope) * rotor.speed;
      if (layout_.error >= 0) {
        torque = torque + Slope(m.integral) * z[layout_.error];
        dz[layout_.error] = Slope(m.aim) - rotor.speed;
      }
      dz[layout_.speed] = balancer.body_derivative(rotor, &torque, z.data(), dz.data()).acceleration;
    }
    Matrix s{};
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) s[i][j] = dz[i].slope[j];
    return s;
  }

  const Certificate& c_;
  const model::System system_;
  const model::StateLayout layout_;
  Row rest_{};
  Matrix frame_{}, gradient_{};  // D, D^T P / level
  std::array<double, size> reach_{};
  double disc_ = 0.0;
};

}  // namespace

std::string tilt_refusal(const model::System& system) {
  const std::vector<model::BallPlane> planes = model::planes_of_balls(system.parameters());
  const bool two_and_two = planes.size() == 2 && planes[0].balls.size() == 2 && planes[1].balls.size() == 2;
  if (!two_and_two) return two_planes_of_two;
  const bool isolated = model::balanced_states(system).kind != model::BalancedStates::Kind::continuum;
  return isolated ? "" : plane_with_nothing_to_cancel;
}

CertificateResult check_tilt(const Certificate& c, double spare) {
  constexpr int size = model::dimension(balls) + 4;
  const int dimension = c.system().dimension();
  if (dimension == size) return TiltProof<size>(c).check(spare);
  if (dimension == size + 1) return TiltProof<size + 1>(c).check(spare);
  if (dimension == size + 2) return TiltProof<size + 2>(c).check(spare);
  return {false, form_frame_level};
}

}  // namespace equipoise
