// The processes of a job: the first gives blocks to whoever asks, with what is known of them, and takes cells in; whom
// it has no block for it sends to help another.
#include "team.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/kernels/cpu_target.hpp"
#include "equipoise/sweeps/cell_desk.hpp"
#include "equipoise/sweeps/sweep_cell.hpp"
#include "job.hpp"
#include "team_help.hpp"
#include "team_messages.hpp"

namespace equipoise::app {

#ifdef EQUIPOISE_MPI

namespace {

enum class Gift : std::uint8_t { nothing, block, other };  // a block's cells to compute, or a process to help

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds rest{2};  // between two looks for messages
constexpr std::chrono::seconds patience{3};   // with others that are to come home

Bytes gift(Gift what) {
  Bytes bytes;
  put(bytes, what);
  return bytes;
}

// The first process' view of all.
class Leader {
 public:
  Leader(Mail& mail, int size, int& left, const SweepPlan& plan, SweepWork& work, int threads, const StopFlag* stop)
      : mail_(mail),
        left_(left),
        plan_(plan),
        work_(work),
        stop_(stop),
        help_(mail, plan, work.desk(), threads, stop),
        others_(static_cast<std::size_t>(size)) {
    others_[0].target = cpu_target();
  }

  // Until all the others have gone, or do not go although they should.
  void run() {
    std::optional<Clock::time_point> stopped;
    while (left_ > 0) {
      const auto message = mail_.next();
      if (message) take(*message);
      others_[0].doing = !work_.idle() ? Doing::block : help_.helping() ? Doing::helps : Doing::nothing;
      help_.step(!work_.idle());
      assign();
      if (message) continue;
      if (is_set(stop_) && !stopped) stopped = Clock::now();
      if (stopped && Clock::now() - *stopped > patience) return;
      std::this_thread::sleep_for(rest);
    }
  }

 private:
  enum class Doing { nothing, block, helps, gone };
  struct Other {
    Doing doing = Doing::block;  // until it asks
    std::string target;          // its instruction set
    std::size_t helped = 0;      // which one, while it helps
  };

  void take(const Message& message) {
    Reader reader(message.bytes);
    Other& other = others_[static_cast<std::size_t>(message.from)];
    if (message.tag == brings) {
      auto [index, cell] = take_cell(reader);
      work_.deliver(index, std::move(cell));
    } else if (message.tag == asks) {
      const std::vector<char> target = reader.take_list<char>();
      other.target.assign(target.begin(), target.end());
      const auto block = work_.next_block();
      other.doing = block ? Doing::block : Doing::nothing;
      if (block) give(message.from, *block);
    } else if (message.tag == leaves) {
      other.doing = Doing::gone;
      --left_;
    } else {
      help_.take(message);
    }
  }

  void give(int to, std::size_t block) {
    Bytes bytes = gift(Gift::block);
    put(bytes, block);
    for (const std::size_t index : plan_.cells_of(block))
      if (const SweepCell* cell = work_.known(index)) put_cell(bytes, index, *cell);
    mail_.send(std::move(bytes), to, gives);
  }

  // Who has nothing to do helps the one at work that has the fewest helpers, of its own kind: others' bits may differ.
  // Once nobody is at work all go home.
  void assign() {
    const auto any = [this](Doing doing) {
      return std::any_of(others_.begin(), others_.end(), [doing](const Other& o) { return o.doing == doing; });
    };
    const bool over = (!any(Doing::block) && !any(Doing::helps)) || is_set(stop_);
    for (std::size_t rank = 0; rank < others_.size(); ++rank) {
      if (others_[rank].doing != Doing::nothing) continue;
      if (over)
        dismiss(rank);
      else if (const auto helped = least_helped(others_[rank].target))
        send_to(rank, *helped);
    }
  }

  void dismiss(std::size_t rank) {
    if (rank == 0) return;
    mail_.send(gift(Gift::nothing), static_cast<int>(rank), gives);
    others_[rank].doing = Doing::gone;
    --left_;
  }

  std::optional<std::size_t> least_helped(const std::string& target) const {
    std::optional<std::size_t> found;
    std::ptrdiff_t fewest = 0;
    for (std::size_t rank = 0; rank < others_.size(); ++rank) {
      if (others_[rank].doing != Doing::block || others_[rank].target != target) continue;
      const auto helpers = std::count_if(others_.begin(), others_.end(), [rank](const Other& o) {
        return o.doing == Doing::helps && o.helped == rank;
      });
      if (found && helpers >= fewest) continue;
      found = rank;
      fewest = helpers;
    }
    return found;
  }

  void send_to(std::size_t rank, std::size_t helped) {
    others_[rank].doing = Doing::helps;
    others_[rank].helped = helped;
    if (rank == 0) return help_.help(static_cast<int>(helped));
    Bytes bytes = gift(Gift::other);
    put(bytes, static_cast<int>(helped));
    mail_.send(std::move(bytes), static_cast<int>(rank), gives);
  }

