// Ensembles at work in this process, whose starts idle threads help to decide.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <vector>

#include "equipoise/analyses/ensembles/chunks.hpp"

namespace equipoise {

/// Callable from any thread.
class OpenEnsembles final : public ChunkHelp {
 public:
  void open(ChunkQueue& queue) override;
  void close(ChunkQueue& queue) override;
  /// Decides a chunk of one of them. False if none is available now.
  bool help();

 private:
  std::mutex mutex_;
  std::condition_variable left_;
  std::vector<ChunkQueue*> open_;
  std::map<ChunkQueue*, int> inside_;  // helpers at work
  std::size_t turn_ = 0;               // they are helped in turn
};

}  // namespace equipoise
