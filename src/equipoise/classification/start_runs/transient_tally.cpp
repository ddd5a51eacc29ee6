// Counts figures by outcome: a distribution for each, and the starts that exceed limits.
#include "equipoise/classification/start_runs/transient_tally.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/results/columns/transient_figures.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

TransientSettings transient_settings(const Study& study) {
  TransientSettings settings;
  if (study.limits.displacement) settings.displacement = *study.limits.displacement;
  if (study.limits.settled) settings.settled = *study.limits.settled;
  settings.release = study.release_time();
  settings.shaft = watched_shaft(study);
  settings.by_direction = model::depends_on_rotor_angle(study.parameters);
  if (knows_energy(study)) settings.work = study.speed.driven() ? WorkSource::motor : WorkSource::balance;
  return settings;
}

TransientSettings transient_settings(const Study& drawn, const TransientSettings& of_all) {
  TransientSettings settings = transient_settings(drawn);
  if (of_all.shaft.bearings.empty()) settings.shaft.bearings.clear();
  return settings;
}

// With contact or dry friction, the energy taken by impacts and friction is not known.
bool knows_energy(const Study& study) {
  if (study.speed.driven()) return true;
  const bool inertia_matters = study.speed.profile != Profile::constant;
  return study.system().smooth() && (!inertia_matters || study.parameters.inertia > 0.0);
}

TransientTally::TransientTally(const Study& study, const Sampler& sampler)
    : limits_(study.limits),
      settings_(transient_settings(study)),
      sampler_(sampler),
      final_speed_(std::fabs(study.speed_profile().final_speed())),
      frequency_(study.scales ? study.scales->frequency : 0.0),
      driven_(study.speed.driven()),
      seed_(study.sampling.seed) {
  for (std::size_t k = 0; k < standard_levels.size(); ++k) levels_[k] = standard_levels[k].level(study);
}

void TransientTally::add(const Outcome& outcome, const TransientRow& row) {
  const double weight = sampler_.weight(seed_, total_++);
  if (first_.size() < most_paired_starts)
    first_.push_back({outcome.kind == OutcomeKind::undecided, weight, row.peak_radial, row.rms_velocity});
  if (std::isnan(row.peak_radial)) {
    ++lost_;
    return;
  }
  const bool attracted = outcome.kind == OutcomeKind::attracted;
  Line& line = lines_[{static_cast<int>(outcome.kind), attracted ? outcome.attractor : 0}];
  ++line.count;
  line.weight += weight;
  line.weight_squared += weight * weight;
  if (std::isfinite(outcome.mean_speed)) {
    line.speed += weight * std::fabs(outcome.mean_speed);
    line.speed_weight += weight;
  }
  for (std::size_t k = 0; k < transient_figures.size(); ++k)
    if (const float value = row.*transient_figures[k].value; !std::isnan(value)) line.figures[k].add(value, weight);
  // Whether a start exceeds a limit for good is known once its motion is.
  const bool known = outcome.kind != OutcomeKind::undecided;
  if (known && row.peak_radial_at_end > settings_.displacement) ++line.lasting;
  if (known && settings_.watches_settling() && row.peak_radial_at_end > settings_.settled) ++line.never;
  count_limits(outcome, row, weight, line);
}

void TransientTally::count_limits(const Outcome& outcome, const TransientRow& row, double weight, Line& line) const {
  const bool open = outcome.kind == OutcomeKind::undecided;
  const double speed = driven_ ? std::fabs(outcome.mean_speed) : final_speed_;
  const LimitsOfStart of = limits_of_start(limits_, row, speed, frequency_);
  for (std::size_t k = 0; k < transient_limits.size(); ++k) {
    const bool stays = !transient_limits[k].at_end && of.exceeded[k];  // of a peak
    line.exceeding[k].add(of.exceeded[k], open && !stays, weight);
    line.exceeding_at_end[k].add(of.exceeded_at_end[k], open, weight);
  }
  for (std::size_t k = 0; k < standard_levels.size(); ++k) {
    if (!levels_[k]) continue;
    const StandardLevel& l = standard_levels[k];
    const bool exceeds = !(row.*l.value <= *levels_[k]);
    line.beyond[k].add(exceeds, open && (l.at_end || !exceeds), weight);
  }
  line.within[static_cast<std::size_t>(Within::at_end)].add(of.at_end, open, weight);
  line.within[static_cast<std::size_t>(Within::on_the_way)].add(of.on_the_way, open && of.on_the_way, weight);
  line.within[static_cast<std::size_t>(Within::both)].add(of.both(), open && of.on_the_way, weight);
}

