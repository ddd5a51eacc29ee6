// Places at the desk: one per cell and sampling method.
#include "equipoise/analyses/sweeps/cell_desk.hpp"

#include <utility>

namespace equipoise {

CellDesk::Place::Place(CellDesk& desk, CellAtWork at) : desk_(desk), at_(std::move(at)) {
  const std::lock_guard guard(desk_.mutex_);
  number_ = ++desk_.last_number_;
  desk_.places_.push_back(this);
}

CellDesk::Place::~Place() {
  const std::lock_guard guard(desk_.mutex_);
  std::erase(desk_.places_, this);
}

void CellDesk::Place::open(ChunkQueue& queue) {
  const std::lock_guard guard(desk_.mutex_);
  queue_ = &queue;
}

void CellDesk::Place::close() {
  std::unique_lock lock(desk_.mutex_);
  queue_ = nullptr;
  std::erase_if(desk_.lent_, [this](const auto& lent) { return lent.second.place == this; });
  desk_.left_.wait(lock, [this] { return inside_ == 0; });
}

bool CellDesk::Place::work_off(std::unique_lock<std::mutex>& lock) {
  struct Inside {
    Place& place;
    std::unique_lock<std::mutex>& lock;
    ~Inside() {
      lock.lock();
      --place.inside_;
      place.desk_.left_.notify_all();
    }
  };
  ChunkQueue* const queue = queue_;
  if (!queue) return false;
  ++inside_;
  lock.unlock();
  const Inside leaving{*this, lock};
  return queue->work_off(false);
}

bool CellDesk::help() {
  std::unique_lock lock(mutex_);
  for (std::size_t tries = places_.size(); tries > 0 && !places_.empty(); --tries)
    if (places_[turn_++ % places_.size()]->work_off(lock)) return true;
  return false;
}

std::optional<CellDesk::Task> CellDesk::newest() {
  const std::lock_guard guard(mutex_);
  if (places_.empty()) return std::nullopt;
  return Task{places_.back()->number_, places_.back()->at_};
}

std::optional<CellDesk::Loan> CellDesk::lend(std::uint64_t task) {
  const std::lock_guard guard(mutex_);
  for (Place* place : places_) {
    if (place->number_ != task || !place->queue_) continue;
    const auto chunk = place->queue_->lend();
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
  place->queue_->give_back(chunk);
}

}  // namespace equipoise
