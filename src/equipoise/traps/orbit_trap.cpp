// Tables of states and quadratic forms over the clock's angle.
#include "equipoise/traps/orbit_trap.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "equipoise/base/angles.hpp"
#include "equipoise/deciding/traps-inl.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/model/ball_count.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;

constexpr int cells_a_turn = 128;  // a chord misses its arc by (2 pi / 128)^2 / 8 = 3e-4 of the curvature
constexpr int most_turns = 16, most_copies = 24;
constexpr int samples_a_turn = 4 * cells_a_turn;  // times at which the orbit and its Floquet vectors are computed

// The orbit at one clock angle: state (angles unwrapped) and quadratic form, both without the clock's angle.
struct Row {
  Eigen::VectorXd place;
  Eigen::MatrixXd form;
};

Eigen::VectorXd without(const Eigen::VectorXd& v, int index) {
  Eigen::VectorXd result(v.size() - 1);
  for (Eigen::Index i = 0, k = 0; i < v.size(); ++i)
    if (i != index) result[k++] = v[i];
  return result;
}

Eigen::MatrixXd without(const Eigen::MatrixXd& m, int index) {
  Eigen::MatrixXd result(m.rows() - 1, m.cols() - 1);
  for (Eigen::Index i = 0, k = 0; i < m.rows(); ++i) {
    if (i == index) continue;
    for (Eigen::Index j = 0, l = 0; j < m.cols(); ++j)
      if (j != index) result(k, l++) = m(i, j);
    ++k;
  }
  return result;
}

// The orbit sampled in time, with its forms P = sum_k Re(conj(w_k) w_k^T).
struct Samples {
  std::vector<Eigen::VectorXd> states;
  std::vector<Eigen::MatrixXd> forms;
  Eigen::VectorXd shift;  // from one period to the next: 2 pi times the winding
};

std::optional<Samples> sample(const model::Parameters& p, double speed, const Motion& motion, int turns) {
  const auto frame = floquet_frame({p, speed}, motion.orbit, samples_a_turn * turns);
  if (!frame) return std::nullopt;
  Samples samples;
  samples.states = frame->states;
  for (const Eigen::MatrixXcd& left : frame->left)
    samples.forms.push_back((left.conjugate() * left.transpose()).real());
  samples.shift = Eigen::VectorXd::Zero(model::dimension(p.balls));
  for (int i = 0; i < p.balls; ++i) samples.shift[model::index::phi(i)] = two_pi * motion.winding[i];
  return samples;
}

// The ball whose angle tells the phase: it turns, always the same way, and fewest times a period; -1 if there is none.
int clock_of(const model::Parameters& p, const Motion& motion) {
  int clock = -1;
  for (int i = 0; i < p.balls; ++i) {
    if (motion.winding[i] == 0 || motion.rate_min[i] * motion.rate_max[i] <= 0.0) continue;
    if (clock < 0 || std::abs(motion.winding[i]) < std::abs(motion.winding[clock])) clock = i;
  }
  return clock;
}

// Rows at the clock angles 2 pi k / cells_a_turn, k = 0 .. turns * cells_a_turn, by linear interpolation in angle.
std::vector<Row> rows_over_angle(const Samples& samples, int clock_index, int turns) {
  const bool rising = samples.shift[clock_index] > 0.0;
  const int count = static_cast<int>(samples.states.size());
  // Sample j of the doubly infinite orbit, j counted so that the clock's angle grows.
  const auto state = [&](int j) -> Eigen::VectorXd {
    const int forward = rising ? j : -j;
    const int lap = static_cast<int>(std::floor(static_cast<double>(forward) / count));
    return samples.states[forward - lap * count] + lap * samples.shift;
  };
  const auto form = [&](int j) -> const Eigen::MatrixXd& {
    const int forward = rising ? j : -j;
    return samples.forms[((forward % count) + count) % count];
  };
  std::vector<Row> rows;
  const double first = state(0)[clock_index];
  // The whole turn nearest below the first sample's angle; rows start there.
  const double origin = two_pi * std::floor(first / two_pi);
  int j = 0;
  while (state(j)[clock_index] > origin) --j;
  for (int k = 0; k <= turns * cells_a_turn; ++k) {
    const double angle = origin + two_pi * k / cells_a_turn;
    while (state(j + 1)[clock_index] <= angle) ++j;
    const Eigen::VectorXd a = state(j), b = state(j + 1);
    const double f = (angle - a[clock_index]) / (b[clock_index] - a[clock_index]);
    rows.push_back({without(Eigen::VectorXd(a + f * (b - a)), clock_index),
                    without(Eigen::MatrixXd((1.0 - f) * form(j) + f * form(j + 1)), clock_index)});
  }
  return rows;
}

std::optional<OrbitTrap> make_trap(int balls, const std::vector<Row>& rows, int clock, int turns, int attractor) {
  const int others = model::dimension(balls) - 1;
  OrbitTrap trap;
  trap.attractor = attractor;
  trap.clock = clock;
  trap.turns = turns;
  trap.cells = cells_a_turn;
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    const Row &a = rows[k], &b = rows[k + 1];
    const dense::Cholesky cholesky(0.5 * (a.form + b.form));
    if (!cholesky.definite()) return std::nullopt;
    const Eigen::MatrixXd factor = cholesky.upper();
    for (int i = 0; i < others; ++i) trap.table.push_back(a.place[i]);
    for (int i = 0; i < others; ++i) trap.table.push_back(b.place[i] - a.place[i]);
    for (int i = 0; i < others; ++i)
      for (int l = i; l < others; ++l) trap.table.push_back(factor(i, l));
  }
  set_level(trap, balls, 1.0);
  return trap;
}

