// The figures that candidates are judged by: names, units, and values from an ensemble.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/results/columns/transient_figures.hpp"
#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/commands/design_result.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

/// A name as people write it, taken apart: "balanced" and "passed" (shares; more is better), "time_to_balance.Q" and
/// "limits_kept", "limits_kept_at_end", "limits_kept_on_the_way" (shares of starts that keep all of [limits]),
/// "COLUMN.Q" (the Q-quantile over starts of a column of transient_figures), "ball_mass", "spin_up_time" and
/// "acceleration" of the prescribed speed (less is better), or a number that is varied: "-balancer.mass" if less of it
/// is better, "balancer.mass" if more is.
struct FigureSource {
  enum class Kind {
    balanced,
    passed,
    limits_kept,
    transient,
    time_to_balance,
    ball_mass,
    spin_up_time,
    acceleration,
    variable
  };
  Kind kind = Kind::balanced;
  std::size_t column = 0;        ///< of transient_figures
  Within within = Within::both;  ///< of limits_kept
  double quantile = 0.0;
  std::string key;  ///< of the variable
  /// Its value in the original study, in the variable's unit; NaN: unknown.
  double own = std::numeric_limits<double>::quiet_NaN();
  std::optional<study::Dimension> dimension;
  DesignFigure figure;

  /// Whether starts must be followed where no balanced state attracts.
  bool by_outcome() const { return needs_transients() || kind == Kind::time_to_balance || kind == Kind::passed; }
  bool needs_transients() const { return kind == Kind::transient || kind == Kind::limits_kept; }
};

/// If the name is invalid, `problem` says why: "must be ...".
std::optional<FigureSource> figure_source(const std::string& name, const Study& study,
                                          const std::vector<DesignVariable>& variables, std::string& problem);

/// The unit's name; empty for a study without units.
std::string figure_unit(const Study& study, std::optional<study::Dimension> dimension);
/// One of the figure's unit as a dimensionless number.
double unit_in_study(const Study& study, std::optional<study::Dimension> dimension);

/// A sample of `basin`, which ran with keep_starts. `candidate`: its study.
DesignSample sample_of(const std::vector<FigureSource>& sources, const BasinResult& basin, const Study& candidate,
                       const std::vector<DesignSetting>& settings);
/// A sample where no balanced state attracts. Of figures for which starts have to be followed, the worst value.
DesignSample sample_without_balance(const std::vector<FigureSource>& sources, std::uint64_t starts,
                                    const Study& candidate, const std::vector<DesignSetting>& settings);

}  // namespace equipoise
