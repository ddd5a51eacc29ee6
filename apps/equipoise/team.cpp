// The processes of a job. Rank 0 hands out blocks of cells and receives finished cells. A process that gets no block is
// sent to another one, to decide starts of the cell at work there.
#include "team.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "equipoise/core/base/bytes.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/analyses/ensembles/ensemble_runner.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"
#include "equipoise/results/types/fate_bytes.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/analyses/sweeps/cell_desk.hpp"
#include "job.hpp"
#include "post.hpp"
#include "time_limit.hpp"
#include "words.hpp"

namespace equipoise {

template <class Bytes, Like<CellAtWork> T>
void members(Bytes& b, T& t) {
  b(t.cell, t.more, t.start.warm_start_states, t.start.warm_start, t.start.warm_start_levels.levels,
    t.start.warm_start_levels.weights, t.method);
}
// The state it was left in: the process that lent the start follows it further.
template <class Bytes, Like<UnlistedStart> T>
void members(Bytes& b, T& t) {
  b(t.place, t.state);
}
template <class Bytes, Like<Chunk> T>
void members(Bytes& b, T& t) {
  b(t.fates, t.transients, t.unlisted);
}

}  // namespace equipoise

namespace equipoise::app {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds rest{2};    // between two checks for messages
constexpr std::chrono::milliseconds pause{10};  // of a process that has nothing to do
constexpr std::chrono::seconds patience{3};     // with processes that should finish

// Rank 0 hands out work and known cells, and receives finished cells. A process with a cell hands out its starts.
enum class Asked : std::uint8_t { for_work, for_cell, to_take_cell, for_starts };

// A process that was stopped abandons its block: the whole job stops for the same reason, or the block would be
// missing.
enum class Stopped : std::uint8_t { no, asked, time_over };

struct Work {
  enum class Kind : std::uint8_t { none, later, block, help } kind = Kind::none;
  std::size_t which = 0;  // block, or process
};
// Starts of a task, which the receiver prepares for first.
struct Starts {
  enum class Kind : std::uint8_t { none, later, get_ready, decide } kind = Kind::none;
  CellDesk::Task task;
  CellDesk::Loan loan;
};
constexpr std::uint64_t no_task = 0, no_loan = 0;

template <class B, Like<Starts> T>
void members(B& b, T& t) {
  b(t.kind, t.task.number, t.task.at, t.loan);
}

void require_whole(const BytesIn& in) {
  if (!in.whole()) throw RunError(words::message_cut_short);
}

Asked asked_in(BytesIn& question) {
  Asked what{};
  question(what);
  return what;
}

// A default value if the post is closed.
template <class T>
T answer_from(const Bytes& bytes) {
  T answer;
  if (bytes.empty()) return answer;
  BytesIn in(bytes);
  in(answer);
  require_whole(in);
  return answer;
}

// What any process does: blocks, one at a time, and starts of others' cells.
class Member {
 public:
  Member(Post& post, const Survey& survey, CellDesk& desk, int threads, const StopFlag* stop)
      : post_(post), survey_(survey), desk_(desk), threads_(threads), stop_(stop) {}

  // Works until nothing is left for anybody.
  void work() {
    const std::string target = cpu_target();
    for (;;) {
      const Work given = answer_from<Work>(post_.ask(0, bytes_of(Asked::for_work, target, why_stopped())));
      if (given.kind == Work::Kind::none) return;
      if (given.kind == Work::Kind::block)
        compute(given.which);
      else if (given.kind == Work::Kind::help)
        help(static_cast<int>(given.which));
      if (given.kind != Work::Kind::block) std::this_thread::sleep_for(pause);
    }
  }

  // For a process prepared for this task: takes back its last loan, and looks for another.
  Starts lend(std::uint64_t ready, std::uint64_t loan, Chunk made) {
    if (loan != no_loan) desk_.give_back(loan, std::move(made));
    if (const auto lent = desk_.lend(ready)) return {Starts::Kind::decide, {}, *lent};
    const auto task = desk_.newest();
    if (!task) return {};
    if (task->number == ready) return {Starts::Kind::later, {}, {}};
    return {Starts::Kind::get_ready, *task, {}};
  }

 private:
  Stopped why_stopped() const {
    return !is_set(stop_) ? Stopped::no : time_is_over() ? Stopped::time_over : Stopped::asked;
  }

