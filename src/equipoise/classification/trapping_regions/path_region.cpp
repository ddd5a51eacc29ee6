// Places along a motion, for one rotor or as polynomials of a family's coordinates.
#include "equipoise/classification/trapping_regions/path_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "equipoise/attractors/motions/motion_bytes.hpp"
#include "equipoise/attractors/motions/motion_symmetry.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/simulation/rule/region_values-inl.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/core/math/lyapunov.hpp"
#include "equipoise/core/math/polynomial_terms.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/classification/trapping_regions/orbit_region.hpp"

namespace equipoise {

namespace {

namespace kernels = HWY_NAMESPACE;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A place misses the middle between two places by (pi / 48)^3 / 6 = 5e-5 of an amplitude. A turn is a ball's or, if
// none turns, lasts as long as the rotor swings once on its springs.
constexpr int places_a_turn = 48, most_path_turns = 12, most_path_copies = 24;
// States next to a place: more than half way to the next one, so that no gap opens where the motion bends.
constexpr double place_reach = 0.8;
// In System::scale().
constexpr double highest_path_level = 4.0;
// Where rotors differ: at most this many are looked at, two or more for each term. Every third one is kept back from
// the fit, as a test of its polynomial.
constexpr std::size_t most_looked_at = 40, asked_a_term = 2, kept_back = 3, fewest = 5;
constexpr int highest_degree = 6;
// A motion about to end attracts ever more slowly. A rotor below this share of the first one's rate counts as lacking
// it.
constexpr double barely = 0.2;
// If a polynomial does not hold for all rotors, this share of the nearest ones is tried alone.
constexpr double nearer_ones = 0.7;
constexpr int most_shrunk = 3;
// From one rotor's motion to the next one's, in System::scale().
constexpr double farthest_neighbour = 8.0;
constexpr double path_tolerance = 1e-10;
// V of the rotors' own motions beyond which trials have no level to pass.
constexpr double highest_path_floor = 0.02, good_floor = 2e-4, floor_margin = 4.0;

double apart(const OwnRotor& a, const OwnRotor& b) { return squared_distance(a.coordinates, b.coordinates); }
bool nearer(const OwnRotor& to, const OwnRotor& a, const OwnRotor& b) { return apart(to, a) < apart(to, b); }

// Rotors of a family: more of them if more values differ.
std::size_t first_looked_at(const OwnRotor& own) { return std::min(most_looked_at, 8 + 8 * own.coordinates.size()); }

// Scales forms so that d^T P d is |d|^2 or more in units of `scale`, except along the flow. False if P is not definite.
bool normalise(std::vector<MatrixXd>& forms, const VectorXd& scale, int free_directions) {
  double least = infinite;
  for (const MatrixXd& form : forms) {
    const VectorXd values = dense::symmetric_eigenvalues(scale.asDiagonal() * form * scale.asDiagonal());
    least = std::min(least, values[free_directions]);
  }
  if (!(least > 0.0) || !std::isfinite(least)) return false;
  for (MatrixXd& form : forms) form /= least;
  return true;
}

// Down to levels that leave trials room to come inside.
LevelLadder ladder_above(double floor) {
  constexpr double room = 32.0;
  LevelLadder ladder{highest_path_level};
  if (floor > 0.0)
    ladder.halvings = std::clamp(static_cast<int>(std::log2(highest_path_level / (room * floor))), 1, ladder.halvings);
  return ladder;
}

}  // namespace

bool PathRegion::describe_rest(const model::System& system, const Motion& motion) {
  const VectorXd scale = system.scale();
  const MatrixXd scaled =
      scale.cwiseInverse().asDiagonal() * model::jacobian(system, motion.state) * scale.asDiagonal();
  const MatrixXd one = MatrixXd::Identity(scaled.rows(), scaled.cols());
  rate_ = dense::largest_real_part(scaled);
  if (!(rate_ < 0.0)) return false;
  const MatrixXd form = solve_lyapunov(scaled - share_of_rate * rate_ * one, one);
  std::vector<MatrixXd> forms{scale.cwiseInverse().asDiagonal() * form * scale.cwiseInverse().asDiagonal()};
  if (!normalise(forms, scale, 0)) return false;
  const VectorXd none = VectorXd::Zero(scale.size());
  along_.push_back({none, none, none, forms.front()});
  positions_ = motion.state;
  lay_out();
  return true;
}

bool PathRegion::describe_orbit(const model::System& system, const Motion& motion) {
  int turns = std::max(1, static_cast<int>(std::lround(motion.orbit.period / two_pi)));
  for (int i = 0; i < balls_; ++i) turns = std::max(turns, std::abs(motion.winding[i]));
  if (turns > most_path_turns) return false;
  const int count = places_a_turn * turns;
  auto frame = floquet_frame(system, motion.orbit, 2 * count);
  if (!frame) return false;
  rate_ = motion.orbit.slowest_rate();
  half_ = place_reach * motion.orbit.period / count;
  const VectorXd scale = system.scale();
  std::vector<MatrixXd> forms;
  for (int k = 0; k < count; ++k) forms.push_back(floquet_form(frame->left[2 * static_cast<std::size_t>(k)]));
  if (!normalise(forms, scale, 1)) return false;
  positions_.resize(scale.size() * count, 1);
  for (int k = 0; k < count; ++k) {
    const VectorXd& state = frame->states[2 * static_cast<std::size_t>(k)];
    const VectorXd flow = model::rate(system, state), scaled = flow.cwiseQuotient(scale);
    const VectorXd phase = scaled.cwiseQuotient(scale) / scaled.squaredNorm();
    between_ = std::max(between_, half_ * scaled.norm());
    along_.push_back({flow, model::jacobian(system, state) * flow, phase, forms[static_cast<std::size_t>(k)]});
    positions_.block(k * scale.size(), 0, scale.size(), 1) = state;
  }
  lay_out();
  for (std::size_t k = 1; k < frame->states.size(); k += 2)
    floor_ = std::max(floor_, floor_margin * value_in_place(frame->states[k].data(), nullptr));
  return floor_ < highest_path_floor;
}

VectorXd PathRegion::away(const VectorXd& state, const VectorXd& from) const {
  VectorXd d = state - from;
  for (int i = 4; i < 4 + balls_; ++i) d[i] = kernels::shortest_turn(d[i]);
  return d;
}

std::optional<PathRegion::There> PathRegion::found(const OwnRotor& own, const There& neighbour,
                                                   const StopFlag* stop) const {
  There there;
  if (half_ == 0.0) {
    const auto rest = refine_equilibrium(own.system, neighbour.rest);
    if (!rest) return std::nullopt;
    there.rest = rest->state;
    there.rate = rest->eigenvalues.real().maxCoeff();
  } else {
    auto orbit = continue_orbit(own.system, neighbour.orbit, farthest_neighbour, stop);
    if (!orbit) return std::nullopt;
    there.orbit = *std::move(orbit);
    there.rate = there.orbit.slowest_rate();
  }
  if (!(there.rate < -slowest_worth_it) || !(there.rate < barely * rate_)) return std::nullopt;
  there.places = places_of(own.system, there);
  return there.places.size() > 0 ? std::optional(std::move(there)) : std::nullopt;
}

bool PathRegion::fits(const model::System& system, const There& there) const {
  const Eigen::Index size = inverse_scale_.size();
  const bool rests = half_ == 0.0;
  return (rests ? there.rest.size() == size : !there.orbit.nodes.empty()) && fits_system(system, there.orbit) &&
         there.places.size() == positions_.rows() && there.between.size() == (rests ? 0 : along_.size()) &&
         std::all_of(there.between.begin(), there.between.end(), [&](const VectorXd& z) { return z.size() == size; });
}

// The first place is where the motion passes closest to the known one.
VectorXd PathRegion::places_of(const model::System& system, There& there) const {
  const Eigen::Index size = inverse_scale_.size();
  std::vector<VectorXd> states{there.rest};
  if (half_ > 0.0) {
    const int count = static_cast<int>(along_.size()), fine = 4 * count;
    const VectorXd first = positions_.block(0, 0, size, 1);
    const std::vector<VectorXd> all = sample_orbit(system, there.orbit, fine);
    const auto distance = [&](const VectorXd& state) { return away(state, first).cwiseProduct(inverse_scale_).norm(); };
    if (all.empty()) return {};
    const auto nearest = std::min_element(
        all.begin(), all.end(), [&](const VectorXd& a, const VectorXd& b) { return distance(a) < distance(b); });
    const auto number = static_cast<std::size_t>(nearest - all.begin());
    const VectorXd& before = all[(number + all.size() - 2) % all.size()];
    double time = 2.0 * there.orbit.period / fine;
    std::optional<VectorXd> at = before;
    for (int round = 0; round < 6 && at && time >= 0.0; ++round) {
      at = advance_state(system, before, time, 0.0, path_tolerance);
      if (at) time -= along_.front().phase.dot(away(*at, first));
    }
    if (!at || !(time >= 0.0)) return {};
    PeriodicOrbit orbit = there.orbit;
    orbit.nodes = {*at};
    states = sample_orbit(system, orbit, 2 * count);
    for (std::size_t k = 1; k < states.size(); k += 2) there.between.push_back(states[k]);
    for (std::size_t k = 0; 2 * k < states.size(); ++k) states[k] = states[2 * k];
    states.resize((states.size() + 1) / 2);
  }
  VectorXd all(static_cast<Eigen::Index>(states.size()) * size);
  if (all.size() != positions_.rows()) return {};
  for (std::size_t k = 0; k < states.size(); ++k) {
    const VectorXd here = positions_.block(static_cast<Eigen::Index>(k) * size, 0, size, 1);
    all.segment(static_cast<Eigen::Index>(k) * size, size) = here + away(states[k], here);
  }
  return all;
}

// From rotor to rotor, each from the nearest one that has the motion. If few of the first have it, more next to those.
bool PathRegion::follow_rotors(const Motion& motion, const std::vector<const OwnRotor*>& rotors, const StopFlag* stop,
                               NotePage* notes) {
  std::vector<const OwnRotor*> tried;
  There first;
  first.rest = motion.state;
  first.orbit = motion.orbit;
  std::vector<There> all;
  const auto lacks = [&](const OwnRotor* own) {
    return std::none_of(all.begin(), all.end(), [&](const There& there) { return there.own == own; });
  };
  const std::size_t at_first = first_looked_at(*rotors.front());
  for (std::size_t k = 0; k < rotors.size() && tried.size() < most_looked_at; ++k) {
    const OwnRotor& own = *rotors[k];
    if (k >= at_first && (all.empty() || all.size() >= at_first / 2)) break;
    const auto nearer_to_it = [&](const OwnRotor* a, const OwnRotor* b) { return nearer(own, *a, *b); };
    if (k >= at_first && lacks(*std::min_element(tried.begin(), tried.end(), nearer_to_it))) continue;
    const auto near = std::min_element(all.begin(), all.end(),
                                       [&](const There& a, const There& b) { return nearer_to_it(a.own, b.own); });
    auto there = noted(
        notes, "a rotor's motion", stop, [&] { return found(own, near == all.end() ? first : *near, stop); },
        [&](const std::optional<There>& known) { return !known || fits(own.system, *known); });
    if (is_set(stop)) return false;
    tried.push_back(&own);
    if (!there) continue;
    there->own = &own;
    all.push_back(*std::move(there));
  }
  for (int shrunk = 0; all.size() < fewest || !fit(all); ++shrunk) {
    if (all.size() < fewest || shrunk == most_shrunk) return false;
    all.resize(std::min(all.size() - 1, static_cast<std::size_t>(nearer_ones * static_cast<double>(all.size()))));
  }
  for (const There& there : all) rate_ = std::max(rate_, there.rate);
  for (const OwnRotor* own : tried) {
    if (!lacks(own)) continue;
    double square = infinite;
    for (const There& there : all) square = std::min(square, apart(*there.own, *own));
    lacking_.push_back({own->coordinates, square});
  }
  return true;
}

// Fits a polynomial of the lowest sufficient degree to the motions of most rotors, and tests it on all.
bool PathRegion::fit(const std::vector<There>& all) {
  std::vector<const OwnRotor*> owns;
  std::vector<VectorXd> fitted;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k % kept_back == kept_back - 1) continue;
    owns.push_back(all[k].own);
    fitted.push_back(all[k].places);
  }
  floor_ = infinite;
  for (int degree = 1; degree <= highest_degree && !(floor_ < good_floor); ++degree) {
    std::vector<VectorXd> rows;
    for (const OwnRotor* own : owns) rows.push_back(polynomial_terms(own->coordinates, degree));
    if (asked_a_term * static_cast<std::size_t>(rows.front().size()) > all.size()) break;
    degree_ = degree;
    positions_ = polynomial_fit(rows, fitted).transpose();
    lay_out();
    floor_ = floor_margin * largest_miss(all);
  }
  return floor_ < highest_path_floor;
}

