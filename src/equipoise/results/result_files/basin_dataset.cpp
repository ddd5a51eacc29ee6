// Dimensions, columns and attributes of an ensemble's results.
#include "equipoise/results/result_files/basin_file.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/results/result_files/basin_outcomes.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/results/result_files/start_columns.hpp"
#include "equipoise/study/sampling/scrambled_sobol.hpp"

namespace equipoise::io {

namespace {

using Type = DataColumn::Type;

// Counts are integers as far as those go, which is enough for any run of this century.
Type count_type(const BasinContents& c) {
  return c.starts <= static_cast<std::uint64_t>(std::numeric_limits<int>::max()) ? Type::integer : Type::real;
}

void describe_grounds(DataColumn& column) {
  for (int k = 0; k < decided_by_count; ++k) column.flags.push_back(k);
  column.attributes.emplace_back("flag_meanings", fmt::format("{}", fmt::join(decided_by_names, " ")));
}

void add_starts(Dataset& data, const BasinContents& c) {
  const std::size_t start = data.dimension("start", c.starts);
  std::map<std::string, std::size_t> along{{"ball", data.dimension("ball", static_cast<std::size_t>(c.header.balls))}};
  const auto place = [](std::size_t k) { return k; };
  data.add("start", "1", "index of the start", {start}, place, count_type(c));
  const auto number = [](std::size_t k) { return k + 1; };
  data.add("ball", "1", "number of the ball", {along["ball"]}, number, Type::integer);
  if (c.header.full_starts) {
    const std::size_t rotor = along["rotor_component"] = data.dimension("rotor_component", 4);
    data.add_texts("rotor_component", rotor, {"x", "y", "x_dot", "y_dot"}, "entry of rotor_state");
  }
  if (!c.header.drawn.empty()) {
    const std::size_t value = along["uncertain_value"] = data.dimension("uncertain_value", c.header.drawn.size());
    data.add_texts("uncertain_value", value, c.header.drawn, "key of the study");
    data.add_texts("uncertain_unit", value, c.header.drawn_units, "unit of its values in drawn");
  }
  const std::vector<StartColumn> columns = start_columns(c.header);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const StartColumn& of_start = columns[k];
    DataColumn& column = data.add(of_start, {start}, c.columns(k), of_start.type);
    if (!of_start.along.empty()) column.along.push_back(along.at(of_start.along));
    if (column.type == Type::single) column.fill = missing_figure;
    if (column.name == "outcome") add_outcome_flags(column, c.summary);
    if (column.name == "decided_by") describe_grounds(column);
  }
}

void add_left_unbalance(Dataset& data, std::size_t kind, const BasinContents& c) {
  constexpr std::size_t width = unbalance_quantiles.size();
  const std::size_t quantile = data.dimension("unbalance_quantile", width);
  data.add("unbalance_quantile", "1", "share of an outcome's starts", {quantile},
           [](std::size_t k) { return unbalance_quantiles[k]; });
  const auto add = [&](const char* name, const char* units, const char* meaning,
                       std::vector<double> OutcomeShare::*of) {
    data.add(name, units, meaning, {kind, quantile}, [&c, of](std::size_t k) {
      const std::vector<double>& left = c.summary[k / width].*of;
      return left.empty() ? no_number : left[k % width];
    });
  };
  add("kind_left_unbalance", "1",
      "unbalance that this share of the starts leaves, or less, if dry friction holds the balls, in M R",
      &OutcomeShare::unbalance);
  if (c.header.scales)
    add("kind_left_balance_grade", "mm s-1", "balance quality grade of that (ISO 21940-11), at the operating speed",
        &OutcomeShare::grade);
}

void add_kinds(Dataset& data, const BasinContents& c) {
  const std::size_t kind = add_outcome_kinds(data, "kind_", c.summary);
  const auto add = [&](const std::string& name, const char* meaning, const auto& of, Type type) {
    data.add(
        name, "1", meaning, {kind}, [&c, of](std::size_t k) { return of(c.summary[k]); }, type);
  };
  const auto count = [](const OutcomeShare& s) { return s.share.count; };
  add("kind_count", "starts with the outcome", count, count_type(c));
  for (const ShareColumn& s : share_columns)
    add(
        std::string("kind_") + s.name, s.of_ensemble,
        [value = s.value](const OutcomeShare& o) { return o.share.*value; }, Type::real);
  for (const OutcomeNumber& n : outcome_numbers)
    if (n.in_files)
      data.add(std::string("kind_") + n.name, n.cf_units(), n.long_name(), {kind},
               [&c, &n](std::size_t k) {
                 const OutcomeShare& o = c.summary[k];
                 return o.id > 0 && o.share.count > 0 ? n.value(o) : no_number;
               })
          .fill = no_number;
  if (c.header.sticks) add_left_unbalance(data, kind, c);
  if (c.header.method == SamplingMethod::random) return;  // random starts need no more than their counts
  const auto interval = [](const OutcomeShare& s) { return interval_names[static_cast<std::size_t>(s.share.by)]; };
  data.add_texts("kind_interval", kind, c.summary, interval,
                 "where the interval is from: wilson, replicates (their spread) or pairs (of a cell)");
  const auto effective = [](const OutcomeShare& s) { return s.share.effective_starts; };
  add("kind_effective_starts", "independent random starts that have the same standard error of the share", effective,
      Type::real);
}

void add_discoveries(Dataset& data, const BasinContents& c) {
  const bool drawn = !c.header.drawn.empty();
  const std::vector<std::string> components = drawn ? std::vector<std::string>{"start"} : c.header.variables;
  const std::size_t met = data.dimension("discovery", c.discoveries.size());
  const std::size_t component = data.dimension("component", components.size());
  data.add_texts("component", component, components, "entry of discovery_state");
  data.add("discovery_state", "1",
           drawn ? "start that first met a motion"
                 : "state on a motion first met during the run: x, y, u, v, phi, phi_dot, and of driven rotors what "
                   "turns them",
           {met, component},
           [&c, width = components.size()](std::size_t k) { return c.discoveries[k / width][k % width]; });
}

void say_attributes(Dataset& data, const BasinContents& c) {
  data.say("identity", identity_of(c.header));
  data.say("cpu_target", fmt::format("{}", fmt::join(c.cpu_targets, ", ")));
  data.say("study", c.study);
  data.say("complete", c.complete ? "yes" : "no");
  data.say("seconds", fmt::format("{:.3f}", c.time.seconds));
  data.say("cpu_seconds", fmt::format("{:.3f}", c.time.cpu_seconds));
  if (!c.header.own_starts.empty()) data.say("own_starts", c.header.own_starts);
  data.say("sampling_method", sampling_method_names[static_cast<std::size_t>(c.header.method)]);
  if (c.header.method != SamplingMethod::sobol) return;
  data.say("sampling_replicates", fmt::format("{}", sobol_replicates));
  data.say("sampling_points_per_replicate", fmt::format("{}", c.starts / sobol_replicates));
}

// Dimensionless like everything else; a study in physical units states its scales.
void say_transients(Dataset& data, const BasinContents& c) {
  const auto say = [&](const char* name, double value) { data.say(name, fmt::format("{}", value)); };
  const TransientSettings& asked = *c.header.transients;
  say("transients_window", asked.window);
  say("limits_displacement", asked.displacement);
  say("limits_settled", asked.settled);
  const std::array<double, 2>& places = asked.shaft.places;
  if (places != std::array<double, 2>{}) data.say("displacements_at", fmt::format("{}, {}", places[0], places[1]));
  if (!asked.shaft.bearings.empty()) data.say("forces_of", "bearing");
  if (!c.header.scales) return;
  say("unit_of_length_m", c.header.scales->length);
  say("unit_of_force_N", c.header.scales->force());
  say("unit_of_velocity_m_per_s", c.header.scales->velocity());
  say("unit_of_time_s", c.header.scales->time());
  say("unit_of_energy_J", c.header.scales->torque());
}

// Starts within all stated limits.
void add_within(Dataset& data, const TransientGroup& all) {
  std::vector<std::string> names;
  std::vector<Share> shares;
  for (std::size_t k = 0; k < within_names.size(); ++k)
    if (all.within[k]) {
      names.emplace_back(within_names[k]);
      shares.push_back(*all.within[k]);
    }
  if (names.empty()) return;
  const std::size_t kept = data.dimension("limits_kept", names.size());
  data.add_texts("limits_kept", kept, names, "when a start is within all limits: at_end, on_the_way, both");
  for (const ShareColumn& s : share_columns)
    data.add(std::string("limits_kept_") + s.name, "1", s.of_ensemble, {kept},
             [shares, value = s.value](std::size_t k) { return shares[k].*value; });
}

// The rotor without balls, and with balls held where they start.
void add_one_bodies(Dataset& data, const WithoutBalls& without) {
  constexpr std::size_t width = reported_quantiles.size();
  std::vector<std::string> names;
  std::vector<std::size_t> told;  // places of the figures
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    if (!transient_figures[k].of_bare_rotor) continue;
    names.emplace_back(transient_figures[k].name);
    told.push_back(k);
  }
  const std::size_t body = data.dimension("one_body", 2), figure = data.dimension("one_body_figure", names.size()),
                    quantile = data.dimension("figure_quantile", width);
  data.add_texts("one_body", body, {"no balls", "balls held where they start"}, "what the rotor carries");
  data.add_texts("one_body_figure", figure, names, "column of the starts' transients");
  data.add("figure_quantile", "1", "share of runs that have less", {quantile},
           [](std::size_t k) { return reported_quantiles[k]; });
  const auto runs_of = [&without](std::size_t k) -> const OneBodyRuns& { return k == 0 ? without.bare : without.held; };
  const auto summary_of = [runs_of, told](std::size_t k) -> const SampleSummary& {
    return runs_of(k / told.size()).figures.figures[told[k % told.size()]];
  };
  data.add("one_body_runs", "1", "runs followed", {body}, [runs_of](std::size_t k) { return runs_of(k).runs; });
  data.add("one_body_stalled", "1", "of these, that stalled", {body},
           [runs_of](std::size_t k) { return runs_of(k).stalled; });
  data.add("one_body_mean", "1", "mean of the figure over runs in which it is finite, dimensionless as in its column",
           {body, figure}, [summary_of](std::size_t k) {
             const SampleSummary& s = summary_of(k);
             return s.open < s.count ? s.mean : no_number;
           });
  data.add("one_body_quantile", "1",
           "quantile of the figure over runs, dimensionless as in its column; infinite where it has no end, missing "
           "where it was not asked",
           {body, figure, quantile}, [summary_of](std::size_t k) {
             const SampleSummary& s = summary_of(k / width);
             return s.count > 0 ? s.quantiles[k % width].value : no_number;
           });
}

}  // namespace

Dataset basin_dataset(const BasinContents& contents) {
  Dataset data("Basins of a rotor with an automatic ball balancer");
  data.filled = false;
  add_starts(data, contents);
  add_kinds(data, contents);
  if (!contents.discoveries.empty()) add_discoveries(data, contents);
  say_attributes(data, contents);
  if (contents.header.transients) say_transients(data, contents);
  if (contents.all) add_within(data, *contents.all);
  if (contents.without_balls) add_one_bodies(data, *contents.without_balls);
  return data;
}

}  // namespace equipoise::io
