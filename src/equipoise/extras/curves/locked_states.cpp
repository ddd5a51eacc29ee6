// A quadratic equation for the rotor's distance from the axis; of a motor, the speeds at which its torque is in
// balance.
#include "equipoise/extras/curves/locked_states.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

// Alike balls share a number, in the order of the first of each.
std::array<int, model::max_balls> alike_groups(const model::Parameters& p, int& groups) {
  std::array<int, model::max_balls> group{};
  groups = 0;
  for (int i = 0; i < p.balls; ++i) {
    int k = 0;
    while (k < i && !p.alike(i, k)) ++k;
    group[static_cast<std::size_t>(i)] = k < i ? group[static_cast<std::size_t>(k)] : groups++;
  }
  return group;
}

std::string kind_name(const LockedKind& kind, int balls, bool alike) {
  std::string here, there;
  int count_here = 0, count_there = 0;
  for (int i = 0; i < balls; ++i) {
    const bool first = kind.side[static_cast<std::size_t>(i)] > 0;
    ++(first ? count_here : count_there);
    std::string& list = first ? here : there;
    list += fmt::format("{}{}", list.empty() ? "" : "+", i + 1);
  }
  if (balls == 1) return "ball on the line";
  if (count_there == 0) return "balls together";
  if (balls == 2) return "balls opposite";
  return alike ? fmt::format("{} balls against {}", count_here, count_there)
               : fmt::format("balls {} against {}", here, there);
}

// The rotor's distance along the line, negative where the first ball lies behind it; and the line's angle.
struct OnLine {
  double reach, angle;
};

// (K + i zeta W) rho e^{i theta} = W^2 (lambda + m e^{i theta}), K = kappa - (1 + sum mu) W^2.
std::vector<OnLine> on_line(const model::Parameters& p, double moment, double speed) {
  const double square = speed * speed, stiff = p.stiffness[0] - (1.0 + p.total_mass()) * square,
               damp = p.damping[0] * speed, unbalance = square * p.eccentricity;
  const double size = stiff * stiff + damp * damp, load = square * moment;
  const double root = unbalance * unbalance * size - damp * damp * load * load;
  if (!(root >= 0.0) || !(unbalance > 0.0) || !(size > 0.0)) return {};
  std::vector<OnLine> found;
  for (const double sign : {-1.0, 1.0}) {
    const double reach = (stiff * load + sign * std::sqrt(root)) / size;
    found.push_back({reach, std::arg(unbalance / (Complex(stiff, damp) * reach - load))});
  }
  return found;
}

VectorXd state_on_line(const model::System& system, const LockedKind& kind, const OnLine& line, double speed) {
  VectorXd state = VectorXd::Zero(system.dimension());
  state[0] = line.reach * std::cos(line.angle);
  state[1] = line.reach * std::sin(line.angle);
  state[2] = -speed * state[1];
  state[3] = speed * state[0];
  for (int i = 0; i < system.balls(); ++i)
    state[model::index::phi(i)] = line.angle + (kind.side[static_cast<std::size_t>(i)] > 0 ? 0.0 : pi);
  if (system.layout().speed >= 0) state[system.layout().speed] = speed;
  return state;
}

// Speeds at which a motor feeds what the supports' dampers take, and the states there.
class FedStates {
 public:
  FedStates(const model::System& system, const LockedKind& kind)
      : system_(system), kind_(kind), moment_(kind.moment(system.parameters())) {}

  std::vector<VectorXd> run() const {
    if (system_.layout().error >= 0) return controlled();
    std::vector<VectorXd> found;
    const double top = std::min(system_.no_load_speed().value_or(model::out_of_reach), model::out_of_reach);
    const model::Parameters& p = system_.parameters();
    const double critical = std::sqrt(p.stiffness[0] / (1.0 + p.total_mass()));
    constexpr int wide = 80, narrow = 80;  // looks over all speeds, and near the critical one
    std::vector<double> speeds;
    for (int k = 1; k < wide; ++k) speeds.push_back(top * k / wide);
    speeds.push_back(top);
    for (int k = 0; k < narrow; ++k) speeds.push_back(critical * (0.7 + 0.6 * (k + 0.5) / narrow));
    speeds.erase(std::remove_if(speeds.begin(), speeds.end(), [&](double s) { return s > top; }), speeds.end());
    std::sort(speeds.begin(), speeds.end());
    for (const std::size_t root : {std::size_t{0}, std::size_t{1}}) {
      if (kind_.own_mirror && root == 0) continue;
      std::optional<double> last;
      for (std::size_t k = 0; k < speeds.size(); ++k) {
        const auto here = gain(speeds[k], root);
        if (here && last && (*here > 0.0) != (*last > 0.0)) add(speeds[k - 1], speeds[k], root, found);
        last = here;
      }
    }
    const auto place = system_.layout().speed;
    std::sort(found.begin(), found.end(), [&](const auto& a, const auto& b) { return a[place] < b[place]; });
    return found;
  }

