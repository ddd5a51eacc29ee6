// What every long call of the library takes: threads, progress, the wish to stop, the instruction set.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "equipoise/base/stop_flag.hpp"

namespace equipoise {

/// How far a call has come.
struct Progress {
  std::uint64_t done = 0;
  std::uint64_t total = 0;         ///< 0: not known
  std::string what;                ///< that is counted, or is at work: "starts", "table-3-t0-25, kinematic law"
  std::optional<double> balanced;  ///< of an ensemble: share of the starts done that end balanced
  bool preparing = false;  ///< a stage of what comes before: a search for attractors, before any start is counted
};

/// Callbacks run on the thread that made the call, so they may use what belongs to it (an interpreter, a window). Work
/// waits for `progress` to return. What a callback throws ends the work, and the call throws it.
struct RunOptions {
  int threads = 0;                   ///< 0: all cores. No result depends on it
  const StopFlag* stop = nullptr;    ///< once it is true the work ends soon; what is done is returned, marked partial
  std::function<bool()> stop_asked;  ///< the same for those who would rather be asked, some twenty times a second
  std::function<void(const Progress&)> progress;  ///< called in order
  /// One of cpu_targets(). The choice is the process's: simultaneous calls must not name different ones.
  std::string cpu_target;
};

}  // namespace equipoise
