// The ways, and what is wrong with none or several.
#include "equipoise/study/reading/ways.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>


namespace equipoise::study {

namespace {

struct Way {
  std::string_view key, words;
};

// Each group states one thing.
const std::vector<std::vector<Way>>& groups() {
  static const std::vector<std::vector<Way>> all{
      {{"rotor.stiffness", "a stiffness greater than 0, such as \"48 kN/m\""},
       {"rotor.natural_frequency", "of the rotor without balls, such as \"8 Hz\" or \"480 rpm\""},
       {"rotor.static_sag", "under its own weight, such as \"3 mm\""}},
      {{"rotor.damping", "a damping coefficient of 0 or more, such as \"200 N s/m\""},
       {"rotor.damping_ratio", "a plain number or \"5 %\", c/(2 sqrt(k M))"},
       {"rotor.logarithmic_decrement", "a plain number, per cycle of free vibration, such as 0.3"},
       {"rotor.quality_factor", "a plain number, sqrt(k M)/c, such as 8"},
       {"rotor.loss_factor", "a plain number, c/sqrt(k M), such as 0.1"}},
      {{"rotor.eccentricity", "a length of 0 or more, such as \"0.2 mm\""},
       {"rotor.unbalance", "mass times eccentricity, such as \"300 g mm\""},
       {"rotor.balance_grade", "a table such as { grade = \"G 6.3\", at = \"3000 rpm\" }"}},
      {{"rotor.inertia", "a moment of inertia greater than 0, such as \"0.02 kg m2\""},
       {"rotor.radius_of_gyration", "sqrt(J/M), such as \"60 mm\""},
       {"rotor.gd2", "4 J, such as \"0.3 kgf m2\""}},
      {{"balancer.race_radius", "a length greater than 0, such as \"60 mm\""},
       {"balancer.race_diameter", "such as \"120 mm\""}},
      {{"balancer.mass", "a mass greater than 0, such as \"5 g\""},
       {"balancer.ball_density", "with balancer.ball_diameter"},
       {"balancer.ball_material", "such as \"steel\", with balancer.ball_diameter"}},
      {{"balancer.drag",
        "a torque for a rate, such as \"1e-6 N m s\", or a force for a velocity, such as \"0.01 N s/m\""},
       {"balancer.oil_viscosity", "with balancer.ball_diameter"},
       {"balancer.oil", "such as { grade = \"ISO VG 32\", at = \"40 degC\" }"}}};
  return all;
}

const std::vector<Way>* group_of(std::string_view key) {
  for (const std::vector<Way>& ways : groups())
    if (std::any_of(ways.begin(), ways.end(), [&](const Way& way) { return way.key == key; })) return &ways;
  return nullptr;
}

}  // namespace

std::string or_give(std::string_view dotted) {
  std::string text;
  if (const std::vector<Way>* ways = group_of(dotted))
    for (const Way& way : *ways)
      if (way.key != dotted) text += fmt::format(", or give {}, {}", way.key, way.words);
  return text;
}

void refuse_several_ways(const Study& study, const Refuse& refuse) {
  for (const std::vector<Way>& ways : groups()) {
    std::string_view given;
    for (const Way& way : ways) {
      if (!study.states(way.key)) continue;
      if (!given.empty()) refuse(std::string(way.key), fmt::format("give either {} or {}, not both", given, way.key));
      given = way.key;
    }
  }
}

std::string_view way_of(const Study& study, std::string_view first, const Refuse& refuse, bool required) {
  const std::vector<Way>& ways = *group_of(first);
  for (const Way& way : ways)
    if (study.states(way.key)) return way.key.substr(way.key.find('.') + 1);
  if (required) refuse(std::string(first), fmt::format("missing; must be {}{}", ways.front().words, or_give(first)));
  return "";
}

}  // namespace equipoise::study
