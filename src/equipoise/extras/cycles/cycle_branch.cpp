// Branch switching at a Hopf point along the pair's eigenvector, then pseudo-arclength continuation.
#include "equipoise/extras/cycles/cycle_branch.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/bordered.hpp"
#include "equipoise/core/math/curve_follower.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double branch_tolerance = 1e-10;  // of a step of the integrations; curves are more precise
constexpr CurveFollower::Limits branch_limits{0.02, 1e-7, 0.05, 0.15, true};
constexpr double first_swing = 0.02;  // radians: small, and far above the integrations' errors
constexpr double parameter_step = 1e-6;

class BranchOfCycles {
 public:
  BranchOfCycles(const CycleSystems& systems, const VectorXd& at, const VectorXd& direction, const CycleShape& shape,
                 const model::System& first)
      : systems_(systems),
        at_(at),
        direction_(direction),
        shape_(shape),
        shooting_(first, shape_, branch_tolerance),
        follower_([this](const VectorXd& x) { return equations(x); }, [this](const VectorXd& x) { return slopes(x); },
                  branch_limits) {}

  // From a Hopf point.
  CycleBranch born_at_rest(const CycleStart& start, const model::System& first, const StopFlag* stop) {
    CycleBranch branch;
    const auto here = beginning(start, first);
    if (here) follow(*here, first_length_, place(here->point), branch, stop);
    return branch;
  }

  // From a cycle.
  CycleBranch from_cycle(const model::System& first, const StopFlag* stop) {
    constexpr double first_step = 0.005;
    CycleBranch branch;
    shooting_.stay_near(first, shape_);
    CurveFollower::Step here{VectorXd::Zero(1 + shooting_.unknowns()), {}, 0.0, {}, {}};
    here.point.tail(shooting_.unknowns()) = shooting_.packed(shape_);
    const VectorXd along = VectorXd::Unit(here.point.size(), 0);
    const auto refined = follower_.at_plane(here.point, along);
    if (!refined) return branch;
    here.point = *refined;
    const auto tangent = follower_.tangent(here.point, along);
    const auto begin = place(here.point);
    if (!tangent || !begin) return branch;
    here.tangent = *tangent;
    branch.places.push_back(*begin);
    from_cycle_ = true;
    follow(here, first_step, begin, branch, stop);
    return branch;
  }

 private:
  void follow(CurveFollower::Step here, double step, std::optional<CyclePlace> last, CycleBranch& branch,
              const StopFlag* stop) {
    while (branch.places.size() < most_of_branch && !is_set(stop)) {
      const auto next = follower_.next(here, step);
      if (!next) return;
      const auto found = place(next->point);
      if (!found) return;
      if (found->at.minCoeff() < 0.0 || found->at.maxCoeff() > 1.0) return end_on_border(here, *next, *last, branch);
      if (found->multipliers.array().abs().maxCoeff() > largest_cycle_multiplier) return;
      const auto system = systems_(found->at);
      if (found->shape.period > longest_period(*system, found->shape, shape_.period)) return;
      const bool shrinks = last && found->swing < last->swing && found->swing < first_swing;
      if (shrinks) return;
      if (!branch.places.empty() && unstable_multipliers(found->multipliers) != unstable_multipliers(last->multipliers))
        add_crossing(here, *next, *last, *found, branch);
      branch.places.push_back(*found);
      shooting_.stay_near(*system, found->shape);
      last = found;
      here = *next;
    }
  }

  void end_on_border(const CurveFollower::Step& a, const CurveFollower::Step& b, const CyclePlace& before,
                     CycleBranch& branch) {
    if (!from_cycle_) return;
    branch.left = true;
    const double from = at_[0] + direction_[0] * a.point[0], to = at_[0] + direction_[0] * b.point[0];
    const double border = to > 1.0 ? 1.0 : 0.0;
    if (from == border) return;
    const auto at = follower_.at_plane(a.point + (border - from) / (to - from) * (b.point - a.point),
                                       VectorXd::Unit(a.point.size(), 0));
    const auto found = at ? place(*at) : std::nullopt;
    if (!found) return;
    if (unstable_multipliers(found->multipliers) != unstable_multipliers(before.multipliers))
      add_crossing(a, {*at, {}, 0.0, {}, {}}, before, *found, branch);
    branch.places.push_back(*found);
  }

  VectorXd parameters(const VectorXd& x) const { return at_ + x[0] * direction_; }

  // At rest, with the tangent that leads to small cycles.
  std::optional<CurveFollower::Step> beginning(const CycleStart& start, const model::System& first) {
    const auto q = eigenvector_near(model::jacobian(first, start.state), std::complex<double>(0.0, start.frequency));
    if (!q) return std::nullopt;
    double swing = 0.0;
    for (int i = 0; i < first.balls(); ++i) swing = std::max(swing, std::abs((*q)[model::index::phi(i)]));
    if (!(swing > 0.0)) return std::nullopt;
    CycleShape small = shape_;
    for (std::size_t k = 0; k < small.nodes.size(); ++k) {
      const std::complex<double> turn =
          std::polar(first_swing / swing, two_pi * static_cast<double>(k) / static_cast<double>(small.nodes.size()));
      small.nodes[k] += (turn * *q).real();
    }
    shooting_.stay_near(first, small);
    CurveFollower::Step step{
        VectorXd::Zero(1 + shooting_.unknowns()), VectorXd::Zero(1 + shooting_.unknowns()), 0.0, {}, {}};
    step.point.tail(shooting_.unknowns()) = shooting_.packed(shape_);
    step.tangent.tail(shooting_.unknowns()) = shooting_.packed(small) - shooting_.packed(shape_);
    first_length_ = step.tangent.norm();
    step.tangent /= first_length_;
    return step;
  }