 private:
  std::optional<VectorXd> state(double speed, std::size_t root) const {
    const auto lines = on_line(system_.parameters(), moment_, speed);
    if (root >= lines.size()) return std::nullopt;
    return state_on_line(system_, kind_, lines[root], speed);
  }
  // psi'' with the rotor held at this distance.
  std::optional<double> gain(double speed, std::size_t root) const {
    const auto at = state(speed, root);
    return at ? std::optional(model::rate(system_, *at)[system_.layout().speed]) : std::nullopt;
  }
  void add(double low, double high, std::size_t root, std::vector<VectorXd>& found) const {
    const auto first = gain(low, root);
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      const auto here = gain(middle, root);
      if (!here) return;
      ((*here > 0.0) == (*first > 0.0) ? low : high) = middle;
    }
    found.push_back(*state(high, root));
  }
  // The control's integral makes the torque that is needed at the speed requested.
  std::vector<VectorXd> controlled() const {
    std::vector<VectorXd> found;
    const double speed = system_.no_load_speed().value_or(0.0);
    if (!(speed > 0.0)) return found;
    for (const std::size_t root : {std::size_t{0}, std::size_t{1}}) {
      auto at = state(speed, root);
      if (!at || (kind_.own_mirror && root == 0)) continue;
      const auto place = system_.layout().speed, error = system_.layout().error;
      const auto gain_with = [&](double integral) {
        (*at)[error] = integral;
        return model::rate(system_, *at)[place];
      };
      // In proportion to the integral as long as the torque is below its limit. A state that needs more is not held.
      const double without = gain_with(0.0);
      constexpr double even = 1e-6;
      double part = 1.0;
      while (part > 1e-9 && std::fabs(gain_with(part) + without - 2.0 * gain_with(0.5 * part)) >
                                even * std::fabs(gain_with(part) - without))
        part *= 0.5;
      const double more = gain_with(part) - without;
      if (more != 0.0 && std::fabs(gain_with(-part * without / more)) <= even * std::fabs(without))
        found.push_back(*at);
    }
    return found;
  }

  const model::System& system_;
  const LockedKind& kind_;
  double moment_;
};

}  // namespace

double LockedKind::moment(const model::Parameters& p) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.balls); ++i) sum += side[i] * p.mass[i];
  return sum;
}

std::vector<LockedKind> locked_kinds(const model::Parameters& p, std::size_t most) {
  int groups = 0;
  const auto group = alike_groups(p, groups);
  std::vector<int> size(static_cast<std::size_t>(groups), 0), here(size);
  for (int i = 0; i < p.balls; ++i) ++size[static_cast<std::size_t>(group[static_cast<std::size_t>(i)])];
  here = size;  // balls of each group on the first ball's side; counted down, the first group slowest
  std::vector<LockedKind> kinds;
  for (;;) {
    std::vector<int> turned(size);
    for (std::size_t g = 0; g < size.size(); ++g) turned[g] = size[g] - here[g];
    if (here >= turned && here[0] > 0) {  // of two that differ by which side is which, one
      LockedKind kind;
      kind.own_mirror = here == turned;
      std::vector<int> left = here;
      std::vector<std::array<int, 2>> numbers(size.size(), {-1, -1});
      for (int i = 0; i < p.balls; ++i) {
        const auto g = static_cast<std::size_t>(group[static_cast<std::size_t>(i)]);
        const bool first = left[g]-- > 0;
        kind.side[static_cast<std::size_t>(i)] = first ? 1 : -1;
        int& number = numbers[g][first ? 0 : 1];
        if (number < 0) number = kind.clusters++;
        kind.cluster[static_cast<std::size_t>(i)] = number;
      }
      kind.name = kind_name(kind, p.balls, groups == 1);
      kinds.push_back(kind);
      if (kinds.size() > most) return {};
    }
    std::size_t g = size.size();
    while (g > 0 && here[g - 1] == 0) here[g - 1] = size[g - 1], --g;
    if (g == 0) return kinds;
    --here[g - 1];
  }
}

std::string locked_states_lack(const model::System& system) {
  const model::Parameters& p = system.parameters();
  if (system.tilts() || !p.race_is_centred() || !system.autonomous())
    return "they are known of rotors that do not tilt, with a centred race, equal supports and no gravity";
  if (p.balls_collide() || p.balls_stick()) return "touching or sticking balls may rest anywhere";
  if (system.coasts()) return "without a drive that lasts no speed is kept";
  if (locked_kinds(p).empty()) return "unlike balls can be divided in too many ways";
  return "";
}

