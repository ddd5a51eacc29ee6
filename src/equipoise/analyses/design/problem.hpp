// A study's [design], read and checked: variables, figures, objectives, requirements; and candidates as studies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/commands/design_result.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

inline constexpr std::size_t most_design_variables = 20, most_design_objectives = 4, most_spin_up_points = 8;

/// A [design] for a study that states none, as TOML to append to it: the balls' number and stock size, oil or drag, and
/// a latch if there is one; the least peak among those that balance and meet [limits] in limits.share of starts; a
/// budget of a minute or two on two cores. Throws InputError if nothing can be chosen.
std::string proposed_design(const StudySource& source);

/// A name as people write it, taken apart: "balanced" and "passed" (shares; more is better), "time_to_balance.Q" and
/// "limits_kept", "limits_kept_at_end", "limits_kept_on_the_way" (shares of starts that keep all of [limits]),
/// "COLUMN.Q" (the Q-quantile over starts of a column of transient_figures), "ball_mass", "spin_up_time" and
/// "acceleration" of the prescribed speed (less is better), or a number that is varied: "-balancer.mass" if less of it
/// is better, "balancer.mass" if more is.
struct FigureSource {
  /// Its value from the ensemble of a candidate, which ran with keep_starts. Empty: it needs no start.
  std::function<DesignEstimate(const BasinResult& basin)> measured;
  /// Then its value from the candidate's study and settings.
  std::function<double(const Study& candidate, const std::vector<DesignSetting>& settings)> stated;
  bool transients = false;                    ///< whether it needs statistics of transients
  bool by_outcome = false;                    ///< whether starts must be followed where no balanced state attracts
  std::optional<study::Dimension> dimension;  ///< of these values, in the candidate's units
  DesignFigure figure;
};

/// `tree`: the study's, which states the variables' own values. If the name is invalid, `problem` says why: "must be
/// ...".
std::optional<FigureSource> figure_source(const std::string& name, const Study& study, const StudyValue& tree,
                                          const std::vector<DesignVariable>& variables, std::string& problem);

/// One of the figure's unit as a dimensionless number.
double unit_in_study(const Study& study, std::optional<study::Dimension> dimension);

/// A sample of `basin`, which ran with keep_starts. `candidate`: its study.
DesignSample sample_of(const std::vector<FigureSource>& sources, const BasinResult& basin, const Study& candidate,
                       const std::vector<DesignSetting>& settings);
/// A sample where no balanced state attracts. Of figures for which starts have to be followed, the worst value.
DesignSample sample_without_balance(const std::vector<FigureSource>& sources, std::uint64_t starts,
                                    const Study& candidate, const std::vector<DesignSetting>& settings);

class DesignProblem {
 public:
  /// Of a study without [design] the proposed one is taken. Throws InputError, naming the key, for unknown variables or
  /// figures, reversed ranges, values that make no valid study, and requests known to be impossible before any work.
  explicit DesignProblem(const StudySource& source);

  const Study& study() const { return study_; }
  const std::vector<DesignVariable>& variables() const { return variables_; }
  const std::vector<FigureSource>& figures() const { return figures_; }
  const std::vector<std::size_t>& objectives() const { return objectives_; }
  const std::vector<DesignLimit>& limits() const { return limits_; }
  DesignMethod method() const { return method_; }  ///< never automatic
  std::uint64_t trajectories() const { return trajectories_; }
  std::uint64_t first_look() const { return first_look_; }   ///< starts of a candidate's first look
  const std::string& proposed() const { return proposed_; }  ///< the [design], if the study states none
  std::uint64_t seed() const { return seed_; }               ///< of the search
  /// Whether figures need statistics of transients, or starts followed where no balanced state attracts.
  bool transients() const;
  bool by_outcome() const;
  /// Whether a candidate without a balanced state misses a requirement, whatever else it does.
  bool requires_balance() const;

  /// Coordinates of a candidate, each from 0 to 1.
  std::size_t dimensions() const { return dimensions_; }
  std::vector<DesignSetting> settings_at(std::span<const double> at) const;

  /// The study itself among the candidates.
  DesignCandidate as_it_is() const;

  /// The study with these settings as a tree; without settings the original study.
  StudyValue tree_of(const std::vector<DesignSetting>& settings) const;
  /// The same for an ensemble of the search or its check. Throws InputError if the study is invalid.
  Study study_of(const std::vector<DesignSetting>& settings, std::uint64_t starts, std::uint64_t seed) const;

  /// Everything that determines the results, as text.
  std::string identity() const;

 private:
  void check_candidates() const;
  void check_one(const std::vector<DesignSetting>& settings, const std::string& key, const std::string& text) const;

  std::string name_, proposed_;
  StudyValue tree_;  ///< without [design]
  Study study_;
  std::vector<DesignVariable> variables_;
  std::vector<FigureSource> figures_;
  std::vector<std::size_t> objectives_;
  std::vector<DesignLimit> limits_;
  DesignMethod method_ = DesignMethod::automatic;
  std::uint64_t trajectories_ = 0, first_look_ = 0, seed_ = 1;
  std::size_t dimensions_ = 0;
};

}  // namespace equipoise
