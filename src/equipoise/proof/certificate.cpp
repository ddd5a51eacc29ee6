// Certificates: what is refused at once, the search for boxes that prove a level, and their verification.
#include "equipoise/proof/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "equipoise/math/dense.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/proof/level_proof.hpp"

namespace equipoise {

namespace {

using Box = Certificate::Box;

// Halvings of the disc in each direction after which a box that cannot be proved shows that the level cannot be.
constexpr int deepest = 11;

// A level is worth proving from this share of the sampled critical one; the search ends when it knows the largest share
// to within `finest`.
constexpr double least_share = 0.3, finest = 0.01;

// The square around the unit disc, a little larger than the slack makes it. A power of two plus another, so that all
// halvings are exact.
template <int n>
Box root() {
  Box box;
  for (int k = 0; k < n; ++k) {
    box.high[k] = 1.0 + 0x1p-10;
    box.low[k] = -box.high[k];
  }
  return box;
}

// Both halves of a box, across its longest side. Search and verification must split alike.
template <int n>
std::pair<Box, Box> halves(const Box& box) {
  int axis = 0;
  for (int k = 1; k < n; ++k)
    if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
  std::pair<Box, Box> result{box, box};
  result.first.high[axis] = result.second.low[axis] = 0.5 * (box.low[axis] + box.high[axis]);
  return result;
}

const CertificateResult not_finished{false, "stopped before it was proved"};

template <int n, bool rolls>
CertificateResult prove(Certificate& c, long budget, const StopFlag* stop) {
  const LevelProof<n, rolls> proof(c);
  if (!proof.fault().empty()) return {false, proof.fault()};
  struct Work {
    Box box;
    int depth;
  };
  std::vector<Work> waiting{{root<n>(), 0}};
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
    if (work.depth >= n * deepest)
      return {false, fmt::format("V could not be shown to decrease everywhere below level {:.6g}", c.level)};
    // Multipliers vary little from box to box: the halves begin with what was found last.
    auto [first, second] = halves<n>(work.box);
    waiting.push_back({second, work.depth + 1});
    waiting.push_back({first, work.depth + 1});
  }
  return {true, ""};
}

// Whether `boxes` [begin, end) are the leaves of halving `box` down, those outside the level set left out.
template <int n, bool rolls>
bool covered(const LevelProof<n, rolls>& proof, const Box& box, std::vector<Box>::iterator begin,
             std::vector<Box>::iterator end, int depth) {
  if (proof.outside(box)) return begin == end;
  if (begin == end) return false;
  if (end - begin == 1 && begin->low == box.low && begin->high == box.high) return true;
  if (depth >= n * deepest) return false;
  const auto [first, second] = halves<n>(box);
  const auto middle = std::partition(begin, end, [&low_half = first](const Box& b) {
    for (int k = 0; k < n; ++k)
      if (!(b.low[k] >= low_half.low[k] && b.high[k] <= low_half.high[k])) return false;
    return true;
  });
  return covered(proof, first, begin, middle, depth + 1) && covered(proof, second, middle, end, depth + 1);
}

template <int n, bool rolls>
CertificateResult check(const Certificate& c, const StopFlag* stop) {
  const LevelProof<n, rolls> proof(c);
  if (!proof.fault().empty()) return {false, proof.fault()};
  std::vector<Box> boxes = c.boxes;
  if (!covered(proof, root<n>(), boxes.begin(), boxes.end(), 0))
    return {false, "the boxes do not cover the level set, each part of it once"};
  for (const Box& box : c.boxes) {
    if (is_set(stop)) return not_finished;
    if (!proof.holds(box))
      return {false,
              fmt::format("the box at tau = ({:.4g}, {:.4g}) does not prove that V decreases", box.low[0], box.low[1])};
  }
  return {true, ""};
}

// Calls `f` with the number of balls, 1 or 2, and whether they roll, as constants.
template <class F>
CertificateResult for_kind(const model::Parameters& p, F&& f) {
  const auto of = [&](auto n) { return p.rolls ? f(n, std::true_type{}) : f(n, std::false_type{}); };
  return p.balls == 1 ? of(std::integral_constant<int, 1>{}) : of(std::integral_constant<int, 2>{});
}

std::string refusal(const model::Parameters& p, double speed) {
  if (p.balls < 1 || p.balls > 2)
    return "three balls or more have a continuum of balanced states; proofs are for isolated ones";
  if (!p.isotropic()) return "proofs need supports that are equal in x and y";
  if (p.gravity != 0.0) return "proofs need gravity 0";
  if (!std::isfinite(speed)) return "the speed must be a finite number";
  const model::BalancedStates states = model::balanced_states(p);
  if (states.kind == model::BalancedStates::Kind::none) return "no balanced state exists: " + states.reason;
  if (states.kind == model::BalancedStates::Kind::family)
    return "without unbalance there is a continuum of balanced states; proofs are for isolated ones";
  return "";
}

// What rules a proof out before any box is tried: in doubles, for a reason that helps more than a failed inequality.
std::string hopeless(const model::Parameters& p, double speed, const double* phi, const Eigen::MatrixXd& form,
                     double level) {
  const int size = model::dimension(p.balls);
  if (form.rows() != size || form.cols() != size || !form.allFinite())
    return fmt::format("the form must be a {0} x {0} matrix of finite numbers", size);
  if (!(level > 0.0) || !std::isfinite(level)) return "the level must be a finite number greater than 0";
  if (!dense::Cholesky(form).definite()) return "the form is not positive definite";
  const Eigen::MatrixXd a = model::jacobian(p, speed, model::centred_state(p, phi).data());
  const double growth = dense::largest_real_part(a);
  if (!(growth < 0.0))
    return fmt::format("the balanced state is not linearly stable at speed {} (growth rate {:.3g})", speed, growth);
  const Eigen::MatrixXd fall = -(form * a + a.transpose() * form);
  if (!dense::Cholesky(fall).definite()) return "V does not decrease along the linearised equations";
  return "";
}

// Columns in which the level set is the unit ball, ball angles last: the inverse of the form's triangular factor.
Eigen::MatrixXd frame_of(const Eigen::MatrixXd& form, double level, int balls) {
  const int size = static_cast<int>(form.rows());
  Eigen::VectorXi order(size);  // x, y, u, v, q_i, phi_i
  for (int i = 0; i < 4; ++i) order[i] = i;
  for (int i = 0; i < balls; ++i) {
    order[4 + i] = model::index::q(i, balls);
    order[4 + balls + i] = model::index::phi(i);
  }
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

CertificateResult prove_level(const model::Parameters& p, double speed, const double* phi, const Eigen::MatrixXd& form,
                              double level, Certificate& c, long budget, const StopFlag* stop) {
  c = {};
  if (std::string reason = refusal(p, speed); !reason.empty()) return {false, reason};
  if (std::string reason = hopeless(p, speed, phi, form, level); !reason.empty()) return {false, reason};
  c.parameters = p;
  c.speed = speed;
  std::copy(phi, phi + p.balls, c.phi.begin());
  c.form = 0.5 * (form + form.transpose());  // V is the same
  c.level = level;
  c.frame = frame_of(c.form, level, p.balls);
  const CertificateResult result = for_kind(p, [&](auto n, auto rolls) { return prove<n, rolls>(c, budget, stop); });
  if (!result.proved) c = {};
  return result;
}

CertificateResult check_certificate(const Certificate& c, const StopFlag* stop) {
  if (std::string reason = refusal(c.parameters, c.speed); !reason.empty()) return {false, reason};
  return for_kind(c.parameters, [&](auto n, auto rolls) { return check<n, rolls>(c, stop); });
}

Certificate largest_certificate(const model::Parameters& p, double speed, const double* phi,
                                const Eigen::MatrixXd& form, double critical, std::string* reason,
                                const StopFlag* stop) {
  Certificate best;
  std::string problem;
  double low = least_share, high = 1.0, share = 0.95;
  while (high - low > finest) {
    Certificate trial;
    const CertificateResult result = prove_level(p, speed, phi, form, share * critical, trial, default_budget, stop);
    if (is_set(stop)) {
      problem = not_finished.reason;
      break;
    }
    if (result.proved) {
      low = share;
      best = std::move(trial);
    } else {
      high = share;
      problem = result.reason;
    }
    share = 0.5 * (low + high);
  }
  if (reason) *reason = best.level > 0.0 ? "" : problem;
  return best;
}

}  // namespace equipoise