  CycleShape shape(const VectorXd& x) const { return shooting_.shape(x.tail(shooting_.unknowns())); }

  bool look_at(const VectorXd& x) {
    if (arcs_at_.size() == x.size() && arcs_at_ == x) return arcs_.has_value();
    const auto system = systems_(parameters(x));
    arcs_ = system ? shooting_.arcs(*system, shape(x)) : std::nullopt;
    arcs_at_ = x;
    return arcs_.has_value();
  }

  std::optional<VectorXd> equations(const VectorXd& x) {
    return look_at(x) ? std::optional(shooting_.equations(shape(x), *arcs_)) : std::nullopt;
  }

  std::optional<MatrixXd> slopes(const VectorXd& x) {
    if (!look_at(x)) return std::nullopt;
    const VectorXd at = parameters(x);
    const auto below = systems_(at - parameter_step * direction_), above = systems_(at + parameter_step * direction_);
    if (!below || !above) return std::nullopt;
    const auto change = shooting_.by_parameter(*below, *above, 2.0 * parameter_step, shape(x), *arcs_, nullptr);
    if (!change) return std::nullopt;
    MatrixXd m(shooting_.unknowns(), 1 + shooting_.unknowns());
    m << change->equations, shooting_.slopes(*arcs_);
    return m;
  }

  std::optional<CyclePlace> place(const VectorXd& x) {
    if (!look_at(x)) return std::nullopt;
    CyclePlace found{parameters(x), shape(x), {}, 0.0};
    const auto system = systems_(found.at);
    found.multipliers = shooting_.multipliers(*system, found.shape, *arcs_);
    found.swing = cycle_swing(*system, found.shape);
    return found;
  }

  void add_crossing(const CurveFollower::Step& a, const CurveFollower::Step& b, const CyclePlace& before,
                    const CyclePlace& after, CycleBranch& branch) {
    const VectorXd chord = b.point - a.point;
    double low = 0.0, high = 1.0;
    CyclePlace near = after;
    for (int k = 0; k < (from_cycle_ ? 24 : 10); ++k) {
      const double middle = 0.5 * (low + high);
      const auto at = follower_.at_plane(a.point + middle * chord, chord.normalized());
      const auto found = at ? place(*at) : std::nullopt;
      if (!found) return;
      const bool same = unstable_multipliers(found->multipliers) == unstable_multipliers(before.multipliers);
      (same ? low : high) = middle;
      near = *found;
    }
    Index nearest = 0;
    near.multipliers.array().abs().log().abs().minCoeff(&nearest);
    const std::complex<double> multiplier = near.multipliers[nearest];
    CycleCrossing crossing{CurveKind::cycle_torus, near, multiplier.real(), shape_.period};
    if (multiplier.imag() == 0.0) {
      crossing.change = multiplier.real() < 0.0 ? CurveKind::cycle_flip : CurveKind::cycle_fold;
      const auto along = [&](const CyclePlace& p) { return (p.at - near.at).dot(direction_); };
      if (crossing.change == CurveKind::cycle_fold && !(along(before) * along(after) > 0.0)) {
        if (!from_cycle_) return;
        crossing.change = CurveKind::pitchfork;
      }
    }
    branch.crossings.push_back(std::move(crossing));
    branch.behind.push_back(branch.places.size());
  }

  const CycleSystems& systems_;
  const VectorXd at_, direction_;
  CycleShape shape_;
  CycleShooting shooting_;
  CurveFollower follower_;
  double first_length_ = 0.0;
  bool from_cycle_ = false;  // not born at rest: symmetry breaks count, and the border is a place
  std::optional<CycleArcs> arcs_;
  VectorXd arcs_at_;
};

}  // namespace

int unstable_multipliers(const VectorXcd& multipliers) {
  return static_cast<int>((multipliers.array().abs() > 1.0).count());
}

CycleBranch cycle_branch(const CycleSystems& systems, const CycleStart& start, const StopFlag* stop) {
  const auto first = systems(start.at);
  if (!first) return {};
  const double period = two_pi / start.frequency;
  const CycleShape at_rest{period, std::vector<VectorXd>(CycleShooting::nodes_for(period), start.state)};
  return BranchOfCycles(systems, start.at, start.direction, at_rest, *first).born_at_rest(start, *first, stop);
}

CycleBranch cycle_branch(const CycleSystems& systems, const VectorXd& at, const VectorXd& direction,
                         const CycleShape& cycle, const StopFlag* stop) {
  const auto first = systems(at);
  return first ? BranchOfCycles(systems, at, direction, cycle, *first).from_cycle(*first, stop) : CycleBranch();
}

}  // namespace equipoise
