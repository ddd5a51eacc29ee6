// Equilibria by the rates of the equations, periodic motions by multiple shooting; both on one follower of curves.
#include "equipoise/extras/cycles/motion_branch.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "equipoise/analyses/continuation/parameter_line.hpp"
#include "equipoise/attractors/equilibria/equilibria.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/math/curve_follower.hpp"
#include "equipoise/extras/cycles/cycle_branch.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"

namespace equipoise {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A parameter over the unit interval; it begins at one of its ends.
class Range {
 public:
  Range(const Study& study, std::string key, double at, double to)
      : study_(study), key_(std::move(key)), low_(std::min(at, to)), high_(std::max(at, to)), rises_(to > at) {}

  double value(double u) const { return u <= 0.0 ? low_ : u >= 1.0 ? high_ : low_ + u * (high_ - low_); }
  double begin() const { return rises_ ? 0.0 : 1.0; }
  double direction() const { return rises_ ? 1.0 : -1.0; }
  // Empty for values that make no valid study. Beyond the ends as well, for derivatives.
  std::optional<model::System> system(double u) const {
    try {
      return study_with(study_, key_, low_ + u * (high_ - low_)).system();
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

 private:
  const Study& study_;
  std::string key_;
  double low_, high_;
  bool rises_;
};

class BranchMaker {
 public:
  BranchMaker(const Range& range, const StopFlag* stop) : range_(range), stop_(stop) {}

  void add_point(double u, Motion motion) {
    std::vector<BranchPoint>& points = made_.branch.points;
    points.push_back({points.size(), range_.value(u), std::move(motion)});
  }
  // Between the last point and the one to come. `more`: deviations that grow.
  void add_event(BranchCause cause, double u, bool more) {
    BranchEvent event;
    event.change = more ? BranchChange::stability_lost : BranchChange::stability_gained;
    event.cause = cause;
    event.low = event.high = range_.value(u);
    event.set_excursion(made_.branch.points.back().motion);
    made_.branch.events.push_back(event);
  }
  MotionBranch finish(const model::Parameters& p, bool left, bool whole) {
    made_.end = is_set(stop_) ? BranchEnd::stopped
                : left        ? BranchEnd::range
                : whole       ? BranchEnd::length
                              : BranchEnd::lost;
    if (made_.branch.points.empty()) return std::move(made_);
    const MotionName name = motion_name(p, made_.branch.points.front().motion);
    made_.branch.id = name.id;
    made_.branch.name = name.name;
    made_.branch.alias = name.alias;
    for (BranchEvent& event : made_.branch.events) event.id = name.id;
    return std::move(made_);
  }

 private:
  const Range& range_;
  const StopFlag* stop_;
  MotionBranch made_;
};

PeriodicOrbit orbit_of(const CyclePlace& place, const Winding& winding) {
  PeriodicOrbit orbit;
  orbit.period = place.shape.period;
  orbit.winding = winding;
  orbit.nodes = place.shape.nodes;
  orbit.multipliers.resize(place.multipliers.size() + 1);
  orbit.multipliers << 1.0, place.multipliers;
  return orbit;
}

BranchCause cause_of(CurveKind change) {
  switch (change) {
    case CurveKind::cycle_flip:
      return BranchCause::period_doubling;
    case CurveKind::cycle_torus:
      return BranchCause::neimark_sacker;
    case CurveKind::pitchfork:
      return BranchCause::pitchfork;
    default:
      return BranchCause::fold;
  }
}

MotionBranch follow_orbit(const Range& range, const PeriodicOrbit& orbit, const StopFlag* stop) {
  BranchMaker maker(range, stop);
  const model::System first = *range.system(range.begin());
  CycleShape shape{orbit.period, {}, VectorXd::Zero(first.dimension())};
  const auto angles = first.angles();
  for (std::size_t i = 0; i < angles.size(); ++i) shape.turned[angles[i].place] = angles[i].turn * orbit.winding[i];
  const int nodes = CycleShooting::nodes_for(orbit.period);
  shape.nodes = sample_orbit(first, orbit, nodes);
  const CycleBranch found =
      cycle_branch([&](const VectorXd& at) { return range.system(at[0]); }, VectorXd::Constant(1, range.begin()),
                   VectorXd::Constant(1, range.direction()), shape, stop);
  std::size_t next = 0;
  for (std::size_t k = 0; k < found.places.size() && !is_set(stop); ++k) {
    const CyclePlace& place = found.places[k];
    for (; next < found.crossings.size() && found.behind[next] <= k; ++next)
      maker.add_event(cause_of(found.crossings[next].change), found.crossings[next].near.at[0],
                      unstable_multipliers(place.multipliers) > unstable_multipliers(found.places[k - 1].multipliers));
    maker.add_point(place.at[0], describe_orbit(*range.system(place.at[0]), orbit_of(place, orbit.winding)));
  }
  return maker.finish(first.parameters(), found.left, found.places.size() >= most_of_branch);
}

// Where the rates vanish, over the parameter and the state in its own units.
class EquilibriumCurve {
 public:
  EquilibriumCurve(const Range& range, const model::System& first)
      : range_(range),
        unit_(natural * first.scale()),
        follower_([this](const VectorXd& x) { return equations(x); }, [this](const VectorXd& x) { return slopes(x); },
                  {0.02, CurveFollower::precision, 0.05, 0.15, false}) {}

  MotionBranch follow(const Equilibrium& from, const StopFlag* stop) {
    BranchMaker maker(range_, stop);
    VectorXd x(1 + unit_.size());
    x << range_.begin(), from.state.cwiseQuotient(unit_);
    std::optional<Place> last = place(x);
    const auto tangent = follower_.tangent(x, range_.direction() * VectorXd::Unit(x.size(), 0));
    if (!last) return maker.finish(range_.system(x[0])->parameters(), false, false);
    const model::Parameters p = last->system.parameters();
    maker.add_point(x[0], last->motion);
    if (!tangent) return maker.finish(p, false, false);
    CurveFollower::Step here{x, *tangent, 0.0, {}, {}};
    double step = 0.005;
    bool left = false;
    std::size_t count = 1;
    for (; count < most_of_branch && !left && !is_set(stop); ++count) {
      const auto next = follower_.next(here, step);
      if (!next) return maker.finish(p, false, false);
      VectorXd there = next->point;
      left = there[0] < 0.0 || there[0] > 1.0;
      if (left) {
        const double border = there[0] > 1.0 ? 1.0 : 0.0;
        const double share = (border - here.point[0]) / (there[0] - here.point[0]);
        const auto at = follower_.at_plane(here.point + share * (there - here.point), VectorXd::Unit(there.size(), 0));
        if (!at || !(share > 0.0)) break;
        there = *at;
      }
      const std::optional<Place> found = place(there);
      if (!found) return maker.finish(p, false, false);
      if (found->growing != last->growing) add_event(here.point, there, *last, *found, maker);
      maker.add_point(there[0], found->motion);
      last = found;
      here = *next;
    }
    return maker.finish(p, left, count >= most_of_branch);
  }

 private:
  static constexpr double natural = 10.0;  // small steps of a state are then small in the parameter

  struct Place {
    model::System system;
    Motion motion;
    Index growing = 0;  // eigenvalues to the right of the imaginary axis
  };

  std::optional<VectorXd> equations(const VectorXd& x) const {
    const auto system = range_.system(x[0]);
    if (!system) return std::nullopt;
    return model::rate(*system, state(x)).cwiseQuotient(unit_);
  }
  std::optional<MatrixXd> slopes(const VectorXd& x) const {
    constexpr double step = 1e-6;
    const auto system = range_.system(x[0]), below = range_.system(x[0] - step), above = range_.system(x[0] + step);
    if (!system || !below || !above) return std::nullopt;
    const VectorXd z = state(x);
    MatrixXd m(unit_.size(), 1 + unit_.size());
    m.col(0) = (model::rate(*above, z) - model::rate(*below, z)).cwiseQuotient(unit_) / (2.0 * step);
    m.rightCols(unit_.size()) = unit_.cwiseInverse().asDiagonal() * model::jacobian(*system, z) * unit_.asDiagonal();
    return m;
  }
  VectorXd state(const VectorXd& x) const { return x.tail(unit_.size()).cwiseProduct(unit_); }

  std::optional<Place> place(const VectorXd& x) const {
    const auto system = range_.system(std::clamp(x[0], 0.0, 1.0));
    const auto found = system ? refine_equilibrium(*system, state(x)) : std::nullopt;
    if (!found) return std::nullopt;
    return Place{*system, describe_equilibrium(*system, *found), (found->eigenvalues.array().real() > 0.0).count()};
  }

  void add_event(const VectorXd& a, const VectorXd& b, const Place& before, const Place& after, BranchMaker& maker) {
    const VectorXd chord = b - a;
    double low = 0.0, high = 1.0;
    VectorXd at = b;
    Eigen::VectorXcd eigenvalues = after.motion.spectrum;
    for (int k = 0; k < 20; ++k) {
      const double middle = 0.5 * (low + high);
      const auto point = follower_.at_plane(a + middle * chord, chord.normalized());
      const auto found = point ? place(*point) : std::nullopt;
      if (!found) break;
      (found->growing == before.growing ? low : high) = middle;
      at = *point;
      eigenvalues = found->motion.spectrum;
    }
    Index nearest = 0;
    eigenvalues.array().real().abs().minCoeff(&nearest);
    const bool turns = (at[0] - a[0]) * (b[0] - at[0]) < 0.0;
    maker.add_event(eigenvalues[nearest].imag() != 0.0 ? BranchCause::hopf
                    : turns                            ? BranchCause::fold
                                                       : BranchCause::pitchfork,
                    at[0], after.growing > before.growing);
  }

  const Range& range_;
  const VectorXd unit_;
  CurveFollower follower_;
};

void check_followable(const Study& study, const std::string& key) {
  const model::System system = study.system();
  const auto refuse = [&](const char* why) {
    throw InputError(study.name, key, "", fmt::format("cannot be varied to follow one motion: {}", why));
  };
  check_has_balls(study);
  if (!system.smooth()) refuse("balls touch or stick; the rotor must be smooth");
  if (!system.autonomous() || system.layout().psi >= 0)
    refuse("the rotor's angle matters, through gravity or supports");
}

}  // namespace

const char* name_of(BranchEnd end) {
  return end == BranchEnd::range    ? "the range ends"
         : end == BranchEnd::length ? "enough points"
         : end == BranchEnd::lost   ? "no further point was found"
                                    : "stopped";
}

MotionBranch follow_motion(const Study& study, const std::string& key, double at, double to,
                           const Eigen::VectorXd& state, const RunOptions& options) {
  if (!(std::isfinite(at) && std::isfinite(to) && at != to))
    throw InputError(study.name, key, fmt::format("{} to {}", at, to), "must be a range between two finite numbers");
  const Study begin = study_with(study, key, at);
  study_with(study, key, to);
  check_followable(begin, key);
  const model::System system = begin.system();
  if (state.size() != system.dimension())
    throw InputError(study.name, "state", fmt::format("{} numbers", state.size()),
                     fmt::format("must be {}, a state of this rotor", system.dimension()));
  return long_call(options, [&](const RunOptions& o) {
    const Range range(study, key, at, to);
    const std::optional<Motion> motion = motion_from(system, state, motion_patience, o.stop);
    if (is_set(o.stop)) return MotionBranch{{}, BranchEnd::stopped};
    const auto refuse = [&](const std::string& what) {
      throw InputError(study.name, "state", "", what + "; must lie on an equilibrium or a periodic motion");
    };
    if (!motion) refuse("leads to no steady motion");
    if (motion->kind == MotionKind::periodic) return follow_orbit(range, motion->orbit, o.stop);
    if (motion->kind != MotionKind::equilibrium) refuse(fmt::format("leads to a {} motion", name_of(motion->kind)));
    const auto equilibrium = refine_equilibrium(system, motion->state);
    if (!equilibrium || model::balanced_freedom(system) > 0 || free_angles(system, motion->state) > 0)
      refuse("leads to one of a continuum of equilibria");
    return EquilibriumCurve(range, system).follow(*equilibrium, o.stop);
  });
}

}  // namespace equipoise
