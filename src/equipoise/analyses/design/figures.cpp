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

using study::Dimension;

constexpr double no_end = std::numeric_limits<double>::infinity();

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

// A lost start has no figure, and the drive's work into balance exists only for starts that end balanced.
DesignEstimate transient_quantile(std::size_t figure, double q, const StartArrays& starts) {
  std::vector<double> values;
  const bool until_balance = transient_figures[figure].value == &TransientRow::energy;
  const std::vector<float>& column = starts.transients[figure];
  for (std::size_t i = 0; i < column.size(); ++i) {
    const bool none = std::isnan(column[i]) || (until_balance && starts.outcome[i] != 1);
    values.push_back(none ? no_end : static_cast<double>(column[i]));
  }
  return quantile_of(values, q);
}

DesignEstimate time_to_balance(double q, const StartArrays& starts) {
  std::vector<double> values;
  for (std::size_t i = 0; i < starts.outcome.size(); ++i)
    values.push_back(starts.outcome[i] == 1 ? starts.decision_time[i] : no_end);
  return quantile_of(values, q);
}

DesignEstimate estimate(const Share& s) { return {s.share, s.low, s.high}; }

// Undecided starts may still come to keep them, or to exceed them.
DesignEstimate limits_kept_share(Within part, const TransientGroup& all) {
  const Share share =
      (part == Within::both ? all.kept() : all.within[static_cast<std::size_t>(part)]).value_or(Share{});
  return {share.share, share.least, share.most};
}

double acceleration_of(const model::SpeedProfile& ramp) {
  double most = ramp.hill ? ramp.hill->steepest() : 0.0;
  for (std::size_t k = 1; k < ramp.times.size(); ++k)
    most = std::max(most, std::fabs(ramp.speeds[k] - ramp.speeds[k - 1]) / (ramp.times[k] - ramp.times[k - 1]));
  return most;
}

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
  double quantile = 0.0;
  const auto at = std::find_if(transient_figures.begin(), transient_figures.end(),
                               [&](const TransientFigure& c) { return column == c.name; });
  if (column == "time_to_balance") {
    source.dimension = Dimension::time;
  } else if (at != transient_figures.end()) {
    source.dimension = at->dimension;
    source.transients = true;
  } else {
    return std::nullopt;
  }
  const std::string q = dot == std::string::npos ? "" : name.substr(dot + 1);
  const auto read = read_number(q.data(), q.data() + q.size(), quantile);
  if (q.empty() || read.error != std::errc() || read.end != q.data() + q.size() || !(quantile > 0.0 && quantile < 1.0))
    problem = fmt::format("must end in a quantile between 0 and 1: \"{0}.0.5\", the median, or \"{0}.0.95\"", column);
  else if (column == "settling_time" && !study.limits.settled)
    problem = "needs limits.settled; must be stated in the study";
  else if (column == "time_above" && !study.limits.displacement)
    problem = "needs limits.displacement; must be stated in the study";
  else if (column == "energy")
    problem = lack_of_energy(study, variables);
  if (!problem.empty()) return std::nullopt;
  source.by_outcome = true;
  const auto figure = static_cast<std::size_t>(at - transient_figures.begin());
  if (source.transients)
    source.measured = [figure, quantile](const BasinResult& basin) {
      return transient_quantile(figure, quantile, *basin.every_start);
    };
  else
    source.measured = [quantile](const BasinResult& basin) { return time_to_balance(quantile, *basin.every_start); };
  return source;
}

constexpr std::string_view limits_kept = "limits_kept";

// "limits_kept", "limits_kept_at_end", "limits_kept_on_the_way"
std::optional<FigureSource> limits_source(const std::string& name, const Study& study, std::string& problem) {
  FigureSource source;
  source.figure.up = source.figure.share = source.transients = source.by_outcome = true;
  Within within = Within::both;
  bool known = name == limits_kept;
  for (const Within part : {Within::at_end, Within::on_the_way})
    if (name == fmt::format("{}_{}", limits_kept, within_names[static_cast<std::size_t>(part)])) {
      within = part;
      known = true;
    }
  if (!known) return std::nullopt;
  const bool some = std::any_of(transient_limits.begin(), transient_limits.end(), [&](const TransientLimit& l) {
    return study.limits.*l.limit && (within != Within::on_the_way || !l.at_end);
  });
  if (some || (within != Within::on_the_way && study.limits.settled)) {
    source.measured = [within](const BasinResult& basin) {
      return limits_kept_share(within, basin.transients->groups.front());
    };
    return source;
  }
  problem = within == Within::on_the_way ? "needs limits.displacement, force or clearance; must be stated in the study"
                                         : "needs [limits]; must be stated in the study";
  return std::nullopt;
}

