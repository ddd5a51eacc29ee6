// The cells that this process works on; idle threads and other processes can decide some of their starts.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/results/types/warm_start_levels.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Where a cell's search begins: with its neighbour's results.
struct CellStart {
  std::vector<std::vector<double>> warm_start_states;
  bool warm_start = false;
  WarmStartLevels warm_start_levels;
  bool operator==(const CellStart&) const = default;
};

/// What another process needs to know to decide starts of a cell with the same bits.
struct CellAtWork {
  std::size_t cell = 0;
  std::vector<std::string> more = {};  ///< set on top of the cell's study
  CellStart start = {};
  SamplingMethod method = SamplingMethod::random;
  bool operator==(const CellAtWork&) const = default;
};

/// Callable from any thread.
class CellDesk {
 public:
  CellDesk() = default;
  CellDesk(const CellDesk&) = delete;
  CellDesk& operator=(const CellDesk&) = delete;

  /// A cell at work, so that others can prepare. Brings an ensemble's chunks to the desk, which must outlive it.
  class Place final : public ChunkHelp {
   public:
    Place(CellDesk& desk, CellAtWork at);
    ~Place() override;
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

    const CellAtWork& at() const { return at_; }
    void open(ChunkQueue& queue) override;
    void close() override;

   private:
    friend class CellDesk;
    bool work_off(std::unique_lock<std::mutex>& lock);

    CellDesk& desk_;
    const CellAtWork at_;
    std::uint64_t number_;
    ChunkQueue* queue_ = nullptr;  // while it is open
    int inside_ = 0;               // others at work on its chunks
  };

  /// Decides a chunk of some cell's starts. False if none is available now.
  bool help();

  struct Task {
    std::uint64_t number = 0;
    CellAtWork at;
  };
  /// For the place taken last.
  std::optional<Task> newest();
  /// A chunk given to another process.
  struct Loan {
    std::uint64_t number = 0, first = 0;
    std::size_t count = 0;
  };
  std::optional<Loan> lend(std::uint64_t task);
  /// Takes back a loan: decided, or given up (no fates). Ignored if the cell is no longer at work.
  void give_back(std::uint64_t loan, Chunk made);

 private:
  struct Lent {
    Place* place;
    std::shared_ptr<Chunk> chunk;
  };

  std::mutex mutex_;
  std::condition_variable left_;
  std::vector<Place*> places_;
  std::size_t turn_ = 0;  // places are helped in turn
  std::map<std::uint64_t, Lent> lent_;
  std::uint64_t last_number_ = 0;  // of tasks and loans
};

}  // namespace equipoise