std::vector<VectorXd> locked_states(const model::System& system, const LockedKind& kind) {
  if (!system.prescribed()) return FedStates(system, kind).run();
  std::vector<VectorXd> found;
  if (system.speed() == 0.0) return found;
  // Where all balls in line just cancel the unbalance: that state is balance itself.
  const double balanced = 1e-12 * system.parameters().all_unbalances();
  for (const OnLine& line : on_line(system.parameters(), kind.moment(system.parameters()), system.speed()))
    if ((!kind.own_mirror || line.reach > 0.0) && std::fabs(line.reach) > balanced)
      found.push_back(state_on_line(system, kind, line, system.speed()));
  return found;
}

LockedSymmetry::LockedSymmetry(const model::System& system, const LockedKind& kind) : balls_(system.balls()) {
  const int dimension = system.dimension(), c = kind.clusters;
  std::vector<Index> place(static_cast<std::size_t>(dimension));
  for (int i = 0; i < dimension; ++i)
    place[static_cast<std::size_t>(i)] = i < 4 ? i : i - 2 * balls_ + 2 * c;  // past the balls
  std::vector<int> members(static_cast<std::size_t>(c), 0), first_ball(static_cast<std::size_t>(c), -1);
  for (int i = 0; i < balls_; ++i) {
    const int number = kind.cluster[static_cast<std::size_t>(i)];
    place[static_cast<std::size_t>(model::index::phi(i))] = 4 + number;
    place[static_cast<std::size_t>(model::index::q(i, balls_))] = 4 + c + number;
    int& first = first_ball[static_cast<std::size_t>(number)];
    if (++members[static_cast<std::size_t>(number)] == 2) partings_.push_back({first, i, 2});
    if (first < 0) first = i;
  }
  for (Parting& parting : partings_)
    parting.balls = members[static_cast<std::size_t>(kind.cluster[static_cast<std::size_t>(parting.ball)])];
  const Index small = dimension - 2 * balls_ + 2 * c;
  spread_ = MatrixXd::Zero(dimension, small);
  first_.assign(static_cast<std::size_t>(small), -1);
  for (int i = 0; i < dimension; ++i) {
    const Index k = place[static_cast<std::size_t>(i)];
    spread_(i, k) = 1.0;
    if (first_[static_cast<std::size_t>(k)] < 0) first_[static_cast<std::size_t>(k)] = i;
  }
  scale_ = reduced(VectorXd(system.scale()));
}

VectorXd LockedSymmetry::reduced(const VectorXd& state) const { return state(first_); }

MatrixXd LockedSymmetry::reduced(const MatrixXd& jacobian) const {
  const MatrixXd rows = jacobian(first_, Eigen::all);
  return rows * spread_;
}

Eigen::VectorXcd LockedSymmetry::whole_left(const Eigen::VectorXcd& small) const {
  Eigen::VectorXcd left = Eigen::VectorXcd::Zero(spread_.rows());
  left(first_) = small;
  return left;
}

VectorXd LockedSymmetry::parting_direction(const Parting& parting) const {
  return VectorXd::Unit(spread_.rows(), model::index::phi(parting.ball)) -
         VectorXd::Unit(spread_.rows(), model::index::phi(parting.other));
}

std::vector<Complex> LockedSymmetry::rates(const MatrixXd& jacobian) const {
  const Eigen::VectorXcd own = dense::eigenvalues(reduced(jacobian));
  std::vector<Complex> all(own.begin(), own.end());
  for (const Parting& parting : partings_) {
    // d'' = push d + brake d' of the difference d of two angles.
    const Index row = parting_place(parting);
    const auto differs = [&](Index a, Index b) { return jacobian(row, a) - jacobian(row, b); };
    const double push = differs(model::index::phi(parting.ball), model::index::phi(parting.other)),
                 brake = differs(row, model::index::q(parting.other, balls_)), half = 0.5 * brake,
                 under = half * half + push;
    for (int k = 1; k < parting.balls; ++k)
      for (const double sign : {-1.0, 1.0})
        all.push_back(under >= 0.0 ? Complex(half + sign * std::sqrt(under)) : Complex(half, sign * std::sqrt(-under)));
  }
  return without_continuum(Eigen::Map<const Eigen::VectorXcd>(all.data(), static_cast<Index>(all.size())), 0, 0.0);
}

BalanceSpectrum locked_spectrum(const model::System& system, const LockedSymmetry& symmetry, const VectorXd& state) {
  BalanceSpectrum found{system, state, model::jacobian(system, state), {}, false};
  found.rates = symmetry.rates(found.jacobian);
  return found;
}

}  // namespace equipoise
