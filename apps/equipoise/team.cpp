// Messages between the processes of a job. The first answers whoever asks for work; a block goes out with what is known
// of it, cells come back one by one.
#include "team.hpp"

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/store/sweep_cells.hpp"
#include "equipoise/sweeps/sweep_cell.hpp"

#ifdef EQUIPOISE_MPI
#define OMPI_SKIP_MPICXX
#define MPICH_SKIP_MPICXX
#include <mpi.h>
#endif

namespace equipoise::app {

namespace {

// By what the starters of jobs leave in the environment: Open MPI, MPICH and its kin, Slurm's srun with PMIx.
bool started_by_mpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"})
    if (std::getenv(name)) return true;
  return false;
}

}  // namespace

#ifdef EQUIPOISE_MPI

namespace {

enum Tag { asks = 1, brings, leaves, gives };
constexpr std::int64_t nothing = -1;

using Bytes = std::vector<std::uint8_t>;

void put_number(Bytes& bytes, std::int64_t number) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof number);
  std::memcpy(bytes.data() + at, &number, sizeof number);
}

std::int64_t take_number(const Bytes& bytes, std::size_t& at) {
  std::int64_t number = nothing;
  if (bytes.size() - at < sizeof number) throw RunError("a message between processes was cut short");
  std::memcpy(&number, bytes.data() + at, sizeof number);
  at += sizeof number;
  return number;
}

void put_cell(Bytes& bytes, std::size_t index, const SweepCell& cell) {
  const Bytes content = store::bytes_of(cell);
  put_number(bytes, static_cast<std::int64_t>(index));
  put_number(bytes, static_cast<std::int64_t>(content.size()));
  bytes.insert(bytes.end(), content.begin(), content.end());
}

std::pair<std::size_t, SweepCell> take_cell(const Bytes& bytes, std::size_t& at) {
  const auto index = static_cast<std::size_t>(take_number(bytes, at));
  const auto size = static_cast<std::size_t>(take_number(bytes, at));
  if (size > bytes.size() - at) throw RunError("a message between processes was cut short");
  auto cell = store::cell_from(bytes.data() + at, size);
  if (!cell) throw RunError("a message between processes holds no cell");
  at += size;
  return {index, std::move(*cell)};
}

void send(const Bytes& bytes, int to, int tag) {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

Bytes receive(const MPI_Status& found) {
  int size = 0;
  MPI_Get_count(&found, MPI_BYTE, &size);
  Bytes bytes(static_cast<std::size_t>(size));
  MPI_Recv(bytes.data(), size, MPI_BYTE, found.MPI_SOURCE, found.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return bytes;
}

std::optional<MPI_Status> waiting() {
  int there = 0;
  MPI_Status found;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &found);
  return there ? std::optional(found) : std::nullopt;
}

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds rest{2};  // between two looks for messages
constexpr std::chrono::seconds patience{3};   // with others that are to come home

void answer(int to, const SweepPlan& plan, const SweepWork& work, const std::optional<std::size_t>& block) {
  Bytes bytes;
  put_number(bytes, block ? static_cast<std::int64_t>(*block) : nothing);
  if (block)
    for (const std::size_t index : plan.cells_of(*block))
      if (const SweepCell* cell = work.known(index)) put_cell(bytes, index, *cell);
  send(bytes, to, gives);
}

void give_nothing(int to) {
  Bytes bytes;
  put_number(bytes, nothing);
  send(bytes, to, gives);
}

}  // namespace

std::string mpi_text() {
  char version[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  MPI_Get_library_version(version, &length);
  const std::string text(version, static_cast<std::size_t>(length));
  return text.substr(0, text.find(','));
}

Team::Team() {
  if (!started_by_mpi()) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  left_ = size_ - 1;
  joined_ = true;
}

// Others that will not answer any more cannot be waited for.
Team::~Team() {
  if (!joined_) return;
  if (left_ == 0)
    MPI_Finalize();
  else
    MPI_Abort(MPI_COMM_WORLD, interrupted);
}

bool Team::agree(bool good) {
  int answer = good;
  if (joined_) MPI_Bcast(&answer, 1, MPI_INT, 0, MPI_COMM_WORLD);
  if (!answer) left_ = 0;
  return answer;
}

void Team::lead(const SweepPlan& plan, SweepWork& work) {
  std::optional<Clock::time_point> stopped;
  while (left_ > 0) {
    const auto found = waiting();
    if (!found) {
      if (stop_flag() && !stopped) stopped = Clock::now();
      if (stopped && Clock::now() - *stopped > patience) return;
      std::this_thread::sleep_for(rest);
      continue;
    }
    const Bytes message = receive(*found);
    std::size_t at = 0;
    if (found->MPI_TAG == brings) {
      auto [index, cell] = take_cell(message, at);
      work.deliver(index, std::move(cell));
      continue;
    }
    const auto block = found->MPI_TAG == asks ? work.next_block() : std::nullopt;
    if (found->MPI_TAG == asks) answer(found->MPI_SOURCE, plan, work, block);
    if (!block) --left_;
  }
}

void Team::dismiss() {
  const Clock::time_point begin = Clock::now();
  while (left_ > 0 && Clock::now() - begin < patience) {
    const auto found = waiting();
    if (!found) {
      std::this_thread::sleep_for(rest);
      continue;
    }
    receive(*found);
    if (found->MPI_TAG == asks) give_nothing(found->MPI_SOURCE);
    if (found->MPI_TAG != brings) --left_;
  }
}

void Team::follow(const SweepPlan& plan, int threads, const StopFlag* stop) {
  const auto deliver = [](std::size_t index, const SweepCell& cell) {
    Bytes message;
    put_cell(message, index, cell);
    send(message, 0, brings);
  };
  for (;;) {
    send({}, 0, asks);
    MPI_Status found;
    MPI_Probe(0, gives, MPI_COMM_WORLD, &found);
    const Bytes work = receive(found);
    std::size_t at = 0;
    const std::int64_t block = take_number(work, at);
    if (block == nothing) break;
    std::map<std::size_t, SweepCell> there;
    while (at < work.size()) there.insert(take_cell(work, at));
    const auto known = [&](std::size_t index) -> const SweepCell* {
      const auto cell = there.find(index);
      return cell == there.end() ? nullptr : &cell->second;
    };
    if (run_block(plan, static_cast<std::size_t>(block), known, deliver, threads, stop)) continue;
    send({}, 0, leaves);
    break;
  }
  left_ = 0;
}

#else

std::string mpi_text() { return "not built in"; }

Team::Team() {
  if (started_by_mpi())
    throw RunError(
        "was started as one of several processes (MPI), but is built without MPI: every one of them would do the whole "
        "work; build it where an MPI library is installed (libopenmpi-dev), or start one process");
}
Team::~Team() = default;
bool Team::agree(bool good) { return good; }
void Team::lead(const SweepPlan&, SweepWork&) {}
void Team::follow(const SweepPlan&, int, const StopFlag*) {}
void Team::dismiss() {}

#endif

}  // namespace equipoise::app
