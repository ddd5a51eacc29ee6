// Options of every long call: threads, progress, the request to stop, the instruction set.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "equipoise/core/base/stop_flag.hpp"

namespace equipoise {

/// How far a call has come.
struct Progress {
  std::uint64_t done = 0;
  std::uint64_t total = 0;         ///< 0: unknown
  std::string what;                ///< what is counted or at work: "starts", "table-3-t0-25, kinematic law"
  std::optional<double> balanced;  ///< for an ensemble: balanced share of the starts done
  bool preparing = false;          ///< a stage before any start is counted, such as the search for attractors
};

/// Callbacks run on the thread that made the call, so they may use what belongs to it, such as an interpreter or a
/// window. Work waits for `progress` to return. An exception from a callback ends the work and leaves the call.
struct RunOptions {
  int threads = 0;                   ///< 0: all cores. No result depends on it
  const StopFlag* stop = nullptr;    ///< once true, work ends soon and returns what is done, marked partial
  std::function<bool()> stop_asked;  ///< the same by polling, some twenty times a second
  std::function<void(const Progress&)> progress;   ///< called in order
  std::function<void(const std::string&)> notice;  ///< a sentence for the user, such as what a damaged file has lost
  /// One of cpu_targets(). It applies to the whole process: simultaneous calls must not name different ones.
  std::string cpu_target;
};

inline void give_notice(const RunOptions& options, const std::string& sentence) {
  if (options.notice && !sentence.empty()) options.notice(sentence);
}

}  // namespace equipoise
