// The processes of a job. Rank 0 hands out blocks of cells and receives finished cells.
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
#include "equipoise/analyses/sweeps/survey_run.hpp"
#include "equipoise/core/base/bytes.hpp"
#include "equipoise/core/base/error.hpp"
#include "post.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds rest{2};    // between two checks for messages
constexpr std::chrono::milliseconds pause{10};  // of a process that has nothing to do
constexpr std::chrono::seconds patience{3};     // with processes that should finish

// What the others ask rank 0.
enum class Asked : std::uint8_t { for_work, for_cell, to_take_cell };

// A process that was stopped abandons its block: the whole job stops for the same reason, or the block would be
// missing.
enum class Stopped : std::uint8_t { no, asked, time_over };

struct Work {
  enum class Kind : std::uint8_t { none, later, block } kind = Kind::none;
  std::size_t block = 0;
};

void require_whole(const BytesIn& in) {
  if (!in.whole()) throw RunError("a message between processes was cut short");
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

// Asks rank 0 for blocks, one at a time, until nothing is left for anybody.
void work_off_blocks(Post& post, const Survey& survey, int threads, const StopFlag* stop) {
  const auto why_stopped = [stop] {
    return !is_set(stop) ? Stopped::no : time_is_over() ? Stopped::time_over : Stopped::asked;
  };
  const auto known = [&post](std::size_t cell) {
    return answer_from<CellRecord>(post.ask(bytes_of(Asked::for_cell, cell)));
  };
  const auto deliver = [&post](std::size_t cell, const CellRecord& made) {
    post.ask(bytes_of(Asked::to_take_cell, cell, made));
  };
  for (;;) {
    const Work given = answer_from<Work>(post.ask(bytes_of(Asked::for_work, why_stopped())));
    if (given.kind == Work::Kind::none) return;
    if (given.kind == Work::Kind::block)
      survey(given.block, {.threads = threads, .stop = stop, .known = known, .deliver = deliver});
    else
      std::this_thread::sleep_for(pause);
  }
}

// A process's own work, in parallel to messages. Destroying it stops waiting for answers.
class OwnWork {
 public:
  OwnWork(Post& post, const std::function<void()>& work) : post_(post), work_(std::async(std::launch::async, work)) {}
  ~OwnWork() { post_.close(); }
  OwnWork(const OwnWork&) = delete;
  OwnWork& operator=(const OwnWork&) = delete;

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

void Team::lead(SurveyRun& work, const StopFlag* stop) {
  std::vector<bool> busy(static_cast<std::size_t>(size_), true);  // by rank, until it asks
  // Once no one works, all are dismissed.
  const auto work_for = [&](int rank, bool stopped) -> Work {
    const auto block = stopped || is_set(stop) ? std::nullopt : work.next_block();
    busy[static_cast<std::size_t>(rank)] = block.has_value();
    if (block) return {Work::Kind::block, *block};
    if (!work.idle() || std::count(busy.begin() + 1, busy.end(), true) > 0) return {Work::Kind::later, 0};
    --left_;
    return {};
  };
  const Post::Answer answer = [&](int from, const Bytes& question) {
    BytesIn in(question);
    const Asked what = asked_in(in);
    if (what == Asked::for_work) {
      Stopped why{};
      in(why);
      require_whole(in);
      if (why == Stopped::time_over) end_time();
      if (why == Stopped::asked) stop_flag().store(true);
      return bytes_of(work_for(from, why != Stopped::no));
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
  std::optional<Clock::time_point> stopped;
  while (left_ > 0) {
    if (post_->step(answer)) continue;
    if (is_set(stop) && !stopped) stopped = Clock::now();
    if (stopped && Clock::now() - *stopped > patience) return;
    std::this_thread::sleep_for(rest);
  }
}

int Team::follow(const Survey& survey, int threads, const StopFlag* stop) {
  const Post::Answer nothing = [](int, const Bytes&) { return Bytes{}; };  // no one asks this process
  return or_end([&] {
    OwnWork own(*post_, [&] { work_off_blocks(*post_, survey, threads, stop); });
    while (!own.over())
      if (!post_->step(nothing)) std::this_thread::sleep_for(rest);
    left_ = 0;
    return static_cast<int>(done);
  });
}

// All get the empty answer: nothing is left.
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
