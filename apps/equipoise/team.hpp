// The processes of one job on a cluster: the first hands out work, all do it. Without MPI there is only one.
#pragma once

#include <memory>
#include <string>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/sweeps/sweep.hpp"

namespace equipoise::app {

/// What --version says about MPI.
std::string mpi_text();
/// Whether this program is built with MPI.
bool has_mpi();

class Post;

class Team {
 public:
  /// Joins the others if mpirun or a similar starter started this process, and this program is built with MPI.
  Team();
  /// Leaves them: once all have left, or at once if this process was stopped.
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  bool alone() const { return size_ == 1; }
  bool leads() const { return rank_ == 0; }
  int size() const { return size_; }

  /// Whether all were given the same words. If not, nobody works.
  bool have_same(const std::string& words);
  /// The first process's finding, made known to all: whether there is work.
  bool agree(bool good);
  /// For the first: gives blocks to the others and receives their cells until none is left. Processes without a block,
  /// this one included, decide starts of others' cells, `threads` chunks at a time.
  void lead(const SweepPlan& plan, SweepWork& work, int threads, const StopFlag* stop);
  /// For the first, if the work cannot go on: sends the others home.
  void dismiss();
  /// For the others: works until the first has nothing more.
  void follow(const SweepPlan& plan, int threads, const StopFlag* stop);

 private:
  int rank_ = 0, size_ = 1, left_ = 0;  // left_: number of other processes that may ask again
  bool joined_ = false;
  std::unique_ptr<Post> post_;
};

}  // namespace equipoise::app
