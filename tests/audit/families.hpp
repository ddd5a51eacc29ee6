// Starts that draw their rotors, compared with the same rotors known exactly.
#pragma once

#include <cstdint>
#include <string>

#include "checks.hpp"

namespace equipoise::audit {

struct FamilyAudit {
  std::string label;
  std::uint64_t starts = 0;    ///< compared one by one with the known rotor of the same values
  std::uint64_t same = 0;      ///< of one kind in both
  std::uint64_t open = 0;      ///< undecided in one of the two
  std::uint64_t boundary = 0;  ///< different, but the known rotor's neighbouring starts end differently too
  std::uint64_t different = 0;
  std::uint64_t rotors = 0;         ///< rotors whose mean shares are compared with those over all values
  double deviation = 0.0;           ///< of the kind that differs most, in standard errors of the difference
  std::string kind;                 ///< the kind that differs most,
  double drawn = 0.0, known = 0.0;  ///< its share over all values, and its mean over rotors
  double seconds = 0.0;             ///< of CPU time
  std::string first;                ///< the first difference; empty if there is none
};

/// Beyond this a share is wrong: one of a hundred comparisons exceeds it once in two hundred audits.
inline constexpr double largest_deviation = 4.0;

/// Audits machine `k` (machines.hpp), whose starts draw their rotors.
FamilyAudit audit_family(std::size_t k, std::uint64_t starts, const Settings& settings);

std::string family_head();
std::string family_line(const FamilyAudit& audit);

}  // namespace equipoise::audit