double PathRegion::largest_miss(const std::vector<There>& all) {
  const Eigen::Index size = inverse_scale_.size();
  double largest = 0.0;
  for (const There& there : all) {
    const auto look_at = [&](const VectorXd& state) {
      hold(state);
      largest = std::max(largest, value_in_place(state.data(), there.own));
    };
    for (Eigen::Index k = 0; k < there.places.size(); k += size) look_at(there.places.segment(k, size));
    for (const VectorXd& state : there.between) look_at(state);
  }
  return largest;
}

// The rotor must not be closer to one that lacks the motion than any rotor that has it.
bool PathRegion::holds_for(const OwnRotor& own) const {
  return std::all_of(lacking_.begin(), lacking_.end(), [&](const Lacking& l) {
    return squared_distance(l.coordinates, own.coordinates) >= l.square_to_nearest;
  });
}

// Positions by terms, phase, flow, bend, half P (twice off its diagonal).
void PathRegion::lay_out() {
  const Eigen::Index size = inverse_scale_.size(), count = positions_.cols();
  table_.clear();
  for (std::size_t k = 0; k < along_.size(); ++k) {
    const Place& place = along_[k];
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index t = 0; t < count; ++t) table_.push_back(positions_(static_cast<Eigen::Index>(k) * size + i, t));
    for (const VectorXd* v : {&place.phase, &place.flow, &place.bend})
      table_.insert(table_.end(), v->begin(), v->end());
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index l = i; l < size; ++l) table_.push_back((l > i ? 2.0 : 1.0) * place.form(i, l));
  }
}

