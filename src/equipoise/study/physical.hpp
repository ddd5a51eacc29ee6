// Studies in physical units: every quantity a string with its unit, turned into the dimensionless keys that the study
// reader takes.
#pragma once

#include "equipoise/study/ball_details.hpp"
#include "equipoise/study/table_reader.hpp"

namespace equipoise::study {

/// Whether the study states a rotor in physical units. What only such a study has tells: rotor.mass,
/// balancer.race_radius and their like.
bool is_physical(const Document& document);

/// Replaces the physical keys of a physical study by dimensionless ones, in place, and sets document.scales; what was
/// written is kept for messages. A dimensionless study stays as it is.
/// Throws InputError for what is missing, given twice, of the wrong dimension, out of range, or a plain number.
void make_dimensionless(Document& document);

/// What a physical study says of its balls, before it is made dimensionless.
BallDetails ball_details(const Document& document);

}  // namespace equipoise::study
