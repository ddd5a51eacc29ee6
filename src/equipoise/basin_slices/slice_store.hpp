// A map's results, kept as they come and resumable.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/basin_slices/pixel_store.hpp"
#include "equipoise/io/journal.hpp"
#include "equipoise/result_files/slice_netcdf.hpp"
#include "equipoise/results/basin_slice.hpp"
#include "equipoise/running/search_log.hpp"

namespace equipoise {

/// Two files, as BasinFile has them: the results, `path`, in NetCDF (map_file.hpp), written whole; and while a run goes
/// on `path`.part with what is new.
class SliceStore : public PixelStore {
 public:
  /// Opens what both hold of the same study, axes, version and arithmetic, or begins anew. Throws InputError if they
  /// cannot be written, are in use, damaged, or hold something else: which, it says.
  SliceStore(const std::string& path, const io::SliceFileHeader& header);

  /// Whether `path` holds the whole map.
  bool complete() const { return file_ && file_->complete(); }
  /// Whether something is not in `path` yet.
  bool unfinished() const { return !pieces_.empty(); }
  /// Pixels that were computed, in any order and some perhaps twice.
  void for_each_known(const std::function<void(std::uint32_t position, short code)>& visit) const;
  /// The codes that those of motions have; some are perhaps there twice.
  const std::vector<OutcomeShare>& codes() const { return codes_; }
  /// States on motions that were first met during earlier runs, in the order of starts: enough to name them again.
  const std::vector<std::vector<double>>& discoveries() const { return discoveries_; }

  /// On disk within about a second of work. Throws RunError, with all before them kept, if the disk cannot take them.
  void append(const std::vector<std::uint32_t>& positions, const std::vector<SlicePixel>& pixels) override;
  /// A code that pixels have from now on.
  void append_code(const OutcomeShare& code);
  void append_attractor_search(const std::vector<double>& state);
  /// Of the search for attractors, as far as runs came that did not finish. Not of a map that is complete.
  SearchLog& notes() { return *notes_; }
  /// Of a map that is not complete, only what was computed.
  void read_rows(int first, int rows, SlicePixel* pixels) const override;

  /// `write` gets a path and writes the results there. Then removes the unfinished part, but for the search
  /// of a map that is not `complete`. Throws RunError, with everything kept as it was, if the disk cannot take them.
  void finish(const std::function<void(const std::string& path)>& write, bool complete);

 private:
  // Pixels of a record of the journal; between the first and the last one there may be others.
  struct Piece {
    std::uint32_t first = 0, last = 0;
    io::Journal::Record record;
  };

  void require_same(const std::string& there, const std::string& of) const;
  void open_results();
  void take(const io::Journal::Record& record);
  void take_name(const io::Journal::Record& record);
  void take_pixels(const io::Journal::Record& record);
  [[noreturn]] void refuse_part() const;
  void keep(io::Journal::Record record, const void* payload, std::size_t bytes);
  void visit(const Piece& piece, const std::function<void(std::uint32_t, const SlicePixel&)>& visit) const;

  const std::string path_;
  const io::SliceFileHeader header_;
  const std::uint64_t size_;  // of the map, in pixels
  io::Journal journal_;
  std::optional<io::SliceReader> file_;
  std::vector<OutcomeShare> codes_;
  std::vector<std::vector<double>> discoveries_;
  std::vector<Piece> pieces_;
  std::unique_ptr<SearchLog> notes_;
};

}  // namespace equipoise
