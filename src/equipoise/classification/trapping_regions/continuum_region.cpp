// States on level sets around members of a continuum. The estimate finds the nearest member, up to an exchange of
// balls, and uses its form.
#include "equipoise/classification/trapping_regions/continuum_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "equipoise/classification/trapping_regions/region_rule.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/balance/room_in_race.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/simulation/batch/own_rotor.hpp"

namespace equipoise {

namespace {

// Over about a radian matrices change by as much as themselves.
constexpr double beside = 0.6;

// Balls that move by angles d_i change the unbalance by no more than sum mu_i |d_i| <= |mu| |d|. 0 with an off-centre
// race, whose unbalance in balance is not 0.
double angle_of_unbalance(const model::Parameters& p) {
  if (!p.race_is_centred()) return 0.0;
  return 1.0 / std::sqrt(std::inner_product(p.mass.begin(), p.mass.begin() + p.balls, p.mass.begin(), 0.0));
}

// A state of a continuum's trapping region falls to this share of its V, where linear theory holds.
constexpr double come_near = 0.03;
// A state next to the slowest member that is tried may end in one a little slower.
constexpr double slower = 0.5;

// Slower members are not tried: each trial would take as long as its member is slow.
double slowest_caught(const ContinuumPart& part) {
  constexpr double share = 0.1, of_all = 2e-4;
  return std::min(-of_all, share * part.fastest_rate);
}

// Of the level of members that were tried, for slower ones. Both scale with the rate (ContinuumMember::unit), which has
// been tried down to a tenth of the fastest. There, terms of second order are a tenth of what they are on that level.
constexpr double slow_share = 0.01;

// V is |s|^2 or more of a deviation s from the state's member, and a hundredth of it may be left along the continuum
// (ContinuumOfEquilibria). Members that were not tried may have half as large a unit again.
double farthest_inside(double reach) {
  constexpr double spare = 1.25, unknown = 1e-6;
  return spare * reach + unknown;
}

// Members of a continuum to try levels around, and how far gravity moves them from each other and from rest.
struct Members {
  std::vector<ContinuumMember> all;
  Eigen::Vector4d place = Eigen::Vector4d::Zero();  // mean of the rotor's
  double unit = 0.0, slowest_rate = 0.0, fastest_rate = 0.0, unrest = 0.0;
  bool everywhere = false;  // all members drawn attract, at no less than a tenth of the fastest rate
};

Members members_to_try(const ContinuumOfEquilibria& continuum, const ContinuumSample& sample,
                       const TrialSettings& settings) {
  constexpr std::size_t most = 64;
  Members result;
  result.slowest_rate = slowest_caught(sample);
  const auto first = static_cast<std::size_t>(
      std::find_if(sample.rates.begin(), sample.rates.end(), [&](double r) { return r <= result.slowest_rate; }) -
      sample.rates.begin());
  result.everywhere = sample.drawn > 0 && sample.stable == sample.drawn && sample.slowest_rate <= result.slowest_rate;
  const std::size_t count = sample.members.size() - first, taken = std::min(most, count);
  const int balls = settings.system->balls();
  for (std::size_t k = 0; k < taken && !is_set(settings.stop); ++k) {
    auto m = continuum.member(sample.members[first + k * count / taken].data());
    if (!m || m->form.size() == 0 || !(m->rate <= result.slowest_rate)) continue;
    result.unit = std::max(result.unit, m->unit);
    result.fastest_rate = std::min(result.fastest_rate, m->rate);
    result.place += m->centre.head(4);
    result.all.push_back(*std::move(m));
  }
  if (result.all.empty()) return result;
  result.place /= static_cast<double>(result.all.size());
  for (const ContinuumMember& m : result.all) {
    result.unrest = std::max(result.unrest, (m.centre.head(4) - result.place).lpNorm<Eigen::Infinity>());
    for (int i = 0; i < balls; ++i)
      result.unrest = std::max(result.unrest, std::fabs(m.centre[model::index::q(i, balls)]));
  }
  return result;
}

double reach_of(const Members& members, double factor) {
  return 1.5 * members.unrest + std::sqrt(std::min(factor * members.unit, 0.5));
}

// The region with this factor.
ContinuumRegion at_factor(ContinuumRegion region, const Members& members, double factor) {
  region.factor = factor;
  region.reach = reach_of(members, factor);
  if (!region.estimate) return region;
  constexpr double safety = 2.0;
  const ContinuumEstimate::Errors errors = region.estimate->errors(*region.continuum, factor);
  if (!(errors.shortfall > 0.0)) {
    region.estimate.reset();
    return region;
  }
  // A state this deep is inside whichever member it comes to, and then creeps to nothing else.
  if (members.everywhere) region.deep = 1.0 / (safety * errors.shortfall);
  // A state taken for outside by mistake is only caught a little later. If the estimate by then falls below `deep`, V
  // need never be computed.
  region.far = safety * errors.floor < region.deep ? region.deep : std::max(errors.excess, safety * errors.floor);
  return region;
}

// In this direction or the opposite one, at the highest V up to `value` where balls in contact do not overlap.
Eigen::VectorXd state_with_room(const ContinuumRegion& region, const ContinuumMember& m, double value,
                                const Eigen::VectorXd& direction, const model::System& system) {
  constexpr int most = 64;
  const bool collide = system.parameters().balls_collide();
  for (int k = 0; k < most; ++k, value *= 0.5)
    for (const double sign : {1.0, -1.0}) {
      Eigen::VectorXd z = region.continuum->state_at(m, value, sign * direction);
      if (!collide || model::least_gap(system.parameters(), &z[model::index::phi(0)]) > 0.0) return z;
    }
  return m.centre;
}

// From a member to its neighbour in the continuum of another rotor.
Eigen::VectorXd moved_to(const model::System& other, const model::System& system, const ContinuumMember& m) {
  std::array<double, model::max_balls> phi = m.phi;
  const double speed = model::balanced_speed(system).value_or(0.0),
               other_speed = model::balanced_speed(other).value_or(speed);
  if (!model::project_to_balanced(other, other_speed, phi.data())) return Eigen::VectorXd::Zero(system.dimension());
  return model::balanced_state(other, other_speed, phi.data()) - model::balanced_state(system, speed, m.phi.data());
}

}  // namespace

ContinuumEstimate::ContinuumEstimate(const model::System& system, std::vector<ContinuumMember> members)
    : system_(system),
      interchangeable_(system.parameters().equal_balls()),
      speed_(model::balanced_speed(system).value_or(0.0)),
      scale_(system.scale()),
      members_(std::move(members)) {
  for (const ContinuumMember& m : members_) {
    moved_.push_back(m.centre - model::balanced_state(system_, speed_, m.phi.data()));
    rings_.push_back(ring(m.phi.data()));
  }
}

ContinuumEstimate::Ring ContinuumEstimate::ring(const double* angles) const {
  const int n = system_.balls();
  Ring result;
  std::iota(result.ball.begin(), result.ball.begin() + n, 0);
  const auto angle = [&](int i) { return wrapped_positive(angles[i]); };
  if (interchangeable_)
    std::sort(result.ball.begin(), result.ball.begin() + n, [&](int a, int b) { return angle(a) < angle(b); });
  for (int i = 0; i < n; ++i) result.angle[i] = angle(result.ball[i]);
  return result;
}

// Alike balls on a ring are all nearest to others in the same order, up to where it begins.
ContinuumEstimate::Nearest ContinuumEstimate::nearest(std::size_t left_out, const double* balanced,
                                                      const Eigen::VectorXd& offset) const {
  const int n = system_.balls();
  const Ring mine = ring(balanced);
  Nearest result{0, std::numeric_limits<double>::infinity(), offset};
  int begin = 0;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (k == left_out) continue;
    for (int turn = 0; turn < (interchangeable_ ? n : 1); ++turn) {
      double distance = 0.0;
      for (int i = 0; i < n; ++i) {
        const double apart = std::fabs(mine.angle[(i + turn) % n] - rings_[k].angle[i]);
        distance = std::max(distance, std::min(apart, two_pi - apart));
      }
      if (distance >= result.distance) continue;
      result.member = k;
      result.distance = distance;
      begin = turn;
    }
  }
  if (!std::isfinite(result.distance)) return result;
  for (int i = 0; i < n; ++i) {
    const int to = rings_[result.member].ball[i], from = mine.ball[(i + begin) % n];
    result.offset[model::index::phi(to)] = offset[model::index::phi(from)];
    result.offset[model::index::q(to, n)] = offset[model::index::q(from, n)];
  }
  return result;
}

