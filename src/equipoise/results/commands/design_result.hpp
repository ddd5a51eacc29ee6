// The result of a design: the candidates that no other beats, the chosen one, its margins, and what limits it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/running/run_info.hpp"
#include "equipoise/core/statistics/share.hpp"
#include "equipoise/machine/drives/spin_up_shape.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/toml/study_value.hpp"

namespace equipoise {

/// The value of a variable that the study does not state, and the column of the study itself.
inline constexpr char design_as_given[] = "as it is";

/// What may be chosen.
struct DesignVariable {
  std::string key;   ///< as --set knows it; "speed": a spin-up
  std::string unit;  ///< of quantities; empty for plain numbers
  double low = 0.0, high = 0.0;
  bool logarithmic = false, whole = false;
  std::vector<StudyValue> choices;     ///< if these are the only values allowed
  std::vector<double> numbers;         ///< of the choices, ascending, from low to high; empty: they have no order
  std::string prefix;                  ///< of a number's words: "ISO VG " of 46
  std::optional<SpinUpShape> spin_up;  ///< `unit`, `low` and `high` are of its speeds
};

/// One variable's value in a candidate, as in a study; for a spin-up a table of times and speeds.
struct DesignSetting {
  std::string key;
  StudyValue value;
};

/// What a candidate is judged by.
struct DesignFigure {
  std::string name;  ///< "balanced", "peak_radial.0.95", "-balancer.mass"
  std::string unit;  ///< of a study in physical units; empty: no dimension
  bool up = false;   ///< whether more of it is better
  bool share = false;
};

/// Without random draws both ends equal the value.
using DesignEstimate = Estimate;

/// [design.require]: must hold with 95 % confidence.
struct DesignLimit {
  std::size_t figure = 0;
  std::optional<double> below, above;
};

/// Figures of a candidate from one ensemble.
struct DesignSample {
  std::uint64_t starts = 0;
  std::vector<DesignEstimate> figures;  ///< by DesignResult::figures; empty if the candidate is not a valid study
  DesignEstimate undecided;
  std::string note;  ///< why no start can end balanced, or why the study is invalid
};

struct DesignCandidate {
  std::vector<DesignSetting> settings;   ///< one for each variable
  DesignSample search;                   ///< on the starts that the search saw
  std::optional<DesignSample> held_out;  ///< on starts that it did not see
  bool as_it_is = false;                 ///< the study itself: if it states no such value, words replace it

  const DesignSample& best_known() const { return held_out ? *held_out : search; }
  /// What is set in the study.
  std::vector<DesignSetting> changes() const { return as_it_is ? std::vector<DesignSetting>{} : settings; }
};

/// The chosen candidate with one of its numbers changed.
struct DesignPoint {
  double value = 0.0;
  std::string given;  ///< as in a study
  DesignSample sample;
};
struct DesignMargin {
  std::string key;                            ///< "balancer.drag", "speed.speeds[1]": the second point
  std::string unit, prefix;                   ///< as of DesignVariable
  double value = 0.0, low = 0.0, high = 0.0;  ///< the chosen value; the range examined
  std::vector<DesignPoint> points;            ///< by value, without the chosen one
  DesignSample here;                          ///< the chosen one, with as many starts as these
  /// How far the value may go while all requirements are met, at the values tried: the last value on either side that
  /// meets them, and what fails beyond; empty: nothing within the range. Without requirements: until the first
  /// objective is certainly worse.
  double keeps_from = 0.0, keeps_to = 0.0;
  std::string fails_below, fails_above;
  double effect = 0.0;  ///< largest change of the first objective within a tenth of the range on either side
};

/// The best candidate found so far.
struct DesignStep {
  std::uint64_t trajectories = 0;
  double violation = 0.0;  ///< of the requirements, relative to the limits; 0: all met
  double value = 0.0;      ///< of the first objective
};

/// How candidates are proposed. auto is CMA-ES for one objective, NSGA-II for several; Latin hypercubes need no pagmo2.
enum class DesignMethod { automatic, cmaes, nsga2, latin };
inline constexpr std::array<const char*, 4> design_method_names{"auto", "cmaes", "nsga2", "latin"};

struct DesignResult : RunInfo {
  Study study;
  std::vector<DesignVariable> variables;
  std::vector<DesignFigure> figures;
  std::vector<std::size_t> objectives;  ///< places in `figures`
  std::vector<DesignLimit> limits;
  DesignMethod method = DesignMethod::automatic;  ///< the one that ran
  std::uint64_t budget = 0, trajectories = 0;     ///< allowed; followed, including earlier runs'
  std::uint64_t candidates = 0;                   ///< different ones
  std::uint64_t search_seed = 0, held_out_seed = 0;
  std::optional<DesignSample> before;  ///< the original study, on the held-out starts
  std::vector<DesignCandidate> front;  ///< by the first objective, the best first
  std::optional<std::size_t> chosen;   ///< place in `front`
  /// False: no candidate meets all requirements, and the chosen one comes nearest.
  bool feasible = false;
  std::vector<DesignMargin> margins;  ///< by effect, the largest first
  std::vector<std::string> limited_by;
  std::vector<DesignStep> history;
  std::string best_study;     ///< the chosen study as TOML
  bool partial = false;       ///< stopped: the front rests only on the search's starts
  bool leave_out = false;     ///< no balancer can help the machine, so that nothing is in `front`
  std::uint64_t resumed = 0;  ///< ensembles read from an earlier run's file
  std::string proposed;       ///< of a study that states no [design]: the one that was used, as TOML
  std::string identity;
};

}  // namespace equipoise
