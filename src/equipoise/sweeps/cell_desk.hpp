// Cells at work in this process, so that others may decide some of their starts: idle threads, other processes.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "equipoise/basins/chunks.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/types/trap_hints.hpp"

namespace equipoise {

/// Where a cell's search begins: with what its neighbour has.
struct CellStart {
  std::vector<std::vector<double>> seeds;
  bool informed = false;
  TrapHints hints;
  bool operator==(const CellStart&) const = default;
};

/// What who decides starts of a cell elsewhere must know to give them the same bits.
struct CellAtWork {
  std::size_t cell = 0;
  CellStart start;
  SamplingMethod method = SamplingMethod::random;
  bool operator==(const CellAtWork&) const = default;
};

/// All from any thread.
class CellDesk {
 public:
  CellDesk() = default;
  CellDesk(const CellDesk&) = delete;
  CellDesk& operator=(const CellDesk&) = delete;

  /// Says that a cell is at work, so that others get ready, until retract().
  void announce(const CellAtWork& cell);
  void retract(std::size_t cell);
  /// What brings an ensemble's chunks to the desk, and announces it; it must not outlive the desk.
  std::unique_ptr<ChunkHelp> help_for(CellAtWork cell);

  /// Decides a chunk of some cell's starts. False if there is none to be had now.
  bool help();

  struct Task {
    std::uint64_t number = 0;
    CellAtWork at;
  };
  /// The one announced last.
  std::optional<Task> newest();
  /// A chunk that goes elsewhere.
  struct Loan {
    std::uint64_t number = 0, first = 0;
    std::size_t count = 0;
  };
  std::optional<Loan> lend(std::uint64_t task);
  /// What was made of it: decided, or given up (no fates). That of a cell which is not at work any more is left alone.
  void give_back(std::uint64_t loan, Chunk made);

 private:
  class Place;
  struct Lent {
    Place* place;
    std::shared_ptr<Chunk> chunk;
  };

  std::mutex mutex_;
  std::condition_variable left_;
  std::vector<Place*> places_;  // of the cells at work
  std::size_t turn_ = 0;        // they are helped one after the other
  std::map<std::uint64_t, CellAtWork> tasks_;
  std::map<std::uint64_t, Lent> lent_;
  std::uint64_t last_number_ = 0;  // of tasks and loans
};

}  // namespace equipoise
