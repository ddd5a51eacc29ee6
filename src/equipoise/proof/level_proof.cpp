// The inequalities behind a certificate, in interval and affine arithmetic.
#include "equipoise/proof/level_proof.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/base/angles.hpp"
#include "equipoise/math/krawczyk.hpp"
#include "equipoise/math/positive_definite.hpp"
#include "equipoise/model/balanced_state.hpp"

namespace equipoise {

namespace {

// The equations of a kind of system.
template <class Flow>
Flow flow_of(const model::System& system) {
  if constexpr (std::is_constructible_v<Flow, const model::System&, double>)
    return Flow(system, 0.0);
  else
    return Flow(system.parameters(), model::Segment{0.0, 0.0, 0.0, system.speed(), 0.0, false});
}

// A number known to lie in an interval.
template <int k>
AffineForm<k> number(const Interval& a, const AffineForm<k>&) {
  return AffineForm<k>(Constant(a));
}
template <int k>
Gradient<Interval, k> number(const Interval& a, const Gradient<Interval, k>&) {
  Gradient<Interval, k> r;
  r.value = a;
  return r;
}

template <int rows, int inner, int columns, class A, class B>
auto product(const A& a, const B& b) {
  std::array<std::array<Interval, columns>, rows> result{};
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      for (int k = 0; k < inner; ++k) result[i][j] = result[i][j] + Interval(a[i][k]) * Interval(b[k][j]);
  return result;
}

// Bound on the error of a balanced state as doubles in any component.
constexpr double centre_error = 1e-10;

// Relative margin by which a search must succeed: far above rounding, far below what decides the share proved.
constexpr double spare_in_search = 1e-11;

}  // namespace

// The torque of a motor below its limit, which check_limit() proves it to be, and the rate of its control's integral.
template <class T, int n, int more>
HWY_NAMESPACE::MotorState<Expansion<T, n, more>> motor_state(const model::DriveSegment& motor,
                                                             const Expansion<T, n, more>&,
                                                             const Expansion<T, n, more>& speed,
                                                             const Expansion<T, n, more>& error) {
  using E = Expansion<T, n, more>;
  E torque = E(motor.constant) + E(motor.slope) * speed;
  if constexpr (more > 1) torque = torque + E(motor.integral) * error;
  return {torque, E(motor.aim) - speed};
}

template <ProofKind kind>
LevelProof<kind>::LevelProof(const Certificate& c)
    : affine_flow_(flow_of<Flow<Affine>>(c.system())), slope_flow_(flow_of<Flow<Slope>>(c.system())) {
  const auto square = [](const Eigen::MatrixXd& m) { return m.rows() == size && m.cols() == size && m.allFinite(); };
  if (!square(c.form) || !square(c.frame) || !(c.level > 0.0) || !std::isfinite(c.level)) {
    fault_ = "form, frame or level do not fit the number of balls";
    return;
  }
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) frame_[i][j] = c.frame(i, j);
  if (!enclose_speed(c) || !enclose_balance(c) || !check_frame(c) || !check_centre(c) || !check_limit(c)) return;
  linearise();
}

template <ProofKind kind>
template <class T>
typename LevelProof<kind>::template Rates<T> LevelProof<kind>::rates(const Flow<T>& flow,
                                                                     const std::array<T, n>& angles) const {
  using E = Motion<T>;
  E z[size];
  for (int v = 0; v < etas; ++v) {
    z[row_of(v)] = E::variable(v);
    if constexpr (kind.body) z[row_of(v)] = z[row_of(v)] + E(number(rest_[v], T()));
  }
  for (int i = 0; i < n; ++i) z[model::index::phi(i)] = E(angles[i]);
  Rates<T> result;
  flow(E(0.0), z, result.data());
  return result;
}

