// Checks the caller's starts before any is followed.
#include "equipoise/classification/start_runs/checks.hpp"

#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/balance/room_in_race.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/results/io/checksum.hpp"

namespace equipoise {

namespace {

struct Quantity {
  const char* key;
  double InitialState::*value;
};
constexpr Quantity rotor[] = {{"psi", &InitialState::psi},
                              {"x", &InitialState::x},
                              {"y", &InitialState::y},
                              {"x_dot", &InitialState::x_dot},
                              {"y_dot", &InitialState::y_dot}};

void check_start(const Study& study, const InitialState& s, std::size_t number) {
  const model::Parameters& p = study.parameters;
  constexpr int of_rotor = -1;
  const auto require = [&](bool holds, const char* key, int ball, double value, const char* problem,
                           const auto&... values) {
    if (holds) return;
    const std::string of_ball = ball == of_rotor ? "" : fmt::format("[{}]", ball);
    throw InputError(fmt::format("start {}", number), fmt::format("initial.{}{}", key, of_ball),
                     fmt::format("{}", value), fmt::format(fmt::runtime(problem), values...));
  };
  const auto as_common = [&](const Quantity& q, const char* why) {
    const double common = study.initial.*q.value;
    require(s.*q.value == common, q.key, of_rotor, s.*q.value, "must be {}, as in [initial], {}", common, why);
  };
  for (const Quantity& q : rotor)
    require(std::isfinite(s.*q.value), q.key, of_rotor, s.*q.value, "must be a finite number");
  for (int i = 0; i < model::max_balls; ++i)
    for (const auto& [key, value] : {std::pair{"phi", s.phi[i]}, std::pair{"phi_dot", s.phi_dot[i]}}) {
      require(std::isfinite(value), key, i, value, "must be a finite number");
      require(i < p.balls || value == 0.0, key, i, value, "must be 0: the study has {} balls", p.balls);
    }
  const bool clamped = study.release_time() > 0.0, prescribed = !study.speed.driven();
  if (prescribed && model::depends_on_rotor_angle(p))
    as_common(rotor[0], "where the rotor turns as prescribed, and its angle matters");
  for (std::size_t k = 1; clamped && prescribed && k < std::size(rotor); ++k)
    as_common(rotor[k], "if the rotor turns as prescribed until the balls are released");
  for (int i = 0; clamped && i < p.balls; ++i)
    require(s.phi_dot[i] == 0.0, "phi_dot", i, s.phi_dot[i], "must be 0: the balls are clamped until their release");
  require(!model::overlap(p, s.phi.data()), "phi", of_rotor, s.phi[0],
          "balls overlap; must be at least {} rad apart, as balls are that touch", p.contact_angle);
}

}  // namespace

void check_takes_starts(const Study& study) {
  if (!study.uncertain.empty())
    throw InputError(study.name, study.uncertain.values.front().key, "",
                     "is uncertain; starts of your own need a study without uncertain values");
}

void check_given_starts(const Study& study, std::span<const InitialState> given) {
  for (std::size_t i = 0; i < given.size(); ++i) check_start(study, given[i], i);
}

std::string checksum_of(const Study& study, std::span<const InitialState> given) {
  const std::size_t angles = static_cast<std::size_t>(study.parameters.balls) * sizeof(double);
  io::Checksum sum;
  for (const InitialState& s : given) {
    for (const Quantity& q : rotor) sum.add(&(s.*q.value), sizeof(double));
    sum.add(s.phi.data(), angles);
    sum.add(s.phi_dot.data(), angles);
  }
  return fmt::format("{} with checksum {:016x}", given.size(), sum.value());
}

}  // namespace equipoise
