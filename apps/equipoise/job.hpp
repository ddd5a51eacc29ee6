// How mpirun or srun started this process.
#pragma once

namespace equipoise::app {

struct Job {
  int size = 1;                    ///< processes; 1: started alone
  int rank = 0;                    ///< this one, from 0
  const char* variable = nullptr;  ///< the environment variable that says so; null: started alone
};

/// From the environment variables of Open MPI, MPICH and its relatives, and Slurm with PMIx.
Job job_of_environment();

/// Whether this is one of several processes that would each do the whole work; for programs built without MPI. The
/// first process reports this for all by throwing InputError. The others return true a second later: job starters end
/// all processes as soon as one has failed, and the first must have reported by then.
bool repeats_work();

}  // namespace equipoise::app