  void compute(std::size_t block) {
    const auto known = [this](std::size_t cell) {
      return answer_from<CellRecord>(post_.ask(0, bytes_of(Asked::for_cell, cell)));
    };
    const auto deliver = [this](std::size_t cell, const CellRecord& made) {
      post_.ask(0, bytes_of(Asked::to_take_cell, cell, made));
    };
    survey_.run_block(block, {.threads = threads_, .desk = &desk_, .stop = stop_, .known = known, .deliver = deliver});
  }

  Starts starts_of(int whom, std::uint64_t ready, std::uint64_t loan = no_loan, const Chunk& made = {}) {
    return answer_from<Starts>(post_.ask(whom, bytes_of(Asked::for_starts, ready, loan, made)));
  }

  // Helps until the other has no cell at work. Its search for a cell's attractors is repeated here meanwhile.
  void help(int whom) {
    for (Starts next = starts_of(whom, no_task); next.kind == Starts::Kind::get_ready && !is_set(stop_);
         next = starts_of(whom, no_task)) {
      const EnsembleHelper ensemble = survey_.helper_for(next.task.at, threads_, stop_);
      if (ensemble.stopped()) return;
      in_parallel(threads_, static_cast<std::size_t>(threads_),
                  [&](std::size_t) { decide_starts(whom, next.task.number, ensemble); });
    }
  }

  // Decides starts until another task is to be prepared for. Undecided loans go back unchanged.
  void decide_starts(int whom, std::uint64_t task, const EnsembleHelper& ensemble) {
    Starts next = starts_of(whom, task);
    while (next.kind == Starts::Kind::later || next.kind == Starts::Kind::decide) {
      if (next.kind == Starts::Kind::later) {
        if (is_set(stop_)) return;
        std::this_thread::sleep_for(rest);
        next = starts_of(whom, task);
        continue;
      }
      Chunk chunk;
      chunk.first = next.loan.first;
      chunk.count = next.loan.count;
      const bool decided = !is_set(stop_) && ensemble.decide(chunk);
      next = starts_of(whom, decided ? task : no_task, next.loan.number, decided ? chunk : Chunk{});
    }
  }

  Post& post_;
  const Survey& survey_;
  CellDesk& desk_;
  const int threads_;
  const StopFlag* stop_;
};

// The first process's view of all processes.
class Queue {
 public:
  // `left`: of the others, those that may ask again.
  Queue(int size, int& left, SurveyWork& work, const StopFlag* stop)
      : left_(left), work_(work), stop_(stop), all_(static_cast<std::size_t>(size)) {
    all_[0].target = cpu_target();
  }

  // A process with nothing to do helps the working one with the fewest helpers. Once nobody works, all go home.
  Work work_for(int rank, std::string target, bool stopped) {
    Process& one = all_[static_cast<std::size_t>(rank)];
    one.doing = Doing::nothing;
    one.target = std::move(target);
    stopped = stopped || is_set(stop_);
    if (const auto block = stopped ? std::nullopt : work_.next_block()) {
      one.doing = Doing::block;
      return {Work::Kind::block, *block};
    }
    if (std::none_of(all_.begin(), all_.end(), [](const Process& p) { return p.doing != Doing::nothing; })) {
      left_ -= rank > 0;
      return {};
    }
    const auto whom = stopped ? std::nullopt : least_helped(one.target);
    if (!whom) return {Work::Kind::later, 0};
    one.doing = Doing::helps;
    one.helped = *whom;
    return {Work::Kind::help, *whom};
  }

 private:
  enum class Doing { nothing, block, helps };
  struct Process {
    Doing doing = Doing::block;  // until it asks
    std::string target;          // instruction set
    std::size_t helped = 0;      // the process that it helps, while it does
  };

  // Only of its own instruction set: results of others may differ in bits.
  std::optional<std::size_t> least_helped(const std::string& target) const {
    std::optional<std::size_t> found;
    std::ptrdiff_t fewest = 0;
    for (std::size_t rank = 0; rank < all_.size(); ++rank) {
      if (all_[rank].doing != Doing::block || all_[rank].target != target) continue;
      const auto helpers = std::count_if(
          all_.begin(), all_.end(), [rank](const Process& p) { return p.doing == Doing::helps && p.helped == rank; });
      if (found && helpers >= fewest) continue;
      found = rank;
      fewest = helpers;
    }
    return found;
  }

  int& left_;
  SurveyWork& work_;
  const StopFlag* stop_;
  std::vector<Process> all_;  // by rank
};

Bytes starts_answer(Member& own, BytesIn& question) {
  std::uint64_t ready = no_task, loan = no_loan;
  Chunk made;
  question(ready, loan, made);
  require_whole(question);
  return bytes_of(own.lend(ready, loan, std::move(made)));
}

// A process's own work, in parallel to messages. Destroying it stops waiting for answers.
class Beside {
 public:
  Beside(Post& post, const std::function<void()>& work) : post_(post), work_(std::async(std::launch::async, work)) {}
  ~Beside() { post_.close(); }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  // Throws what the work threw.
  bool over() {
    if (work_.valid() && work_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) work_.get();
    return !work_.valid();
  }

