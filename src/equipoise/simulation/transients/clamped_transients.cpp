// Quadratic forms over a grid of times.
#include "equipoise/simulation/transients/clamped_transients.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/integrate/clamped.hpp"
#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/simulation/transients/transient_step-inl.hpp"

namespace equipoise {

namespace {

double points_in(const model::Parameters& p, const model::Segment& s) {
  const double fastest =
      std::max({std::fabs(s.speed), std::fabs(s.speed_at(s.end)), std::sqrt(std::max(p.stiffness[0], p.stiffness[1]))});
  return std::ceil((s.end - s.begin) * 64.0 * fastest / (2.0 * std::numbers::pi));
}

// The grid times of every clamped segment, from its beginning to just before its end.
std::vector<double> grid_of(const model::Parameters& p, const std::vector<model::Segment>& segments) {
  std::vector<double> times;
  for (const model::Segment& s : segments) {
    if (!s.clamped) break;
    const double points = points_in(p, s);
    for (double k = 0.0; k < points; ++k) times.push_back(s.begin + (s.end - s.begin) * (k / points));
    times.push_back(std::nextafter(s.end, s.begin));
  }
  return times;
}

}  // namespace

double clamped_grid_points(const model::Parameters& p, const std::vector<model::Segment>& segments) {
  double points = 0.0;
  for (const model::Segment& s : segments) {
    if (!s.clamped) break;
    points += points_in(p, s) + 1.0;
  }
  return points;
}

ClampedTransients::Monomials ClampedTransients::Squares::of(const std::array<std::array<double, 2>, 3>& v) {
  const auto dot = [&](int i, int j) { return v[i][0] * v[j][0] + v[i][1] * v[j][1]; };
  return {dot(0, 0), 2.0 * dot(0, 1), 2.0 * dot(0, 2), dot(1, 1), 2.0 * dot(1, 2), dot(2, 2)};
}

void ClampedTransients::Squares::add(const std::array<std::array<double, 2>, 3>& v) {
  const Monomials c = of(v);
  for (std::size_t j = 0; j < c.size(); ++j) coefficient[j].push_back(c[j]);
}

double ClampedTransients::Squares::at(const Monomials& m, std::size_t k) const {
  double sum = 0.0;
  for (std::size_t j = 0; j < m.size(); ++j) sum += m[j] * coefficient[j][k];
  return sum;
}

// Eight maxima side by side let compilers use vector instructions.
double ClampedTransients::Squares::largest(const Monomials& m) const {
  constexpr std::size_t width = 8;
  std::array<double, width> most{};
  const std::size_t points = coefficient[0].size(), whole = points / width * width;
  for (std::size_t k = 0; k < whole; k += width)
    for (std::size_t i = 0; i < width; ++i) {
      const double value = at(m, k + i);
      most[i] = value > most[i] ? value : most[i];
    }
  double result = *std::max_element(most.begin(), most.end());
  for (std::size_t k = whole; k < points; ++k) result = std::max(result, at(m, k));
  return result;
}

std::size_t ClampedTransients::Squares::place_of(const Monomials& m, double largest) const {
  std::size_t k = 0;
  // Vector instructions may round the same sum otherwise.
  while (k + 1 < coefficient[0].size() && at(m, k) < largest * (1.0 - 1e-12)) ++k;
  return k;
}

ClampedTransients::ClampedTransients(const model::Parameters& p, const std::vector<model::Segment>& segments,
                                     const std::array<double, 4>& initial, double tolerance,
                                     const TransientSettings& settings, const StopFlag* stop)
    : settings_(settings),
      proportional_(!model::depends_on_rotor_angle(p) &&
                    std::all_of(initial.begin(), initial.end(), [](double v) { return v == 0.0; })),
      times_(grid_of(p, segments)) {
  ClampedBasis at_release;
  const auto observe = [&](double t, const model::Segment& segment, const ClampedBasis& basis) {
    std::array<std::array<double, 2>, 3> centre, force;
    const double psi = segment.psi_at(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const double* z = basis.values.data() + 4 * k;
      centre[k] = {z[0], z[1]};
      force[k] = model::bearing_force(p, psi, z);
    }
    const std::array<double, 2> rest = model::rest_position(p, psi);
    for (std::size_t i = 0; i < 2; ++i) centre[0][i] -= rest[i];
    radius_.add(centre);
    speeds_.push_back(segment.speed_at(t));
    force_.add(force);
    force[0][1] += model::total_weight(p);
    if (p.gravity != 0.0) dynamic_.add(force);
    if (settings_.work != WorkSource::none) lose(p, t, segment, basis);
  };
  const auto status = integrate_clamped(p, segments, initial, tolerance, at_release, times_, observe,
                                        std::numeric_limits<double>::infinity(), stop);
  if (is_set(stop)) {
    times_.clear();
    return;
  }
  if (status != IntegrationStatus::done || radius_.coefficient[0].size() != times_.size())
    throw RunError("the clamped spin-up could not be integrated");
  if (!proportional_) return;
  const Monomials one{1.0, 1.0, 0.0, 1.0, 0.0, 0.0};
  radius_peak_ = radius_.largest(one);
  radius_place_ = radius_.place_of(one, radius_peak_);
  force_peak_ = force_.largest(one);
}

// Trapezoidal rule: power oscillates with at least 32 grid times a period, so errors cancel except at a segment's ends.
void ClampedTransients::lose(const model::Parameters& p, double t, const model::Segment& segment,
                             const ClampedBasis& basis) {
  std::array<std::array<double, 2>, 3> rate;
  const double psi = segment.psi_at(t);
  for (std::size_t k = 0; k < 3; ++k) {
    const double* z = basis.values.data() + 4 * k;
    rate[k] = model::in_fixed_axes(std::cos(psi), std::sin(psi), z[model::index::u], z[model::index::v]);
    for (std::size_t i = 0; i < 2; ++i) rate[k][i] *= std::sqrt(p.damping[i]);
  }
  const Monomials power = Squares::of(rate);
  if (losses_.empty()) begin_ = basis;
  if (losses_.empty() || losses_.back().segment.begin != segment.begin)
    losses_.push_back({segment, t, basis, power, {}});
  Losses& here = losses_.back();
  for (std::size_t j = 0; j < power.size(); ++j) here.energy[j] += 0.5 * (t - here.until) * (here.power[j] + power[j]);
  here.until = t;
  here.end = basis;
  here.power = power;
}

DriveWork ClampedTransients::work(const model::Parameters& p, const double* phi, const Monomials& m) const {
  DriveWork work;
  if (losses_.empty()) return work;
  double z[model::dimension(model::max_balls)] = {};
  std::copy_n(phi, p.balls, z + model::index::phi(0));
  const auto stored = [&](const model::Segment& segment, double t, const ClampedBasis& basis) {
    basis.centre(p, phi, z);
    return model::energy(p, p.inertia, segment, t, z);
  };
  const auto of = [&](const Monomials& c) { return std::inner_product(m.begin(), m.end(), c.begin(), 0.0); };
  work.begun = true;
  work.stored = stored(losses_.front().segment, losses_.front().segment.begin, begin_);
  for (const Losses& one : losses_) {
    if (&one != &losses_.front() && one.segment.acceleration != (&one - 1)->segment.acceleration) work.end_piece();
    const double now = stored(one.segment, one.until, one.end);
    work.piece += now - work.stored + of(one.energy);
    work.stored = now;
    work.power = of(one.power);
  }
  return work;
}

TransientSums ClampedTransients::sums(const model::Parameters& p, const double* phi) const {
  TransientSums result;
  if (times_.empty()) return result;
  const std::complex<double> unbalance = model::unbalance(p, phi);
  const double ux = unbalance.real(), uy = unbalance.imag();
  const Monomials m{1.0, ux, uy, ux * ux, ux * uy, uy * uy};
  const double square = ux * ux + uy * uy;
  result.end = settings_.release;
  result.work = work(p, phi, m);
  result.clamped_peak.square = proportional_ ? square * radius_peak_ : radius_.largest(m);
  const std::size_t there = proportional_ ? radius_place_ : radius_.place_of(m, result.clamped_peak.square);
  result.clamped_peak.time = times_[there];
  result.clamped_peak.speed = speeds_[there];
  result.force_peak = proportional_ ? square * force_peak_ : force_.largest(m);
  result.dynamic_peak = dynamic_.coefficient[0].empty() ? result.force_peak : dynamic_.largest(m);
  const double limit = settings_.displacement * settings_.displacement;
  if (!(result.clamped_peak.square > limit)) return result;
  // r^2 is taken as linear between grid times.
  double from = radius_.at(m, 0) - limit;
  for (std::size_t k = 1; k < times_.size(); ++k) {
    const double to = radius_.at(m, k) - limit;
    result.time_above += (times_[k] - times_[k - 1]) * HWY_NAMESPACE::transient::share_above(from, to);
    from = to;
  }
  return result;
}

}  // namespace equipoise