// Where a motor gives what the supports' dampers take of a shaft that whirls at the race's offset e, and where the
// other components then rest: x + i y = -e, u + i v = -i psi' e (docs/equations.md, "An off-centre race").
template <ProofKind kind>
bool LevelProof<kind>::enclose_speed(const Certificate& c) {
  if constexpr (kind.body) {
    const model::Parameters& p = c.parameters;
    const Interval x(p.race_offset[0]), y(p.race_offset[1]);
    const Interval damping = Interval(p.damping[0]) * (square(x) + square(y));
    Interval speed(c.speed);
    if constexpr (kind.driven) {
      const model::DriveSegment& m = *c.motor;
      speed = kind.integral ? Interval(m.aim) : Interval(m.constant) / (damping - Interval(m.slope));
      rest_[4 + n] = speed;
      if constexpr (kind.integral)
        rest_[etas - 1] = (damping * speed - Interval(m.constant) - Interval(m.slope) * speed) / Interval(m.integral);
      if (!((damping * speed).magnitude() < m.limit)) fault_ = "the motor is at its limit in balance";
      if (!((speed - Interval(c.speed)).magnitude() < centre_error)) fault_ = "the speed is not that of balance";
    }
    rest_[0] = -x;
    rest_[1] = -y;
    rest_[2] = speed * y;
    rest_[3] = -(speed * x);
  }
  return fault_.empty();
}

// The balanced state lies where the race's centre, and with it everything else, does not accelerate: all other rates at
// rest are products with its acceleration A', and that of a driven rotor then gives its motor nothing to do. (du/dt,
// dv/dt) is A' + (e_y, -e_x) psi'' where the rest of the state is the balanced one. One ball's angle cannot make both
// vanish: its balanced state exists only if ball and unbalance weigh exactly the same, and is then phi = pi.
template <ProofKind kind>
bool LevelProof<kind>::enclose_balance(const Certificate& c) {
  const model::Parameters& p = c.parameters;
  if constexpr (n == 1) {
    balance_[0] = {pi, std::nextafter(pi, 4.0)};
    if (p.mass[0] != p.eccentricity || !p.race_is_centred())
      fault_ = "one ball balances only what weighs exactly as much as itself";
    else if (!(std::fabs(c.phi[0] - pi) < centre_error))
      fault_ = "the ball angle does not enclose a balanced state";
  } else {
    const auto at_rest = [&](const std::array<Slope, n>& angles) {
      const auto f = rates(slope_flow_, angles);
      std::array<Slope, n> race{f[2].coefficient[0], f[3].coefficient[0]};
      if constexpr (kind.driven) {
        const Slope& turning = f[row_of_theta(n)].coefficient[0];
        race[0] = race[0] - turning * Slope(p.race_offset[1]);
        race[1] = race[1] + turning * Slope(p.race_offset[0]);
      }
      return race;
    };
    if (!enclose_zero(at_rest, {c.phi[0], c.phi[1]}, centre_error, balance_))
      fault_ = "the ball angles do not enclose a balanced state";
  }
  return fault_.empty();
}

// The frame makes the form the unit one up to 1e-10, so both are regular and the form is positive definite; ball angles
// depend on tau alone and turn less than half around the race.
template <ProofKind kind>
bool LevelProof<kind>::check_frame(const Certificate& c) {
  constexpr double frame_error = 1e-10;
  Rows<double, size> form, transposed;
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      form[i][j] = c.form(i, j);
      transposed[i][j] = frame_[j][i];
    }
  gradient_ = product<size, size, size>(transposed, form);
  for (auto& row : gradient_)
    for (Interval& entry : row) entry = entry / Interval(c.level);
  const auto unit = product<size, size, size>(gradient_, frame_);
  for (int i = 0; i < size; ++i) {
    Interval sum(0.0);
    for (int j = 0; j < size; ++j) {
      sum = sum + Interval((unit[i][j] - Interval(i == j ? 1.0 : 0.0)).magnitude());
      if (form[i][j] != form[j][i]) fault_ = "the form is not symmetric";
    }
    if (!(sum.high < frame_error)) fault_ = "the frame does not make the level set of the form the unit ball";
  }
  disc_ = ((Interval(1.0) + Interval(level_slack)) / (Interval(1.0) - Interval(frame_error))).high;

  for (int i = 0; i < n; ++i) {
    const int row = model::index::phi(i);
    Interval reach(0.0);
    for (int j = 0; j < size; ++j) {
      if (j < etas && frame_[row][j] != 0.0) fault_ = "the frame lets ball angles depend on more than tau";
      reach = reach + square(Interval(frame_[row][j]));
    }
    if (!(square_root(reach * Interval(disc_)).high < 3.1)) fault_ = "the level set reaches around the race";
  }
  return fault_.empty();
}

