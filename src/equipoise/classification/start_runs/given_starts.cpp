// Checks the caller's starts before any is followed.
#include "equipoise/classification/start_runs/checks.hpp"

#include <cmath>

#include <fmt/format.h>

#include "equipoise/attractors/periodic_orbits/return_map.hpp"
#include "equipoise/core/base/error.hpp"
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

class GivenStart {
 public:
  GivenStart(const Study& study, const InitialState& state, std::size_t number)
      : study_(study), s_(state), number_(number) {}

  void check() const {
    check_numbers();
    const InitialState& common = study_.initial;
    const bool clamped = study_.release_time() > 0.0, prescribed = !study_.speed.driven();
    if (prescribed && model::depends_on_rotor_angle(study_.parameters))
      require("psi", s_.psi, common.psi, "where the rotor turns as prescribed, and its angle matters");
    if (clamped && prescribed)
      for (const Quantity& q : std::span(rotor).subspan(1))
        require(q.key, s_.*q.value, common.*q.value, "where the rotor turns as prescribed until the balls are let go");
    for (int i = 0; clamped && i < study_.parameters.balls; ++i)
      if (s_.phi_dot[i] != 0.0)
        fail("phi_dot", s_.phi_dot[i], "must be 0: the balls are clamped until their release", i);
    if (overlap(study_.parameters, s_.phi.data()))
      fail("phi", s_.phi[0],
           fmt::format("balls overlap; must be at least {} rad apart, as balls are that touch",
                       study_.parameters.contact_angle));
  }

 private:
  void check_numbers() const {
    for (const Quantity& q : rotor) finite(q.key, s_.*q.value);
    for (int i = 0; i < model::max_balls; ++i) {
      finite("phi", s_.phi[i], i);
      finite("phi_dot", s_.phi_dot[i], i);
      if (i < study_.parameters.balls) continue;
      absent("phi", s_.phi[i], i);
      absent("phi_dot", s_.phi_dot[i], i);
    }
  }

  [[noreturn]] void fail(const char* key, double value, const std::string& problem, int ball = -1) const {
    const std::string of_ball = ball < 0 ? "" : fmt::format("[{}]", ball);
    throw InputError(fmt::format("start {}", number_), fmt::format("initial.{}{}", key, of_ball),
                     fmt::format("{}", value), problem);
  }
  void finite(const char* key, double value, int ball = -1) const {
    if (!std::isfinite(value)) fail(key, value, "must be a finite number", ball);
  }
  void absent(const char* key, double value, int ball) const {
    if (value != 0.0) fail(key, value, fmt::format("must be 0: the study has {} balls", study_.parameters.balls), ball);
  }
  void require(const char* key, double value, double common, const char* why) const {
    if (value != common) fail(key, value, fmt::format("must be {}, as in [initial], {}", common, why));
  }

  const Study& study_;
  const InitialState& s_;
  std::size_t number_;
};

}  // namespace

void check_takes_starts(const Study& study) {
  if (!study.uncertain.empty())
    throw InputError(study.name, study.uncertain.values.front().key, "",
                     "is uncertain; starts of one's own need a study without uncertain values");
}

void check_given_starts(const Study& study, std::span<const InitialState> given) {
  for (std::size_t i = 0; i < given.size(); ++i) GivenStart(study, given[i], i).check();
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
