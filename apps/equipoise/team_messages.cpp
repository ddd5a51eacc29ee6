// Cells, tasks and chunks as bytes; sending and receiving.
#ifdef EQUIPOISE_MPI
#include "team_messages.hpp"

#include "equipoise/base/error.hpp"
#include "equipoise/store/sweep_cells.hpp"

namespace equipoise::app {

const std::uint8_t* Reader::skip(std::size_t count) {
  if (count > bytes_.size() - at_) throw RunError("a message between processes was cut short");
  at_ += count;
  return bytes_.data() + at_ - count;
}

void put_cell(Bytes& bytes, std::size_t index, const SweepCell& cell) {
  put(bytes, index);
  put_list(bytes, store::bytes_of(cell));
}

std::pair<std::size_t, SweepCell> take_cell(Reader& reader) {
  const auto index = reader.take<std::size_t>();
  const auto size = reader.take<std::size_t>();
  auto cell = store::cell_from(reader.skip(size), size);
  if (!cell) throw RunError("a message between processes holds no cell");
  return {index, std::move(*cell)};
}

void put_task(Bytes& bytes, const CellDesk::Task& task) {
  put(bytes, task.number);
  put(bytes, task.at.cell);
  put(bytes, task.at.method);
  put(bytes, task.at.start.informed);
  put(bytes, task.at.start.seeds.size());
  for (const std::vector<double>& seed : task.at.start.seeds) put_list(bytes, seed);
  put_list(bytes, task.at.start.hints.levels);
  put_list(bytes, task.at.start.hints.weights);
}

CellDesk::Task take_task(Reader& reader) {
  CellDesk::Task task;
  task.number = reader.take<std::uint64_t>();
  task.at.cell = reader.take<std::size_t>();
  task.at.method = reader.take<SamplingMethod>();
  task.at.start.informed = reader.take<bool>();
  for (auto left = reader.take<std::size_t>(); left > 0; --left)
    task.at.start.seeds.push_back(reader.take_list<double>());
  task.at.start.hints.levels = reader.take_list<LevelHint>();
  task.at.start.hints.weights = reader.take_list<ModeWeight>();
  return task;
}

void put_chunk(Bytes& bytes, const Chunk& chunk) {
  put_list(bytes, chunk.fates);
  put_list(bytes, chunk.transients);
  put(bytes, chunk.unlisted.size());
  for (const UnlistedStart& start : chunk.unlisted) {
    put(bytes, start.place);
    put_list(bytes, start.state);
  }
}

Chunk take_chunk(Reader& reader) {
  Chunk chunk;
  chunk.fates = reader.take_list<Fate>();
  chunk.transients = reader.take_list<TransientRow>();
  for (auto left = reader.take<std::size_t>(); left > 0; --left) {
    UnlistedStart& start = chunk.unlisted.emplace_back();
    start.place = reader.take<std::size_t>();
    start.state = reader.take_list<double>();
  }
  return chunk;
}

void Mail::send(Bytes bytes, int to, int tag) {
  Sent& sent = sent_.emplace_back(Sent{std::move(bytes), MPI_REQUEST_NULL});
  MPI_Isend(sent.bytes.data(), static_cast<int>(sent.bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD, &sent.request);
}

std::optional<Message> Mail::next() {
  std::erase_if(sent_, [](Sent& sent) {
    int gone = 0;
    MPI_Test(&sent.request, &gone, MPI_STATUS_IGNORE);
    return gone != 0;
  });
  int there = 0, size = 0;
  MPI_Status found;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &found);
  if (!there) return std::nullopt;
  MPI_Get_count(&found, MPI_BYTE, &size);
  Message message{found.MPI_SOURCE, found.MPI_TAG, Bytes(static_cast<std::size_t>(size))};
  MPI_Recv(message.bytes.data(), size, MPI_BYTE, found.MPI_SOURCE, found.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return message;
}

void Mail::see_off() {
  for (Sent& sent : sent_) MPI_Wait(&sent.request, MPI_STATUS_IGNORE);
  sent_.clear();
}

}  // namespace equipoise::app

#endif
