// What each answer needs of a system, in one table, and why a system does not have it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "equipoise/model/system.hpp"

namespace equipoise::model {

/// What may be asked about a system.
enum class Answer { trajectory, shares, attractors, proofs, displacements, branches, maps };

/// What an answer may need. Smooth: both of the balls'; autonomous: both of the supports'.
enum class Need { prescribed_speed, passing_balls, sliding_balls, centred_race, equal_supports, no_gravity };

struct Capability {
  Answer answer;
  const char* name;     ///< of the answer, as errors call it
  const char* command;  ///< that gives it to any system which has what it needs; empty if it is no command of its own
  bool smooth, prescribed, centred, autonomous;

  constexpr bool needs(Need need) const {
    switch (need) {
      case Need::prescribed_speed:
        return prescribed;
      case Need::passing_balls:
      case Need::sliding_balls:
        return smooth;
      case Need::centred_race:
        return centred;
      default:
        return autonomous;
    }
  }
};

/// One line an answer, in the order of Answer.
inline constexpr std::array<Capability, 7> capabilities{{
    {Answer::trajectory, "trajectories", "simulate", false, false, false, false},
    {Answer::shares, "shares", "basin", false, false, false, false},
    {Answer::attractors, "attractors", "attractors", false, false, false, false},
    {Answer::proofs, "proofs", "", true, false, false, true},
    {Answer::displacements, "observed displacements", "", true, true, true, true},
    {Answer::branches, "branches along a parameter", "", false, false, false, false},
    {Answer::maps, "maps", "map", false, false, false, false},
}};
constexpr const Capability& capability(Answer answer) { return capabilities[static_cast<std::size_t>(answer)]; }

/// What a system lacks for an answer, and one line that says so.
struct Lack {
  Need need;
  std::string reason;
};

/// The first need, in the order of Need, that the system does not meet; empty if it has all.
std::optional<Lack> lacking(const System& system, Answer answer);

}  // namespace equipoise::model