// The balanced state in doubles, as programs know it, in place of the exact one moves V by less than the slack: sqrt V
// differs by at most sqrt(V(shift of the centre)).
template <ProofKind kind>
bool LevelProof<kind>::check_centre(const Certificate& c) {
  constexpr double shift = 1e-11;
  const Eigen::VectorXd centre = model::balanced_state(c.system(), c.speed, c.phi.data());
  std::array<Interval, size> away{};
  for (int v = 0; v < etas; ++v)
    if (kind.body) away[row_of(v)] = Interval((rest_[v] - Interval(centre[row_of(v)])).magnitude());
  for (int i = 0; i < n; ++i) away[model::index::phi(i)] = Interval((balance_[i] - Interval(c.phi[i])).magnitude());
  Interval moved(0.0);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) moved = moved + away[i] * away[j] * Interval(std::fabs(c.form(i, j)));
  if (!(moved.high < shift * shift * c.level)) fault_ = "the ball angles are not close enough to a balanced state";
  return fault_.empty();
}

// Nowhere on V <= level does the motor give all it can: there its torque is linear.
template <ProofKind kind>
bool LevelProof<kind>::check_limit(const Certificate& c) {
  if constexpr (kind.driven) {
    const model::DriveSegment& m = *c.motor;
    Interval reach(0.0);
    for (int j = 0; j < size; ++j) {
      Interval change = Interval(m.slope) * Interval(frame_[row_of_theta(n)][j]);
      if constexpr (kind.integral) change = change + Interval(m.integral) * Interval(frame_[size - 1][j]);
      reach = reach + square(change);
    }
    const auto& e = c.parameters.race_offset;
    const Interval balanced = Interval(c.parameters.damping[0]) * (square(Interval(e[0])) + square(Interval(e[1])));
    const Interval most = Interval((balanced * rest_[4 + n]).magnitude()) + square_root(reach * Interval(disc_));
    if (!(most.high < m.limit)) fault_ = "the motor reaches its limit on the level set";
  }
  return fault_.empty();
}

