// The ways, and what is wrong with none or several.
#include "equipoise/study/reading/ways.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "equipoise/study/words/machine.hpp"
#include "equipoise/study/words/study.hpp"

namespace equipoise::study {

namespace {

struct Way {
  std::string_view key, words;
};

// Each group states one thing.
const std::vector<std::vector<Way>>& groups() {
  static const std::vector<std::vector<Way>> all{
      {{"rotor.stiffness", words::machine::stiffness},
       {"rotor.natural_frequency", words::machine::natural_frequency},
       {"rotor.static_sag", words::machine::static_sag}},
      {{"rotor.damping", words::machine::damping},
       {"rotor.damping_ratio", "a plain number or \"5 %\", c/(2 sqrt(k M))"},
       {"rotor.logarithmic_decrement", words::machine::logarithmic_decrement},
       {"rotor.quality_factor", words::machine::quality_factor},
       {"rotor.loss_factor", words::machine::loss_factor}},
      {{"rotor.eccentricity", words::machine::eccentricity},
       {"rotor.unbalance", words::machine::unbalance},
       {"rotor.balance_grade", words::machine::balance_grade}},
      {{"rotor.inertia", words::machine::inertia},
       {"rotor.radius_of_gyration", "sqrt(J/M), such as \"60 mm\""},
       {"rotor.gd2", "4 J, such as \"0.3 kgf m2\""}},
      {{"balancer.race_radius", words::machine::race_radius},
       {"balancer.race_diameter", words::machine::race_diameter}},
      {{"balancer.mass", words::machine::mass},
       {"balancer.ball_density", "with balancer.ball_diameter"},
       {"balancer.ball_material", words::machine::ball_material}},
      {{"balancer.drag", words::machine::drag},
       {"balancer.oil_viscosity", "with balancer.ball_diameter"},
       {"balancer.oil", words::machine::oil}}};
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
      if (!given.empty()) refuse(std::string(way.key), fmt::format(words::study::either_or, given, way.key));
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
