// Questions to the first process of a job: any thread of another asks, the first one's main thread answers.
#pragma once

#define OMPI_SKIP_MPICXX
#define MPICH_SKIP_MPICXX
#include <mpi.h>

#include <condition_variable>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

namespace equipoise::app {

using Bytes = std::vector<char>;

class Post {
 public:
  using Answer = std::function<Bytes(int from, const Bytes& question)>;

  /// The answer of process 0; empty once the post is closed. Not for the thread that calls step().
  Bytes ask(Bytes question);
  /// Receives a message, and answers it if it is a question. False if none has come. Call from one thread only.
  bool step(const Answer& answer);
  /// No one here waits for answers any more.
  void close();
  /// Waits until everything has been sent.
  void see_off();

 private:
  struct Sent {
    Bytes bytes;
    MPI_Request request;
  };
  void send(Bytes bytes, int to, int tag);

  std::mutex mutex_;  // only one thread at a time calls MPI
  std::condition_variable came_;
  std::list<Sent> sent_;
  std::map<int, std::optional<Bytes>> answers_;  // by number; empty: not yet answered
  int next_ = 0;
  bool closed_ = false;
};

}  // namespace equipoise::app