template <ProofKind kind>
void LevelProof<kind>::linearise() {
  std::array<Slope, n> angles;
  for (int i = 0; i < n; ++i) angles[i] = Slope(balance_[i], i);
  const auto f = rates(slope_flow_, angles);
  for (int row = 0; row < size; ++row) {
    // The equations never branch on values, so one look at their shape holds for every box.
    if (f[row].beyond) fault_ = "the equations are not linear in x, y, u, v and quadratic in each ball's speed";
    for (int v = 0; v < etas; ++v) jacobian_[row][row_of(v)] = f[row].coefficient[1 + v].value;
    for (int i = 0; i < n; ++i) {
      jacobian_[row][model::index::phi(i)] = f[row].coefficient[0].slope[i];
      square_[row][i] = f[row].coefficient[Motion<Slope>::square_of(i)].value;
      square_constant_[row][i] = Constant(square_[row][i]);
    }
    if constexpr (kind.driven)
      for (int v = 0; v < etas; ++v) {
        by_speed_[row][v] = f[row].coefficient[Motion<Slope>::product_with_speed(v)].value;
        by_speed_constant_[row][v] = Constant(by_speed_[row][v]);
      }
    for (int j = 0; j < size; ++j) {
      jacobian_constant_[row][j] = Constant(jacobian_[row][j]);
      gradient_constant_[row][j] = Constant(gradient_[row][j]);
    }
  }
  linear_ = product<size, size, size>(product<size, size, size>(gradient_, jacobian_), frame_);
  const auto along = product<size, size, n>(gradient_, square_);
  for (int i = 0; i < n; ++i)
    for (int a = 0; a < size; ++a)
      for (int b = 0; b < size; ++b) bilinear_[i][a][b] = along[a][i] * Interval(frame_[model::index::q(i, n)][b]);
  if constexpr (kind.driven) {
    std::array<std::array<double, size>, etas> rows;
    for (int v = 0; v < etas; ++v) rows[v] = frame_[row_of(v)];
    bilinear_[n] = product<size, etas, size>(product<size, size, etas>(gradient_, by_speed_), rows);
  }
}

template <ProofKind kind>
bool LevelProof<kind>::outside(const Box& box) const {
  Interval distance(0.0);
  for (int k = 0; k < n; ++k) distance = distance + square(Interval(box.low[k], box.high[k]));
  return distance.low > disc_;
}

template <ProofKind kind>
std::array<Interval, LevelProof<kind>::n> LevelProof<kind>::deviation(const Box& box) const {
  std::array<Interval, n> delta{};
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k)
      delta[i] = delta[i] + Interval(frame_[model::index::phi(i)][etas + k]) * Interval(box.low[k], box.high[k]);
  return delta;
}

// On V <= level with tau in the box: the part along tau, and that along eta, |eta|^2 <= disc - |tau|^2.
template <ProofKind kind>
std::array<Interval, LevelProof<kind>::thetas> LevelProof<kind>::speeds(const Box& box) const {
  Interval room(disc_);
  for (int k = 0; k < n; ++k) room = room - Interval(square(Interval(box.low[k], box.high[k])).low);
  std::array<Interval, thetas> q{};
  for (int i = 0; i < thetas; ++i) {
    const auto& row = frame_[row_of_theta(i)];
    Interval length(0.0);
    for (int j = 0; j < etas; ++j) length = length + square(Interval(row[j]));
    const double reach = square_root(length * Interval(std::max(0.0, room.high))).high;
    q[i] = Interval(-reach, reach);
    for (int k = 0; k < n; ++k) q[i] = q[i] + Interval(row[etas + k]) * Interval(box.low[k], box.high[k]);
  }
  return q;
}

// Around the balanced state dV/dt is of second order in d, so no margin of zeroth order can prove it. There f(d) = S d
// with a slope S enclosed over the box (it holds the centre, and the ray to each of its points), and the symmetric part
// of G S D must be negative definite.
template <ProofKind kind>
bool LevelProof<kind>::holds_around_centre(const Box& box, double spare) const {
  const auto delta = deviation(box);
  const auto speed = speeds(box);
  std::array<Slope, n> angles;
  for (int i = 0; i < n; ++i) angles[i] = Slope(balance_[i] + delta[i], i);
  const auto f = rates(slope_flow_, angles);
  for (int vertex = 0; vertex < vertices; ++vertex) {
    Rows<Interval, size> change{};
    std::array<Interval, thetas> theta;
    for (int i = 0; i < thetas; ++i) theta[i] = (vertex >> i) & 1 ? speed[i].high : speed[i].low;
    for (int row = 0; row < size; ++row) {
      for (int v = 0; v < etas; ++v)
        change[row][row_of(v)] = f[row].coefficient[1 + v].value - jacobian_[row][row_of(v)];
      for (int i = 0; i < n; ++i) {
        const int phi = model::index::phi(i), q = model::index::q(i, n);
        const Interval bend = f[row].coefficient[Motion<Slope>::square_of(i)].value - square_[row][i];
        change[row][q] = change[row][q] + theta[i] * bend;
        change[row][phi] = f[row].coefficient[0].slope[i] - jacobian_[row][phi];
      }
      if constexpr (kind.driven)
        for (int v = 0; v < etas; ++v) {
          const Interval bend = f[row].coefficient[Motion<Slope>::product_with_speed(v)].value - by_speed_[row][v];
          change[row][row_of(v)] = change[row][row_of(v)] + theta[n] * bend;
        }
    }
    const auto moved = product<size, size, size>(product<size, size, size>(gradient_, change), frame_);
    Rows<Interval, size> fall;
    for (int a = 0; a < size; ++a)
      for (int b = 0; b <= a; ++b) {
        Interval twice = linear_[a][b] + linear_[b][a] + moved[a][b] + moved[b][a];
        for (int i = 0; i < thetas; ++i) twice = twice + theta[i] * (bilinear_[i][a][b] + bilinear_[i][b][a]);
        fall[a][b] = -twice;
      }
    if (!certainly_positive(fall, spare)) return false;
  }
  return true;
}

