// Certificates: what is refused at once, the search for boxes that prove a level, and their verification.
#include "equipoise/classification/proved_regions/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "equipoise/classification/proved_regions/level_proof.hpp"
#include "equipoise/classification/proved_regions/level_frame.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/capability.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

namespace {

using Box = Certificate::Box;

// Halvings in each direction after which an unproved box means that the level cannot be proved.
constexpr int deepest = 11;

// Shares of the sampled critical level: the least worth proving, and the resolution of the search.
constexpr double least_share = 0.3, finest = 0.01;
// Of a tilting rotor one box around the whole set is tried, which proves small ones: shares are halved, down to this
// one, then the last is refined. Rounding in the balanced state bars smaller ones.
constexpr double least_of_one_box = 1e-5, finest_ratio = 1.05;

// The square around the unit disc with room for the slack; its bounds make all halvings exact.
template <ProofKind kind>
Box root() {
  Box box;
  for (int k = 0; k < kind.balls; ++k) {
    box.high[k] = 1.0 + 0x1p-10;
    box.low[k] = -box.high[k];
  }
  return box;
}

// Search and verification must split boxes alike: across the longest side.
template <ProofKind kind>
std::pair<Box, Box> halves(const Box& box) {
  int axis = 0;
  for (int k = 1; k < kind.balls; ++k)
    if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
  std::pair<Box, Box> result{box, box};
  result.first.high[axis] = result.second.low[axis] = 0.5 * (box.low[axis] + box.high[axis]);
  return result;
}

const CertificateResult not_finished{false, stopped_before_proof};

template <ProofKind kind>
CertificateResult prove(Certificate& c, long budget, const StopFlag* stop) {
  const LevelProof<kind> proof(c);
  if (!proof.fault().empty()) return {false, proof.fault()};
  struct Work {
    Box box;
    int depth;
  };
  std::vector<Work> waiting{{root<kind>(), 0}};
  while (!waiting.empty()) {
    Work work = waiting.back();
    waiting.pop_back();
    if (proof.outside(work.box)) continue;
    if (is_set(stop)) return not_finished;
    if (budget-- <= 0) return {false, fmt::format("the boxes allowed do not suffice to prove level {:.6g}", c.level)};
    if (proof.find(work.box)) {
      c.boxes.push_back(work.box);
      continue;
    }
    if (work.depth >= kind.balls * deepest)
      return {false, fmt::format("V could not be shown to decrease everywhere below level {:.6g}", c.level)};
    // Multipliers vary little from box to box: the halves begin with what was found last.
    auto [first, second] = halves<kind>(work.box);
    waiting.push_back({second, work.depth + 1});
    waiting.push_back({first, work.depth + 1});
  }
  return {true, ""};
}

// Whether `boxes` [begin, end) are the leaves of halving `box` down, those outside the level set left out.
template <ProofKind kind>
bool covered(const LevelProof<kind>& proof, const Box& box, std::vector<Box>::iterator begin,
             std::vector<Box>::iterator end, int depth, const StopFlag* stop) {
  if (is_set(stop)) return false;
  if (proof.outside(box)) return begin == end;
  if (begin == end) return false;
  if (end - begin == 1 && begin->low == box.low && begin->high == box.high) return true;
  if (depth >= kind.balls * deepest) return false;
  const auto [first, second] = halves<kind>(box);
  const auto middle = std::partition(begin, end, [&low_half = first](const Box& b) {
    for (int k = 0; k < kind.balls; ++k)
      if (!(b.low[k] >= low_half.low[k] && b.high[k] <= low_half.high[k])) return false;
    return true;
  });
  return covered(proof, first, begin, middle, depth + 1, stop) && covered(proof, second, middle, end, depth + 1, stop);
}

template <ProofKind kind>
CertificateResult check(const Certificate& c, const StopFlag* stop) {
  const LevelProof<kind> proof(c);
  if (!proof.fault().empty()) return {false, proof.fault()};
  std::vector<Box> boxes = c.boxes;
  if (!covered(proof, root<kind>(), boxes.begin(), boxes.end(), 0, stop))
    return is_set(stop) ? not_finished
                        : CertificateResult{false, "the boxes do not cover the level set, each part of it once"};
  for (const Box& box : c.boxes) {
    if (is_set(stop)) return not_finished;
    if (!proof.holds(box))
      return {false,
              fmt::format("the box at tau = ({:.4g}, {:.4g}) does not prove that V decreases", box.low[0], box.low[1])};
  }
  return {true, ""};
}

std::string refusal(const model::System& system) {
  const model::Parameters& p = system.parameters();
  if (!p.tilts() && (p.balls < 1 || p.balls > 2))
    return "three balls or more have a continuum of balanced states; proofs are for isolated ones";
  if (!std::isfinite(system.speed())) return speed_is_finite;
  if (const auto lack = model::lacking(system, model::ResultKind::proofs)) return lack->reason;
  const model::BalancedStates states = model::balanced_states(system);
  if (states.kind == model::BalancedStates::Kind::none)
    return fmt::format("no balanced state exists: {}", states.reason);
  if (p.tilts()) return tilt_refusal(system);
  if (states.kind == model::BalancedStates::Kind::continuum)
    return "without unbalance there is a continuum of balanced states; proofs are for isolated ones";
  return "";
}

// Checks in doubles before any box is tried: their reasons help more than a failed inequality.
std::string hopeless(const model::System& system, double speed, const double* phi, const Eigen::MatrixXd& form,
                     double level) {
  const int size = system.dimension();
  if (form.rows() != size || form.cols() != size || !form.allFinite())
    return fmt::format("the form must be a {0} x {0} matrix of finite numbers", size);
  if (!(level > 0.0) || !std::isfinite(level)) return "the level must be a finite number greater than 0";
  if (!dense::Cholesky(form).definite()) return "the form is not positive definite";
  const Eigen::MatrixXd a = model::jacobian(system, model::balanced_state(system, speed, phi));
  const double growth = dense::largest_real_part(a);
  if (!(growth < 0.0))
    return fmt::format("the balanced state is not linearly stable at speed {} (growth rate {:.3g})", speed, growth);
  const Eigen::MatrixXd fall = -(form * a + a.transpose() * form);
  if (!dense::Cholesky(fall).definite()) return "V does not decrease along the linearised equations";
  return "";
}

// Columns in which the level set is the unit ball, ball angles last: the inverse of the form's triangular factor.
Eigen::MatrixXd frame_of(const model::System& system, const Eigen::MatrixXd& form, double level) {
  const int size = system.dimension(), balls = system.balls();
  std::vector<int> order;  // x, y, u, v, q_i, a driven rotor's speed and the integral of its error; phi_i
  for (int i = 0; i < 4; ++i) order.push_back(i);
  for (int i = model::index::q(0, balls); i < size; ++i) order.push_back(i);
  for (int i = 0; i < balls; ++i) order.push_back(model::index::phi(i));
  Eigen::MatrixXd sorted(size, size), frame = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) sorted(i, j) = form(order[i], order[j]);
  const Eigen::MatrixXd inverse =
      dense::Cholesky(sorted).solve_upper(Eigen::MatrixXd(std::sqrt(level) * Eigen::MatrixXd::Identity(size, size)));
  for (int i = 0; i < size; ++i)
    for (int j = i; j < size; ++j) frame(order[i], j) = inverse(i, j);
  return frame;
}

}  // namespace