std::optional<double> ContinuumEstimate::depth_without(std::size_t left_out, const Eigen::VectorXd& state,
                                                       double factor) const {
  const int n = system_.balls();
  std::array<double, model::max_balls> balanced{};
  for (int i = 0; i < n; ++i) balanced[i] = state[model::index::phi(i)];
  if (!model::project_to_balanced(system_, speed_, balanced.data())) return std::nullopt;
  const Nearest near =
      nearest(left_out, balanced.data(), state - model::balanced_state(system_, speed_, balanced.data()));
  if (!(near.distance < beside)) return std::nullopt;
  const ContinuumMember& m = members_[near.member];
  Eigen::VectorXd d = near.offset - moved_[near.member];
  for (int i = 0; i < n; ++i) d[model::index::phi(i)] = wrapped(d[model::index::phi(i)]);
  d = d.cwiseQuotient(scale_);
  const Eigen::VectorXd s = m.range.transpose() * (d - m.along * (m.left * d));
  return s.dot(m.form * s) / ContinuumOfEquilibria::level(m, factor);
}

ContinuumEstimate::Errors ContinuumEstimate::errors(const ContinuumOfEquilibria& continuum, double factor) const {
  constexpr int directions = 16;
  Errors result;
  Directions draw(continuum.directions());
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const double level = ContinuumOfEquilibria::level(members_[k], factor);
    for (int i = 0; i < directions; ++i)
      if (const auto depth = depth_without(k, continuum.state_at(members_[k], level, draw.next()), factor)) {
        result.shortfall = std::max(result.shortfall, 1.0 / *depth);
        result.excess = std::max(result.excess, *depth);
      }
    result.floor = std::max(result.floor, depth_without(k, members_[k].centre, factor).value_or(0.0));
  }
  return result;
}