// Whether some limit is stated that has to be kept then.
bool TransientTally::kept(Within when) const {
  const bool some = std::any_of(transient_limits.begin(), transient_limits.end(), [&](const TransientLimit& l) {
    return limits_.*l.limit && (when == Within::at_end || !l.at_end);
  });
  return some || (when == Within::at_end && limits_.settled);
}

void TransientTally::Line::merge(const Line& other) {
  count += other.count;
  weight += other.weight;
  weight_squared += other.weight_squared;
  speed += other.speed;
  speed_weight += other.speed_weight;
  lasting += other.lasting;
  never += other.never;
  for (std::size_t k = 0; k < figures.size(); ++k) figures[k].merge(other.figures[k]);
  const auto add = [](auto& to, const auto& from) {
    for (std::size_t k = 0; k < to.size(); ++k) to[k].merge(from[k]);
  };
  add(exceeding, other.exceeding);
  add(exceeding_at_end, other.exceeding_at_end);
  add(within, other.within);
  add(beyond, other.beyond);
}

// Bounded by what the undecided starts of the group could still do.
Share TransientTally::share(const Line& line, const Having& having) {
  const auto of = [&](std::uint64_t count, double counted) {
    return wilson_share(count, line.count, counted, line.weight, line.weight_squared);
  };
  const auto& [all, more, fewer] = having;
  Share result = of(all.count, all.weight);
  result.most = of(all.count + more.count, all.weight + more.weight).high;
  result.least = of(all.count - fewer.count, all.weight - fewer.weight).low;
  return result;
}

TransientGroup TransientTally::group(const Line& line) const {
  TransientGroup result;
  result.starts = line.count;
  if (line.speed_weight > 0.0) result.mean_speed = line.speed / line.speed_weight;
  result.lasting = line.lasting;
  result.never = line.never;
  for (std::size_t k = 0; k < line.figures.size(); ++k) result.figures[k] = line.figures[k].summary();
  for (std::size_t k = 0; k < transient_limits.size(); ++k)
    if (limits_.*transient_limits[k].limit) {
      result.exceeded[k] = share(line, line.exceeding[k]);
      result.exceeded_at_end[k] = share(line, line.exceeding_at_end[k]);
    }
  for (std::size_t k = 0; k < standard_levels.size(); ++k)
    if (levels_[k]) result.beyond[k] = share(line, line.beyond[k]);
  for (std::size_t k = 0; k < result.within.size(); ++k)
    if (kept(static_cast<Within>(k))) result.within[k] = share(line, line.within[k]);
  return result;
}

// Undecided starts may come to rest, or to more than any other: 0 or infinity bounds them.
std::array<QuantileEstimate, reported_quantiles.size()> TransientTally::sure_end_velocity() const {
  const std::size_t velocity = figure_place(&TransientRow::rms_velocity);
  Distribution seen, quiet, loud;
  for (const auto& [key, line] : lines_) {
    seen.merge(line.figures[velocity]);
    if (static_cast<OutcomeKind>(key.first) != OutcomeKind::undecided) {
      quiet.merge(line.figures[velocity]);
      loud.merge(line.figures[velocity]);
      continue;
    }
    const double weight = line.weight / static_cast<double>(line.count);
    for (std::uint64_t i = 0; i < line.count; ++i) {
      quiet.add(0.0f, weight);
      loud.add(std::numeric_limits<float>::infinity(), weight);
    }
  }
  auto result = seen.summary().quantiles;
  const auto least = quiet.summary().quantiles, most = loud.summary().quantiles;
  for (std::size_t k = 0; k < result.size(); ++k) {
    result[k].low = least[k].low;
    result[k].high = most[k].high;
  }
  return result;
}

TransientResult TransientTally::result(const Catalogue& catalogue) const {
  TransientResult result{settings_, lost_, {}, first_};
  Line all;
  for (const auto& [key, line] : lines_) all.merge(line);
  result.groups.push_back(group(all));
  result.groups.back().name = "all";
  result.groups.back().sure_end_velocity = sure_end_velocity();
  for (const auto& [key, line] : lines_) {
    TransientGroup one = group(line);
    const auto kind = static_cast<OutcomeKind>(key.first);
    const Attractor* a = key.second > 0 ? catalogue.find(key.second) : nullptr;
    one.id = kind == OutcomeKind::attracted ? key.second : told_of(kind).code;
    one.name = a ? a->name : name_of(kind);
    result.groups.push_back(one);
  }
  return result;
}

}  // namespace equipoise
