// Reads how mpirun or srun started this process.
#include "team.hpp"

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "words.hpp"

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
                   !shares ? fmt::format(words::shares_no_work, job.size, name)
                           : fmt::format(words::built_without_mpi, job.size, parts ? words::or_a_part_each : ""));
}

}  // namespace equipoise::app
