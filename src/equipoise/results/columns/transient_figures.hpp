// The figures of transients: what they are, and one line each, from which every report of them is made.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "equipoise/results/columns/column.hpp"
#include "equipoise/results/types/transient_table.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The figures of one start, as they are stored and counted; not-a-number for one that was lost. Dimensionless: lengths
/// in R, forces in M R omega_c^2, velocities in R omega_c, energy in M R^2 omega_c^2, times in 1/omega_c. Displacements
/// are from where the rotor rests under its weight; bearing forces hold the weight. "At the end": of the steady motion
/// that the start ended in; for an undecided start, and if that motion's own figures are not known, in the last window.
/// transient_figures explains each.
struct TransientRow {
  float peak_radial = 0.0f, peak_radial_after_release = 0.0f, peak_radial_at_end = 0.0f;
  float peak_force = 0.0f;  ///< of springs and dampers on the support
  float rms_force = 0.0f, rms_velocity = 0.0f;
  float peak_dynamic_force = 0.0f, rms_dynamic_force = 0.0f;  ///< without the force at rest under the weight
  float rms_velocity_one_direction = 0.0f;                    ///< in X or Y, whichever has more
  /// |lambda + sum mu_i e^{i phi_i}|. For a tilting rotor, in the worse of its outermost bearings' planes, over its
  /// share of what the rotor may have.
  float residual_unbalance = 0.0f;
  /// 0 without a limit; infinite: the motion at the end exceeds it, or r still did when the start was last followed.
  float time_above = 0.0f;
  float settling_time = 0.0f;  ///< infinite in the same cases
  /// When and at what |psi'| the largest r was reached; not-a-number if the motion at the end has it.
  float peak_time = 0.0f, peak_speed = 0.0f;
  float energy = 0.0f;  ///< not-a-number if work is not required
  float followed_until = 0.0f;
};

/// The figures of complete sums; `lost`: the trajectory diverged or failed; `end`: figures of its motion, if known.
TransientRow transient_row(const TransientSettings& settings, const TransientSums& sums, bool lost,
                           const std::optional<MotionFigures>& end = std::nullopt);

/// A figure of TransientRow.
struct TransientFigure : Column {
  float TransientRow::*value;
  const char* title;          ///< in tables and pictures
  bool on_page = false;       ///< has a line of its own on a page
  bool of_bare_rotor = true;  ///< also reported for the rotor without balls
  /// Whether text shows it for this study; null: always. Otherwise another figure says the same.
  bool (*differs)(const Study&) = nullptr;
  /// The limit that it needs; null: none. The drive's work needs a WorkSource.
  std::optional<double> Limits::*needs = nullptr;
  /// For a figure that may have no end: what a start does whose motion exceeds the limit for good, and what one does
  /// that had not fallen below it when it was last followed.
  std::array<const char*, 2> open{"?", "?"};

  /// An unbalance is shown over the rotor's mass, as a length.
  study::Dimension told_in() const {
    return dimension == study::Dimension::unbalance ? study::Dimension::length : *dimension;
  }
};
/// Where along its shaft a tilting rotor is watched. Forces are reported for each bearing if each is known and there
/// are no other supports (Study::each_bearing()). They are those of all supports together if a machine stands on feet,
/// which slide by that sum, and if starts draw values that could make the supports other than these bearings.
WatchedShaft watched_shaft(const Study& study);

/// Whether bearing forces differ by the weight, and velocities in X from those in Y.
bool weighs(const Study& study);
bool has_directions(const Study& study);
/// Whether the rotor's speed changes on the way.
bool runs_up(const Study& study);

