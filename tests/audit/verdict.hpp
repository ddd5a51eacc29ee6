// The result of one check of one study.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace equipoise::audit {

enum class Verdict {
  passed,
  failed,
  not_asked,  ///< does not apply to this study, or the study's share of time was used up
};

/// One check.
struct Check {
  Verdict verdict = Verdict::not_asked;
  std::string seen;  ///< a few words for the table: "200 of 200", "2 flips"

  struct Fault {
    std::string what, command;  ///< one line each; the command shows the fault
  };
  std::vector<Fault> faults;

  static Check passed(std::string seen) { return {Verdict::passed, std::move(seen), {}}; }
  void fail(std::string what, std::string command) {
    verdict = Verdict::failed;
    if (faults.size() < most_faults) faults.push_back({std::move(what), std::move(command)});
  }

  static constexpr std::size_t most_faults = 3;  ///< shown; further ones say the same
};

}  // namespace equipoise::audit
