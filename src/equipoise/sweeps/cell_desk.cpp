// Places at the desk: one a cell, taken while its starts are decided.
#include "equipoise/sweeps/cell_desk.hpp"

#include <utility>

namespace equipoise {

// Who is at one of its chunks is inside; close() waits for all to leave.
class CellDesk::Place final : public ChunkHelp {
 public:
  Place(CellDesk& desk, CellAtWork cell) : at(std::move(cell)), desk_(desk) {}

  void open(ChunkQueue& opened) override {
    desk_.announce(at);
    const std::lock_guard guard(desk_.mutex_);
    queue = &opened;
    desk_.places_.push_back(this);
  }

  void close() override {
    std::unique_lock lock(desk_.mutex_);
    std::erase(desk_.places_, this);
    std::erase_if(desk_.lent_, [this](const auto& lent) { return lent.second.place == this; });
    desk_.left_.wait(lock, [this] { return inside == 0; });
  }

  bool work_off(std::unique_lock<std::mutex>& lock) {
    struct Inside {
      Place& place;
      std::unique_lock<std::mutex>& lock;
      ~Inside() {
        lock.lock();
        --place.inside;
        place.desk_.left_.notify_all();
      }
    };
    ++inside;
    lock.unlock();
    const Inside leaving{*this, lock};
    return queue->work_off(false);
  }

  const CellAtWork at;
  ChunkQueue* queue = nullptr;

 private:
  CellDesk& desk_;
  int inside = 0;
};

std::unique_ptr<ChunkHelp> CellDesk::help_for(CellAtWork cell) {
  return std::make_unique<Place>(*this, std::move(cell));
}

bool CellDesk::help() {
  std::unique_lock lock(mutex_);
  for (std::size_t tries = places_.size(); tries > 0 && !places_.empty(); --tries)
    if (places_[turn_++ % places_.size()]->work_off(lock)) return true;
  return false;
}

void CellDesk::announce(const CellAtWork& cell) {
  const std::lock_guard guard(mutex_);
  for (const auto& [number, task] : tasks_)
    if (task == cell) return;
  tasks_.emplace(++last_number_, cell);
}

void CellDesk::retract(std::size_t cell) {
  const std::lock_guard guard(mutex_);
  std::erase_if(tasks_, [cell](const auto& task) { return task.second.cell == cell; });
}

std::optional<CellDesk::Task> CellDesk::newest() {
  const std::lock_guard guard(mutex_);
  if (tasks_.empty()) return std::nullopt;
  return Task{tasks_.rbegin()->first, tasks_.rbegin()->second};
}

std::optional<CellDesk::Loan> CellDesk::lend(std::uint64_t task) {
  const std::lock_guard guard(mutex_);
  const auto wanted = tasks_.find(task);
  if (wanted == tasks_.end()) return std::nullopt;
  for (Place* place : places_) {
    if (place->at != wanted->second) continue;
    const auto chunk = place->queue->lend();
    if (!chunk) continue;
    lent_[++last_number_] = {place, chunk};
    return Loan{last_number_, chunk->first, chunk->count};
  }
  return std::nullopt;
}

void CellDesk::give_back(std::uint64_t loan, Chunk made) {
  const std::lock_guard guard(mutex_);
  const auto at = lent_.find(loan);
  if (at == lent_.end()) return;
  const auto [place, chunk] = at->second;
  lent_.erase(at);
  chunk->from_elsewhere = !made.fates.empty();
  chunk->fates = std::move(made.fates);
  chunk->unlisted = std::move(made.unlisted);
  chunk->transients = std::move(made.transients);
  place->queue->give_back(chunk);
}

}  // namespace equipoise
