// Readings of table 7's protocol as segments of the rotor's motion.
#include "table_7_protocol.hpp"

#include <algorithm>
#include <limits>

#include "equipoise/extras/literature/published_tables.hpp"

namespace equipoise {

namespace {

struct Branch {
  double begin, end, speed, slope;  // of the ramp function
  BranchLaw law;

  // psi' and psi'' at `t`.
  double rate(double t) const {
    const double omega = speed + slope * (t - begin);
    if (law == BranchLaw::published) return omega + t * slope;
    if (law == BranchLaw::own_time) return omega + (t - begin) * slope;
    return omega;
  }
  double acceleration() const { return law == BranchLaw::kinematic ? slope : 2.0 * slope; }
};

}  // namespace

std::array<double, 3> Table7Protocol::ends(const Table7Row& row) const {
  if (durations) return {row.t0, row.t0 + row.t1, row.t0 + row.t1 + row.t2};
  return {row.t0, row.t1, row.t2};
}

double Table7Protocol::release_time(const Table7Row& row) const {
  const auto [t0, t1, t2] = ends(row);
  switch (release) {
    case Table7Release::at_hold_end:
      return t1;
    case Table7Release::at_fall_speed:
      return t1 + (t2 - t1) * (peak - release_speed) / (peak - final);
    case Table7Release::at_settling:
      return t2;
    case Table7Release::at_rise_speed:
      break;
  }
  return release_speed == peak ? t0 : t0 * release_speed / peak;
}

std::vector<model::Segment> Table7Protocol::segments(const Table7Row& row) const {
  const auto [t0, t1, t2] = ends(row);
  constexpr double never = std::numeric_limits<double>::infinity();
  const Branch branches[] = {{0.0, t0, 0.0, peak / t0, rise},
                             {t0, t1, peak, 0.0, BranchLaw::kinematic},
                             {t1, t2, peak, (final - peak) / (t2 - t1), fall},
                             {t2, never, final, 0.0, BranchLaw::kinematic}};
  const double free_from = release_time(row);
  std::vector<model::Segment> result;
  double psi = 0.0;
  const auto add = [&](const Branch& b, double begin, double end) {
    if (!(begin < end)) return;
    result.push_back({begin, end, psi, b.rate(begin), b.acceleration(), end <= free_from});
    if (end < never) psi = result.back().psi_at(end);
  };
  for (const Branch& b : branches) {
    const double cut = std::clamp(free_from, b.begin, b.end);
    add(b, b.begin, cut);
    add(b, cut, b.end);
  }
  return result;
}

Study Table7Protocol::study(const Table7Row& row) const {
  const auto [t0, t1, t2] = ends(row);
  Study study = paper_rotor(damping, drag);
  study.name = "table 7";
  study.parameters.eccentricity = eccentricity;
  study.parameters.mass = {mass, mass};
  study.speed.profile = Profile::trapezoid;
  study.speed.peak = peak;
  study.speed.final = final;
  study.speed.rise_until = t0;
  study.speed.hold_until = t1;
  study.speed.fall_until = t2;
  return study;
}

}  // namespace equipoise