inline constexpr auto transient_figures = std::to_array<TransientFigure>({
    {{"peak_radial", "largest radial displacement of the centre from its place at rest", study::Dimension::length},
     &TransientRow::peak_radial,
     "peak displacement",
     true},
    {{"peak_time", "study time of that", study::Dimension::time, "missing: the motion at the end has it"},
     &TransientRow::peak_time,
     "time of the peak",
     false,
     false,
     runs_up},
    {{"peak_speed", "speed of the rotor at that time", study::Dimension::speed,
      "missing: the motion at the end has it"},
     &TransientRow::peak_speed,
     "speed at the peak",
     false,
     false,
     runs_up},
    {{"peak_radial_after_release", "largest radial displacement from release on", study::Dimension::length},
     &TransientRow::peak_radial_after_release,
     "peak displacement after release",
     false,
     false},
    {{"peak_radial_at_end", "largest radial displacement of the motion at the end", study::Dimension::length},
     &TransientRow::peak_radial_at_end,
     "peak displacement at the end"},
    {{"peak_force", "largest bearing force, the weight included", study::Dimension::force},
     &TransientRow::peak_force,
     "peak bearing force",
     true},
    {{"rms_force", "root mean square bearing force at the end, the weight included", study::Dimension::force},
     &TransientRow::rms_force,
     "RMS bearing force at the end"},
    {{"peak_dynamic_force", "largest bearing force without the part that carries the weight at rest",
      study::Dimension::force},
     &TransientRow::peak_dynamic_force,
     "peak dynamic force",
     false,
     true,
     weighs},
    {{"rms_dynamic_force", "root mean square at the end of the bearing force without that part",
      study::Dimension::force},
     &TransientRow::rms_dynamic_force,
     "RMS dynamic force at the end",
     false,
     true,
     weighs},
    {{"rms_velocity", "root mean square velocity of the centre at the end", study::Dimension::velocity},
     &TransientRow::rms_velocity,
     "RMS velocity at the end",
     true},
    {{"rms_velocity_one_direction", "the same in X or in Y, whichever has more", study::Dimension::velocity},
     &TransientRow::rms_velocity_one_direction,
     "RMS velocity, one direction",
     false,
     true,
     has_directions},
    {{"residual_unbalance",
      "unbalance that turns with the rotor at the end: the size of its mean in the rotating frame",
      study::Dimension::unbalance},
     &TransientRow::residual_unbalance,
     "residual unbalance U/M"},
    {{"time_above", "time with the radial displacement above limits.displacement", study::Dimension::time,
      "missing: it goes on"},
     &TransientRow::time_above,
     "time above the limit",
     true,
     true,
     nullptr,
     &Limits::displacement,
     {"lasting", "not over"}},
    {{"settling_time", "time from release until the radial displacement was last above limits.settled",
      study::Dimension::time, "missing: not settled"},
     &TransientRow::settling_time,
     "settling time",
     true,
     true,
     nullptr,
     &Limits::settled,
     {"never", "not yet"}},
    {{"energy", "work of the drive until the outcome was known, without what it took back in pieces of braking",
      study::Dimension::energy, "missing: not asked"},
     &TransientRow::energy,
     "work of the drive",
     true,
     false},
    {{"followed_until", "study time up to which the start was followed", study::Dimension::time},
     &TransientRow::followed_until,
     "followed until",
     false,
     false},
});
static_assert(sizeof(TransientRow) == transient_figures.size() * sizeof(float), "a figure has no line here");
constexpr std::size_t figure_place(float TransientRow::*value) {
  std::size_t k = 0;
  while (transient_figures[k].value != value) ++k;
  return k;
}

/// What a figure is multiplied by: a function of the rotor's speed in the end, >= 0, and of omega_c in rad/s.
struct SpeedFactor {
  double (*of)(double speed, double frequency);
  study::Dimension told_in;
};
/// From a velocity at one frequency to the acceleration weighted for hands (machine/standards/hand_arm.hpp).
double hand_arm_factor(double speed, double frequency);

/// A limit whose excess is counted, in the order of TransientGroup::exceeded.
struct TransientLimit {
  const char* name;  ///< key of [limits]
  std::optional<double> Limits::*limit;
  const char* measured;                   ///< what it limits: "peak displacement"
  float TransientRow::*value;             ///< that figure
  float TransientRow::*end;               ///< the figure of the motion at the end that has to keep it
  const char* exceeded;                   ///< follows the limit: "5 mm is exceeded on the way"
  bool at_end = false;                    ///< the others are peaks, which stay exceeded
  const SpeedFactor* by_speed = nullptr;  ///< the figure times this