std::optional<FigureSource> plain_source(const std::string& name, const Study& study) {
  FigureSource source;
  source.figure.up = source.figure.share = name == "balanced" || name == "passed";
  if (name == "balanced") {
    source.measured = [](const BasinResult& basin) { return estimate(basin.attractors.front().share); };
  } else if (name == "passed" && study.speed.driven()) {
    source.measured = [](const BasinResult& basin) { return estimate(basin.passed.value_or(Share{})); };
    source.by_outcome = true;
  } else if (name == "ball_mass") {
    source.stated = [](const Study& s, const auto&) { return s.parameters.total_mass(); };
    source.dimension = Dimension::mass;
  } else if (name == "spin_up_time" && !study.speed.driven()) {
    source.stated = [](const Study& s, const auto&) { return s.speed_profile().settled_time(); };
    source.dimension = Dimension::time;
  } else if (name == "acceleration" && !study.speed.driven()) {
    source.stated = [](const Study& s, const auto&) {
      return acceleration_of(s.speed_profile()) * unit_in_study(s, Dimension::time) /
             unit_in_study(s, Dimension::speed);
    };
    if (study.scales) source.figure.unit = "rpm/s";
  } else {
    return std::nullopt;
  }
  return source;
}

std::optional<FigureSource> variable_source(const std::string& name, const StudyValue& tree,
                                            const std::vector<DesignVariable>& variables) {
  FigureSource source;
  source.figure.up = name.front() != '-';
  const std::string key = source.figure.up ? name : name.substr(1);
  const auto at = std::find_if(variables.begin(), variables.end(),
                               [&](const DesignVariable& v) { return v.key == key && !v.spin_up && v.prefix.empty(); });
  if (at == variables.end()) return std::nullopt;
  source.figure.unit = at->unit;
  // The value in the study as it is; NaN: unknown.
  const StudyValue* written = tree.find_path(key);
  const double own = written ? number_in_unit(*written, at->unit) : std::numeric_limits<double>::quiet_NaN();
  source.stated = [key, own](const Study&, const std::vector<DesignSetting>& settings) {
    for (const DesignSetting& s : settings)
      if (s.key == key) return number_of(s.value);
    return own;
  };
  return source;
}

DesignEstimate certain(double value) { return {value, value, value}; }

DesignEstimate scaled(DesignEstimate e, double unit) { return {e.value / unit, e.low / unit, e.high / unit}; }

DesignEstimate stated(const FigureSource& source, const Study& candidate, const std::vector<DesignSetting>& settings) {
  return certain(source.stated(candidate, settings) / unit_in_study(candidate, source.dimension));
}

}  // namespace

double unit_in_study(const Study& study, std::optional<Dimension> dimension) {
  if (!dimension || !study.scales) return 1.0;
  const double shown = study::measure(std::string("1 ") + study::words(*dimension).shown, {*dimension}).value;
  return shown / study::scale_of(*dimension, *study.scales);
}

std::optional<FigureSource> figure_source(const std::string& name, const Study& study, const StudyValue& tree,
                                          const std::vector<DesignVariable>& variables, std::string& problem) {
  std::optional<FigureSource> source = plain_source(name, study);
  if (!source) source = limits_source(name, study, problem);
  if (!source && problem.empty()) source = quantile_source(name, study, variables, problem);
  if (!source && problem.empty() && !name.empty()) source = variable_source(name, tree, variables);
  if (!source) {
    if (problem.empty())
      problem = fmt::format(
          "must be balanced{}, limits_kept, ball_mass, a quantile over starts such as \"peak_radial.0.95\" (of {}), or "
          "a key of [design.vary], with - before it if less is better",
          study.speed.driven() ? ", passed" : ", spin_up_time, acceleration", column_names());
    return std::nullopt;
  }
  source->figure.name = name;
  if (source->dimension && study.scales) source->figure.unit = study::words(*source->dimension).shown;
  return source;
}

DesignSample sample_of(const std::vector<FigureSource>& sources, const BasinResult& basin, const Study& candidate,
                       const std::vector<DesignSetting>& settings) {
  DesignSample sample;
  sample.starts = basin.starts;
  sample.undecided = estimate(basin.undecided);
  sample.note = basin.note;
  for (const FigureSource& source : sources)
    sample.figures.push_back(source.measured
                                 ? scaled(source.measured(basin), unit_in_study(candidate, source.dimension))
                                 : stated(source, candidate, settings));
  return sample;
}

DesignSample sample_without_balance(const std::vector<FigureSource>& sources, std::uint64_t starts,
                                    const Study& candidate, const std::vector<DesignSetting>& settings) {
  DesignSample sample;
  sample.starts = starts;
  sample.note = "no balanced state attracts";
  for (const FigureSource& source : sources)
    sample.figures.push_back(source.figure.share ? certain(0.0)
                             : source.measured   ? certain(no_end)
                                                 : stated(source, candidate, settings));
  return sample;
}

}  // namespace equipoise
