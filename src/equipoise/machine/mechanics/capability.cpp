// Which needs a system meets, and words for those it does not meet.
#include "equipoise/machine/mechanics/capability.hpp"

#include <cstddef>

#include "equipoise/machine/words/mechanics.hpp"

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
      return words::mechanics::prescribed_speed;
    case Need::passing_balls:
      return words::mechanics::passing_balls;
    case Need::sliding_balls:
      return words::mechanics::sliding_balls;
    case Need::centred_race:
      return words::mechanics::centred_race;
    case Need::equal_supports:
      return words::mechanics::equal_supports;
    case Need::no_gravity:
      return words::mechanics::no_gravity;
    case Need::no_tilt:
      return words::mechanics::no_tilt;
    case Need::turning:
      return words::mechanics::turning;
    case Need::linear_torque:
      return words::mechanics::linear_torque;
    default:
      return words::mechanics::lasting_drive;
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
