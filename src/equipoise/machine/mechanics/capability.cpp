// Which needs a system meets, and words for those it does not meet.
#include "equipoise/machine/mechanics/capability.hpp"

#include <cstddef>

namespace equipoise::model {

namespace {

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
    case Need::no_gravity:
      return p.gravity == 0.0;
    case Need::no_tilt:
      return !system.tilts();
    case Need::turning:
      return system.section() != Section::stroboscopic || system.speed() != 0.0;
    case Need::linear_torque:
      return system.prescribed() || system.drive().motor.is_linear();
    default:
      return !system.coasts();
  }
}

}  // namespace

const char* words(Need need) {
  switch (need) {
    case Need::prescribed_speed:
      return "a prescribed speed";
    case Need::passing_balls:
      return "balls that pass each other, 0 or contact = false";
    case Need::sliding_balls:
      return "balls without rolling resistance or stiction, 0";
    case Need::centred_race:
      return "a centred race, [0, 0]";
    case Need::equal_supports:
      return "equal values in x and y";
    case Need::no_gravity:
      return "gravity 0";
    case Need::no_tilt:
      return "a rotor that does not tilt, without rotor.tilt";
    case Need::turning:
      return "a rotor that turns in the end (other than 0) where supports are unequal or gravity acts";
    case Need::linear_torque:
      return "a motor whose torque is linear in the speed, without a load";
    default:
      return "a drive that lasts";
  }
}

namespace {

// "simulate, basin and attractors": the commands that do not have this need.
std::string commands_without(Need need) {
  std::string text;
  std::size_t left = 0;
  for (const Capability& c : capabilities) left += *c.command != '\0' && !c.needs.has(need);
  for (const Capability& c : capabilities) {
    if (*c.command == '\0' || c.needs.has(need)) continue;
    text += c.command;
    if (--left > 0) text += left > 1 ? ", " : " and ";
  }
  return text;
}

}  // namespace

std::optional<Lack> lacking(const System& system, ResultKind result) {
  const Capability& asked = capability(result);
  for (const Need need : all_needs) {
    if (!asked.needs.has(need) || offers(system, need)) continue;
    const std::string others = commands_without(need);
    return Lack{need, std::string(asked.name) + " need " + words(need) + " (" + others +
                          (others.find(" and ") == std::string::npos ? " takes any)" : " take any)")};
  }
  return std::nullopt;
}

}  // namespace equipoise::model