template <ProofKind kind>
typename LevelProof<kind>::Slice LevelProof<kind>::slice(const Box& box) const {
  Slice s;
  std::array<Affine, n> tau, delta, angles;
  for (int k = 0; k < n; ++k) {
    s.middle[k] = 0.5 * (box.low[k] + box.high[k]);
    s.half[k] = rounded_up(std::max(box.high[k] - s.middle[k], s.middle[k] - box.low[k]));
    tau[k].centre = s.middle[k];
    tau[k].slope[k] = s.half[k];
  }
  s.theta = speeds(box);
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) delta[i] = delta[i] + tau[k] * Constant(frame_[model::index::phi(i)][etas + k]);
    angles[i] = Affine(Constant(balance_[i])) + delta[i];
  }
  const auto f = rates(affine_flow_, angles);

  // The remainder of f: still[row] + sum_v moving[row][v] w_v + sum_i theta_i bend[row][i] q_i.
  std::array<Affine, etas> w_of_tau;
  for (int v = 0; v < etas; ++v)
    for (int k = 0; k < n; ++k) w_of_tau[v] = w_of_tau[v] + tau[k] * Constant(frame_[row_of(v)][etas + k]);
  std::array<Affine, size> still;
  Rows<Affine, etas> moving;
  Rows<Affine, n> bend;
  for (int row = 0; row < size; ++row) {
    still[row] = f[row].coefficient[0];
    for (int i = 0; i < n; ++i) {
      still[row] = still[row] - delta[i] * jacobian_constant_[row][model::index::phi(i)];
      bend[row][i] = f[row].coefficient[Motion<Affine>::square_of(i)] - Affine(square_constant_[row][i]);
    }
    for (int v = 0; v < etas; ++v) {
      moving[row][v] = f[row].coefficient[1 + v] - Affine(jacobian_constant_[row][row_of(v)]);
      still[row] = still[row] + moving[row][v] * w_of_tau[v];
    }
  }

  // G times that, in (eta, tau) instead of w: at_rest[a] + sum_j along[a][j] eta_j, and likewise for each theta_i.
  std::array<Affine, size> at_rest;
  Rows<Affine, etas> along;
  Rows<Affine, n> bent;
  for (int a = 0; a < size; ++a) {
    std::array<Affine, etas> by_w;
    for (int row = 0; row < size; ++row) {
      const Constant& g = gradient_constant_[a][row];
      at_rest[a] = at_rest[a] + still[row] * g;
      for (int v = 0; v < etas; ++v) by_w[v] = by_w[v] + moving[row][v] * g;
      for (int i = 0; i < n; ++i) bent[a][i] = bent[a][i] + bend[row][i] * g;
    }
    for (int j = 0; j < etas; ++j)
      for (int v = 0; v < etas; ++v) along[a][j] = along[a][j] + by_w[v] * Constant(frame_[row_of(v)][j]);
  }

  // The form in (eta, 1) of (eta; tau)^T (linear (eta; tau) + remainder). Linear terms are exactly affine in tau but
  // for tau^T X tau, which lies below its tangent at the middle where X is negative definite (corners() adds what
  // else).
  const auto fill = [&](Square<Affine>& form, const Rows<Interval, size>& x, const std::array<Affine, size>& rest,
                        const auto& slope) {
    Affine& corner = form[one][one];
    for (int k = 0; k < n; ++k) {
      corner = corner + tau[k] * rest[etas + k];
      for (int j = 0; j < n; ++j) {
        const Interval both = x[etas + k][etas + j] + x[etas + j][etas + k];
        corner = corner + (tau[j] - Affine(0.5 * s.middle[j])) * Constant(both * Interval(s.middle[k]));
      }
    }
    for (int j = 0; j < etas; ++j) {
      Affine sum = rest[j];
      for (int k = 0; k < n; ++k)
        sum = sum + tau[k] * Constant(x[j][etas + k] + x[etas + k][j]) + tau[k] * slope(etas + k, j);
      form[one][j] = sum * Constant(0.5);
      for (int i = j; i < etas; ++i)
        form[i][j] = (Affine(Constant(x[i][j] + x[j][i])) + slope(i, j) + slope(j, i)) * Constant(0.5);
    }
  };
  fill(s.base, linear_, at_rest, [&](int a, int j) { return along[a][j]; });
  for (int i = 0; i < n; ++i) {
    std::array<Affine, size> rest;
    for (int a = 0; a < size; ++a) rest[a] = bent[a][i] * w_of_tau[4 + i];
    const auto& q_row = frame_[model::index::q(i, n)];
    fill(s.part[i], bilinear_[i], rest, [&](int a, int j) { return bent[a][i] * Constant(q_row[j]); });
  }
  if constexpr (kind.driven) {
    Rows<Affine, etas> bend_by_speed, by_eta;
    for (int row = 0; row < size; ++row)
      for (int v = 0; v < etas; ++v)
        bend_by_speed[row][v] =
            f[row].coefficient[Motion<Affine>::product_with_speed(v)] - Affine(by_speed_constant_[row][v]);
    std::array<Affine, size> rest;
    for (int a = 0; a < size; ++a)
      for (int v = 0; v < etas; ++v) {
        Affine by_w;
        for (int row = 0; row < size; ++row) by_w = by_w + bend_by_speed[row][v] * gradient_constant_[a][row];
        rest[a] = rest[a] + by_w * w_of_tau[v];
        for (int j = 0; j < etas; ++j) by_eta[a][j] = by_eta[a][j] + by_w * Constant(frame_[row_of(v)][j]);
      }
    fill(s.part[n], bilinear_[n], rest, [&](int a, int j) { return by_eta[a][j]; });
  }
  return s;
}