VectorXd PathRegion::terms(const OwnRotor* own) const {
  return own && degree_ > 0 ? polynomial_terms(own->coordinates, degree_) : VectorXd::Ones(positions_.cols());
}

double PathRegion::value_in_place(const double* state, const OwnRotor* own) const {
  if (own && !holds_for(*own)) return infinite;
  const VectorXd factors = terms(own);
  const int size = static_cast<int>(inverse_scale_.size()), count = static_cast<int>(factors.size());
  const std::size_t row = static_cast<std::size_t>(size) * static_cast<std::size_t>(count + 3) +
                          static_cast<std::size_t>(size * (size + 1) / 2);
  std::array<double, max_dimension> d{};
  VectorXd here(size);
  double least = infinite;
  for (std::size_t k = 0; k < along_.size(); ++k) {
    const double* at = &table_[k * row];
    for (int i = 0; i < size; ++i, at += count) {
      here[i] = at[0] * factors[0];
      for (int t = 1; t < count; ++t) here[i] += at[t] * factors[t];
      d[i] = state[i] - here[i];
    }
    for (int i = 4; i < 4 + balls_; ++i) d[i] = kernels::shortest_turn(d[i]);
    if (half_ > 0.0) {
      double later = 0.0;
      for (int i = 0; i < size; ++i) later += at[i] * d[i];
      if (std::fabs(later) > half_) continue;
      if (own && degree_ > 0) {  // its motion passes here in its own time
        const VectorXd flow = model::rate(own->system, here);
        later /= Eigen::Map<const VectorXd>(at, size).dot(flow);
        for (int i = 0; i < size; ++i) d[i] -= later * (flow[i] + 0.5 * later * at[2 * size + i]);
      } else {
        for (int i = 0; i < size; ++i) d[i] -= later * (at[size + i] + 0.5 * later * at[2 * size + i]);
      }
    }
    double square = 0.0;
    for (int i = 0; i < size; ++i) square += std::pow(d[i] * inverse_scale_[i], 2);
    if (square > least) continue;
    at += 3 * size;
    double v = 0.0;
    for (int i = 0; i < size; ++i) {
      double sum = 0.0;
      for (int l = i; l < size; ++l) sum += *at++ * d[l];
      v += d[i] * sum;
    }
    least = std::min(least, v);
  }
  return least;
}

