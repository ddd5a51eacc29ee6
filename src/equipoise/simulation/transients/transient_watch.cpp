// Transients of one trajectory without lanes.
#include "equipoise/simulation/transients/transient_watch.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <span>

#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/balance/tolerance_planes.hpp"
#include "equipoise/machine/model/equation_terms-inl.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/unbalance.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE::transient;
}  // namespace

TurningUnbalance turning_unbalance(const model::Parameters& p, const WatchedShaft& shaft, const double* phi) {
  if (!p.tilts()) {
    const std::complex<double> all = model::unbalance(p, phi);
    return {all.real(), all.imag(), 0.0, 0.0};
  }
  const auto [a, b] = model::unbalances_in_planes(p, shaft.places, phi);
  return {a.real(), a.imag(), b.real(), b.imag()};
}

TransientSample transient_sample(const model::Parameters& p, const WatchedShaft& shaft, double psi, double t,
                                 const double* z, const double* tilt) {
  const double sine = std::sin(psi), cosine = std::cos(psi), sag = model::static_sag(p), slope = model::static_slope(p);
  const std::array<double, 2> all = model::bearing_force(p, psi, z, tilt);  // in fixed axes
  const HWY_NAMESPACE::RotorMotion<double> rotor{0.0, 0.0, sine, cosine};
  const bool each = tilt && !shaft.bearings.empty();
  constexpr std::array<double, 4> upright{};
  const double* slopes = tilt ? tilt : upright.data();
  const auto at = [&](std::size_t b) {
    const double place = each ? shaft.bearings[b].at : shaft.places[b];
    std::array<double, 4> section{};
    for (std::size_t k = 0; k < section.size(); ++k) section[k] = z[k] + place * slopes[k];
    const double rest = sag + place * slope;
    HWY_NAMESPACE::Vector2<double> force{all[0], all[1]};
    HWY_NAMESPACE::Vector2<double> at_rest{0.0, -model::total_weight(p)};
    if (each) {
      const double load = model::load_at_rest(p, shaft.bearings[b]);
      force = HWY_NAMESPACE::BearingForce<double>(shaft.bearings[b]).of(rotor, section.data());
      at_rest = {load * sine, load * cosine};
    }
    return kernels::sample_of<double>({sine, cosine}, rest, at_rest, force, section.data());
  };
  TransientSample sample{t, turning_unbalance(p, shaft, z + model::index::phi(0)), {}};
  sample.count = tilt ? std::max(shaft.places.size(), shaft.bearings.size()) : 1;
  for (std::size_t b = 0; b < sample.count; ++b) sample.places[b] = at(b);
  return sample;
}

TransientWatch::TransientWatch(const TransientSettings& settings, const TransientSums& sums)
    : settings_(settings), limits_(settings), sums_(sums), t_(sums.end) {
  gathered_.load(0, sums_, free_);
}

void TransientWatch::begin(const TransientSample& first, bool free) {
  if (free != free_) {
    gathered_.store(0, t_, sums_, free_);
    gathered_.load(0, sums_, free);
    free_ = free;
  }
  limits_.settling = free && settings_.watches_settling();
  if (!begun_) gathered_.resume(0, sums_, first.t, first.places[0]);
  gathered_.stand(0, first.t, std::span(first.places).first(first.count), first.unbalance);
  t_ = first.t;
  if (!begun_) gathered_.restart(0, t_);
  begun_ = true;
}

void TransientWatch::step(const std::array<TransientSample, 3>& samples) {
  const double begin = t_;
  t_ = samples[2].t;
  const double h = t_ - begin;
  Gather::Turning unbalance;
  std::copy(samples[2].unbalance.begin(), samples[2].unbalance.end(), unbalance.part);
  using Step = kernels::Sample<double>[3];
  const auto put = [&](std::size_t k, Step& step) {
    for (std::size_t i = 0; i < 3; ++i) step[i] = samples[i].places[k];
  };
  Step at, other;
  put(0, at);
  if (samples[0].count > 1) {
    put(1, other);
    gathered_.add(limits_, 1, true, begin, t_, h, at, other, unbalance);
  } else {
    gathered_.add(limits_, 1, true, begin, t_, h, at, unbalance);
  }
  for (std::size_t k = 2; k < samples[0].count; ++k) {
    put(k, other);
    gathered_.add_place(static_cast<int>(k), limits_, 1, true, begin, t_, h, other, unbalance);
  }
}

void TransientWatch::end_piece() { gathered_.end_piece(0); }

TransientSums TransientWatch::sums() const {
  TransientSums result = sums_;
  gathered_.store(0, t_, result, free_);
  return result;
}

}  // namespace equipoise