template <ProofKind kind>
std::array<typename LevelProof<kind>::Corner, LevelProof<kind>::corners> LevelProof<kind>::at_corners(
    const Slice& s, int vertex, double spare) const {
  std::array<double, thetas> theta;
  for (int i = 0; i < thetas; ++i) theta[i] = (vertex >> i) & 1 ? s.theta[i].high : s.theta[i].low;
  Square<Affine> form = s.base;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j <= i; ++j)
      for (int k = 0; k < thetas; ++k) form[i][j] = form[i][j] + s.part[k][i][j] * Constant(theta[k]);

  // rho^T X rho over the box, X the matrix of tau^T X tau.
  Interval x[n][n], excess(0.0);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j) {
      x[k][j] = linear_[etas + k][etas + j] + linear_[etas + j][etas + k];
      for (int i = 0; i < thetas; ++i)
        x[k][j] = x[k][j] + Interval(theta[i]) * (bilinear_[i][etas + k][etas + j] + bilinear_[i][etas + j][etas + k]);
    }
  bool falling = x[0][0].high < 0.0;
  if constexpr (n == 2) falling = falling && (x[0][0] * x[1][1] - x[0][1] * x[1][0]).low > 0.0;
  if (!falling)
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        excess = excess + Interval(0.5 * std::max(0.0, k == j ? x[k][j].high : x[k][j].magnitude())) *
                              Interval(s.half[k]) * Interval(s.half[j]);

  // Radii of a row go to its diagonal, as in certainly_positive(); so does the rounding of the sums below.
  std::array<double, side> spread{};
  for (int i = 0; i < side; ++i)
    for (int j = 0; j <= i; ++j) {
      const Affine& entry = form[i][j];
      const double bound = entry.radius + (0x1p-46 + spare) * (std::fabs(entry.centre) + entry.swing());
      spread[i] += bound;
      if (j != i) spread[j] += bound;
    }
  for (double& sum : spread) sum *= Affine::grown;
  spread[one] = rounded_up(spread[one] + excess.high);

  std::array<Corner, corners> result;
  for (int c = 0; c < corners; ++c) {
    Corner& corner = result[c];
    for (int i = 0; i < side; ++i) {
      for (int j = 0; j <= i; ++j) {
        double value = form[i][j].centre;
        for (int k = 0; k < n; ++k) value += (c >> k) & 1 ? form[i][j].slope[k] : -form[i][j].slope[k];
        corner.form[i][j] = value;
      }
      corner.form[i][i] = rounded_up(corner.form[i][i] + spread[i]);
    }
    // disc - |tau|^2 below its tangent at the middle.
    Interval room(disc_);
    for (int k = 0; k < n; ++k) {
      const Interval m(s.middle[k]), h((c >> k) & 1 ? s.half[k] : -s.half[k]);
      room = room - m * (m + Interval(2.0) * h);
    }
    corner.room = room.high;
  }
  return result;
}

