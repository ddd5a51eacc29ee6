// Forms and levels of trapping regions around balanced states.
#include "equipoise/classification/balanced_regions/balanced_region.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "equipoise/attractors/motions/motion_symmetry.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/core/math/lyapunov.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

namespace {

// For weighing: with random steps from the worst, enough to rank weights; without them thousands mislead. Ranked by the
// level that gradients find, weights of overdamped balls would give level sets that can hardly be proved.
constexpr int rays_while_weighing = 300;
constexpr int rays_for_level = 2000;  // plus descent: 300 and 20 000 agree to 1e-5

// Mean time in which the linear flow takes ball angles up to `spread` away from balance into the level set. Good
// weights make it small. The spread is where balls are when the last slow approach begins.
class EntryTime {
 public:
  EntryTime(const Modes& modes, int balls) : modes_(modes) {
    constexpr double spread = 0.5;
    for (int a = -2; a <= 2; ++a)
      for (int b = -2; b <= 2; ++b) {
        if (a == 0 && b == 0) continue;
        Eigen::VectorXd z = Eigen::VectorXd::Zero(modes.left.rows());
        z[model::index::phi(0)] = 0.5 * spread * a;
        if (balls > 1) z[model::index::phi(1)] = 0.5 * spread * b;
        amplitudes_.push_back((modes.left.transpose() * z).cwiseAbs2());
      }
  }

  double operator()(const Eigen::VectorXd& weights, double level) const {
    if (!(level > 0.0)) return std::numeric_limits<double>::infinity();
    double sum = 0.0;
    for (const Eigen::VectorXd& amplitude : amplitudes_) sum += entry(weights.cwiseProduct(amplitude), level);
    return sum / static_cast<double>(amplitudes_.size());
  }

 private:
  // Root of sum_k a_k e^{2 Re(rate_k) t} = level by bisection; the sum only falls.
  double entry(const Eigen::VectorXd& a, double level) const {
    const auto value = [&](double t) { return (a.array() * (2.0 * t * modes_.rates.real().array()).exp()).sum(); };
    if (value(0.0) <= level) return 0.0;
    double high = 1.0;
    while (value(high) > level && high < 1e9) high *= 2.0;
    double low = 0.5 * high;
    for (int i = 0; i < 12; ++i) {
      const double middle = 0.5 * (low + high);
      (value(middle) > level ? low : high) = middle;
    }
    return high;
  }

  Modes modes_;
  std::vector<Eigen::VectorXd> amplitudes_;
};

// The weights of the nearest eigenvalues.
Eigen::VectorXd weights_from(const std::vector<ModeWeight>& known, const Modes& modes) {
  Eigen::VectorXd weights(modes.rates.size());
  for (Eigen::Index k = 0; k < weights.size(); ++k) {
    const auto away = [&](const ModeWeight& w) { return std::abs(modes.rates[k] - std::complex<double>(w.re, w.im)); };
    weights[k] = std::min_element(known.begin(), known.end(), [&](const ModeWeight& x, const ModeWeight& y) {
                   return away(x) < away(y);
                 })->weight;
  }
  return weights;
}

// The modal form with the weights of the least entry time: coordinate search over one weight for each conjugate pair.
// Unit weights on unit vectors are within a factor of two of the best in every row of the paper. A neighbour's weights
// are good enough if they are better.
Eigen::MatrixXd best_modal_form(const model::System& system, const Eigen::VectorXd& centre, const Eigen::MatrixXd& a,
                                std::vector<ModeWeight>& known, Directions& vectors) {
  const Modes modes = left_modes(a);
  const Eigen::Index size = modes.rates.size();
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(size);
  const EntryTime entry_time(modes, system.balls());
  const auto cost = [&](const Eigen::VectorXd& w) {
    return entry_time(w, critical_level(system, centre, modal_form(modes, w), rays_while_weighing, vectors, false));
  };
  double least = cost(weights);
  const int sweeps = known.empty() ? 3 : 0;
  if (!known.empty())
    if (const Eigen::VectorXd near = weights_from(known, modes); cost(near) < least) weights = near;
  for (double factor : {2.0, 1.4}) {
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      bool improved = false;
      for (Eigen::Index k = 0; k < size; ++k) {
        if (modes.rates[k].imag() < 0.0) continue;  // moves with its conjugate
        for (double by : {factor, 1.0 / factor}) {
          Eigen::VectorXd trial = weights;
          for (Eigen::Index j = 0; j < size; ++j)
            if (std::abs(modes.rates[j] - modes.rates[k]) < 1e-12 ||
                std::abs(modes.rates[j] - std::conj(modes.rates[k])) < 1e-12)
              trial[j] *= by;
          const double value = cost(trial);
          if (value < least) {
            least = value;
            weights = trial;
            improved = true;
          }
        }
      }
      if (!improved) break;
    }
  }
  known.clear();
  for (Eigen::Index k = 0; k < size; ++k) known.push_back({modes.rates[k].real(), modes.rates[k].imag(), weights[k]});
  return modal_form(modes, weights);
}

using Angles = std::array<double, model::max_balls>;
using State = std::array<double, max_dimension>;

BalancedRegion make_region(const State& place, const Eigen::MatrixXd& form, double level) {
  BalancedRegion region;
  region.place = place;
  region.level = level;
  const auto size = static_cast<int>(form.rows());
  const Eigen::MatrixXd factor = dense::Cholesky(form).upper();
  const Eigen::MatrixXd inverse = dense::inverse(form);
  region.factor.resize(static_cast<std::size_t>(size) * size);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) region.factor[i * size + j] = factor(i, j);
    region.reach[i] = std::sqrt(level * inverse(i, i));
  }
  return region;
}