  Mail& mail_;
  int& left_;
  const SweepPlan& plan_;
  SweepWork& work_;
  const StopFlag* stop_;
  TeamHelp help_;
  std::vector<Other> others_;  // by rank; the first is this process
};

// Any other process: one block at a time on a thread of its own, beside the messages.
class Follower {
 public:
  Follower(Mail& mail, const SweepPlan& plan, int threads, const StopFlag* stop)
      : mail_(mail), plan_(plan), threads_(threads), stop_(stop), help_(mail, plan, desk_, threads, stop) {}

  void run() {
    ask();
    while (!home_) {
      const auto message = mail_.next();
      if (message) take(*message);
      send_cells();
      end_block();
      help_.step(block_.valid());
      end_help();
      if (waits_ && is_set(stop_)) leave();
      if (!message) std::this_thread::sleep_for(rest);
    }
  }

 private:
  void ask() {
    Bytes bytes;
    const std::string target = cpu_target();
    put_list(bytes, std::vector<char>(target.begin(), target.end()));
    mail_.send(std::move(bytes), 0, asks);
    waits_ = true;
  }

  void leave() {
    mail_.send({}, 0, leaves);
    home_ = true;
  }

  void take(const Message& message) {
    if (message.tag != gives) return help_.take(message);
    waits_ = false;
    Reader reader(message.bytes);
    const auto what = reader.take<Gift>();
    home_ = what == Gift::nothing;
    helps_ = what == Gift::other;
    if (helps_) help_.help(reader.take<int>());
    if (what == Gift::block) begin_block(reader);
  }

  void begin_block(Reader& reader) {
    const auto block = reader.take<std::size_t>();
    std::map<std::size_t, SweepCell> there;
    while (!reader.at_end()) there.insert(take_cell(reader));
    block_ = std::async(std::launch::async, [this, block, there = std::move(there)] {
      const auto known = [&there](std::size_t index) -> const SweepCell* {
        const auto cell = there.find(index);
        return cell == there.end() ? nullptr : &cell->second;
      };
      const auto deliver = [this](std::size_t index, const SweepCell& cell) {
        Bytes bytes;
        put_cell(bytes, index, cell);
        const std::lock_guard guard(delivering_);
        delivered_.push_back(std::move(bytes));
      };
      return run_block(plan_, block, known, deliver, {.threads = threads_, .desk = &desk_, .stop = stop_});
    });
  }

  void send_cells() {
    const std::lock_guard guard(delivering_);
    for (Bytes& cell : delivered_) mail_.send(std::move(cell), 0, brings);
    delivered_.clear();
  }

  void end_block() {
    if (!block_.valid() || block_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    const bool whole = block_.get();
    send_cells();  // the last may have come since
    if (whole)
      ask();
    else
      leave();
  }

  void end_help() {
    if (!helps_ || help_.helping()) return;
    helps_ = false;
    ask();
  }

  Mail& mail_;
  const SweepPlan& plan_;
  const int threads_;
  const StopFlag* stop_;
  CellDesk desk_;
  TeamHelp help_;
  bool home_ = false, waits_ = false, helps_ = false;
  std::mutex delivering_;
  std::vector<Bytes> delivered_;
  std::future<bool> block_;  // whether it was not stopped
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

Team::Team() : mail_(std::make_unique<Mail>()) {
  if (!job_of_environment().variable) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  left_ = size_ - 1;
  joined_ = true;
}

// Others that will not answer any more cannot be waited for.
Team::~Team() {
  if (!joined_) return;
  if (left_ == 0) {
    mail_->see_off();
    MPI_Finalize();
  } else {
    MPI_Abort(MPI_COMM_WORLD, interrupted);
  }
}

// Equal numbers have the same least and largest one, which is the complement of the least complement.
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

void Team::lead(const SweepPlan& plan, SweepWork& work, int threads, const StopFlag* stop) {
  Leader(*mail_, size_, left_, plan, work, threads, stop).run();
}

void Team::dismiss() {
  const Clock::time_point begin = Clock::now();
  while (left_ > 0 && Clock::now() - begin < patience) {
    const auto message = mail_->next();
    if (!message) {
      std::this_thread::sleep_for(rest);
      continue;
    }
    if (message->tag == asks) mail_->send(gift(Gift::nothing), message->from, gives);
    if (message->tag == asks || message->tag == leaves) --left_;
  }
}

void Team::follow(const SweepPlan& plan, int threads, const StopFlag* stop) {
  Follower(*mail_, plan, threads, stop).run();
  left_ = 0;
}

#else

class Mail {};

std::string mpi_text() { return "not built in"; }
bool has_mpi() { return false; }

Team::Team() = default;
Team::~Team() = default;
bool Team::have_same(const std::string&) { return true; }
bool Team::agree(bool good) { return good; }
void Team::lead(const SweepPlan&, SweepWork&, int, const StopFlag*) {}
void Team::follow(const SweepPlan&, int, const StopFlag*) {}
void Team::dismiss() {}

#endif

}  // namespace equipoise::app