  const TransientFigure& figure() const { return transient_figures[figure_place(value)]; }
  study::Dimension told_in() const { return by_speed ? by_speed->told_in : figure().told_in(); }
};
inline constexpr SpeedFactor times_speed{[](double speed, double) { return speed; }, study::Dimension::velocity};
inline constexpr SpeedFactor weighted_for_hands{hand_arm_factor, study::Dimension::acceleration};
inline constexpr auto transient_limits = std::to_array<TransientLimit>({
    {"displacement", &Limits::displacement, "peak displacement", &TransientRow::peak_radial,
     &TransientRow::peak_radial_at_end, " is exceeded on the way"},
    {"force", &Limits::force, "peak force", &TransientRow::peak_force, &TransientRow::rms_force,
     " on the supports is exceeded on the way"},
    {"velocity", &Limits::velocity, "RMS velocity", &TransientRow::rms_velocity, &TransientRow::rms_velocity,
     " RMS in the end is exceeded", true},
    {"clearance", &Limits::clearance, "hits of the housing: peak displacement", &TransientRow::peak_radial,
     &TransientRow::peak_radial_at_end, " of clearance is used up on the way: the rotor hits its housing"},
    {"residual", &Limits::residual, "residual unbalance U/M", &TransientRow::residual_unbalance,
     &TransientRow::residual_unbalance, " of residual unbalance is exceeded in the end", true},
    {"grade", &Limits::grade, "e omega", &TransientRow::residual_unbalance, &TransientRow::residual_unbalance,
     " of e omega is exceeded in the end", true, &times_speed},
    {"velocity_one_direction", &Limits::velocity_one_direction, "RMS velocity in one direction",
     &TransientRow::rms_velocity_one_direction, &TransientRow::rms_velocity_one_direction,
     " RMS in one direction in the end is exceeded", true},
    {"dynamic_force", &Limits::dynamic_force, "peak dynamic force", &TransientRow::peak_dynamic_force,
     &TransientRow::rms_dynamic_force, " of dynamic force on the supports is exceeded on the way"},
    {"settling_time", &Limits::settling_time, "settling time", &TransientRow::settling_time,
     &TransientRow::settling_time, " for settling is exceeded", true},
    {"hand_arm", &Limits::hand_arm, "a_hv", &TransientRow::rms_velocity, &TransientRow::rms_velocity,
     " of weighted hand-arm vibration is exceeded in the end", true, &weighted_for_hands},
});

/// Which of the stated limits a start meets: those of the motion at the end, including limits.settled; those on the
/// way, which peaks meet or not; or both. A limit on force is met at the end if the root mean square meets it.
enum class Within { at_end, on_the_way, both };
inline constexpr std::array<const char*, 3> within_names{"at_end", "on_the_way", "both"};
inline constexpr std::array<const char*, 3> within_titles{"within all limits at the end",
                                                          "never over a limit on the way", "both"};

/// Which of the stated limits one start meets. It meets all limits that are not stated. Whatever is not known, such as
/// the speed of a start that was not watched for long enough, meets none.
struct LimitsOfStart {
  std::array<bool, transient_limits.size()> exceeded{}, exceeded_at_end{};
  bool at_end = true, on_the_way = true;  ///< Within

  bool both() const { return at_end && on_the_way; }
};
/// `speed`: the rotor's in the end; `frequency`: omega_c in rad/s, read for limits that need a study with units.
LimitsOfStart limits_of_start(const Limits& limits, const TransientRow& row, double speed, double frequency);

struct StandardLevel {
  const char* name;                              ///< in JSON and files
  float TransientRow::*value;                    ///< the figure
  bool at_end;                                   ///< else it is a peak, which stays exceeded
  std::optional<double> (*level)(const Study&);  ///< dimensionless; empty where the study does not ask
};

/// Zone boundaries A/B, B/C, C/D of the study's class, for the velocity in one direction; empty for a rotor that
/// turns too slowly for the standard's band of frequencies.
std::optional<double> zone_boundary(const Study& study, int boundary);
/// The peak force on the supports, the weight that hangs in them included, from which on a machine on feet may slide.
std::optional<double> sliding_level(const Study& study);

inline constexpr std::array<StandardLevel, 4> standard_levels{{
    {"zone_a", &TransientRow::rms_velocity_one_direction, true, [](const Study& s) { return zone_boundary(s, 0); }},
    {"zone_b", &TransientRow::rms_velocity_one_direction, true, [](const Study& s) { return zone_boundary(s, 1); }},
    {"zone_c", &TransientRow::rms_velocity_one_direction, true, [](const Study& s) { return zone_boundary(s, 2); }},
    {"standing_still", &TransientRow::peak_force, false, sliding_level},
}};

}  // namespace equipoise