OffContinuum::OffContinuum(const model::System& system)
    : system_(system),
      rests_(model::balanced_freedom(system) > 0),
      speed_(model::balanced_speed(system).value_or(0.0)),
      angle_of_unbalance_(angle_of_unbalance(system.parameters())),
      scale_(system.scale()) {}

double OffContinuum::least(const Eigen::VectorXd& state) const {
  if (!rests_) return 0.0;
  const double* angles = &state[model::index::phi(0)];
  const Eigen::VectorXd moved = (state - model::balanced_state(system_, speed_, angles)).cwiseQuotient(scale_);
  return std::hypot(moved.norm(), angle_of_unbalance_ * std::abs(model::unbalance(system_.parameters(), angles)));
}

bool ContinuumRegion::holds(const Eigen::VectorXd& state, const OwnRotor* own) const {
  if (own)
    return ContinuumOfEquilibria::is_of(own->system) &&
           ContinuumOfEquilibria(own->system).holds(state, factor, slowest_rate, slow_factor);
  const auto depth = estimate ? estimate->depth(state, factor) : std::nullopt;
  if (depth && *depth < deep) return true;
  if (off && off->least(state) > farthest_inside(reach)) return false;
  return !(depth && *depth > far) && continuum->holds(state, factor, slowest_rate, slow_factor);
}

std::optional<ContinuumRegion> continuum_region(const std::shared_ptr<const ContinuumOfEquilibria>& continuum,
                                                const ContinuumSample& sample, const TrialSettings& settings) {
  if (!continuum || !sample.attracts()) return std::nullopt;
  const Members members = members_to_try(*continuum, sample, settings);
  if (members.all.empty()) return std::nullopt;
  ContinuumRegion region{continuum,     0.0, members.slowest_rate,
                         members.place, 0.0, std::make_shared<ContinuumEstimate>(*settings.system, members.all)};
  region.off = std::make_shared<const OffContinuum>(*settings.system);
  // With anisotropic supports or gravity every test takes a flight of its own.
  TrialCounts counts{.few = 128, .all = 1024, .low_may_fail = true};
  if (!settings.system->autonomous()) counts.few /= 4, counts.all /= 4;
  const auto member_of = [&](std::size_t number, std::size_t of) -> const ContinuumMember& {
    return members.all[number * members.all.size() / of];
  };
  const auto state = [&](const Trial& trial) {
    const ContinuumMember& m = member_of(trial.number, trial.of);
    Eigen::VectorXd z = state_with_room(region, m, trial.level * m.unit, trial.direction, *settings.system);
    if (trial.own) z += moved_to(trial.own->system, *settings.system, m);
    return z;
  };
  const auto complete = [&](Trials& trials, double tried, const TryRange& tries) {
    ContinuumRegion near = at_factor(region, members, come_near * tried);
    near.slowest_rate *= slower;
    // Regions are tested where half windows end. A test costs more than following a state until V has fallen by a
    // factor of e, even at the member that attracts most.
    trials.rule.window = std::max(trials.rule.window, 1.0 / -members.fastest_rate);
    set_regions(trials.rule, *settings.system, {}, near);  // tests depend on the window
    trials.flight = [&](std::size_t first) {
      const double rate = -member_of(tries.first + first, tries.of).rate;  // the slowest of the chunk
      return Trials::Flight{2.0 * std::log(1.0 / come_near) / (2.0 * rate) + 500.0, 0.0};
    };
    return true;
  };
  const double factor =
      level_by_trials(settings, continuum->directions(), {0.5 / members.unit}, counts, 0.0, state, complete);
  if (!(factor > 0.0)) return std::nullopt;
  region = at_factor(std::move(region), members, factor);
  region.slow_factor = slow_share * factor;
  return region;
}

}  // namespace equipoise
