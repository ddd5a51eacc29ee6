// What systems offer, and the words for what they do not.
#include "equipoise/model/capability.hpp"

#include <cstddef>

namespace equipoise::model {

namespace {

constexpr std::array all_needs{Need::prescribed_speed, Need::passing_balls,  Need::sliding_balls,
                               Need::centred_race,     Need::equal_supports, Need::no_gravity};

bool offers(const System& system, Need need) {
  const Parameters& p = system.parameters();
  switch (need) {
    case Need::prescribed_speed:
      return system.prescribed();
    case Need::passing_balls:
      return !system.events().contact;
    case Need::sliding_balls:
      return !system.events().stick;
    case Need::centred_race:
      return p.race_is_centred();
    case Need::equal_supports:
      return p.isotropic();
    default:
      return p.gravity == 0.0;
  }
}

const char* words(Need need) {
  switch (need) {
    case Need::prescribed_speed:
      return "a prescribed speed";
    case Need::passing_balls:
      return "balls that pass each other, 0";
    case Need::sliding_balls:
      return "balls without rolling resistance or stiction, 0";
    case Need::centred_race:
      return "a centred race, [0, 0]";
    case Need::equal_supports:
      return "equal values in x and y";
    default:
      return "gravity 0";
  }
}

// "simulate, basin and attractors": the commands that do without.
std::string commands_without(Need need) {
  std::string text;
  std::size_t left = 0;
  for (const Capability& c : capabilities) left += *c.command != '\0' && !c.needs(need);
  for (const Capability& c : capabilities) {
    if (*c.command == '\0' || c.needs(need)) continue;
    text += c.command;
    if (--left > 0) text += left > 1 ? ", " : " and ";
  }
  return text;
}

}  // namespace

std::optional<Lack> lacking(const System& system, Answer answer) {
  const Capability& asked = capability(answer);
  for (const Need need : all_needs) {
    if (!asked.needs(need) || offers(system, need)) continue;
    return Lack{need, std::string(asked.name) + " need " + words(need) + " (" + commands_without(need) + " take any)"};
  }
  return std::nullopt;
}

}  // namespace equipoise::model
