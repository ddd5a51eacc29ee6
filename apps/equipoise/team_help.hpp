// What a process lets others do, and does for them: starts of cells at work, a chunk at a time.
#pragma once

#ifdef EQUIPOISE_MPI
#include <cstdint>
#include <future>
#include <memory>
#include <vector>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/sweeps/cell_help.hpp"
#include "equipoise/sweeps/sweep_plan.hpp"
#include "team_messages.hpp"

namespace equipoise::app {

class TeamHelp {
 public:
  /// `threads`: as many chunks of others are decided at a time.
  TeamHelp(Mail& mail, const SweepPlan& plan, CellDesk& desk, int threads, const StopFlag* stop)
      : mail_(mail), plan_(plan), desk_(desk), threads_(static_cast<std::size_t>(threads)), stop_(stop) {}
  /// Sends away who still waits.
  ~TeamHelp();
  TeamHelp(const TeamHelp&) = delete;
  TeamHelp& operator=(const TeamHelp&) = delete;

  /// Begins to help that process, until it has nothing more at work.
  void help(int rank);
  bool helping() const { return helped_ != nobody; }

  /// A message of offers, lends or returns.
  void take(const Message& message);
  /// Does what can be done now; to be called again and again. `at_work`: cells are at work here.
  void step(bool at_work);

 private:
  static constexpr int nobody = -1;
  struct Waiting {
    int rank;
    std::uint64_t ready;  // for this task
  };
  struct InHand {
    std::uint64_t loan;
    std::future<Chunk> chunk;
  };

  bool answer(const Waiting& other, bool at_work);
  void take_offer(int from, Reader reader);
  void take_answer(Reader reader);
  void get_ready(const CellDesk::Task& task);
  void decide(std::uint64_t task, const CellDesk::Loan& loan);
  void return_decided();
  void offer(std::uint64_t what);

  Mail& mail_;
  const SweepPlan& plan_;
  CellDesk& desk_;
  const std::size_t threads_;
  const StopFlag* stop_;
  std::vector<Waiting> waiting_;  // others, for chunks of ours

  // For another:
  int helped_ = nobody;
  bool over_ = false;       // nothing more is to come from it
  std::size_t offers_ = 0;  // that it has not answered yet
  std::uint64_t task_ = 0;  // that we are ready for, or are getting ready for; 0: none
  std::shared_ptr<const EnsembleHelper> ensemble_;
  std::future<std::shared_ptr<const EnsembleHelper>> search_;
  std::vector<InHand> in_hand_;
};

}  // namespace equipoise::app

#endif