template <ProofKind kind>
bool LevelProof<kind>::central(const Box& box) {
  for (int k = 0; k < n; ++k)
    if (!(box.low[k] <= 0.0 && box.high[k] >= 0.0)) return false;
  return true;
}

template <ProofKind kind>
bool LevelProof<kind>::find(Box& box) const {
  if (central(box)) return holds_around_centre(box, spare_in_search);
  const Slice s = slice(box);
  for (int vertex = 0; vertex < vertices; ++vertex)
    if (!find_multiplier(at_corners(s, vertex, spare_in_search), box.multiplier[vertex])) return false;
  return true;
}

template <ProofKind kind>
bool LevelProof<kind>::holds(const Box& box) const {
  if (central(box)) return holds_around_centre(box, 0.0);
  const Slice s = slice(box);
  for (int vertex = 0; vertex < vertices; ++vertex) {
    if (!(box.multiplier[vertex] >= 0.0)) return false;
    double bound;
    for (const Corner& corner : at_corners(s, vertex, 0.0))
      if (judge(corner, box.multiplier[vertex], bound) != Multiplier::proves) return false;
  }
  return true;
}

// As with_proof_kind() asks for them.
template class LevelProof<ProofKind{1}>;
template class LevelProof<ProofKind{1, true}>;
template class LevelProof<ProofKind{1, true, true}>;
template class LevelProof<ProofKind{1, true, true, true}>;
template class LevelProof<ProofKind{1, true, true, true, true}>;
template class LevelProof<ProofKind{2}>;
template class LevelProof<ProofKind{2, true}>;
template class LevelProof<ProofKind{2, true, true}>;
template class LevelProof<ProofKind{2, true, true, true}>;
template class LevelProof<ProofKind{2, true, true, true, true}>;

}  // namespace equipoise
