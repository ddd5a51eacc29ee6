// One motion as JSON and in words: its name in an engineer's words, its stability.
#pragma once

#include <optional>
#include <string>

#include "equipoise/machine/datasheet/scales.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/results/types/attractor.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// "balls circulate together" for "co-drifting", from a motion's name (docs/explanation/motions.md, "Names"). "" for a
/// name that has no such words: a report then shows the name.
std::string plain_name(const std::string& name);

/// "balls circulate together (V1)" in a study with physical units, "co-drifting (V1)" in any other. `named`: has `name`
/// and `alias`.
template <class Named>
std::string reader_title(const Named& named, bool physical) {
  const std::string plain = physical ? plain_name(named.name) : "";
  const std::string& words = plain.empty() ? named.name : plain;
  return named.alias.empty() ? words : words + " (" + named.alias + ")";
}

/// The slowest decay of a deviation, without shifts in time: "stable, slowest rate -0.02510"; with scales in 1/s.
std::string stability_text(const Attractor& a, const std::optional<model::Scales>& scales);

void to_json(Json& json, const ContinuumPart& part);
/// The keys of `equipoise attractors --json`, without shares and state.
void to_json(Json& json, const PartOf<Attractor, Study>& attractor);

}  // namespace equipoise
