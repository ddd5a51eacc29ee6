// What of a certificate does not depend on a box: the balanced state, the frame, a motor's limit, the linear part.
#include "equipoise/classification/proved_regions/level_proof.hpp"

#include <cmath>

#include "equipoise/classification/proved_regions/level_frame.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/krawczyk.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"

namespace equipoise {

namespace {

template <class Flow>
Flow flow_of(const model::System& system) {
  if constexpr (std::is_constructible_v<Flow, const model::System&, double>)
    return Flow(system, 0.0);
  else
    return Flow(system.parameters(), model::Segment{0.0, 0.0, 0.0, system.speed(), 0.0, false});
}

// Bound on the error of a balanced state as doubles in any component.
constexpr double centre_error = 1e-10;

}  // namespace

template <ProofKind kind>
LevelProof<kind>::LevelProof(const Certificate& c)
    : affine_flow_(flow_of<Flow<Affine>>(c.system())), slope_flow_(flow_of<Flow<Slope>>(c.system())) {
  const auto square = [](const Eigen::MatrixXd& m) { return m.rows() == size && m.cols() == size && m.allFinite(); };
  if (!square(c.form) || !square(c.frame) || !(c.level > 0.0) || !std::isfinite(c.level)) {
    fault_ = form_frame_level;
    return;
  }
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) frame_[i][j] = c.frame(i, j);
  if (!enclose_speed(c) || !enclose_balance(c) || !check_frame(c) || !check_centre(c) || !check_limit(c)) return;
  linearise();
}

// Where a motor gives what the supports' dampers take of a shaft that whirls at the race's offset e, and where the
// other components then rest: x + i y = -e, u + i v = -i psi' e (docs/explanation/equations.md, "An off-centre race").
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
      if (!((speed - Interval(c.speed)).magnitude() < centre_error)) fault_ = other_speed;
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
      fault_ = "one ball balances only if it weighs as much as the unbalance and the race is centred";
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
    if (!enclose_zero(at_rest, {c.phi[0], c.phi[1]}, centre_error, balance_)) fault_ = angles_enclose_none;
  }
  return fault_.empty();
}

// Ball angles depend on tau alone and turn less than half around the race.
template <ProofKind kind>
bool LevelProof<kind>::check_frame(const Certificate& c) {
  constexpr double frame_error = 1e-10;
  if (const char* fault = enclose_frame<size>(c, frame_error, gradient_, disc_)) {
    fault_ = fault;
    return false;
  }
  for (int i = 0; i < n; ++i) {
    const int row = model::index::phi(i);
    Interval reach(0.0);
    for (int j = 0; j < size; ++j) {
      if (j < etas && frame_[row][j] != 0.0) fault_ = "the frame lets ball angles depend on more than tau";
      reach = reach + square(Interval(frame_[row][j]));
    }
    if (!(square_root(reach * Interval(disc_)).high < 3.1)) fault_ = reaches_around;
  }
  return fault_.empty();
}

// Programs use the balanced state in doubles: that moves sqrt V by at most sqrt(V(shift)), less than the slack.
template <ProofKind kind>
bool LevelProof<kind>::check_centre(const Certificate& c) {
  constexpr double shift = 1e-11;
  const Eigen::VectorXd centre = model::balanced_state(c.system(), c.speed, c.phi.data());
  std::array<Interval, size> away{};
  for (int v = 0; v < etas; ++v)
    if (kind.body) away[row_of(v)] = Interval((rest_[v] - Interval(centre[row_of(v)])).magnitude());
  for (int i = 0; i < n; ++i) away[model::index::phi(i)] = Interval((balance_[i] - Interval(c.phi[i])).magnitude());
  if (!is_centred<size>(c, away, shift)) fault_ = angles_not_close;
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
    if (!(most.high < m.limit)) fault_ = motor_reaches_limit;
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
    }
    if constexpr (kind.driven)
      for (int v = 0; v < etas; ++v) by_speed_[row][v] = f[row].coefficient[Motion<Slope>::product_with_speed(v)].value;
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

}  // namespace equipoise

#include "equipoise/classification/proved_regions/level_proof_kinds.inc"
