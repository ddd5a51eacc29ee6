// A map's results, kept as they come and resumable.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "equipoise/results/plane_map.hpp"
#include "equipoise/store/map_netcdf.hpp"
#include "equipoise/maps/pixel_store.hpp"

namespace equipoise {

class Notes;

/// Two files, as BasinFile has them: the results, `path`, in NetCDF (map_file.hpp), written whole; and while a run goes
/// on `path`.part with what is new.
class MapStore : public PixelStore {
 public:
  /// Opens what both hold of the same study, axes, version and arithmetic, or begins anew. Throws InputError if they
  /// cannot be written, are in use, damaged, or hold something else: which, it says.
  MapStore(const std::string& path, const store::MapFileHeader& header);
  ~MapStore() override;
  MapStore(const MapStore&) = delete;
  MapStore& operator=(const MapStore&) = delete;

  /// Whether `path` holds the whole map.
  bool complete() const;
  /// Whether something is not in `path` yet.
  bool unfinished() const;
  /// Pixels that were computed, in any order and some perhaps twice.
  void for_each_known(const std::function<void(std::uint32_t position, short code)>& visit) const;
  /// The codes that those of motions have; some are perhaps there twice.
  const std::vector<OutcomeShare>& codes() const;
  /// States on motions that were first met during earlier runs, in the order of starts: enough to name them again.
  const std::vector<std::vector<double>>& discoveries() const;

  /// On disk within about a second of work. Throws
  /// RunError, with all before them kept, if the disk cannot take them.
  void append(const std::vector<std::uint32_t>& positions, const std::vector<MapPixel>& pixels) override;
  /// A code that pixels have from now on.
  void append_code(const OutcomeShare& code);
  void append_discovery(const std::vector<double>& state);
  /// Of the search for attractors, as far as runs came that did not finish. Not of a map that is complete.
  Notes& notes();
  /// Of a map that is not complete, only what was computed.
  void read_rows(int first, int rows, MapPixel* pixels) const override;

  /// `write` gets a path and writes the results there. Then removes the unfinished part, but for the search
  /// of a map that is not `complete`. Throws RunError, with everything kept as it was, if the disk cannot take them.
  void finish(const std::function<void(const std::string& path)>& write, bool complete);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace equipoise
