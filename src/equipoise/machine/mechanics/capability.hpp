// What each kind of result needs of a system, in one table for commands, their errors and the guide.
#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <string>

#include "equipoise/machine/model/system.hpp"

namespace equipoise::model {

/// The kinds of result about a system.
enum class ResultKind {
  trajectory,
  shares,
  attractors,
  proofs,
  displacements,
  branches,
  maps,
  transients,
  equations,
  pages,
  designs,
  curves
};

/// Properties of a system that a result may need.
enum class Need {
  prescribed_speed,
  passing_balls,
  sliding_balls,
  centred_race,
  equal_supports,
  no_gravity,
  turning,        ///< a final speed other than 0, if the equations depend on the rotor's angle
  lasting_drive,  ///< a prescribed speed, or a torque that does not vanish for good
  linear_torque,  ///< a prescribed speed, or a torque that is linear in the speed
};
inline constexpr std::array all_needs{Need::prescribed_speed, Need::passing_balls,  Need::sliding_balls,
                                      Need::centred_race,     Need::equal_supports, Need::no_gravity,
                                      Need::turning,          Need::lasting_drive,  Need::linear_torque};

class Needs {
 public:
  constexpr Needs(std::initializer_list<Need> needs) {
    for (const Need need : needs) bits_ |= 1u << static_cast<unsigned>(need);
  }
  constexpr bool has(Need need) const { return (bits_ >> static_cast<unsigned>(need) & 1u) != 0; }

 private:
  unsigned bits_ = 0;
};

struct Capability {
  ResultKind result;
  const char* name;     ///< of the result, in errors
  const char* command;  ///< gives the result for every system that meets the needs; empty if no command does
  Needs needs;
};

/// One row per result, in the order of ResultKind. docs/reference/commands/index.md shows it.
inline constexpr std::array<Capability, 12> capabilities{{
    {ResultKind::trajectory, "trajectories", "simulate", {}},
    {ResultKind::shares, "shares", "basin", {Need::turning}},
    {ResultKind::attractors, "attractors", "attractors", {Need::turning, Need::lasting_drive}},
    {ResultKind::proofs,
     "proofs",
     "",
     {Need::passing_balls, Need::sliding_balls, Need::equal_supports, Need::no_gravity, Need::lasting_drive,
      Need::linear_torque}},
    {ResultKind::displacements,
     "observed displacements",
     "",
     {Need::prescribed_speed, Need::passing_balls, Need::sliding_balls, Need::centred_race, Need::equal_supports,
      Need::no_gravity}},
    {ResultKind::branches, "branches along a parameter", "", {Need::turning, Need::lasting_drive}},
    {ResultKind::maps, "maps", "map", {Need::turning, Need::lasting_drive}},
    {ResultKind::transients, "figures of transients", "", {}},
    {ResultKind::equations, "equations for other integrators", "", {}},
    {ResultKind::pages, "reports and pages", "", {}},
    {ResultKind::designs, "designs", "", {}},
    {ResultKind::curves,
     "curves in a plane of two parameters",
     "chart",
     {Need::centred_race, Need::equal_supports, Need::no_gravity, Need::turning, Need::lasting_drive}},
}};
constexpr const Capability& capability(ResultKind result) { return capabilities[static_cast<std::size_t>(result)]; }

/// A need in words: "a prescribed speed".
const char* words(Need need);

/// A need that a system does not meet, and a line that says so.
struct Lack {
  Need need;
  std::string reason;
};

/// The first need, in the order of Need, that the system does not meet; empty if it meets all.
std::optional<Lack> lacking(const System& system, ResultKind result);

}  // namespace equipoise::model
