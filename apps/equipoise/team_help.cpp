// Offers, loans and their return. Who offers help names the task that it is ready for; the answer is a chunk of that,
// or the task to get ready for, or that there is none. So nobody who is not ready holds a chunk.
#ifdef EQUIPOISE_MPI
#include "team_help.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

namespace equipoise::app {

namespace {

enum class Answer : std::uint8_t { nothing, get_ready, decide };
constexpr std::uint64_t takes_back = std::numeric_limits<std::uint64_t>::max();  // its offers, in place of a task

template <class T>
bool is_there(const std::future<T>& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

TeamHelp::~TeamHelp() {
  for (const Waiting& other : waiting_) answer(other, false);
}

void TeamHelp::help(int rank) {
  helped_ = rank;
  over_ = false;
  task_ = 0;  // numbers of another are others
  ensemble_.reset();
}

void TeamHelp::take(const Message& message) {
  Reader reader(message.bytes);
  if (message.tag == offers) return take_offer(message.from, reader);
  if (message.tag == lends) return take_answer(reader);
  const auto loan = reader.take<std::uint64_t>();
  desk_.give_back(loan, take_chunk(reader));
}

void TeamHelp::take_offer(int from, Reader reader) {
  const auto ready = reader.take<std::uint64_t>();
  if (ready != takes_back) return waiting_.push_back({from, ready});
  for (const Waiting& other : waiting_)
    if (other.rank == from) answer(other, false);
  std::erase_if(waiting_, [from](const Waiting& other) { return other.rank == from; });
}

void TeamHelp::take_answer(Reader reader) {
  --offers_;
  const auto kind = reader.take<Answer>();
  if (kind == Answer::nothing) {
    over_ = true;
  } else if (kind == Answer::get_ready) {
    get_ready(take_task(reader));
  } else {
    const auto task = reader.take<std::uint64_t>();
    decide(task, reader.take<CellDesk::Loan>());
  }
}

void TeamHelp::get_ready(const CellDesk::Task& task) {
  if (task.number == task_ || search_.valid()) return;
  task_ = task.number;
  ensemble_.reset();
  search_ = std::async(std::launch::async, [this, at = task.at] {
    return std::make_shared<const EnsembleHelper>(helper_for(plan_, at, static_cast<int>(threads_), stop_));
  });
}

// What is meant for a task that we are no longer ready for goes back as it came.
void TeamHelp::decide(std::uint64_t task, const CellDesk::Loan& loan) {
  const auto ensemble = task == task_ ? ensemble_ : nullptr;
  in_hand_.push_back({loan.number, std::async(std::launch::async, [ensemble, loan] {
                        Chunk chunk;
                        chunk.first = loan.first;
                        chunk.count = loan.count;
                        if (!ensemble || ensemble->stopped() || !ensemble->decide(chunk)) chunk = {};
                        return chunk;
                      })});
}

void TeamHelp::return_decided() {
  for (InHand& held : in_hand_) {
    if (!is_there(held.chunk)) continue;
    Bytes bytes;
    put(bytes, held.loan);
    put_chunk(bytes, held.chunk.get());
    mail_.send(std::move(bytes), helped_, returns);
  }
  std::erase_if(in_hand_, [](const InHand& held) { return !held.chunk.valid(); });
}

void TeamHelp::offer(std::uint64_t what) {
  Bytes bytes;
  put(bytes, what);
  mail_.send(std::move(bytes), helped_, offers);
}

void TeamHelp::step(bool at_work) {
  std::erase_if(waiting_, [&](const Waiting& other) { return answer(other, at_work); });
  if (!helping()) return;
  return_decided();
  if (is_there(search_)) ensemble_ = search_.get();
  if (is_set(stop_) && !over_) {
    over_ = true;
    offer(takes_back);
  }
  if (search_.valid()) return;
  const std::size_t most = ensemble_ ? threads_ : 1;
  for (; !over_ && offers_ + in_hand_.size() < most; ++offers_) offer(ensemble_ ? task_ : 0);
  if (over_ && offers_ == 0 && in_hand_.empty()) helped_ = nobody;
}

// False if there is no answer yet.
bool TeamHelp::answer(const Waiting& other, bool at_work) {
  Bytes bytes;
  if (!at_work) {
    put(bytes, Answer::nothing);
  } else if (const auto loan = desk_.lend(other.ready)) {
    put(bytes, Answer::decide);
    put(bytes, other.ready);
    put(bytes, *loan);
  } else {
    const auto task = desk_.newest();
    if (!task || task->number == other.ready) return false;
    put(bytes, Answer::get_ready);
    put_task(bytes, *task);
  }
  mail_.send(std::move(bytes), other.rank, lends);
  return true;
}

}  // namespace equipoise::app

#endif