Samples reordered(const Samples& samples, int balls, const std::vector<int>& order) {
  Eigen::VectorXi index(model::dimension(balls));
  index.head(4) << 0, 1, 2, 3;
  for (int i = 0; i < balls; ++i) {
    index[model::index::phi(i)] = model::index::phi(order[i]);
    index[model::index::q(i, balls)] = model::index::q(order[i], balls);
  }
  Samples result = samples;
  for (Eigen::VectorXd& z : result.states) z = z(index).eval();
  for (Eigen::MatrixXd& f : result.forms) f = f(index, index).eval();
  result.shift = samples.shift(index);
  return result;
}

// Least distance of a state from sampled ones, ball angles modulo 2 pi.
double distance(const Eigen::VectorXd& z, const std::vector<Eigen::VectorXd>& states, int balls) {
  double least = 1e300;
  for (const Eigen::VectorXd& s : states) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < z.size(); ++i) {
      const bool angle = i >= 4 && i < 4 + balls;
      sum += std::pow(angle ? wrapped(z[i] - s[i]) : z[i] - s[i], 2);
    }
    least = std::min(least, sum);
  }
  return std::sqrt(least);
}

}  // namespace

std::vector<OrbitTrap> orbit_traps(const model::Parameters& p, double speed, const Motion& motion, int attractor) {
  if (motion.kind != MotionKind::periodic || !motion.stable || motion.copies > most_copies) return {};
  const int clock = clock_of(p, motion);
  if (clock < 0) return {};
  const int turns = std::abs(motion.winding[clock]);
  if (turns > most_turns) return {};
  const auto samples = sample(p, speed, motion, turns);
  if (!samples) return {};

  std::vector<OrbitTrap> traps;
  std::vector<Samples> images;
  std::vector<int> order(p.balls);
  std::iota(order.begin(), order.end(), 0);
  do {
    Samples image = reordered(*samples, p.balls, order);
    // Neighbouring samples are this far apart, so an image that lies on an earlier one comes closer than that.
    const double spacing = (samples->states[1] - samples->states[0]).norm();
    const bool known = std::any_of(images.begin(), images.end(), [&](const Samples& earlier) {
      return distance(image.states[0], earlier.states, p.balls) < 2.0 * spacing;
    });
    if (!known) {
      const int place = static_cast<int>(std::find(order.begin(), order.end(), clock) - order.begin());
      const auto trap =
          make_trap(p.balls, rows_over_angle(image, model::index::phi(place), turns), place, turns, attractor);
      if (!trap) return {};
      traps.push_back(*trap);
      images.push_back(std::move(image));
    }
  } while (static_cast<int>(traps.size()) < motion.copies && std::next_permutation(order.begin(), order.end()));
  return traps;
}

void set_level(OrbitTrap& trap, int balls, double level) {
  const int others = model::dimension(balls) - 1, columns = orbit_trap_columns(others + 1);
  trap.level = level;
  trap.q_low.fill(1e300);
  trap.q_high.fill(-1e300);
  double r_low = 1e300, r_high = 0.0;
  for (std::size_t at = 0; at < trap.table.size(); at += columns) {
    const double *place = &trap.table[at], *change = place + others, *packed = change + others;
    Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(others, others);
    for (int i = 0, entry = 0; i < others; ++i)
      for (int l = i; l < others; ++l) factor(i, l) = packed[entry++];
    const Eigen::MatrixXd inverse = dense::inverse(factor);
    // The quadratic form's reach in each variable, and one in the plane of the rotor's centre that covers every way.
    const Eigen::VectorXd reach = (level * (inverse * inverse.transpose()).diagonal()).cwiseSqrt();
    const double around = std::hypot(reach[0], reach[1]);
    for (double f : {0.0, 1.0}) {
      const double r = std::hypot(place[0] + f * change[0], place[1] + f * change[1]);
      r_low = std::min(r_low, r - around - std::hypot(change[0], change[1]));
      r_high = std::max(r_high, r + around);
      for (int i = 0; i < balls; ++i) {
        const int k = 4 + balls - 1 + i;
        trap.q_low[i] = std::min(trap.q_low[i], place[k] + f * change[k] - reach[k]);
        trap.q_high[i] = std::max(trap.q_high[i], place[k] + f * change[k] + reach[k]);
      }
    }
  }
  trap.r2_low = r_low > 0.0 ? r_low * r_low : -1.0;
  trap.r2_high = r_high * r_high;
}

double trap_value(const OrbitTrap& trap, int balls, const double* state) {
  return kernels::trap_value(trap, model::BallCount<model::any_count>(balls), state);
}

double trap_value(const BalancedTrap& trap, int balls, const double* state) {
  return kernels::trap_value(trap, model::BallCount<model::any_count>(balls), state);
}

void trap_state(const OrbitTrap& trap, int balls, int row, const double* direction, double* state) {
  const int dimension = model::dimension(balls), others = dimension - 1;
  const double* place = trap.table.data() + static_cast<std::ptrdiff_t>(row) * orbit_trap_columns(dimension);
  const double* packed = place + 2 * others;
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(others, others);
  for (int i = 0, entry = 0; i < others; ++i)
    for (int l = i; l < others; ++l) factor(i, l) = packed[entry++];
  const Eigen::VectorXd d =
      factor.triangularView<Eigen::Upper>().solve(Eigen::Map<const Eigen::VectorXd>(direction, others));
  for (int i = 0, k = 0; i < dimension; ++i)
    if (i != 4 + trap.clock) {
      state[i] = place[k] + d[k];
      ++k;
    }
  state[4 + trap.clock] = two_pi * (row % trap.cells) / trap.cells;
}

}  // namespace equipoise
