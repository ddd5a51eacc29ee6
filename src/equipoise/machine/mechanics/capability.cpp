// Which needs a system meets, and words for those it does not meet.
#include "equipoise/machine/mechanics/capability.hpp"

#include <cstddef>

namespace equipoise::model {

namespace {

struct NeedLine {
  Need need;
  const char* words;
  bool (*met)(const System&);
};
constexpr std::array<NeedLine, 9> need_lines{{
    {Need::prescribed_speed, "a prescribed speed", [](const System& s) { return s.prescribed(); }},
    {Need::passing_balls, "balls that pass each other, 0 or contact = false",
     [](const System& s) { return !s.events().contact; }},
    {Need::sliding_balls, "balls without rolling resistance or stiction, 0",
     [](const System& s) { return !s.events().stick; }},
    {Need::centred_race, "a centred race, [0, 0]", [](const System& s) { return s.parameters().race_is_centred(); }},
    {Need::equal_supports, "equal values in x and y", [](const System& s) { return s.parameters().isotropic(); }},
    {Need::no_gravity, "gravity 0", [](const System& s) { return s.parameters().gravity == 0.0; }},
    {Need::turning, "a rotor that turns in the end (other than 0) where supports are unequal or gravity acts",
     [](const System& s) { return s.section() != Section::stroboscopic || s.speed() != 0.0; }},
    {Need::lasting_drive, "a drive that lasts", [](const System& s) { return !s.coasts(); }},
    {Need::linear_torque, "a motor whose torque is linear in the speed, without a load",
     [](const System& s) { return s.prescribed() || s.drive().motor.is_linear(); }},
}};

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

const char* words(Need need) { return need_lines[static_cast<std::size_t>(need)].words; }

std::optional<Lack> lacking(const System& system, ResultKind result) {
  const Capability& asked = capability(result);
  for (const auto& [need, words, met] : need_lines) {
    if (!asked.needs.has(need) || met(system)) continue;
    const std::string others = commands_without(need);
    return Lack{need, std::string(asked.name) + " need " + words + " (" + others +
                          (others.find(" and ") == std::string::npos ? " takes any)" : " take any)")};
  }
  return std::nullopt;
}

}  // namespace equipoise::model
