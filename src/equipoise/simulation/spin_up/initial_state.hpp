// From a start's index to its initial values, and from those to a state of the equations.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/balance/coincident_balls.hpp"
#include "equipoise/machine/balance/room_in_race.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {

/// Writes dimension(balls) numbers: the state of `s` at rotor speed `speed` (psi' at t = 0). For a tilting rotor also
/// the four variables of the tilt, which begin at `tilt`.
inline void initial_state(const InitialState& s, int balls, double speed, double* z, int tilt = -1) {
  z[model::index::x] = s.x;
  z[model::index::y] = s.y;
  const std::array<double, 2> velocity = model::inertial_velocity(speed, s.x, s.y, s.x_dot, s.y_dot);
  z[model::index::u] = velocity[0];
  z[model::index::v] = velocity[1];
  for (int i = 0; i < balls; ++i) {
    z[model::index::phi(i)] = s.phi[i];
    z[model::index::q(i, balls)] = s.phi_dot[i];
  }
  if (tilt < 0) return;
  z[tilt] = s.tilt_x;
  z[tilt + 1] = s.tilt_y;
  const std::array<double, 2> rate = model::inertial_velocity(speed, s.tilt_x, s.tilt_y, s.tilt_x_dot, s.tilt_y_dot);
  z[tilt + 2] = rate[0];
  z[tilt + 3] = rate[1];
}

/// Sets alike balls in one place a few 1e-9 apart, as all simulations do.
inline InitialState parted(const model::Parameters& p, InitialState s) {
  model::part_coincident(p, s.phi.data(), s.phi_dot.data());
  return s;
}
inline std::vector<InitialState> parted(const model::Parameters& p, std::span<const InitialState> given) {
  std::vector<InitialState> starts(given.begin(), given.end());
  for (InitialState& s : starts) model::part_coincident(p, s.phi.data(), s.phi_dot.data());
  return starts;
}

/// Whether exchanging balls changes no start's probability and no outcome: alike balls with equal rates.
inline bool balls_exchange(const Study& study) {
  const auto& rates = study.initial.phi_dot;
  bool alike = study.parameters.equal_balls();
  for (int i = 1; i < study.parameters.balls && !study.sampling.box.phi_dot; ++i) alike = alike && rates[i] == rates[0];
  return alike;
}

inline Sampler sampler_of(const Study& study) {
  return {study.sampling.method.value_or(SamplingMethod::random), study.parameters.balls, study.sampling.starts,
          balls_exchange(study)};
}

/// Start `index` of `seed`: [initial] with drawn ball angles, and with values drawn from [sampling.box].
inline InitialState start_of(const Study& study, const Sampler& sampler, std::uint64_t seed, std::uint64_t index) {
  const int balls = study.parameters.balls;
  const SamplingBox& box = study.sampling.box;
  InitialState s = study.initial;
  sampler.angles(seed, index, s.phi.data());
  if (study.parameters.balls_collide()) make_room(study.parameters, s.phi.data());
  if (box.empty()) return s;
  double fractions[4 + model::max_balls];
  bool drawn[4 + model::max_balls] = {box.x.has_value(), box.y.has_value(), box.x_dot.has_value(),
                                      box.y_dot.has_value()};
  std::fill_n(drawn + 4, balls, box.phi_dot.has_value());
  sampler.fractions(seed, index, 4 + balls, drawn, fractions);
  const auto draw = [&](const std::optional<SamplingBox::Side>& side, int k, double& value) {
    // A weighted mean stays between the bounds even if their difference rounds.
    if (side) value = std::clamp((1.0 - fractions[k]) * side->low + fractions[k] * side->high, side->low, side->high);
  };
  draw(box.x, 0, s.x);
  draw(box.y, 1, s.y);
  draw(box.x_dot, 2, s.x_dot);
  draw(box.y_dot, 3, s.y_dot);
  for (int i = 0; i < balls; ++i) draw(box.phi_dot, 4 + i, s.phi_dot[i]);
  return s;
}
inline std::vector<InitialState> starts_of(const Study& study, const Sampler& sampler, std::uint64_t seed,
                                           std::uint64_t first, std::size_t count) {
  std::vector<InitialState> starts;
  starts.reserve(count);
  for (std::size_t i = 0; i < count; ++i) starts.push_back(start_of(study, sampler, seed, first + i));
  return starts;
}
/// The fractions, from 0 to 1, that start `index` draws for the uncertain values.
inline std::vector<double> drawn_fractions(const Study& study, const Sampler& sampler, std::uint64_t seed,
                                           std::uint64_t index) {
  const SamplingBox& box = study.sampling.box;
  const int wanted = box.x.has_value() + box.y.has_value() + box.x_dot.has_value() + box.y_dot.has_value() +
                     (box.phi_dot ? study.parameters.balls : 0);
  std::vector<double> fractions;
  for (const UncertainValue& value : study.uncertain.values)
    fractions.push_back(sampler.named(seed, index, wanted, static_cast<int>(fractions.size()), value.key));
  return fractions;
}
/// The uncertain values themselves, for drawn_study().
inline std::vector<double> drawn_values(const Study& study, const Sampler& sampler, std::uint64_t seed,
                                        std::uint64_t index) {
  std::vector<double> values = drawn_fractions(study, sampler, seed, index);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = study.uncertain.values[k].at(values[k]);
  return values;
}
/// start_of() with the uncertain values that the start draws; with medians if those make no valid study.
inline InitialState drawn_start_of(const Study& study, const Sampler& sampler, std::uint64_t seed,
                                   std::uint64_t index) {
  if (study.uncertain.empty()) return start_of(study, sampler, seed, index);
  try {
    return start_of(drawn_study(study, drawn_values(study, sampler, seed, index)), sampler, seed, index);
  } catch (const InputError&) {
    return start_of(study, sampler, seed, index);
  }
}
inline InitialState start_of(const Study& study, std::uint64_t seed, std::uint64_t index) {
  return start_of(study, sampler_of(study), seed, index);
}

}  // namespace equipoise
