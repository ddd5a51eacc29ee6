// One motion as JSON and in words, for lists of attractors.
#pragma once

#include <optional>
#include <string>

#include "equipoise/machine/datasheet/scales.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/results/types/attractor.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The slowest decay of a deviation, without shifts in time: "stable, slowest rate -0.02510"; with scales in 1/s.
std::string stability_text(const Attractor& a, const std::optional<model::Scales>& scales);

void to_json(Json& json, const ContinuumPart& part);
/// The keys of `equipoise attractors --json`, without shares and state.
void to_json(Json& json, const PartOf<Attractor, Study>& attractor);

}  // namespace equipoise
