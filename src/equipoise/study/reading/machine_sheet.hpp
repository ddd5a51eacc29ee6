// The tables of the machine: read, and turned from what a data sheet states to dimensionless numbers, part by part.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/reading/rules.hpp"

namespace equipoise::study {

/// [rotor] with its tables, and every [[place]]. Quantities are read in SI units.
void read_rotor(const StudyFile& file, Study& study);
/// [balancer]. A rotor without balls states its race at most.
void read_balancer(const StudyFile& file, Study& study);
/// [speed]: a ramp function or a motor with its load.
void read_speed(const StudyFile& file, Study& study);
/// The mm/s of a balance quality grade, "G 6.3"; empty if the text names none.
std::optional<double> grade_named(const std::string& text);

/// The study of a machine in physical units, from its quantities in SI units (docs/explanation/equations.md, "Units").
Study nondimensionalise(const Study& machine, const Refuse& refuse);

/// Its parts read `machine`, in SI units, and put what follows into `study`.
struct Sheet {
  const Study& machine;
  Study& study;
  const Refuse& refuse;
  const DataSheet& given = machine.sheet;
  const model::Parameters& in_si = machine.parameters;
  model::Parameters& p = study.parameters;

  bool states(std::string_view key) const { return machine.states(key); }
  std::string_view way(std::string_view first, bool required = true) const {
    return way_of(machine, first, refuse, required);
  }
};
/// Stiffnesses over their mean, which it returns in N/m.
double put_stiffness(const Sheet& sheet);
/// With the scales of the study: damping, tilt, unbalance in places and inertia.
void put_rotor(const Sheet& sheet);
/// The sizes of balls, in SI units; returns R in m.
double put_race(const Sheet& sheet);
/// With the scales of the study: masses and drag of the balls, and how they touch.
void put_balls(const Sheet& sheet);

}  // namespace equipoise::study
