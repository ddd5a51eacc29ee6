// Questions between the processes of a job: asked from any thread, answered by the main one of the other process.
#pragma once

#ifdef EQUIPOISE_MPI
#define OMPI_SKIP_MPICXX
#define MPICH_SKIP_MPICXX
#include <mpi.h>

#include <atomic>
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

  /// What that process, which may be this one, answers; empty once the post is closed. From any thread but the one of
  /// step().
  Bytes ask(int whom, Bytes question);
  /// Takes in a message, and answers it if it is a question. False if none has come. Of one thread.
  bool step(const Answer& answer);
  /// Nobody here waits for answers any more.
  void close();
  bool closed() const { return closed_; }
  /// Waits until everything sent is on its way.
  void see_off();

 private:
  struct Sent {
    Bytes bytes;
    MPI_Request request;
  };
  void send(Bytes bytes, int to, int tag);

  std::mutex mutex_;  // MPI is called by one thread at a time
  std::condition_variable came_;
  std::list<Sent> sent_;
  std::map<int, std::optional<Bytes>> answers_;  // by number; none: not yet
  int next_ = 0;
  std::atomic<bool> closed_{false};
};

}  // namespace equipoise::app

#endif
