// All checks of one study, within a share of time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "drawn_study.hpp"
#include "ensemble.hpp"
#include "verdict.hpp"

namespace equipoise::audit {

struct Settings {
  std::uint64_t starts = 300;          ///< of an ensemble
  std::uint64_t machine_starts = 100;  ///< of a machine's ensemble, followed one by one in plain doubles
  int threads = 2;
  double seconds = 40.0;  ///< CPU time per study; further checks are then skipped
  double longer = 20.0;   ///< factor on the decision time up to which starts are followed
  std::string folder;     ///< for studies that failed, and the commands that show it
};

/// The columns of the table.
enum class Column : std::size_t {
  later,      ///< what was said still holds long after
  horizon,    ///< the same if nothing is decided early, over three times the time
  proof,      ///< the same if decided by proof
  rotated,    ///< the rotor's initial angle does not matter
  mirror,     ///< everything turns the other way
  order,      ///< balls in the opposite order
  physical,   ///< in SI units
  threads,    ///< bit-identical with one thread and with three
  processor,  ///< another instruction set
  replayed,   ///< single starts again
  figures,    ///< signs, units and sums of printed figures
  undecided,  ///< at most a fifth, or a message says why
};
inline constexpr std::size_t column_count = 12;
extern const std::array<const char*, column_count> column_names;

struct StudyAudit {
  DrawnStudy drawn;
  std::string refused;  ///< the program's own message, if it refused the study before any work
  std::string answer;   ///< "balanced 61 %, ..."
  double undecided_share = 0.0;
  double seconds = 0.0;                    ///< CPU
  std::array<Check, column_count> checks;  ///< by Column

  Check& at(Column column) { return checks[static_cast<std::size_t>(column)]; }
  bool failed() const;
};

StudyAudit audit_study(const DrawnStudy& drawn, const Settings& settings);

}  // namespace equipoise::audit
