// The processes of one job on a cluster: work handed out by the first, done by all. Without MPI there is only one.
#pragma once

#include <memory>
#include <string>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/sweeps/sweep.hpp"

namespace equipoise::app {

/// What --version says of it.
std::string mpi_text();
/// Whether this program is built with MPI.
bool has_mpi();

class Post;

class Team {
 public:
  /// Joins the others if mpirun, or what does as it does, started this process and this program is built with MPI.
  Team();
  /// Leaves them: once all have left, or at once if this process was stopped.
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  bool alone() const { return size_ == 1; }
  bool leads() const { return rank_ == 0; }
  int size() const { return size_; }

  /// Whether all were given the same words. If not there is no work for anybody.
  bool have_same(const std::string& words);
  /// What the first found of what was asked, known to all: whether there is work.
  bool agree(bool good);
  /// Of the first: gives blocks to the others and takes their cells until none of them has any left. Whom no block is
  /// left for decides starts of others' cells, this process too: `threads` chunks at a time.
  void lead(const SweepPlan& plan, SweepWork& work, int threads, const StopFlag* stop);
  /// Of the first, if the work cannot go on: sends the others home.
  void dismiss();
  /// Of the others: works until the first has nothing more.
  void follow(const SweepPlan& plan, int threads, const StopFlag* stop);

 private:
  int rank_ = 0, size_ = 1, left_ = 0;  // left_: of the others, those that may ask again
  bool joined_ = false;
  std::unique_ptr<Post> post_;
};

}  // namespace equipoise::app
