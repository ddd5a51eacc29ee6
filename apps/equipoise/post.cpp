// A question's tag is twice its number; its answer's tag is one more.
#include "post.hpp"

#include <exception>
#include <utility>

namespace equipoise::app {

namespace {

constexpr int numbers = 16'000;  // MPI promises tags up to 32767

}  // namespace

Bytes Post::ask(Bytes question) {
  std::unique_lock lock(mutex_);
  if (closed_) return {};
  const int number = next_;
  next_ = (next_ + 1) % numbers;
  const auto place = answers_.emplace(number, std::nullopt).first;
  send(std::move(question), 0, 2 * number);
  came_.wait(lock, [&] { return closed_ || place->second; });
  Bytes answer = std::move(place->second).value_or(Bytes{});
  answers_.erase(place);
  return answer;
}

bool Post::step(const Answer& answer) {
  std::unique_lock lock(mutex_);
  std::erase_if(sent_, [](Sent& sent) {
    int gone = 0;
    MPI_Test(&sent.request, &gone, MPI_STATUS_IGNORE);
    return gone != 0;
  });
  int there = 0, size = 0;
  MPI_Status found;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &found);
  if (!there) return false;
  const int from = found.MPI_SOURCE, tag = found.MPI_TAG;
  MPI_Get_count(&found, MPI_BYTE, &size);
  Bytes bytes(static_cast<std::size_t>(size));
  MPI_Recv(bytes.data(), size, MPI_BYTE, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  if (tag % 2 != 0) {
    if (const auto place = answers_.find(tag / 2); place != answers_.end()) place->second = std::move(bytes);
    came_.notify_all();
    return true;
  }
  lock.unlock();
  Bytes made;
  std::exception_ptr thrown;  // the other process waits for an answer all the same
  try {
    made = answer(from, bytes);
  } catch (...) {
    thrown = std::current_exception();
  }
  lock.lock();
  send(std::move(made), from, tag + 1);
  if (thrown) std::rethrow_exception(thrown);
  return true;
}

void Post::close() {
  const std::lock_guard guard(mutex_);
  closed_ = true;
  came_.notify_all();
}

void Post::see_off() {
  for (Sent& sent : sent_) MPI_Wait(&sent.request, MPI_STATUS_IGNORE);
  sent_.clear();
}

// Call with the lock held. No message waits for another to be received.
void Post::send(Bytes bytes, int to, int tag) {
  Sent& sent = sent_.emplace_back(Sent{std::move(bytes), MPI_REQUEST_NULL});
  MPI_Isend(sent.bytes.data(), static_cast<int>(sent.bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD, &sent.request);
}

}  // namespace equipoise::app
