// The processes of one job on a cluster: the first hands out work, all do it. Without MPI there is only one.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "commands.hpp"
#include "equipoise/analyses/sweeps/survey.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "options.hpp"

namespace equipoise::app {

/// What --version says about MPI.
std::string mpi_text();
/// Whether this program is built with MPI.
bool has_mpi();

/// How mpirun or srun started this process.
struct Job {
  int size = 1;                    ///< processes; 1: started alone
  int rank = 0;                    ///< this one, from 0
  const char* variable = nullptr;  ///< the environment variable that says so; null: started alone
};

/// From the environment variables of Open MPI, MPICH and its relatives, and Slurm with PMIx.
Job job_of_environment();

/// Whether this is one of several processes each of which would do the whole work of this command and write its files,
/// because the command shares no work or the program is built without MPI. The first process reports it for all by
/// throwing InputError. The others get true a second later: job starters end all processes as soon as one has failed,
/// and the first must have reported by then.
bool repeats_work(const CLI::App& command);

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

  /// Each of several processes on a machine has a core of its own.
  int threads(const std::optional<std::string>& option) const { return option || alone() ? threads_option(option) : 1; }

  /// Whether all were given the same words. If not, no one has any work.
  bool have_same(const std::string& words);
  /// What `prepare` makes in the first process, then in the others. If the input is wrong, the first one reports it,
  /// and none of the others prepares anything.
  template <class Prepare>
  auto prepared(const Prepare& prepare) {
    std::optional<decltype(prepare())> made;
    try {
      if (leads()) made = prepare();
    } catch (...) {
      agree(false);
      throw;
    }
    if (agree(leads()) && !leads()) made = or_end([&] { return prepare(); });
    return made;
  }
  /// In the first: what `compute` makes with these options of a survey. Gives blocks to the others and takes their
  /// cells until no one works. If the work cannot go on, the others are dismissed.
  template <class Options, class Compute>
  auto lead(Options& options, const Compute& compute) {
    if (!alone()) options.helpers = [this, stop = options.stop](SurveyRun& work) { lead(work, stop); };
    return or_end(compute);
  }
  /// Of the others: works until the first has nothing more. Returns the exit code.
  int follow(const Survey& survey, int threads, const StopFlag* stop);

 private:
  // What cannot go on here ends for all: others are sent home. If some no longer ask, the error is said before the
  // whole job is aborted, since nothing can be said after.
  template <class Work>
  auto or_end(const Work& work) {
    try {
      return work();
    } catch (...) {
      if (leads()) dismiss();
      if (left_ > 0) abort(say_error(std::current_exception()));
      throw;
    }
  }
  bool agree(bool good);  // what the first found, known to all
  void lead(SurveyRun& work, const StopFlag* stop);
  void dismiss();
  [[noreturn]] void abort(int code);

  int rank_ = 0, size_ = 1, left_ = 0;    // left_: of the others, those that may ask again
  [[maybe_unused]] bool joined_ = false;  // without MPI nothing is joined
  std::unique_ptr<Post> post_;
};

}  // namespace equipoise::app
