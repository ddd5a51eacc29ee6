// How mpirun or srun started this process.
#pragma once

#include <CLI/CLI.hpp>

namespace equipoise::app {

struct Job {
  int size = 1;                    ///< processes; 1: started alone
  int rank = 0;                    ///< this one, from 0
  const char* variable = nullptr;  ///< the environment variable that says so; null: started alone
};

/// From the environment variables of Open MPI, MPICH and its relatives, and Slurm with PMIx.
Job job_of_environment();

/// Whether this is one of several processes each of which would do the whole work of this command, and write its files:
/// because the command shares no work, or because the program is built without MPI. The first process says so for all:
/// it throws InputError. The others are told true, a second later: starters of jobs end all processes as soon as one
/// has failed, and the first must have spoken by then.
bool repeats_work(const CLI::App& command);

}  // namespace equipoise::app
