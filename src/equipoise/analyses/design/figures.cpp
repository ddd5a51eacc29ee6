// Shares, quantiles over starts, and figures that follow from the study alone.
#include "equipoise/analyses/design/problem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "equipoise/analyses/design/settings.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/core/statistics/quantile.hpp"
#include "equipoise/results/columns/transient_figures.hpp"

namespace equipoise {

namespace {

using FigureKind = FigureSource::Kind;
using study::Dimension;

constexpr double no_end = std::numeric_limits<double>::infinity();

std::string column_names() {
  std::string names = "time_to_balance";
  for (const TransientFigure& c : transient_figures) names += fmt::format(", {}", c.name);
  return names;
}

// Why the drive's work is unknown; empty: it is known.
std::string lack_of_energy(const Study& study, const std::vector<DesignVariable>& variables) {
  const bool spins_up =
      std::any_of(variables.begin(), variables.end(), [](const DesignVariable& v) { return v.spin_up; });
  if (!study.speed.driven() && !study.system().smooth())
    return "must be another figure: at a prescribed speed the work that collisions and dry friction take is not known "
           "(of a motor, profile \"torque\", it is)";
  if (!knows_energy(study) || (spins_up && !(study.parameters.inertia > 0.0)))
    return "needs rotor.inertia, which a change of speed has to work against; must be stated in the study";
  return "";
}

// "peak_radial.0.95"
std::optional<FigureSource> quantile_source(const std::string& name, const Study& study,
                                            const std::vector<DesignVariable>& variables, std::string& problem) {
  const std::size_t dot = name.find('.');
  const std::string column = name.substr(0, dot);
  FigureSource source;
  const auto at = std::find_if(transient_figures.begin(), transient_figures.end(),
                               [&](const TransientFigure& c) { return column == c.name; });
  if (column == "time_to_balance") {
    source.kind = FigureKind::time_to_balance;
    source.dimension = Dimension::time;
  } else if (at != transient_figures.end()) {
    source.kind = FigureKind::transient;
    source.column = static_cast<std::size_t>(at - transient_figures.begin());
    source.dimension = transient_figures[source.column].dimension;
  } else {
    return std::nullopt;
  }
  const std::string q = dot == std::string::npos ? "" : name.substr(dot + 1);
  const auto read = read_number(q.data(), q.data() + q.size(), source.quantile);
  if (q.empty() || read.error != std::errc() || read.end != q.data() + q.size() ||
      !(source.quantile > 0.0 && source.quantile < 1.0))
    problem = fmt::format("must end in a quantile between 0 and 1: \"{0}.0.5\", the median, or \"{0}.0.95\"", column);
  else if (column == "settling_time" && !study.limits.settled)
    problem = "needs limits.settled; must be stated in the study";
  else if (column == "time_above" && !study.limits.displacement)
    problem = "needs limits.displacement; must be stated in the study";
  else if (column == "energy")
    problem = lack_of_energy(study, variables);
  if (!problem.empty()) return std::nullopt;
  return source;
}

constexpr std::string_view limits_kept = "limits_kept";

// "limits_kept", "limits_kept_at_end", "limits_kept_on_the_way"
std::optional<FigureSource> limits_source(const std::string& name, const Study& study, std::string& problem) {
  FigureSource source;
  source.kind = FigureKind::limits_kept;
  source.figure.up = source.figure.share = true;
  bool known = name == limits_kept;
  for (const Within part : {Within::at_end, Within::on_the_way})
    if (name == fmt::format("{}_{}", limits_kept, within_names[static_cast<std::size_t>(part)])) {
      source.within = part;
      known = true;
    }
  if (!known) return std::nullopt;
  const bool some = std::any_of(transient_limits.begin(), transient_limits.end(), [&](const TransientLimit& l) {
    return study.limits.*l.limit && (source.within != Within::on_the_way || !l.at_end);
  });
  if (some || (source.within != Within::on_the_way && study.limits.settled)) return source;
  problem = source.within == Within::on_the_way
                ? "needs limits.displacement, force or clearance; must be stated in the study"
                : "needs [limits]; must be stated in the study";
  return std::nullopt;
}

std::optional<FigureSource> plain_source(const std::string& name, const Study& study) {
  FigureSource source;
  source.figure.up = source.figure.share = name == "balanced" || name == "passed";
  if (name == "balanced") {
    source.kind = FigureKind::balanced;
  } else if (name == "passed" && study.speed.driven()) {
    source.kind = FigureKind::passed;
  } else if (name == "ball_mass") {
    source.kind = FigureKind::ball_mass;
    source.dimension = Dimension::mass;
  } else if (name == "spin_up_time" && !study.speed.driven()) {
    source.kind = FigureKind::spin_up_time;
    source.dimension = Dimension::time;
  } else if (name == "acceleration" && !study.speed.driven()) {
    source.kind = FigureKind::acceleration;
  } else {
    return std::nullopt;
  }
  return source;
}

std::optional<FigureSource> variable_source(const std::string& name, const std::vector<DesignVariable>& variables) {
  FigureSource source;
  source.kind = FigureKind::variable;
  source.figure.up = name.front() != '-';
  source.key = source.figure.up ? name : name.substr(1);
  const auto at = std::find_if(variables.begin(), variables.end(), [&](const DesignVariable& v) {
    return v.key == source.key && !v.spin_up && v.prefix.empty();
  });
  if (at == variables.end()) return std::nullopt;
  source.figure.unit = at->unit;
  return source;
}

DesignEstimate certain(double value) { return {value, value, value}; }

// The `q`-quantile of values, some of which may be infinite; sorts them.
DesignEstimate quantile_of(std::vector<double>& values, double q) {
  if (values.empty()) return {no_end, 0.0, no_end};
  std::sort(values.begin(), values.end());
  const auto count = values.size();
  const auto place = static_cast<std::size_t>(std::ceil(q * static_cast<double>(count)));
  const RankInterval ranks = quantile_ranks(count, q);
  return {values[std::clamp<std::size_t>(place, 1, count) - 1], ranks.low > 0 ? values[ranks.low - 1] : 0.0,
          ranks.high <= count ? values[ranks.high - 1] : no_end};
}

DesignEstimate scaled(DesignEstimate e, double unit) { return {e.value / unit, e.low / unit, e.high / unit}; }

// A start that was lost has no figure, and the drive's work into balance exists only for starts that come to it.
DesignEstimate transient_quantile(const FigureSource& source, const StartArrays& starts) {
  std::vector<double> values;
  const bool until_balance = transient_figures[source.column].value == &TransientRow::energy;
  const std::vector<float>& column = starts.transients[source.column];
  for (std::size_t i = 0; i < column.size(); ++i) {
    const bool none = std::isnan(column[i]) || (until_balance && starts.outcome[i] != 1);
    values.push_back(none ? no_end : static_cast<double>(column[i]));
  }
  return quantile_of(values, source.quantile);
}

DesignEstimate time_to_balance(const FigureSource& source, const StartArrays& starts) {
  std::vector<double> values;
  for (std::size_t i = 0; i < starts.outcome.size(); ++i)
    values.push_back(starts.outcome[i] == 1 ? starts.decision_time[i] : no_end);
  return quantile_of(values, source.quantile);
}

double acceleration_of(const model::SpeedProfile& ramp) {
  double most = ramp.hill ? ramp.hill->steepest() : 0.0;
  for (std::size_t k = 1; k < ramp.times.size(); ++k)
    most = std::max(most, std::fabs(ramp.speeds[k] - ramp.speeds[k - 1]) / (ramp.times[k] - ramp.times[k - 1]));
  return most;
}

// Figures that need no start; 0 for all others.
double stated(const FigureSource& source, const Study& study, const std::vector<DesignSetting>& settings) {
  const double unit = unit_in_study(study, source.dimension);
  switch (source.kind) {
    case FigureKind::ball_mass:
      return study.parameters.total_mass() / unit;
    case FigureKind::spin_up_time:
      return study.speed_profile().settled_time() / unit;
    case FigureKind::acceleration:
      return acceleration_of(study.speed_profile()) * unit_in_study(study, Dimension::time) /
             unit_in_study(study, Dimension::speed);
    case FigureKind::variable:
      for (const DesignSetting& s : settings)
        if (s.key == source.key) return number_of(s.value);
      return source.own;
    default:
      return 0.0;
  }
}

}  // namespace

std::string figure_unit(const Study& study, std::optional<Dimension> dimension) {
  return dimension && study.scales ? study::words(*dimension).shown : "";
}

double unit_in_study(const Study& study, std::optional<Dimension> dimension) {
  if (!dimension || !study.scales) return 1.0;
  const double shown = study::measure(std::string("1 ") + study::words(*dimension).shown, {*dimension}).value;
  return shown / study::scale_of(*dimension, *study.scales);
}

std::optional<FigureSource> figure_source(const std::string& name, const Study& study,
                                          const std::vector<DesignVariable>& variables, std::string& problem) {
  std::optional<FigureSource> source = plain_source(name, study);
  if (!source) source = limits_source(name, study, problem);
  if (!source && problem.empty()) source = quantile_source(name, study, variables, problem);
  if (!source && problem.empty() && !name.empty()) source = variable_source(name, variables);
  if (!source) {
    if (problem.empty())
      problem = fmt::format(
          "must be balanced{}, limits_kept, ball_mass, a quantile over starts such as \"peak_radial.0.95\" (of {}), or "
          "a key of [design.vary], with - before it if less is better",
          study.speed.driven() ? ", passed" : ", spin_up_time, acceleration", column_names());
    return std::nullopt;
  }
  source->figure.name = name;
  if (source->dimension) source->figure.unit = figure_unit(study, source->dimension);
  if (source->kind == FigureKind::acceleration && study.scales) source->figure.unit = "rpm/s";
  return source;
}

DesignSample sample_of(const std::vector<FigureSource>& sources, const BasinResult& basin, const Study& candidate,
                       const std::vector<DesignSetting>& settings) {
  const auto estimate = [](const Share& s) { return DesignEstimate{s.share, s.low, s.high}; };
  const auto kept = [&](Within part) {  // undecided starts may still come to it, or lose it
    const TransientGroup& all = basin.transients->groups.front();
    const Share share =
        (part == Within::both ? all.kept() : all.within[static_cast<std::size_t>(part)]).value_or(Share{});
    return DesignEstimate{share.share, share.least, share.most};
  };
  DesignSample sample;
  sample.starts = basin.starts;
  sample.undecided = estimate(basin.undecided);
  sample.note = basin.note;
  for (const FigureSource& source : sources) {
    const double unit = unit_in_study(candidate, source.dimension);
    if (source.kind == FigureKind::balanced)
      sample.figures.push_back(estimate(basin.attractors.front().share));
    else if (source.kind == FigureKind::passed)
      sample.figures.push_back(estimate(basin.passed.value_or(Share{})));
    else if (source.kind == FigureKind::limits_kept)
      sample.figures.push_back(kept(source.within));
    else if (source.kind == FigureKind::transient)
      sample.figures.push_back(scaled(transient_quantile(source, *basin.every_start), unit));
    else if (source.kind == FigureKind::time_to_balance)
      sample.figures.push_back(scaled(time_to_balance(source, *basin.every_start), unit));
    else
      sample.figures.push_back(certain(stated(source, candidate, settings)));
  }
  return sample;
}

DesignSample sample_without_balance(const std::vector<FigureSource>& sources, std::uint64_t starts,
                                    const Study& candidate, const std::vector<DesignSetting>& settings) {
  DesignSample sample;
  sample.starts = starts;
  sample.note = "no balanced state attracts";
  for (const FigureSource& source : sources) {
    const bool endless = source.kind == FigureKind::transient || source.kind == FigureKind::time_to_balance;
    sample.figures.push_back(certain(source.figure.share ? 0.0
                                     : endless           ? no_end
                                                         : stated(source, candidate, settings)));
  }
  return sample;
}

}  // namespace equipoise