 private:
  Post& post_;
  std::future<void> work_;
};

}  // namespace

std::string mpi_text() {
  char version[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  MPI_Get_library_version(version, &length);
  const std::string text(version, static_cast<std::size_t>(length));
  return text.substr(0, text.find(','));
}

bool has_mpi() { return true; }

Team::Team() : post_(std::make_unique<Post>()) {
  if (!job_of_environment().variable) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  left_ = size_ - 1;
  joined_ = true;
}

// Processes that no longer answer cannot be waited for.
Team::~Team() {
  if (!joined_) return;
  if (left_ == 0) {
    post_->see_off();
    MPI_Finalize();
  } else {
    abort(time_is_over() ? out_of_time : interrupted);
  }
}

void Team::abort(int code) {
  MPI_Abort(MPI_COMM_WORLD, code);
  std::abort();  // MPI_Abort() does not return, but is not declared so
}

// Numbers are equal if the least is the greatest; the greatest is the complement of the least complement.
bool Team::have_same(const std::string& words) {
  if (!joined_) return true;
  const std::uint64_t number = std::hash<std::string>()(words);
  const std::array<std::uint64_t, 2> mine{number, ~number};
  std::array<std::uint64_t, 2> least{};
  MPI_Allreduce(mine.data(), least.data(), 2, MPI_UINT64_T, MPI_MIN, MPI_COMM_WORLD);
  const bool same = least[0] == ~least[1];
  if (!same) left_ = 0;
  return same;
}

bool Team::agree(bool good) {
  int answer = good;
  if (joined_) MPI_Bcast(&answer, 1, MPI_INT, 0, MPI_COMM_WORLD);
  if (!answer) left_ = 0;
  return answer;
}

void Team::lead(const Survey& survey, SurveyWork& work, int threads, const StopFlag* stop) {
  Member own(*post_, survey, work.desk(), threads, stop);
  Queue queue(size_, left_, work, stop);
  const Post::Answer answer = [&](int from, const Bytes& question) {
    BytesIn in(question);
    const Asked what = asked_in(in);
    if (what == Asked::for_starts) return starts_answer(own, in);
    if (what == Asked::for_work) {
      std::string target;
      Stopped why{};
      in(target, why);
      require_whole(in);
      if (why == Stopped::time_over) end_time();
      if (why == Stopped::asked) stop_flag().store(true);
      return bytes_of(queue.work_for(from, std::move(target), why != Stopped::no));
    }
    std::size_t index = 0;
    in(index);
    if (what == Asked::for_cell) return bytes_of(work.known(index));
    CellRecord made;
    in(made);
    require_whole(in);
    work.deliver(index, made);
    return bytes_of(true);
  };
  Beside beside(*post_, [&] {
    while (!work.idle() && !post_->closed()) std::this_thread::sleep_for(pause);
    own.work();
  });
  std::optional<Clock::time_point> stopped;
  while (left_ > 0) {
    beside.over();
    if (post_->step(answer)) continue;
    if (is_set(stop) && !stopped) stopped = Clock::now();
    if (stopped && Clock::now() - *stopped > patience) return;
    std::this_thread::sleep_for(rest);
  }
}

int Team::follow(const Survey& survey, int threads, const StopFlag* stop) {
  CellDesk desk;
  Member own(*post_, survey, desk, threads, stop);
  const Post::Answer answer = [&](int, const Bytes& question) {
    BytesIn in(question);
    asked_in(in);  // for starts
    return starts_answer(own, in);
  };
  return or_end([&] {
    Beside beside(*post_, [&] { own.work(); });
    while (!beside.over())
      if (!post_->step(answer)) std::this_thread::sleep_for(rest);
    left_ = 0;
    return static_cast<int>(done);
  });
}

// Everybody gets the empty answer: nothing is left.
void Team::dismiss() {
  const Clock::time_point begin = Clock::now();
  const Post::Answer answer = [&](int, const Bytes& question) {
    BytesIn in(question);
    left_ -= asked_in(in) == Asked::for_work;
    return Bytes{};
  };
  while (left_ > 0 && Clock::now() - begin < patience)
    if (!post_->step(answer)) std::this_thread::sleep_for(rest);
}

}  // namespace equipoise::app
