// From what a data sheet states to dimensionless numbers, part by part.
#pragma once

#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/reading/rules.hpp"

namespace equipoise::study {

/// The study of a machine in physical units, from its quantities in SI units (docs/explanation/equations.md, "Units").
Study nondimensionalise(const Study& machine, const Refuse& refuse);

// Its parts: they read `machine`, in SI units, and put what follows into `study`.

/// Stiffnesses over their mean, which it returns in N/m.
double put_stiffness(const Study& machine, Study& study, const Refuse& refuse);
/// With the scales of `study`: damping, tilt, unbalance in places and inertia.
void put_rotor(const Study& machine, Study& study, const Refuse& refuse);
/// The sizes of balls, in SI units; returns R in m.
double put_race(const Study& machine, Study& study, const Refuse& refuse);
/// With the scales of `study`: masses and drag of the balls, and how they touch.
void put_balls(const Study& machine, Study& study, const Refuse& refuse);

}  // namespace equipoise::study