// The form whose sampled level set is entered soonest, among modal ones and Lyapunov's for Q = 1 (modal forms
// degenerate if modes are nearly defective).
BalancedRegion isolated_region(const model::System& system, const Angles& phi, double speed,
                               std::vector<ModeWeight>& weights) {
  const Eigen::VectorXd state = model::balanced_state(system, speed, phi.data());
  const Eigen::MatrixXd a = model::jacobian(system, state);
  Directions vectors(a.rows());
  const Eigen::MatrixXd modal = best_modal_form(system, state, a, weights, vectors);
  const Eigen::MatrixXd plain = solve_lyapunov(a, Eigen::MatrixXd::Identity(a.rows(), a.cols()));
  const auto level_of = [&](const Eigen::MatrixXd& form) {
    return critical_level(system, state, form, rays_for_level, vectors);
  };
  const auto log_volume = [&](const Eigen::MatrixXd& form, double level) {
    return level > 0.0 ? 0.5 * (a.rows() * std::log(level) - std::log(dense::determinant(form))) : -1e300;
  };
  const double modal_level = level_of(modal), plain_level = level_of(plain);
  const bool use_modal = log_volume(modal, modal_level) >= log_volume(plain, plain_level);
  const Eigen::MatrixXd& form = use_modal ? modal : plain;
  const double level = use_modal ? modal_level : plain_level;
  State place{};
  std::copy(state.begin(), state.end(), place.begin());
  std::copy_n(phi.begin(), system.balls(), place.begin() + model::index::phi(0));
  return make_region(place, form, level_margin * level);
}

// Sign of a state's component in the mirror image, whose rotor turns the other way.
double mirror_sign(const model::System& system, int place) {
  if (const int tilt = system.layout().tilt; tilt >= 0 && place >= tilt) place -= tilt;  // sx, us as x, u
  return place == model::index::x || place == model::index::u ? 1.0 : -1.0;
}

model::System reflected(const model::System& system) {
  model::Parameters p = system.parameters();
  model::DrivePiece drive = system.drive();
  p.race_offset[1] = -p.race_offset[1];
  p.eccentricity_angle = -p.eccentricity_angle;
  drive.speed = -drive.speed;
  drive.motor = drive.motor.mirrored();
  return {p, drive};
}

BalancedRegion reflected(const model::System& system, const BalancedRegion& region) {
  Eigen::VectorXd sign(system.dimension());
  State place = region.place;
  for (int i = 0; i < system.dimension(); ++i) {
    sign[i] = mirror_sign(system, i);
    place[i] *= sign[i];
  }
  return make_region(place, sign.asDiagonal() * form_of(region) * sign.asDiagonal(), region.level);
}

}  // namespace

BalancedRegion exchanged(const BalancedRegion& region) {
  const Eigen::MatrixXd form = form_of(region);
  const Eigen::VectorXi from = exchanged_components(2, {1, 0}, form.rows());
  State place = region.place;
  std::swap(place[model::index::phi(0)], place[model::index::phi(1)]);
  return make_region(place, form(from, from), region.level);
}

// The search always runs for a rotor that turns forwards, so that mirror images have the same level.
BalancedRegion balanced_region(const model::System& system, const Angles& phi, std::vector<ModeWeight>& weights) {
  const double speed = model::balanced_speed(system).value_or(0.0), forwards = std::fabs(speed);
  Angles angles = phi;
  const bool backwards = speed < 0.0, equal = system.balls() == 2 && system.parameters().equal_balls();
  for (int i = 0; backwards && i < system.balls(); ++i) angles[i] = -phi[i];
  if (backwards && equal) std::swap(angles[0], angles[1]);  // with alike balls, both states are made from the first
  const BalancedRegion region = isolated_region(backwards ? reflected(system) : system, angles, forwards, weights);
  if (!backwards) return region;
  return reflected(system, equal ? exchanged(region) : region);
}

Eigen::MatrixXd weighted_form(const Eigen::MatrixXd& a, const std::vector<ModeWeight>& weights) {
  const Modes modes = left_modes(a);
  return modal_form(modes, weights_from(weights, modes));
}

Eigen::MatrixXd form_of(const BalancedRegion& region) {
  const auto size = static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(region.factor.size()))));
  const FactorView factor(region.factor.data(), size, size);
  return factor.transpose() * factor;
}

void set_level(BalancedRegion& region, double level) {
  const double stretch = std::sqrt(level / region.level);
  region.level = level;
  for (double& reach : region.reach) reach *= stretch;
}

double touching_level(const model::System& system, const BalancedRegion& region) {
  const model::Parameters& p = system.parameters();
  double level = std::numeric_limits<double>::infinity();
  if (!p.balls_collide()) return level;
  const Eigen::MatrixXd inverse = dense::inverse(form_of(region));
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < i; ++k) {
      const double room = std::max(std::fabs(wrapped(region.angles()[i] - region.angles()[k])) - p.contact_angle, 0.0);
      const int a = model::index::phi(i), b = model::index::phi(k);
      level = std::min(level, room * room / (inverse(a, a) + inverse(b, b) - 2.0 * inverse(a, b)));
    }
  return level;
}

Eigen::VectorXd state_on_level(const BalancedRegion& region, double level, const Eigen::VectorXd& direction) {
  return state_on_level(region.place.data(), region.factor.data(), level, direction);
}

Eigen::VectorXd state_on_level(const double* place, const double* factor, double level,
                               const Eigen::VectorXd& direction) {
  const Eigen::Index size = direction.size();
  const Eigen::VectorXd d =
      std::sqrt(level) * FactorView(factor, size, size).triangularView<Eigen::Upper>().solve(direction);
  return Eigen::Map<const Eigen::VectorXd>(place, size) + d;
}

}  // namespace equipoise
