// What the processes of a job say to each other: bytes with a tag.
#pragma once

#ifdef EQUIPOISE_MPI
#define OMPI_SKIP_MPICXX
#define MPICH_SKIP_MPICXX
#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <list>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "equipoise/basins/chunks.hpp"
#include "equipoise/results/sweep_result.hpp"
#include "equipoise/sweeps/cell_desk.hpp"

namespace equipoise::app {

/// asks: for work, of the first; with the sender's instruction set. brings: it a cell. leaves: its service. gives:
/// work, by the first. Between any two: offers to decide starts; lends starts or says which; returns their fates.
enum Tag { asks = 1, brings, leaves, gives, offers, lends, returns };

using Bytes = std::vector<std::uint8_t>;

/// Bytes at the end.
template <class T>
void put(Bytes& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}
template <class T>
void put_list(Bytes& bytes, const std::vector<T>& values) {
  put(bytes, values.size());
  for (const T& value : values) put(bytes, value);
}

/// Reads them from the front. Throws RunError where they end too early.
class Reader {
 public:
  explicit Reader(const Bytes& bytes) : bytes_(bytes) {}

  bool at_end() const { return at_ == bytes_.size(); }
  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(&value, skip(sizeof value), sizeof value);
    return value;
  }
  template <class T>
  std::vector<T> take_list() {
    std::vector<T> values;
    for (auto left = take<std::size_t>(); left > 0; --left) values.push_back(take<T>());
    return values;
  }
  const std::uint8_t* skip(std::size_t count);

 private:
  const Bytes& bytes_;
  std::size_t at_ = 0;
};

void put_cell(Bytes& bytes, std::size_t index, const SweepCell& cell);
std::pair<std::size_t, SweepCell> take_cell(Reader& reader);
void put_task(Bytes& bytes, const CellDesk::Task& task);
CellDesk::Task take_task(Reader& reader);
/// What was decided; of unlisted starts place and state.
void put_chunk(Bytes& bytes, const Chunk& chunk);
Chunk take_chunk(Reader& reader);

struct Message {
  int from = 0, tag = 0;
  Bytes bytes;
};

/// Of one thread. No message waits for another to be taken in.
class Mail {
 public:
  void send(Bytes bytes, int to, int tag);
  /// A message that has come, if there is one.
  std::optional<Message> next();
  /// Waits until everything sent is on its way.
  void see_off();

 private:
  struct Sent {
    Bytes bytes;
    MPI_Request request;
  };
  std::list<Sent> sent_;
};

}  // namespace equipoise::app

#endif
