// One distribution for every figure and outcome; what exceeds a limit is counted.
#include "equipoise/run/transient_tally.hpp"

#include <cmath>
#include <limits>

namespace equipoise {

namespace {
constexpr float endless = std::numeric_limits<float>::infinity();
constexpr double exceeds_nothing = std::numeric_limits<double>::infinity();

std::string name_of(Outcome outcome) { return outcome == Outcome::stalled ? "stalled" : "undecided"; }
}  // namespace

TransientSettings transient_settings(const Study& study) {
  TransientSettings settings;
  if (study.limits.displacement) settings.displacement = *study.limits.displacement;
  if (study.limits.settled) settings.settled = *study.limits.settled;
  settings.release = study.release_time();
  return settings;
}

TransientTally::TransientTally(const Study& study, const Sampler& sampler)
    : limits_(study.limits), settings_(transient_settings(study)), sampler_(sampler), seed_(study.sampling.seed) {}

void TransientTally::add(const Fate& fate, const TransientRow& row) {
  const double weight = sampler_.weight(seed_, total_++);
  if (std::isnan(row.peak_radial)) {
    ++lost_;
    return;
  }
  const bool attracted = fate.outcome == Outcome::attracted;
  Line& line = lines_[{static_cast<int>(fate.outcome), attracted ? fate.attractor : 0}];
  ++line.count;
  line.weight += weight;
  line.weight_squared += weight * weight;
  if (std::isfinite(fate.mean_speed)) {
    line.speed += weight * std::fabs(fate.mean_speed);
    line.speed_weight += weight;
  }
  for (std::size_t k = 0; k < transient_columns.size(); ++k) {
    float value = row.*transient_columns[k].value;
    // A rotor that still exceeds the limit when it is last seen goes on exceeding it.
    if (transient_columns[k].value == &TransientRow::time_above && row.peak_radial_at_end > settings_.displacement)
      value = endless;
    line.figures[k].add(value, weight);
  }
  const std::array<std::pair<float, std::optional<double>>, 3> asked{
      {{row.peak_radial, limits_.displacement}, {row.peak_force, limits_.force}, {row.rms_velocity, limits_.velocity}}};
  for (std::size_t k = 0; k < asked.size(); ++k)
    if (asked[k].first > asked[k].second.value_or(exceeds_nothing)) {
      ++line.exceeding[k];
      line.exceeding_weight[k] += weight;
    }
}

void TransientTally::Line::merge(const Line& other) {
  count += other.count;
  weight += other.weight;
  weight_squared += other.weight_squared;
  speed += other.speed;
  speed_weight += other.speed_weight;
  for (std::size_t k = 0; k < figures.size(); ++k) figures[k].merge(other.figures[k]);
  for (std::size_t k = 0; k < exceeding.size(); ++k) {
    exceeding[k] += other.exceeding[k];
    exceeding_weight[k] += other.exceeding_weight[k];
  }
}

TransientGroup TransientTally::group(const Line& line) const {
  TransientGroup result;
  result.starts = line.count;
  if (line.speed_weight > 0.0) result.mean_speed = line.speed / line.speed_weight;
  for (std::size_t k = 0; k < line.figures.size(); ++k) result.figures[k] = line.figures[k].summary();
  const std::array<std::optional<double>, 3> limits{limits_.displacement, limits_.force, limits_.velocity};
  for (std::size_t k = 0; k < limits.size(); ++k)
    if (limits[k])
      result.exceeded[k] =
          wilson_share(line.exceeding[k], line.count, line.exceeding_weight[k], line.weight, line.weight_squared);
  return result;
}

TransientResult TransientTally::result(const Catalogue& catalogue) const {
  TransientResult result{settings_, lost_, {}};
  Line all;
  for (const auto& [key, line] : lines_) all.merge(line);
  result.groups.push_back(group(all));
  result.groups.back().name = "all";
  for (const auto& [key, line] : lines_) {
    TransientGroup one = group(line);
    one.id = key.second;
    const Attractor* a = key.second > 0 ? catalogue.find(key.second) : nullptr;
    one.name = a ? a->name : name_of(static_cast<Outcome>(key.first));
    result.groups.push_back(one);
  }
  return result;
}

}  // namespace equipoise
