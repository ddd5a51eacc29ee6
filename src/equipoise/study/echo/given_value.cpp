// Units of values given next to a study.
#include "equipoise/study/echo/given_value.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/read_number.hpp"
#include "equipoise/study/contents/keys.hpp"

namespace equipoise::study {

std::optional<ValueUnit> unit_of(const Study& study, Dimension dimension) {
  if (!study.scales) return std::nullopt;
  return ValueUnit{dimension, scale_of(dimension, *study.scales)};
}

std::optional<ValueUnit> unit_of(const Study& study, const std::string& key) {
  const Key* quantity = find_key(key, false).key;
  if (!quantity || !quantity->dimension) return std::nullopt;
  auto unit = unit_of(study, *quantity->dimension);
  if (key != "balancer.drag" || !unit) return unit;
  const model::Parameters& p = study.parameters;
  if (!std::equal(p.mass.begin() + 1, p.mass.begin() + p.balls, p.mass.begin())) return std::nullopt;
  unit->scale *= p.mass.front();  // D = beta m R^2 omega_c
  unit->other = Dimension::damping;
  unit->other_scale = scale_of(Dimension::damping, *study.scales) * p.mass.front();
  return unit;
}

GivenValue read_given(const std::string& text, const std::optional<ValueUnit>& unit) {
  GivenValue given;
  const char* end = text.data() + text.size();
  const auto [after, error] = read_number(text.data(), end, given.value);
  if (error == std::errc() && after == end && std::isfinite(given.value)) return given;
  if (!unit) {
    given.problem = "is not a plain number";
    return given;
  }
  std::vector<Dimension> wanted{unit->dimension};
  if (unit->other) wanted.push_back(*unit->other);
  const Measured measured = measure(text, wanted);
  const bool other = unit->other && measured.dimension == *unit->other;
  given.value = measured.value / (other ? unit->other_scale : unit->scale);
  given.problem = measured.problem;
  return given;
}

std::string in_own_unit(double value, Dimension dimension, const std::optional<model::Scales>& scales) {
  const ShownUnit unit = shown_unit(dimension, scales);
  return scales ? fmt::format("{:.6g} {}", value * unit.size, unit.name) : fmt::format("{}", value);
}

StatedValue stated_release(const Study& study) {
  const SpeedSetting& speed = study.speed;
  if (study.release.speed) return {"release.speed", in_own_unit(*study.release.speed, Dimension::speed, study.scales)};
  const auto time = [&](const char* key, double t) {
    return StatedValue{key, in_own_unit(t, Dimension::time, study.scales)};
  };
  if (study.release.time) return time("release.time", *study.release.time);
  switch (speed.profile) {
    case Profile::trapezoid:
      return time("speed.rise_until", speed.rise_until);
    case Profile::points:
      return time("speed.times", speed.times.back());
    case Profile::hill:
      return speed.until ? time("speed.until", *speed.until) : time("speed.half_time", speed.half_time);
    default:
      return time(study.states("speed.run_up") ? "speed.run_up" : "speed.duration", speed.duration);
  }
}

}  // namespace equipoise::study
