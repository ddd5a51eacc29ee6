// The file of a design: ensembles kept as they come, the answer written whole in the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "equipoise/results/design_result.hpp"

namespace equipoise {

/// Two files, as of a sweep (sweep_file.hpp). The results, `path`, are NetCDF (classic, 64-bit offsets), sealed: by
/// ensemble its starts, its figures with their intervals and its candidate as text; by member of the front its figures
/// on the held-out starts. While the search goes on, `path`.part holds every ensemble that the results do not.
class DesignFile {
 public:
  /// Opens what there is of the same design, or begins anew. `most`: ensembles that there may be. Throws InputError if
  /// it cannot be written, is in use, damaged, or holds something else: which, it says.
  DesignFile(const std::string& path, const std::string& identity, std::size_t most);
  ~DesignFile();
  DesignFile(const DesignFile&) = delete;
  DesignFile& operator=(const DesignFile&) = delete;

  /// Of the `number`-th question, if what was kept is the answer to it.
  std::optional<DesignSample> sample(std::uint64_t number, const std::string& name) const;
  /// On disk within about a second of work. Throws RunError, with all before it kept, if the disk cannot take it.
  void append(std::uint64_t number, const std::string& name, const DesignSample& sample);
  /// Writes the results, if anything is new or there is no file. Throws RunError, with everything kept as it was.
  void finish(const DesignResult& result);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace equipoise