VectorXd PathRegion::state_on_level(std::size_t which, double level, const VectorXd& direction,
                                    const OwnRotor* own) const {
  const std::size_t k = which % along_.size();
  const Place& place = along_[k];
  const Eigen::Index size = inverse_scale_.size();
  const auto scale = inverse_scale_.cwiseInverse().asDiagonal();
  MatrixXd form = scale * place.form * scale;
  const VectorXd flow = place.flow.cwiseProduct(inverse_scale_);
  const VectorXd unit = half_ > 0.0 ? flow.normalized() : VectorXd::Zero(size);
  form += unit * unit.transpose();
  VectorXd d = dense::Cholesky(form).solve_upper(direction);
  d -= unit * unit.dot(d);
  d = scale * d;
  d *= std::sqrt(level / d.dot(place.form * d));
  return positions_.middleRows(static_cast<Eigen::Index>(k) * size, size) * terms(own) + d;
}

std::shared_ptr<PathRegion> PathRegion::around(const model::System& system, const Motion& motion, int attractor,
                                               const std::vector<const OwnRotor*>& rotors, const StopFlag* stop,
                                               NotePage* notes) {
  const bool rest = motion.kind == MotionKind::equilibrium;
  if (!motion.stable || motion.set_valued || (!rest && motion.kind != MotionKind::periodic)) return nullptr;
  if (!system.autonomous() || motion.copies > most_path_copies || motion.state.size() != system.dimension())
    return nullptr;
  std::shared_ptr<PathRegion> region(new PathRegion(system, attractor));
  if (!(rest ? region->describe_rest(system, motion) : region->describe_orbit(system, motion))) return nullptr;
  if (!(region->rate_ < -slowest_worth_it)) return nullptr;
  const Eigen::Index size = system.dimension();
  for (Eigen::Index k = 0; k < region->positions_.rows(); k += size)
    region->hold(region->positions_.block(k, 0, size, 1));
  for (const BallOrder& image : exchange_images(system, motion))
    region->places_.push_back(exchanged_components(system.balls(), image, size));
  if (!rotors.empty() && !region->follow_rotors(motion, rotors, stop, notes)) return nullptr;
  return region;
}

std::shared_ptr<const PathRegion> path_region(const model::System& system, const Motion& motion, int attractor,
                                              const TrialSettings& settings, const OwnRotor* own, double near) {
  std::vector<const OwnRotor*> rotors = pointers_to(settings.rotors);
  if (own)  // the first ones contain the part's corners; the nearest go first
    std::stable_sort(rotors.begin(),
                     rotors.begin() + static_cast<std::ptrdiff_t>(std::min(rotors.size(), first_looked_at(*own))),
                     [&](const OwnRotor* a, const OwnRotor* b) { return nearer(*own, *a, *b); });
  const auto region = PathRegion::around(system, motion, attractor, rotors, settings.stop, settings.notes);
  if (!region) return nullptr;
  TrialSettings of_those = settings;
  std::vector<OwnRotor> having;
  std::copy_if(settings.rotors.begin(), settings.rotors.end(), std::back_inserter(having),
               [&](const OwnRotor& rotor) { return region->holds_for(rotor); });
  if (having.empty() && !settings.rotors.empty()) return nullptr;
  of_those.rotors = having;
  return validate(region, ladder_above(region->floor()), of_those, near) ? region : nullptr;
}

}  // namespace equipoise
