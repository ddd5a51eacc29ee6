// Reads how mpirun or srun started this process.
#include "team.hpp"

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"

namespace equipoise::app {

namespace {

int number(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

}  // namespace

Job job_of_environment() {
  if (std::getenv("OMPI_COMM_WORLD_SIZE"))
    return {number("OMPI_COMM_WORLD_SIZE", 1), number("OMPI_COMM_WORLD_RANK", 0), "OMPI_COMM_WORLD_SIZE"};
  if (std::getenv("PMI_SIZE")) return {number("PMI_SIZE", 1), number("PMI_RANK", 0), "PMI_SIZE"};
  // PMIx gives no size; Slurm, which starts processes with it, does.
  if (std::getenv("PMIX_RANK")) {
    const int rank = number("PMIX_RANK", 0);
    return {number("SLURM_STEP_NUM_TASKS", number("SLURM_NTASKS", rank + 1)), rank, "PMIX_RANK"};
  }
  return {};
}

bool repeats_work(const CLI::App& command) {
  const Job job = job_of_environment();
  const std::string name = command.get_name();
  const auto has = [&](const char* option) { return command.get_option_no_throw(option) != nullptr; };
  const bool computes_or_writes = has("--threads") || has("--output");
  if (job.size <= 1 || !computes_or_writes) return false;
  const bool shares = name == "sweep" || name == "capacity" || name == "design", parts = has("--shard");
  if (shares && (has_mpi() || (parts && command.count("--shard") > 0))) return false;
  if (job.rank > 0) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    return true;
  }
  throw InputError(job.variable, "", "",
                   !shares
                       ? fmt::format("says that {} processes were started, but \"{}\" shares no work: each would do "
                                     "the whole work. Start one process, which uses all cores",
                                     job.size, name)
                       : fmt::format("says that {} processes were started, but this program is built without MPI: each "
                                     "would do the whole work. Install an MPI library (Debian: apt-get install "
                                     "libopenmpi-dev) and build again (./dev run, or cmake), or {}start one process",
                                     job.size, parts ? "give each process a part with --shard I/N, or " : ""));
}

}  // namespace equipoise::app