model::System Certificate::system() const {
  if (!motor) return {parameters, speed};
  return {parameters, model::DrivePiece{.prescribed = false, .motor = *motor}};
}

CertificateResult prove_level(const model::System& system, const double* phi, const Eigen::MatrixXd& form, double level,
                              Certificate& c, long budget, const StopFlag* stop) {
  c = {};
  if (std::string reason = refusal(system); !reason.empty()) return {false, reason};
  const double speed = *model::balanced_speed(system);
  if (std::string reason = hopeless(system, speed, phi, form, level); !reason.empty()) return {false, reason};
  c.parameters = system.parameters();
  c.speed = speed;
  if (!system.prescribed()) c.motor = system.drive().motor;
  std::copy(phi, phi + system.balls(), c.phi.begin());
  c.form = 0.5 * (form + form.transpose());  // V is the same
  c.level = level;
  c.frame = frame_of(system, c.form, level);
  CertificateResult result =
      system.tilts() ? check_tilt(c, spare_in_search)
                     : with_proof_kind(system, [&](auto kind) { return prove<kind.value>(c, budget, stop); });
  if (!result.proved) c = {};
  return result;
}

CertificateResult check_certificate(const Certificate& c, const StopFlag* stop) {
  const model::System system = c.system();
  if (std::string reason = refusal(system); !reason.empty()) return {false, reason};
  if (system.tilts()) return check_tilt(c, 0.0);
  return with_proof_kind(system, [&](auto kind) { return check<kind.value>(c, stop); });
}

namespace {

// The level at which the motor reaches its limit somewhere; infinite if it has none.
double level_at_limit(const model::System& system, const double* phi, const Eigen::MatrixXd& form) {
  if (system.prescribed() || !std::isfinite(system.drive().motor.limit)) return std::numeric_limits<double>::infinity();
  const model::DriveSegment& m = system.drive().motor;
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(system.dimension());
  slope[system.layout().speed] = m.slope;
  if (system.layout().error >= 0) slope[system.layout().error] = m.integral;
  const double speed = *model::balanced_speed(system);
  const double room = m.limit - std::fabs(system.torque(model::balanced_state(system, speed, phi)));
  return room * room / slope.dot(dense::inverse(form) * slope);
}

}  // namespace

Certificate largest_certificate(const model::System& system, const double* phi, const Eigen::MatrixXd& form,
                                double critical, std::string* reason, const StopFlag* stop) {
  Certificate best;
  std::string first, last;
  const auto proves = [&](double share) {
    Certificate trial;
    const CertificateResult result = prove_level(system, phi, form, share * critical, trial, default_budget, stop);
    if (result.proved) best = std::move(trial);
    if (!result.proved) last = result.reason;
    if (first.empty()) first = last;
    return result.proved;
  };
  if (system.tilts()) {
    double low = 0.5;
    while (low >= least_of_one_box && !proves(low)) low *= 0.5;
    for (double high = 2.0 * low; best.level > 0.0 && high > finest_ratio * low;) {
      const double share = std::sqrt(low * high);
      (proves(share) ? low : high) = share;
    }
    last = first;  // of the largest set
  } else if (last = refusal(system); last.empty()) {
    if (form.rows() == system.dimension()) critical = std::min(critical, level_at_limit(system, phi, form));
    for (double low = least_share, high = 1.0, share = 0.95; high - low > finest; share = 0.5 * (low + high)) {
      (proves(share) ? low : high) = share;
      if (!is_set(stop)) continue;
      last = not_finished.reason;
      break;
    }
  }
  if (reason) *reason = best.level > 0.0 ? "" : last;
  return best;
}

}  // namespace equipoise
