// Many starts from a fixed list of machines, each followed long after its decision.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "checks.hpp"

namespace equipoise::audit {

struct MachineAudit {
  std::string label;
  std::uint64_t starts = 0, decided = 0, wrong = 0;
  double undecided_share = 0.0;
  double usual = 0.0;    ///< nine in ten decided starts were decided before this time
  double looked = 0.0;   ///< time when they were checked again
  double seconds = 0.0;  ///< of CPU time
  std::string first;     ///< the first contradiction; empty if there is none
};

/// Number of machines.
std::size_t machine_count();
std::string machine_label(std::size_t k);
Study machine_study(std::size_t k);
/// Decides `starts` starts of machine k and follows every one of them, with nothing that decides, at least
/// settings.longer times as long as nine in ten took to be decided.
MachineAudit audit_machine(std::size_t k, std::uint64_t starts, const Settings& settings);

std::string machine_head();
std::string machine_line(const MachineAudit& audit);

}  // namespace equipoise::audit
